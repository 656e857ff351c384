//! What something soft may touch in a sub-step.

use std::collections::BTreeMap;

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d_f64::parry::query::{ClosestPoints, Ray, closest_points};
use rapier3d_f64::parry::shape::{Segment, Shape, Triangle};
use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryFilter, RigidBody};
use soft::V3;

use super::coupling::Coupled;
use super::part::Part;
use super::{Placed, Start};
use crate::bodies::{Bodies, Tag};
use crate::convert::from_vector;
use crate::world::World;

/// Distance at which contacts are prepared beside what both sides move, metres.
const SLACK: f64 = 1e-3;
/// Farthest that a point may be beneath the surface on its side, metres, beside its reach.
const MAX_DEPTH: f64 = 0.05;
/// Cosine of the angle between normals at which a point counts as behind an obstacle.
const OPPOSITE: f64 = -0.5;
/// Weight of a corner below which a point is on the side opposite to it.
const EDGE: f64 = 1e-6;

/// For nodes near a collider (by its index) the side of its surface on which they are: normals, which point to them.
pub(super) type Sides = BTreeMap<(u32, usize), V3>;

/// The search for one rope, cloth or volume.
pub(super) struct Search<'a> {
    pub number: usize,
    /// Found in the sub-step before.
    pub sides: &'a Sides,
    pub placed: &'a Placed,
    pub bodies: &'a Bodies,
    pub world: &'a World,
    pub start: Start<'a>,
}

/// What a search finds.
pub(super) struct Found<P: Part> {
    pub contacts: Vec<P::Contact>,
    pub sides: Sides,
}

/// Something near it.
pub(super) struct Obstacle<'a> {
    pub handle: ColliderHandle,
    collider: &'a Collider,
    rigid: &'a RigidBody,
    tag: Tag,
    pub friction: f64,
    /// How near a point of what is soft has to come.
    pub reach: f64,
    /// Where that may be.
    pub bounds: Aabb,
}

/// A point of a surface near one of what is soft.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub point: V3,
    pub normal: V3,
    pub distance: f64,
}

impl Search<'_> {
    pub(super) fn run<P: Part>(&self, part: &P, found: &mut Found<P>, coupled: &mut Coupled) {
        let Some(bounds) = self.bounds(part) else {
            return;
        };
        let query = self.world.broad_phase.as_query_pipeline(
            self.world.narrow_phase.query_dispatcher(),
            &self.world.bodies,
            &self.world.colliders,
            QueryFilter::default(),
        );
        let around = query.intersect_aabb_conservative(bounds);
        let mut near: Vec<ColliderHandle> = around.map(|(handle, _)| handle).collect();
        near.sort_unstable_by_key(|handle| handle.into_raw_parts());
        for handle in near {
            self.touch(part, handle, found, coupled);
        }
    }

    /// How far a node goes in this sub-step at most.
    fn way(&self, part: &impl Part) -> f64 {
        let fall = V3::from(self.start.gravity).norm() * self.start.step;
        (part.fastest() + fall) * self.start.step
    }

    /// Where it may be in this sub-step.
    fn bounds(&self, part: &impl Part) -> Option<Aabb> {
        let points: Vec<Vector> = (0..part.len())
            .map(|node| place(part.point(node)))
            .collect();
        let is_somewhere = points.iter().all(|point| point.is_finite());
        let way = part.radius() + SLACK + self.way(part);
        is_somewhere.then(|| Aabb::from_points(points).loosened(way))
    }

    fn touch<P: Part>(
        &self,
        part: &P,
        handle: ColliderHandle,
        found: &mut Found<P>,
        coupled: &mut Coupled,
    ) {
        let Some(obstacle) = self.obstacle(part, handle) else {
            return;
        };
        let nodes = self.near_nodes(part, &obstacle);
        let index = handle.into_raw_parts().0;
        let known = nodes.iter().enumerate();
        let sides = known.filter_map(|(node, near)| Some(((index, node), (*near)?.normal)));
        found.sides.extend(sides);
        let mut touches = part.touches(self, &obstacle, nodes);
        if !touches.is_empty()
            && obstacle.rigid.is_dynamic()
            && let Some(body) = self.bodies.get(obstacle.tag.shape)
        {
            let number = coupled.add(obstacle.tag.shape, body.rigid);
            touches
                .iter_mut()
                .for_each(|contact| P::is_with(contact, number));
        }
        found.contacts.append(&mut touches);
    }

    fn obstacle(&self, part: &impl Part, handle: ColliderHandle) -> Option<Obstacle<'_>> {
        let collider = self.world.colliders.get(handle)?;
        let rigid = self.world.bodies.get(collider.parent()?)?;
        let tag = Tag::unpack(collider.user_data);
        let response = self.start.verdicts.response(self.placed.tag(), tag);
        let friction = self.placed.friction_in(response, collider.friction())?;
        let ways = self.way(part) + self.world.way(collider, self.start.step);
        let reach = part.radius() + SLACK + ways;
        collider.is_enabled().then(|| Obstacle {
            handle,
            collider,
            rigid,
            tag,
            friction,
            reach,
            bounds: collider.compute_aabb().loosened(reach),
        })
    }

    /// Whether a node is in or at the object that holds it there.
    pub(super) fn is_exempt(&self, node: usize, obstacle: &Obstacle) -> bool {
        let mut held = self.placed.held.iter();
        held.any(|held| held.exempts(node, obstacle.tag.shape))
    }

    /// For each node the nearest point of an obstacle, where it is near and may touch it.
    fn near_nodes(&self, part: &impl Part, obstacle: &Obstacle) -> Vec<Option<Near>> {
        let index = obstacle.handle.into_raw_parts().0;
        let of_node = |node: usize| {
            let point = place(part.point(node));
            let is_near =
                obstacle.bounds.contains_local_point(point) && !self.is_exempt(node, obstacle);
            let side = self.sides.get(&(index, node));
            is_near.then(|| obstacle.nearest(point, side)).flatten()
        };
        (0..part.len()).map(of_node).collect()
    }
}

pub(super) fn place(point: V3) -> Vector {
    Vector::new(point.x, point.y, point.z)
}

impl Obstacle<'_> {
    /// The point of the surface nearest to a point. What has come to be within the obstacle, or behind it, is nearest to the side on which it was.
    fn nearest(&self, point: Vector, side: Option<&V3>) -> Option<Near> {
        let near = self.projected(point)?;
        let has_passed = |side: &&V3| near.distance < 0.0 || near.normal.dot(side) < OPPOSITE;
        let side = side.filter(has_passed);
        side.and_then(|side| self.beneath(point, side))
            .or(Some(near))
    }

    /// The surface above a point that is within the obstacle or behind it, seen along a direction.
    fn beneath(&self, point: Vector, side: &V3) -> Option<Near> {
        let up = place(*side);
        let (pose, shape) = (self.collider.position(), self.collider.shape());
        let cast = |from: Vector, is_solid: bool| {
            let ray = Ray::new(from, up);
            shape.cast_ray_and_get_normal(pose, &ray, self.reach + MAX_DEPTH, is_solid)
        };
        let entry = cast(point, true)?.time_of_impact;
        let exit = cast(point + up * (entry + 1e-9), false)?;
        let surface = point + up * (entry + exit.time_of_impact);
        let normal = if exit.normal.dot(up) < 0.0 {
            -exit.normal
        } else {
            exit.normal
        };
        let depth = (surface - point).dot(normal);
        Some(Near {
            point: V3::from(from_vector(point + normal * depth)),
            normal: V3::from(from_vector(normal)),
            distance: -depth,
        })
    }

    fn projected(&self, point: Vector) -> Option<Near> {
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
    pub(super) fn nearest_on_edge(&self, ends: [V3; 2], reach: f64) -> Option<(f64, Near)> {
        let [from, to] = ends.map(place);
        let (on_edge, near) = self.nearest_on(&Segment::new(from, to), reach)?;
        let along = to - from;
        let weight = (on_edge - from).dot(along) / along.length_squared();
        let is_within = (EDGE..=1.0 - EDGE).contains(&weight);
        is_within.then_some((weight, near))
    }

    /// Where a triangle is nearest to the surface, if that is nearer than `reach` and not at a corner: weights of the corners.
    pub(super) fn nearest_on_triangle(
        &self,
        corners: [V3; 3],
        reach: f64,
    ) -> Option<([f64; 3], Near)> {
        let [a, b, c] = corners.map(place);
        let (point, near) = self.nearest_on(&Triangle::new(a, b, c), reach)?;
        let (ab, ac, ap) = (b - a, c - a, point - a);
        let normal = ab.cross(ac);
        let area = normal.length_squared();
        let third = ab.cross(ap).dot(normal) / area;
        let second = ap.cross(ac).dot(normal) / area;
        let weights = [1.0 - second - third, second, third];
        let is_corner = weights.iter().any(|weight| *weight > 1.0 - EDGE);
        let is_sound = weights.iter().all(|weight| weight.is_finite());
        (is_sound && !is_corner).then_some((weights, near))
    }

    /// Where a shape of the world is nearest to the surface, if that is nearer than `reach`.
    fn nearest_on(&self, own: &dyn Shape, reach: f64) -> Option<(Vector, Near)> {
        if reach <= 0.0 {
            return None;
        }
        let (place, shape) = (self.collider.position(), self.collider.shape());
        let found = closest_points(&EnginePose::IDENTITY, own, place, shape, reach).ok()?;
        let ClosestPoints::WithinMargin(on_own, on_surface) = found else {
            return None;
        };
        let apart = on_own - on_surface;
        let distance = apart.length();
        if distance < 1e-9 || distance >= reach {
            return None;
        }
        let near = Near {
            point: V3::from(from_vector(on_surface)),
            normal: V3::from(from_vector(apart / distance)),
            distance,
        };
        Some((on_own, near))
    }

    /// Velocity of the surface, if no force moves it.
    pub(super) fn velocity_at(&self, point: V3, step: f64) -> V3 {
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
