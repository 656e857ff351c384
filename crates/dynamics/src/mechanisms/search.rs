//! The search for what bodies touch that are solved together.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    CoefficientCombineRule, Collider, ColliderHandle, RigidBody, RigidBodyHandle,
};

use super::ghosts;
use super::points::{Pair, Point};
use super::surroundings::NearPair;
use crate::bodies::Tag;
use crate::contacts::{self, ColliderPair, ContactResponse, Verdicts, pair_of, tags};
use crate::convert::from_vector;
use crate::world::World;
use scene::Handle;

/// Largest number of contact points that are solved together.
const MAX_POINTS: usize = 128;

#[derive(Clone, Copy)]
struct Surface {
    friction: f64,
    restitution: f64,
}

/// What the search looks for.
#[derive(Clone, Copy)]
pub(super) struct Conditions<'a> {
    /// Mechanism and body of linked shapes.
    pub places: &'a BTreeMap<Handle, (usize, usize)>,
    pub verdicts: &'a Verdicts,
    /// Seconds.
    pub step: f64,
    /// Largest number of free bodies that are solved together.
    pub max_guests: usize,
    /// Distance up to which surfaces count as near though their bodies hardly move, metres.
    pub slack: f64,
    /// Bodies that are left to rapier with all that touches them.
    pub is_refused: &'a dyn Fn(RigidBodyHandle, Handle) -> bool,
}

/// The mechanism that is to solve its contacts.
pub(super) struct Touching<'a> {
    pub mechanism: usize,
    /// Number of its bodies; guests come after them.
    pub linked: usize,
    /// The colliders of those that move.
    pub colliders: &'a [ColliderHandle],
    /// Index of those that do not.
    pub bases: &'a BTreeMap<Handle, usize>,
}

/// The search for what a mechanism touches.
pub(super) struct Search<'a> {
    world: &'a World,
    conditions: Conditions<'a>,
    touching: Touching<'a>,
    pub guests: Vec<Handle>,
    /// Colliders still to be looked at.
    queue: Vec<ColliderHandle>,
    seen: BTreeSet<ColliderPair>,
    pub points: Vec<Point>,
    /// A mechanism that is near this one or one of its guests.
    pub meeting: Option<usize>,
}

/// What is at one side of a pair.
#[derive(Clone, Copy)]
enum Side {
    Obstacle,
    Body(usize),
}

impl Side {
    fn body(self) -> Option<usize> {
        match self {
            Self::Obstacle => None,
            Self::Body(index) => Some(index),
        }
    }
}

impl<'a> Search<'a> {
    pub(super) fn new(
        world: &'a World,
        conditions: Conditions<'a>,
        touching: Touching<'a>,
    ) -> Self {
        Self {
            world,
            conditions,
            queue: touching.colliders.to_vec(),
            touching,
            guests: Vec::new(),
            seen: BTreeSet::new(),
            points: Vec::new(),
            meeting: None,
        }
    }

    /// Finds guests and points; None when they are to be left to rapier.
    pub(super) fn run(&mut self, pairs: &mut BTreeMap<ColliderPair, Pair>) -> Option<()> {
        while let Some(collider) = self.queue.pop() {
            for colliders in self.world.near(collider, self.conditions.step) {
                if self.may_touch(colliders) && self.seen.insert(pair_of(colliders)) {
                    self.look_at(colliders, pairs)?;
                }
            }
            if self.points.len() > MAX_POINTS || self.guests.len() > self.conditions.max_guests {
                return None;
            }
        }
        ghosts::remove_seams(&mut self.points, &self.world.colliders);
        Some(())
    }

    /// Finds the points of pairs that are known to be near: all others are too far away.
    pub(super) fn look_at_known(
        &mut self,
        near: &[NearPair],
        pairs: &mut BTreeMap<ColliderPair, Pair>,
    ) -> Option<()> {
        for pair in near {
            if !pair.is_apart(self.world, self.conditions.slack) {
                self.look_at(pair.colliders, pairs)?;
            }
        }
        if self.points.len() > MAX_POINTS {
            return None;
        }
        ghosts::remove_seams(&mut self.points, &self.world.colliders);
        Some(())
    }

    /// Whether two colliders are of different bodies and no mask forbids that they touch: the pieces of a robot's own links have hundreds of pairs.
    fn may_touch(&self, colliders: [ColliderHandle; 2]) -> bool {
        let Some([first, second]) = self.world.known.both(colliders) else {
            return false;
        };
        let tags = [first, second].map(|known| Tag::unpack(known.tag));
        let response = self.conditions.verdicts.response(tags[0], tags[1]);
        first.body != second.body && response != ContactResponse::NoCollision
    }

    /// Adds the points of a pair, and its guest; None when the mechanism cannot solve it.
    fn look_at(
        &mut self,
        handles: [ColliderHandle; 2],
        pairs: &mut BTreeMap<ColliderPair, Pair>,
    ) -> Option<()> {
        let [Some(first), Some(second)] = handles.map(|handle| self.world.colliders.get(handle))
        else {
            return Some(());
        };
        let Some([a, b]) = tags(&self.world.colliders, handles[0], handles[1]) else {
            return Some(());
        };
        let is_possible =
            first.parent() != second.parent() && first.is_enabled() && second.is_enabled();
        let response = self.conditions.verdicts.response(a, b);
        let Some(surface) = surface(first, second, response).filter(|_| is_possible) else {
            return Some(());
        };
        let reach = self.reach([first, second]);
        let pair = pairs.entry(pair_of(handles)).or_default();
        pair.mechanism = self.touching.mechanism;
        pair.response = response;
        pair.touches = pair.update(first, second, reach);
        // rapier would prepare contacts at larger distances.
        pair.is_solved = pair.touches || self.touching.linked == 0;
        if !pair.touches {
            return Some(());
        }
        let bodies = [self.side(first, a)?, self.side(second, b)?].map(Side::body);
        let base = [a, b]
            .into_iter()
            .find_map(|tag| self.touching.bases.get(&tag.shape).copied());
        let mut points = pair.points(handles, first, second, reach);
        let is_free = |body: Option<usize>| body.is_some_and(|body| body >= self.touching.linked);
        if bodies.into_iter().any(is_free) && self.pass_by([first, second], &points) {
            return Some(());
        }
        for point in &mut points {
            point.mechanism = self.touching.mechanism;
            point.shapes = [a.shape, b.shape];
            (point.contact.bodies, point.contact.base) = (bodies, base);
            (point.contact.friction, point.contact.restitution) =
                (surface.friction, surface.restitution);
            let (place, normal) = (point.place(), point.normal);
            let (world, colliders) = (self.world, [first, second]);
            let along = world
                .surfaces
                .velocity(colliders, &world.bodies, place, normal);
            point.contact.velocity = from_vector(self.obstacle_velocity(colliders, place) + along);
        }
        self.points.extend(points);
        Some(())
    }

    /// How near the surfaces of two colliders have to be to touch in this sub-step.
    fn reach(&self, colliders: [&Collider; 2]) -> f64 {
        if self.touching.linked > 0 {
            return self.conditions.slack;
        }
        let ways = colliders.map(|collider| self.world.way(collider, self.conditions.step));
        self.conditions.slack + ways.iter().sum::<f64>()
    }

    /// Whether bodies that do not touch yet will not in this sub-step either.
    fn pass_by(&self, colliders: [&Collider; 2], points: &[Point]) -> bool {
        let nearest = points
            .iter()
            .min_by(|a, b| a.contact.distance.total_cmp(&b.contact.distance));
        let Some(nearest) = nearest else { return true };
        let [first, second] = colliders.map(|collider| {
            self.world
                .way_of_point(collider, nearest.place(), self.conditions.step)
        });
        let way = first - second;
        let comes_near = way.dot(nearest.normal) < -nearest.contact.distance;
        comes_near && nearest.contact.distance > ghosts::CLEARANCE && !ghosts::meet(colliders, way)
    }

    /// What a collider belongs to; None for another mechanism.
    fn side(&mut self, collider: &Collider, tag: Tag) -> Option<Side> {
        let Touching {
            mechanism, linked, ..
        } = self.touching;
        if let Some(&(other, body)) = self.conditions.places.get(&tag.shape) {
            if other != mechanism {
                self.meeting = Some(other);
                return None;
            }
            return Some(Side::Body(body));
        }
        let handle = collider.parent()?;
        let rigid = self.world.bodies.get(handle)?;
        if !rigid.is_dynamic() {
            return Some(Side::Obstacle);
        }
        if let Some(known) = self.guests.iter().position(|&guest| guest == tag.shape) {
            return Some(Side::Body(linked + known));
        }
        if (self.conditions.is_refused)(handle, tag.shape) || self.world.has_joints(handle) {
            return None;
        }
        self.guests.push(tag.shape);
        self.queue.extend(rigid.colliders());
        Some(Side::Body(linked + self.guests.len() - 1))
    }

    /// Velocity of the second shape relative to the first at a point, as far as no force moves them.
    fn obstacle_velocity(&self, colliders: [&Collider; 2], place: Vector) -> Vector {
        let velocity = |collider: &Collider| {
            let rigid = collider
                .parent()
                .and_then(|body| self.world.bodies.get(body));
            rigid.map_or(Vector::ZERO, |rigid| {
                velocity_at(rigid, place, self.conditions.step)
            })
        };
        velocity(colliders[1]) - velocity(colliders[0])
    }
}

fn surface(first: &Collider, second: &Collider, response: ContactResponse) -> Option<Surface> {
    let combine = CoefficientCombineRule::combine;
    let restitutions = (
        first.restitution_combine_rule(),
        second.restitution_combine_rule(),
    );
    match response {
        ContactResponse::NoCollision => None,
        ContactResponse::Collide {
            friction,
            restitution,
        } => Some(Surface {
            friction,
            restitution,
        }),
        ContactResponse::Default => Some(Surface {
            friction: contacts::friction(first, second),
            restitution: combine(
                first.restitution(),
                second.restitution(),
                restitutions.0,
                restitutions.1,
            ),
        }),
    }
}

/// Velocity of a body that no force moves at a point; zero for others.
fn velocity_at(rigid: &RigidBody, place: Vector, step: f64) -> Vector {
    if !rigid.is_kinematic() {
        return Vector::ZERO;
    }
    let local = rigid.position().inverse_transform_point(place);
    (*rigid.next_position() * local - place) / step
}
