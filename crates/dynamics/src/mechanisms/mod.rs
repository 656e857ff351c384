//! Bodies linked by joints, between rapier and the crate that solves them.
//!
//! Before each sub-step the forces of all links and of the contacts of linked bodies are found by [`articulation`], for the velocities bodies
//! would have after gravity and scripts' forces, and applied to the bodies. Links that hang together by bodies that move are a mechanism, a
//! system of its own: what one does costs the others nothing, and many are solved on several threads. Where mechanisms touch each other rapier
//! solves contacts and joints; the mechanisms then start from the contact impulses of the sub-step before, so that rapier only answers what
//! changes.

mod capsule_contacts;
pub(super) mod exact_contacts;
mod face_contacts;
mod ghosts;
mod linked;
mod linked_shape;
mod loose;
mod needed_points;
mod normals;
pub(super) mod points;
mod reach;
mod search;
mod surroundings;
mod tendons;
pub(super) mod workers;

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix6, Vector6};
use rapier3d_f64::prelude::{Collider, RigidBody};

use crate::bodies::{Bodies, Tag};
use crate::contacts;
use crate::contacts::Verdicts;
use crate::links::Links;
use crate::tendons::Tendons;
use crate::world::{PREDICTION_DISTANCE, World};
use exact_contacts::ExactContacts;
use linked::builder::{Builder, builders};
use linked::{Linked, divide, share};
use linked_shape::LinkedShape;
use loose::{Loose, Start};
use scene::Handle;
use search::Conditions;
use surroundings::Surroundings;
use workers::Workers;

/// Number of joints from which on mechanisms are solved on several threads: with fewer, waking the threads takes as long as the work.
const MIN_JOINTS_FOR_THREADS: usize = 150;

/// Largest number of bodies of mechanisms that are solved as one since they touch each other.
const MAX_JOINED_BODIES: usize = 64;
/// Largest number of free bodies that are solved together with a mechanism.
const MAX_GUESTS: usize = 12;

/// The mechanisms of a scene.
#[derive(Default)]
pub(super) struct Mechanisms {
    all: Vec<Linked>,
    joint_count: usize,
    /// Bodies and links that are left to rapier.
    of_rapier: Vec<(Vec<LinkedShape>, Vec<usize>)>,
    /// The mechanism of a body that moves, and its index there.
    places: BTreeMap<Handle, (usize, usize)>,
    /// Free bodies of which mechanisms solve the contacts in the present sub-step.
    guests: BTreeSet<Handle>,
    contacts: ExactContacts,
    loose: Loose,
    /// Joints and force sensors, base to tip.
    order: Vec<Handle>,
    /// Shapes of mechanisms that are solved as one, since they touch each other or the same free body.
    joined: BTreeSet<[Handle; 2]>,
    surroundings: Surroundings,
    /// Whether no other bodies move.
    are_alone: bool,
}

impl Mechanisms {
    /// Builds the systems for the links; mechanisms with a joint that selects rapier are left to rapier. `order`: base to tip.
    pub(super) fn rebuild(
        &mut self,
        links: &mut Links,
        order: &[Handle],
        bodies: &Bodies,
        tendons: &mut Tendons,
        world: &mut World,
    ) {
        let has_link = |handle: &&Handle| links.contains(**handle);
        self.order = order.iter().filter(has_link).copied().collect();
        self.joined.clear();
        self.join_by_tendons(links, tendons);
        self.build(links, bodies, world);
        for tendon in tendons.iter_mut() {
            tendon.is_linked = self.host_of(tendon, links, bodies).is_some();
        }
    }

    fn build(&mut self, links: &mut Links, bodies: &Bodies, world: &mut World) {
        self.all
            .iter()
            .for_each(|linked| linked.enable_engine_gyration(true, world));
        let builders = builders(links, &self.order, &self.joined, bodies);
        let (of_rapier, exact): (Vec<Builder>, Vec<Builder>) =
            builders.into_iter().partition(Builder::is_for_rapier);
        self.of_rapier = of_rapier
            .into_iter()
            .map(|builder| (builder.shapes, builder.links))
            .collect();
        self.of_rapier
            .iter()
            .for_each(|(_, places)| share(places, true, links, world));
        self.all = exact
            .into_iter()
            .map(|builder| builder.build(bodies, world))
            .collect();
        self.joint_count = self.all.iter().map(|linked| linked.links().len()).sum();
        self.all
            .iter()
            .for_each(|linked| linked.enable_engine_gyration(false, world));
        self.places = BTreeMap::new();
        for (number, linked) in self.all.iter().enumerate() {
            let dynamic = linked
                .bodies()
                .iter()
                .enumerate()
                .filter(|(_, body)| body.is_dynamic);
            self.places
                .extend(dynamic.map(|(index, body)| (body.shape, (number, index))));
        }
        self.surroundings.forget();
        let moving = bodies.iter().filter(|(_, body)| body.build.dynamic);
        self.are_alone = moving.count() == self.places.len();
    }

    /// Notes in how many parts rapier makes the next sub-step for linked bodies.
    pub(super) fn note_parts(&self, links: &mut Links, world: &mut World) {
        for (bodies, places) in &self.of_rapier {
            divide(bodies, places, true, links, world);
        }
        for linked in &self.all {
            divide(linked.bodies(), linked.links(), linked.shared, links, world);
        }
    }

    /// Whether a shape that moves belongs to a mechanism.
    pub(super) fn contains(&self, shape: Handle) -> bool {
        self.places.contains_key(&shape)
    }

    /// Whether rapier holds all links.
    #[cfg(test)]
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Finds the forces for a sub-step of `step` seconds, and tells the links what they bear. `verdicts`: about contacts.
    #[allow(clippy::too_many_arguments, reason = "what a sub-step starts from")]
    pub(super) fn solve(
        &mut self,
        links: &mut Links,
        bodies: &Bodies,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
        verdicts: &Verdicts,
        tendons: &Tendons,
        workers: &mut Workers,
    ) {
        self.contacts.clear();
        self.find_contacts(bodies, world, step, verdicts);
        while self.join() {
            self.build(links, bodies, world);
            self.contacts.restart();
            self.find_contacts(bodies, world, step, verdicts);
        }
        for (number, linked) in self.all.iter_mut().enumerate() {
            linked.read(links, world, gravity, step, self.contacts.of(number));
        }
        self.add_contact_impulses(world);
        self.add_tendons(tendons, links, bodies, world);
        self.for_each(workers, Linked::solve);
        for (number, linked) in self.all.iter_mut().enumerate() {
            if linked.is_solved {
                self.contacts.store(number, linked.contact_impulses());
            } else {
                self.contacts.leave(number);
            }
            linked.shared |= !linked.is_solved;
            share(linked.links(), linked.shared, links, world);
            if linked.is_solved {
                linked.apply_loads(links, world);
            }
        }
        let alone = self.all.iter().filter(|linked| !linked.shared);
        self.guests = alone.flat_map(Linked::guests).collect();
        let start = Start {
            links,
            bodies,
            world,
            gravity,
            step,
            verdicts,
            places: &self.places,
        };
        let (contacts, guests) = (&mut self.contacts, &mut self.guests);
        self.loose.solve(start, contacts, guests, self.all.len());
    }

    /// Finds what each mechanism touches; those that touch too much are left to rapier.
    fn find_contacts(&mut self, bodies: &Bodies, world: &World, step: f64, verdicts: &Verdicts) {
        for (number, linked) in self.all.iter_mut().enumerate() {
            let touching = linked.touching(number);
            let conditions = Conditions {
                places: &self.places,
                verdicts,
                step,
                max_guests: MAX_GUESTS,
                slack: PREDICTION_DISTANCE,
                is_refused: &|_, _| false,
            };
            let near = self.surroundings.of(number);
            let guests = self.contacts.find(world, conditions, touching, near);
            linked.shared = guests.is_none();
            linked.receive(guests.unwrap_or_default(), bodies);
        }
    }

    /// Notes which mechanisms touch each other or the same free body, unless they are large together; whether that is new.
    fn join(&mut self) -> bool {
        let known = self.joined.len();
        let mut meetings = self.contacts.meetings();
        let mut hosts: BTreeMap<Handle, usize> = BTreeMap::new();
        for (number, linked) in self.all.iter().enumerate() {
            meetings.extend(
                linked
                    .guests()
                    .map(|guest| [*hosts.entry(guest).or_insert(number), number]),
            );
        }
        for numbers in meetings.into_iter().filter(|[a, b]| a != b) {
            let both = numbers.map(|number| self.all.get(number));
            if let [Some(first), Some(second)] = both
                && first.bodies().len() + second.bodies().len() <= MAX_JOINED_BODIES
                && let (Some(a), Some(b)) = (first.moving_shape(), second.moving_shape())
            {
                self.joined.insert([a.min(b), a.max(b)]);
            }
        }
        self.joined.len() > known
    }

    /// Of a body that was solved just now: the velocity that it gets, and what an impulse changes of that. None for what the engine moves.
    pub(super) fn response(&mut self, shape: Handle) -> Option<(Vector6<f64>, Matrix6<f64>)> {
        let (linked, body) = self.solver_of(shape)?;
        linked.response(body)
    }

    /// Of a body that was solved just now: the velocity that it gets. None for what the engine moves.
    pub(super) fn velocity(&mut self, shape: Handle) -> Option<Vector6<f64>> {
        let (linked, body) = self.solver_of(shape)?;
        linked.velocity(body)
    }

    /// What solves a body, and its number there.
    fn solver_of(&mut self, shape: Handle) -> Option<(&mut Linked, usize)> {
        if let Some(&(number, body)) = self.places.get(&shape) {
            return Some((&mut self.all[number], body));
        }
        let hosts = self.all.iter_mut().filter(|linked| !linked.shared);
        let mut hosts = hosts.chain(self.loose.groups_mut());
        hosts.find_map(|host| {
            let guest = host.guests().position(|guest| guest == shape)?;
            let body = host.bodies().len() + guest;
            Some((host, body))
        })
    }

    /// Applies the forces to the bodies, which the engine then moves.
    pub(super) fn apply_forces(&self, world: &mut World) {
        self.all
            .iter()
            .filter(|linked| linked.is_solved)
            .for_each(|linked| linked.apply_forces(world, true));
        for group in self.loose.groups() {
            group.apply_forces(world, group.moves(world));
        }
    }

    /// Whether all that moves are bodies of mechanisms that were solved with all that acts on them: the engine has nothing to add.
    pub(super) fn can_integrate(&self, world: &World) -> bool {
        let moving = world
            .awake()
            .filter(|&body| world.bodies.get(body).is_some_and(RigidBody::is_dynamic));
        self.of_rapier.is_empty()
            && self.all.iter().all(Linked::can_integrate)
            && moving.count() == self.places.len()
    }

    /// Moves the bodies over the sub-step that was solved, and finds their corrected positions.
    pub(super) fn integrate(
        &mut self,
        links: &mut Links,
        world: &mut World,
        workers: &mut Workers,
    ) {
        self.for_each(workers, Linked::integrate);
        self.all
            .iter()
            .for_each(|linked| linked.apply_motions(links, world));
    }

    /// Whether the mechanisms, which have just moved, know without the engine what they may touch next.
    pub(super) fn know_surroundings(&self, world: &mut World) -> bool {
        if !self.surroundings.are_known() {
            return false;
        }
        world.move_colliders();
        self.surroundings.cover(world)
    }

    /// Finds out what the mechanisms may touch from now on, for as long as nothing else moves.
    pub(super) fn look_around(&mut self, world: &World) {
        self.surroundings.forget();
        if self.are_alone {
            let colliders = self.all.iter().map(Linked::colliders);
            self.surroundings.find(world, colliders);
        }
    }

    /// What the mechanisms may touch has to be found by the engine.
    pub(super) fn forget_surroundings(&mut self) {
        self.surroundings.forget();
    }

    /// Calls `work` for every mechanism.
    fn for_each(&mut self, workers: &mut Workers, work: fn(&mut Linked)) {
        if self.joint_count < MIN_JOINTS_FOR_THREADS {
            self.all.iter_mut().for_each(work);
        } else {
            self.all = workers.for_each(std::mem::take(&mut self.all), work);
        }
    }

    /// The contacts that mechanisms solve.
    pub(super) fn contacts(&mut self) -> &mut ExactContacts {
        &mut self.contacts
    }

    /// Whether the contacts of a collider are solved with a mechanism, and by nobody else.
    pub(super) fn solves(&self, collider: &Collider) -> bool {
        let shape = Tag::unpack(collider.user_data).shape;
        match self.places.get(&shape) {
            Some(place) => !self.all[place.0].shared,
            None => self.guests.contains(&shape),
        }
    }

    /// Adds the impulses that contacts are expected to exert: those rapier starts from.
    fn add_contact_impulses(&mut self, world: &World) {
        if !self.all.iter().any(|linked| linked.shared) {
            return;
        }
        let is_shared = |shape| {
            self.places
                .get(&shape)
                .is_some_and(|place| self.all[place.0].shared)
        };
        for push in contacts::expected(world, is_shared) {
            for (shape, sign) in [(push.shapes[0], 1.0), (push.shapes[1], -1.0)] {
                if let Some(&(number, body)) = self.places.get(&shape) {
                    self.all[number].add_push(body, push.impulse.map(|x| x * sign), push.point);
                }
            }
        }
    }

    /// Corrects the positions of the bodies after a sub-step, so that the links hold.
    pub(super) fn correct_positions(
        &mut self,
        links: &mut Links,
        world: &mut World,
        workers: &mut Workers,
    ) {
        self.all
            .iter_mut()
            .for_each(|linked| linked.read_motions(links, world));
        self.loose
            .groups()
            .for_each(|group| group.remove_forces(world));
        self.for_each(workers, Linked::correct_positions);
        self.apply_positions(links, world);
    }

    /// Moves the bodies to the corrected positions.
    pub(super) fn apply_positions(&self, links: &mut Links, world: &mut World) {
        for linked in &self.all {
            linked.apply_positions(world);
            linked.correct_loads(links);
        }
    }
}
