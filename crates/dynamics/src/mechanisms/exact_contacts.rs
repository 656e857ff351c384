//! Contacts that mechanisms solve exactly, together with their joints (`articulation::Contact`): with what no force moves, with free bodies
//! that touch the mechanism (guests) and what those touch in turn, and of links with each other. So a light foot is as hard as all that stands
//! on it. rapier leaves these pairs out.
//!
//! A mechanism that touches another one, or too much, is left to rapier, with its joints as impulse joints.

use std::collections::{BTreeMap, BTreeSet};

use articulation::Contact;
use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::details::ContactManifoldsWorkspace;
use rapier3d_f64::parry::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, TrackedContact,
};
use rapier3d_f64::prelude::{CoefficientCombineRule, Collider, ColliderHandle, RigidBody};

use crate::bodies::Tag;
use crate::contacts::{self, ColliderPair, ContactResponse, Verdicts, pair_of, tags};
use crate::convert::{from_vector, to_vector};
use crate::world::{PREDICTION_DISTANCE, World};
use scene::Handle;

/// Largest number of contact points of one surface that are solved.
const MAX_GROUP_POINTS: usize = 4;
/// Cosine of the largest angle between the normals of points of one surface.
const MIN_NORMAL_COSINE: f64 = 0.99;
/// Largest number of contact points that a mechanism solves.
const MAX_POINTS: usize = 128;
/// Largest number of free bodies that are solved together with a mechanism.
const MAX_GUESTS: usize = 12;

type Manifold = ContactManifold<(), [f64; 3]>;

/// The contacts that mechanisms solve.
#[derive(Default)]
pub(crate) struct ExactContacts {
    pairs: BTreeMap<ColliderPair, Pair>,
    points: Vec<Point>,
}

/// Two colliders that are near each other.
#[derive(Default)]
struct Pair {
    mechanism: usize,
    manifolds: Vec<Manifold>,
    workspace: Option<ContactManifoldsWorkspace>,
    touches: bool,
}

#[derive(Clone, Copy)]
struct Surface {
    friction: f64,
    restitution: f64,
}

/// A point of a pair in the present sub-step.
pub(crate) struct Point {
    pair: ColliderPair,
    /// Indices of the manifold and of the point there.
    index: (usize, usize),
    mechanism: usize,
    pub shapes: [Handle; 2],
    contact: Contact,
    /// On the first shape.
    pub impulse: Vector,
    /// Points to the first shape.
    pub normal: Vector,
}

impl Point {
    pub(crate) fn place(&self) -> Vector {
        to_vector(self.contact.point)
    }
}

/// The search for what a mechanism touches.
struct Search<'a> {
    world: &'a World,
    places: &'a BTreeMap<Handle, (usize, usize)>,
    verdicts: &'a Verdicts,
    step: f64,
    mechanism: usize,
    /// Number of bodies of the mechanism, before its guests.
    linked: usize,
    bases: &'a BTreeMap<Handle, usize>,
    guests: Vec<Handle>,
    /// Colliders still to be looked at.
    queue: Vec<ColliderHandle>,
    seen: BTreeSet<ColliderPair>,
    points: Vec<Point>,
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

impl ExactContacts {
    /// Forgets the points of the sub-step before.
    pub(super) fn clear(&mut self) {
        self.points.clear();
        for pair in self.pairs.values_mut() {
            pair.touches = false;
        }
    }

    /// Finds what a mechanism touches; returns its guests, or None when it is left to rapier. `places`: mechanism and body of linked shapes.
    pub(super) fn find(
        &mut self,
        world: &World,
        places: &BTreeMap<Handle, (usize, usize)>,
        verdicts: &Verdicts,
        step: f64,
        touching: Touching<'_>,
    ) -> Option<Vec<Handle>> {
        let Touching {
            mechanism,
            linked,
            colliders,
            bases,
        } = touching;
        let mut search = Search {
            world,
            places,
            verdicts,
            step,
            mechanism,
            linked,
            bases,
            guests: Vec::new(),
            queue: colliders.to_vec(),
            seen: BTreeSet::new(),
            points: Vec::new(),
        };
        let found = search.run(&mut self.pairs);
        if found.is_none() {
            self.pairs.retain(|_, pair| pair.mechanism != mechanism);
            return None;
        }
        self.points.append(&mut search.points);
        Some(search.guests)
    }

    /// The contacts of a mechanism.
    pub(super) fn of(&self, mechanism: usize) -> Vec<Contact> {
        self.points
            .iter()
            .filter(|point| point.mechanism == mechanism)
            .map(|point| point.contact)
            .collect()
    }

    /// Stores what the contacts of a mechanism exert.
    pub(super) fn store(&mut self, mechanism: usize, impulses: impl Iterator<Item = [f64; 3]>) {
        let points = self
            .points
            .iter_mut()
            .filter(|point| point.mechanism == mechanism);
        for (point, impulse) in points.zip(impulses) {
            point.impulse = to_vector(impulse);
            let (manifold, index) = point.index;
            if let Some(pair) = self.pairs.get_mut(&point.pair) {
                pair.manifolds[manifold].points[index].data = impulse;
            }
        }
    }

    /// Leaves the contacts of a mechanism to rapier.
    pub(super) fn leave(&mut self, mechanism: usize) {
        self.points.retain(|point| point.mechanism != mechanism);
        self.pairs.retain(|_, pair| pair.mechanism != mechanism);
    }

    /// The pairs that mechanisms solve, rising; pairs that are no longer near are forgotten.
    pub(crate) fn pairs(&mut self) -> Vec<ColliderPair> {
        self.pairs.retain(|_, pair| pair.touches);
        self.pairs.keys().copied().collect()
    }

    /// The points of the present sub-step.
    pub(crate) fn points(&self) -> &[Point] {
        &self.points
    }
}

impl Search<'_> {
    fn run(&mut self, pairs: &mut BTreeMap<ColliderPair, Pair>) -> Option<()> {
        while let Some(collider) = self.queue.pop() {
            for pair in self.world.narrow_phase.contact_pairs_with(collider) {
                let colliders = [pair.collider1, pair.collider2];
                if self.seen.insert(pair_of(colliders)) {
                    self.look_at(colliders, pairs)?;
                }
            }
            if self.points.len() > MAX_POINTS || self.guests.len() > MAX_GUESTS {
                return None;
            }
        }
        Some(())
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
        let Some(surface) =
            surface(first, second, self.verdicts.response(a, b)).filter(|_| is_possible)
        else {
            return Some(());
        };
        let key = pair_of(handles);
        let pair = pairs.entry(key).or_default();
        pair.mechanism = self.mechanism;
        pair.touches = pair.update(first, second);
        if !pair.touches {
            return Some(());
        }
        let bodies = [self.side(first, a)?, self.side(second, b)?].map(Side::body);
        let base = [a, b]
            .into_iter()
            .find_map(|tag| self.bases.get(&tag.shape).copied());
        let mut points = pair.points(key, first, second);
        for point in &mut points {
            point.mechanism = self.mechanism;
            point.shapes = [a.shape, b.shape];
            (point.contact.bodies, point.contact.base) = (bodies, base);
            (point.contact.friction, point.contact.restitution) =
                (surface.friction, surface.restitution);
            point.contact.velocity =
                from_vector(self.obstacle_velocity([first, second], point.place()));
        }
        self.points.extend(points);
        Some(())
    }

    /// What a collider belongs to; None for another mechanism.
    fn side(&mut self, collider: &Collider, tag: Tag) -> Option<Side> {
        if let Some(&(mechanism, body)) = self.places.get(&tag.shape) {
            return (mechanism == self.mechanism).then_some(Side::Body(body));
        }
        let handle = collider.parent()?;
        let rigid = self.world.bodies.get(handle)?;
        if !rigid.is_dynamic() {
            return Some(Side::Obstacle);
        }
        if let Some(known) = self.guests.iter().position(|&guest| guest == tag.shape) {
            return Some(Side::Body(self.linked + known));
        }
        if self.world.joints.attached_joints(handle).next().is_some() {
            return None;
        }
        self.guests.push(tag.shape);
        self.queue.extend(rigid.colliders());
        Some(Side::Body(self.linked + self.guests.len() - 1))
    }

    /// Velocity of the second shape relative to the first at a point, as far as no force moves them.
    fn obstacle_velocity(&self, colliders: [&Collider; 2], place: Vector) -> Vector {
        let velocity = |collider: &Collider| {
            let rigid = collider
                .parent()
                .and_then(|body| self.world.bodies.get(body));
            rigid.map_or(Vector::ZERO, |rigid| velocity_at(rigid, place, self.step))
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

impl Pair {
    /// Finds the points for where the shapes are; whether there are any.
    fn update(&mut self, first: &Collider, second: &Collider) -> bool {
        let apart = first.position().inv_mul(second.position());
        // parry would keep points that moved by less than a millimetre: behind a wheel that begins to roll they drive it on.
        self.manifolds
            .iter_mut()
            .for_each(Manifold::mark_shapes_deformed);
        let dispatcher: &dyn PersistentQueryDispatcher<(), [f64; 3]> = &DefaultQueryDispatcher;
        let shapes = (first.shape(), second.shape());
        let found = dispatcher.contact_manifolds(
            &apart,
            shapes.0,
            shapes.1,
            PREDICTION_DISTANCE,
            &mut self.manifolds,
            &mut self.workspace,
        );
        found.is_ok()
            && self
                .manifolds
                .iter()
                .any(|manifold| manifold.points.iter().any(is_near))
    }

    fn points(&self, key: ColliderPair, first: &Collider, second: &Collider) -> Vec<Point> {
        let mut points = Vec::new();
        for (number, manifold) in self.manifolds.iter().enumerate() {
            let placed = |pose: &EnginePose, part: Option<&EnginePose>| {
                part.map_or(*pose, |part| *pose * *part)
            };
            let a = placed(first.position(), manifold.subshape_pos1());
            let b = placed(second.position(), manifold.subshape_pos2());
            // parry's normal points from the first to the second.
            let normal = -(a.rotation * manifold.local_n1);
            for (index, found) in manifold
                .points
                .iter()
                .enumerate()
                .filter(|(_, found)| is_near(found))
            {
                let place = (a * found.local_p1 + b * found.local_p2) * 0.5;
                points.push(Point::new(key, (number, index), found, place, normal));
            }
        }
        reduced(points)
    }
}

fn is_near(found: &TrackedContact<[f64; 3]>) -> bool {
    found.dist < PREDICTION_DISTANCE
}

impl Point {
    fn new(
        pair: ColliderPair,
        index: (usize, usize),
        found: &TrackedContact<[f64; 3]>,
        place: Vector,
        normal: Vector,
    ) -> Self {
        let contact = Contact {
            bodies: [None; 2],
            base: None,
            point: from_vector(place),
            normal: from_vector(normal),
            distance: found.dist,
            friction: 0.0,
            restitution: 0.0,
            velocity: [0.0; 3],
            impulse: found.data,
        };
        Self {
            pair,
            index,
            mechanism: 0,
            shapes: [Handle(0); 2],
            contact,
            impulse: Vector::ZERO,
            normal,
        }
    }
}

/// At most four points of each surface: the deepest, and those that span the largest area with it.
fn reduced(points: Vec<Point>) -> Vec<Point> {
    if points.len() <= MAX_GROUP_POINTS {
        return points;
    }
    let mut groups: Vec<Vec<Point>> = Vec::new();
    for point in points {
        let group = groups
            .iter_mut()
            .find(|group| group[0].normal.dot(point.normal) > MIN_NORMAL_COSINE);
        match group {
            Some(group) => group.push(point),
            None => groups.push(vec![point]),
        }
    }
    groups.into_iter().flat_map(corners).collect()
}

fn corners(group: Vec<Point>) -> Vec<Point> {
    if group.len() <= MAX_GROUP_POINTS {
        return group;
    }
    let at = |index: usize| group[index].place();
    let best = |score: &dyn Fn(usize) -> f64| {
        (0..group.len()).fold(0, |best, index| {
            if score(index) > score(best) {
                index
            } else {
                best
            }
        })
    };
    let deepest = best(&|index| -group[index].contact.distance);
    let farthest = best(&|index| (at(index) - at(deepest)).length());
    let across = (at(farthest) - at(deepest)).cross(group[0].normal);
    let left = best(&|index| (at(index) - at(deepest)).dot(across));
    let right = best(&|index| (at(deepest) - at(index)).dot(across));
    let chosen = [deepest, farthest, left, right];
    group
        .into_iter()
        .enumerate()
        .filter(|(index, _)| chosen.contains(index))
        .map(|(_, point)| point)
        .collect()
}
