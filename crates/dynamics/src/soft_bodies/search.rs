//! What a rope may touch in a sub-step.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d_f64::parry::query::{ClosestPoints, closest_points};
use rapier3d_f64::parry::shape::Segment;
use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryFilter, RigidBody};
use soft::{Contact, Rod, Surface, Touch, V3};

use super::coupling::Coupled;
use super::{Placed, Start};
use crate::bodies::{Bodies, Tag};
use crate::convert::from_vector;
use crate::world::World;

/// Distance at which contacts are prepared beside what both sides move, metres.
const SLACK: f64 = 1e-3;
/// An edge is nearer than its ends where it is so by this part of the radius.
const NEARER: f64 = 1e-3;

/// The search for one rope.
pub(super) struct Search<'a> {
    pub number: usize,
    pub placed: &'a Placed,
    pub rod: &'a Rod,
    pub bodies: &'a Bodies,
    pub world: &'a World,
    pub start: Start<'a>,
}

/// Something near the rope.
struct Obstacle<'a> {
    handle: ColliderHandle,
    collider: &'a Collider,
    rigid: &'a RigidBody,
    tag: Tag,
    friction: f64,
    /// How near the axis of the rope has to come.
    reach: f64,
}

/// A point of a surface near one of the rope.
struct Near {
    point: V3,
    normal: V3,
    distance: f64,
}

impl Search<'_> {
    pub(super) fn run(&self, contacts: &mut Vec<Contact>, coupled: &mut Coupled) {
        let Some(bounds) = self.bounds() else {
            return;
        };
        let query = self.world.broad_phase.as_query_pipeline(
            self.world.narrow_phase.query_dispatcher(),
            &self.world.bodies,
            &self.world.colliders,
            QueryFilter::default(),
        );
        let found = query.intersect_aabb_conservative(bounds);
        let mut near: Vec<ColliderHandle> = found.map(|(handle, _)| handle).collect();
        near.sort_unstable_by_key(|handle| handle.into_raw_parts());
        for handle in near {
            self.touch(handle, contacts, coupled);
        }
    }

    fn fastest(&self) -> f64 {
        let speeds = (0..self.rod.len()).map(|node| self.rod.velocity(node).norm());
        let fall = V3::from(self.start.gravity).norm() * self.start.step;
        speeds.fold(0.0, f64::max) + fall
    }

    /// Where the rope may be in this sub-step.
    fn bounds(&self) -> Option<Aabb> {
        let points: Vec<Vector> = self
            .rod
            .points()
            .map(|p| Vector::new(p.x, p.y, p.z))
            .collect();
        let is_somewhere = points.iter().all(|point| point.is_finite());
        let way = self.rod.material.radius + SLACK + self.fastest() * self.start.step;
        is_somewhere.then(|| Aabb::from_points(points).loosened(way))
    }

    fn touch(&self, handle: ColliderHandle, contacts: &mut Vec<Contact>, coupled: &mut Coupled) {
        let Some(obstacle) = self.obstacle(handle) else {
            return;
        };
        let start = contacts.len();
        self.find_points(&obstacle, contacts);
        if contacts.len() > start
            && obstacle.rigid.is_dynamic()
            && let Some(body) = self.bodies.get(obstacle.tag.shape)
        {
            let number = coupled.add(obstacle.tag.shape, body.rigid);
            for contact in &mut contacts[start..] {
                contact.surface = Surface::Body(number);
            }
        }
    }

    fn obstacle(&self, handle: ColliderHandle) -> Option<Obstacle<'_>> {
        let collider = self.world.colliders.get(handle)?;
        let rigid = self.world.bodies.get(collider.parent()?)?;
        let tag = Tag::unpack(collider.user_data);
        let response = self.start.verdicts.response(self.placed.tag(), tag);
        let friction = self.placed.friction_in(response, collider.friction())?;
        let ways = self.fastest() * self.start.step + self.world.way(collider, self.start.step);
        collider.is_enabled().then_some(Obstacle {
            handle,
            collider,
            rigid,
            tag,
            friction,
            reach: self.rod.material.radius + SLACK + ways,
        })
    }

    fn find_points(&self, obstacle: &Obstacle, contacts: &mut Vec<Contact>) {
        let bounds = obstacle.collider.compute_aabb().loosened(obstacle.reach);
        let nodes: Vec<Option<Near>> = (0..self.rod.len())
            .map(|node| {
                let point = self.point(node);
                let is_near = bounds.contains_local_point(point) && !self.is_exempt(node, obstacle);
                is_near.then(|| obstacle.nearest(point)).flatten()
            })
            .collect();
        for edge in 0..self.rod.len() - 1 {
            let ends = [self.point(edge), self.point(edge + 1)];
            let around = Aabb::from_points(ends);
            let is_exempt = [edge, edge + 1]
                .iter()
                .any(|node| self.is_exempt(*node, obstacle));
            if self.rod.is_broken(edge) || is_exempt || !around.intersects(&bounds) {
                continue;
            }
            let of_ends = nodes[edge..=edge + 1]
                .iter()
                .flatten()
                .map(|near| near.distance);
            let nearest =
                of_ends.fold(obstacle.reach, f64::min) - NEARER * self.rod.material.radius;
            if let Some((weight, near)) = obstacle.nearest_on(ends, nearest) {
                contacts.push(self.contact(edge, weight, &near, obstacle, true));
            }
        }
        for (node, near) in nodes.iter().enumerate() {
            if let Some(near) = near.as_ref().filter(|near| near.distance < obstacle.reach) {
                let edge = node.min(self.rod.len() - 2);
                let weight = (node - edge) as f64;
                contacts.push(self.contact(edge, weight, near, obstacle, false));
            }
        }
    }

    fn point(&self, node: usize) -> Vector {
        let point = self.rod.point(node);
        Vector::new(point.x, point.y, point.z)
    }

    /// Whether a node is in or at the object that holds the rope there.
    fn is_exempt(&self, node: usize, obstacle: &Obstacle) -> bool {
        let mut held = self.placed.held.iter();
        held.any(|held| held.exempts(node, obstacle.tag.shape))
    }

    fn contact(
        &self,
        edge: usize,
        weight: f64,
        near: &Near,
        obstacle: &Obstacle,
        is_between: bool,
    ) -> Contact {
        let last = u64::from(weight == 1.0) << 1;
        let key = u64::from(obstacle.handle.into_raw_parts().0) << 2 | last | u64::from(is_between);
        Contact {
            rod: self.number,
            edge,
            weight,
            surface: Surface::Obstacle(obstacle.velocity_at(near.point, self.start.step)),
            touch: Touch::new(near.point, near.normal, obstacle.friction),
            key,
        }
    }
}

impl Obstacle<'_> {
    /// The point of the surface nearest to a point.
    fn nearest(&self, point: Vector) -> Option<Near> {
        let shape = self.collider.shape();
        let found = shape.project_point(self.collider.position(), point, false);
        let apart = point - found.point;
        let distance = apart.length();
        if distance < 1e-9 || !distance.is_finite() {
            return None;
        }
        let sign = if found.is_inside { -1.0 } else { 1.0 };
        Some(Near {
            point: V3::from(from_vector(found.point)),
            normal: V3::from(from_vector(apart / distance)) * sign,
            distance: distance * sign,
        })
    }

    /// Where an edge is nearest to the surface, if that is nearer than `reach` and not at its ends.
    fn nearest_on(&self, [from, to]: [Vector; 2], reach: f64) -> Option<(f64, Near)> {
        if reach <= 0.0 {
            return None;
        }
        let segment = Segment::new(from, to);
        let (place, shape) = (self.collider.position(), self.collider.shape());
        let found = closest_points(&EnginePose::IDENTITY, &segment, place, shape, reach).ok()?;
        let ClosestPoints::WithinMargin(on_edge, on_surface) = found else {
            return None;
        };
        let along = to - from;
        let weight = (on_edge - from).dot(along) / along.length_squared();
        let apart = on_edge - on_surface;
        let distance = apart.length();
        if !(1e-6..=1.0 - 1e-6).contains(&weight) || distance < 1e-9 || distance >= reach {
            return None;
        }
        let near = Near {
            point: V3::from(from_vector(on_surface)),
            normal: V3::from(from_vector(apart / distance)),
            distance,
        };
        Some((weight, near))
    }

    /// Velocity of the surface, if no force moves it.
    fn velocity_at(&self, point: V3, step: f64) -> V3 {
        if !self.rigid.is_kinematic() {
            return V3::zeros();
        }
        let place = Vector::new(point.x, point.y, point.z);
        let local = self.rigid.position().inverse_transform_point(place);
        V3::from(from_vector(
            (*self.rigid.next_position() * local - place) / step,
        ))
    }
}
