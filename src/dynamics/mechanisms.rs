//! Bodies linked by joints, between rapier and the crate that solves them.
//!
//! Before each sub-step the forces of all links and of the contacts of linked bodies are found by [`articulation`], for the velocities bodies
//! would have after gravity and scripts' forces, and applied to the bodies. Links that hang together by bodies that move are a mechanism, a
//! system of its own: what one does costs the others nothing. Where mechanisms touch each other rapier solves contacts and joints; the
//! mechanisms then start from the contact impulses of the sub-step before, so that rapier only answers what changes.

use std::collections::{BTreeMap, BTreeSet};

use articulation::{BodyMotion, BodyProperties, BodyState, JointProperties, JointState, Mechanism, spatial};
use geometry::{Finite, partition};
use nalgebra::Vector6;
use rapier3d_f64::prelude::{Collider, RigidBody, RigidBodyHandle};

use super::bodies::{Bodies, Body, Tag};
use super::contacts;
use super::contacts::Verdicts;
use super::convert::{from_pose, from_vector, to_pose, to_vector};
use super::exact_contacts::{ExactContacts, Touching};
use super::links::{Link, Links};
use super::plan::LinkPlan;
use super::world::World;
use crate::scene::Handle;
use crate::scene::joint::JointSolver;

/// Iterations of rapier's solver over linked bodies in each part of a sub-step, beside the usual ones: what a contact changes has to find
/// its way along the chain.
const SHARED_ITERATIONS: usize = 10;
/// The same where bodies touch nothing, and the sub-step is not divided.
const UNDIVIDED_ITERATIONS: usize = 50;

/// The mechanisms of a scene.
#[derive(Default)]
pub(super) struct Mechanisms {
    all: Vec<Linked>,
    /// Bodies and links that are left to rapier.
    of_rapier: Vec<(Vec<LinkedShape>, Vec<Handle>)>,
    /// The mechanism of a body that moves, and its index there.
    places: BTreeMap<Handle, (usize, usize)>,
    /// Free bodies of which mechanisms solve the contacts in the present sub-step.
    guests: BTreeSet<Handle>,
    contacts: ExactContacts,
}

/// A mechanism with what it stands for in the scene and in rapier.
struct Linked {
    mechanism: Mechanism,
    bodies: Vec<LinkedShape>,
    /// Free bodies that touch the mechanism.
    guests: Vec<LinkedShape>,
    /// In the order of the mechanism's joints.
    links: Vec<Handle>,
    /// Whether rapier solves the links as well.
    shared: bool,
}

/// A body of a mechanism.
struct LinkedShape {
    shape: Handle,
    rigid: RigidBodyHandle,
    is_dynamic: bool,
    /// Forces and torques of scripts: they outlast a sub-step, those of links do not.
    external: Vector6<f64>,
}

/// A mechanism in the making.
#[derive(Default)]
struct Builder {
    bodies: Vec<BodyProperties>,
    shapes: Vec<LinkedShape>,
    places: BTreeMap<Handle, usize>,
    joints: Vec<JointProperties>,
    links: Vec<Handle>,
    /// Whether a joint selects rapier's joints, and whether there is a screw, which rapier lacks.
    asks_rapier: bool,
    has_screw: bool,
}

impl Mechanisms {
    /// Builds the systems for the links; mechanisms with a joint that selects rapier are left to rapier. `order`: base to tip.
    pub(super) fn rebuild(&mut self, links: &mut Links, order: &[Handle], bodies: &Bodies, world: &mut World) {
        self.all.iter().for_each(|linked| linked.enable_engine_gyration(true, world));
        let builders = builders(links, order, bodies);
        let (of_rapier, exact): (Vec<Builder>, Vec<Builder>) = builders.into_iter().partition(Builder::is_for_rapier);
        self.of_rapier = of_rapier.into_iter().map(|builder| (builder.shapes, builder.links)).collect();
        self.of_rapier.iter().for_each(|(_, handles)| share(handles, true, links, world));
        self.all = exact.into_iter().map(Builder::build).collect();
        self.all.iter().for_each(|linked| linked.enable_engine_gyration(false, world));
        self.places = BTreeMap::new();
        for (number, linked) in self.all.iter().enumerate() {
            let dynamic = linked.bodies.iter().enumerate().filter(|(_, body)| body.is_dynamic);
            self.places.extend(dynamic.map(|(index, body)| (body.shape, (number, index))));
        }
    }

    /// Notes in how many parts rapier makes the next sub-step for linked bodies.
    pub(super) fn note_parts(&self, links: &mut Links, world: &mut World) {
        for (bodies, handles) in &self.of_rapier {
            divide(bodies, handles, true, links, world);
        }
        for linked in &self.all {
            divide(&linked.bodies, &linked.links, linked.shared, links, world);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Finds the forces for a sub-step of `step` seconds, and applies them to bodies and links. `verdicts`: about contacts.
    pub(super) fn apply_forces(
        &mut self,
        links: &mut Links,
        bodies: &Bodies,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
        verdicts: &Verdicts,
    ) {
        self.contacts.clear();
        let mut alone = Vec::with_capacity(self.all.len());
        for (number, linked) in self.all.iter_mut().enumerate() {
            let touching = linked.touching(number, bodies);
            let guests = self.contacts.find(world, &self.places, verdicts, step, touching);
            alone.push(guests.is_some());
            linked.receive(guests.unwrap_or_default(), bodies);
        }
        let begun: Vec<bool> =
            self.all.iter_mut().map(|linked| linked.begin(links, world, gravity, step).is_some()).collect();
        self.add_contact_impulses(world, &alone);
        for (number, linked) in self.all.iter_mut().enumerate() {
            linked.mechanism.set_contacts(&self.contacts.of(number));
            let solved = begun[number] && linked.mechanism.solve();
            if solved {
                self.contacts.store(number, linked.mechanism.contact_impulses());
            } else {
                self.contacts.leave(number);
            }
            linked.shared = !solved || !alone[number];
            share(&linked.links, linked.shared, links, world);
            if solved {
                linked.apply_forces(links, world);
            }
        }
        let alone = self.all.iter().filter(|linked| !linked.shared);
        self.guests = alone.flat_map(|linked| linked.guests.iter().map(|guest| guest.shape)).collect();
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
    fn add_contact_impulses(&mut self, world: &World, alone: &[bool]) {
        let is_shared = |shape| self.places.get(&shape).is_some_and(|place| !alone[place.0]);
        for push in contacts::expected(world, is_shared) {
            for (shape, sign) in [(push.shapes[0], 1.0), (push.shapes[1], -1.0)] {
                if let Some(&(number, body)) = self.places.get(&shape) {
                    self.all[number].mechanism.add_impulse(body, push.impulse.map(|x| x * sign), push.point);
                }
            }
        }
    }

    /// Corrects the positions of the bodies after a sub-step, so that the links hold.
    pub(super) fn correct_positions(&mut self, links: &Links, world: &mut World) {
        self.all.iter_mut().for_each(|linked| linked.correct_positions(links, world));
    }
}

/// A builder for each set of links that hang together by bodies that move. Links at the tips come first, which are eliminated first.
fn builders(links: &Links, order: &[Handle], bodies: &Bodies) -> Vec<Builder> {
    let plan = |handle: &Handle| links.get(handle).map(|link| (*handle, &link.plan));
    let plans: Vec<(Handle, &LinkPlan)> = order.iter().rev().filter_map(plan).collect();
    let moving = |shape: Handle| bodies.get(shape).filter(|body| body.build.dynamic).map(|_| shape);
    let ends = |(_, plan): &(Handle, &LinkPlan)| [plan.first, plan.second].into_iter().filter_map(moving);
    let numbers = partition(plans.iter().map(ends));
    let mut builders = Vec::new();
    builders.resize_with(numbers.iter().max().map_or(0, |last| last + 1), Builder::default);
    for ((handle, plan), number) in plans.into_iter().zip(numbers) {
        builders[number].add(handle, plan, bodies);
    }
    builders
}

impl Builder {
    fn add(&mut self, link: Handle, plan: &LinkPlan, bodies: &Bodies) {
        self.asks_rapier |= plan.solver == JointSolver::Impulse;
        self.has_screw |= plan.pitch != 0.0;
        if let (Some(first), Some(second)) = (self.body(plan.first, bodies), self.body(plan.second, bodies)) {
            let LinkPlan { kind, base, tip, pitch, .. } = *plan;
            self.joints.push(JointProperties { kind: kind.joint(), bodies: [first, second], base, tip, pitch });
            self.links.push(link);
        }
    }

    /// Index of the body of a shape.
    fn body(&mut self, shape: Handle, bodies: &Bodies) -> Option<usize> {
        let body = bodies.get(shape)?;
        Some(*self.places.entry(shape).or_insert_with(|| {
            self.bodies.push(properties(body));
            self.shapes.push(LinkedShape {
                shape,
                rigid: body.rigid,
                is_dynamic: body.build.dynamic,
                external: Vector6::zeros(),
            });
            self.bodies.len() - 1
        }))
    }

    /// Whether the links are left to rapier alone.
    fn is_for_rapier(&self) -> bool {
        self.asks_rapier && !self.has_screw
    }

    fn build(self) -> Linked {
        Linked {
            mechanism: Mechanism::new(self.bodies, self.joints),
            bodies: self.shapes,
            guests: Vec::new(),
            links: self.links,
            shared: false,
        }
    }
}

fn properties(body: &Body) -> BodyProperties {
    let mass = &body.build.mass;
    if body.build.dynamic {
        BodyProperties::dynamic(mass.mass, mass.inertia * mass.mass, mass.com.into())
    } else {
        BodyProperties::immovable(mass.com.into())
    }
}

/// Lets rapier hold the links as well, or not: where the mechanism solves its contacts there is nothing to add.
fn share(handles: &[Handle], with_engine: bool, links: &mut Links, world: &mut World) {
    for handle in handles {
        if let Some(link) = links.get_mut(handle) {
            link.share(with_engine, world);
        }
    }
}

/// Notes in how many parts rapier makes the next sub-step for linked bodies, and lets it iterate accordingly if it holds the links.
fn divide(bodies: &[LinkedShape], handles: &[Handle], with_engine: bool, links: &mut Links, world: &mut World) {
    let moving = || bodies.iter().filter(|body| body.is_dynamic);
    let parts = moving().map(|body| world.parts_of(body.rigid)).max().unwrap_or(1);
    for handle in handles {
        if let Some(link) = links.get_mut(handle) {
            link.parts = parts;
        }
    }
    let iterations = match (with_engine, parts) {
        (false, _) => 0,
        (true, 1) => UNDIVIDED_ITERATIONS,
        (true, _) => SHARED_ITERATIONS,
    };
    for body in moving() {
        let differs = |rigid: &RigidBody| rigid.additional_pgs_iterations() != iterations;
        if world.bodies.get(body.rigid).is_some_and(differs)
            && let Some(rigid) = world.bodies.get_mut(body.rigid)
        {
            rigid.set_additional_pgs_iterations(iterations);
        }
    }
}

impl Linked {
    /// What the search for contacts has to know of the mechanism.
    fn touching(&self, mechanism: usize, bodies: &Bodies) -> Touching {
        let moving = self.bodies.iter().filter(|body| body.is_dynamic);
        let colliders =
            moving.filter_map(|body| bodies.get(body.shape)).flat_map(|body| body.colliders.iter().copied());
        let resting = self.bodies.iter().enumerate().filter(|(_, body)| !body.is_dynamic);
        let bases = resting.map(|(index, body)| (body.shape, index)).collect();
        Touching { mechanism, linked: self.bodies.len(), colliders: colliders.collect(), bases }
    }

    /// Takes free bodies in for a sub-step.
    fn receive(&mut self, guests: Vec<Handle>, bodies: &Bodies) {
        let guests: Vec<(Handle, &Body)> =
            guests.into_iter().filter_map(|shape| Some((shape, bodies.get(shape)?))).collect();
        self.mechanism.set_guests(guests.iter().map(|(_, body)| properties(body)));
        let guest = |(shape, body): (Handle, &Body)| LinkedShape {
            shape,
            rigid: body.rigid,
            is_dynamic: true,
            external: Vector6::zeros(),
        };
        self.guests = guests.into_iter().map(guest).collect();
    }

    /// Whether rapier applies the gyroscopic torque; to linked bodies the mechanism does, since rapier would apply it to what the links
    /// do as well.
    fn enable_engine_gyration(&self, on: bool, world: &mut World) {
        for body in self.bodies.iter().filter(|body| body.is_dynamic) {
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.enable_gyroscopic_forces(on);
            }
        }
    }

    /// Reads where bodies and links are, and what acts on them; None when rapier lacks one.
    fn begin(&mut self, links: &Links, world: &World, gravity: [f64; 3], step: f64) -> Option<()> {
        let mut states = Vec::with_capacity(self.bodies.len());
        for body in self.bodies.iter_mut().chain(&mut self.guests) {
            let state = body_state(world.bodies.get(body.rigid)?, body.is_dynamic, step);
            body.external = state.force;
            states.push(state);
        }
        let joints: Vec<JointState> =
            self.links.iter().map(|handle| links.get(handle).map(joint_state)).collect::<Option<_>>()?;
        self.mechanism.begin(&states, &joints, gravity, step);
        Some(())
    }

    fn apply_forces(&self, links: &mut Links, world: &mut World) {
        for (handle, load) in self.links.iter().zip(self.mechanism.joint_loads()) {
            if let Some(link) = links.get_mut(handle) {
                link.set_solution(&load, world);
            }
        }
        for (body, load) in self.bodies.iter().chain(&self.guests).zip(self.mechanism.body_loads()) {
            if let (Some(load), Some(rigid)) = (load, world.bodies.get_mut(body.rigid)) {
                rigid.add_force(to_vector(linear(&load)), true);
                rigid.add_torque(to_vector(angular(&load)), true);
            }
        }
    }

    fn correct_positions(&mut self, links: &Links, world: &mut World) {
        self.bodies.iter().chain(&self.guests).for_each(|body| body.remove_forces_of_links(world));
        let motions: Option<Vec<BodyMotion>> =
            self.bodies.iter().map(|body| world.bodies.get(body.rigid).map(motion)).collect();
        let turned: Option<Vec<f64>> =
            self.links.iter().map(|handle| links.get(handle).map(|link| link.turned)).collect();
        let (Some(motions), Some(turned)) = (motions, turned) else { return };
        for (body, corrected) in self.bodies.iter().zip(self.mechanism.correct_positions(&motions, &turned)) {
            let Some(motion) = corrected.filter(|motion| motion.pose.is_finite()) else { continue };
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.set_position(to_pose(&motion.pose), false);
                rigid.set_linvel(to_vector(linear(&motion.velocity)), false);
                rigid.set_angvel(to_vector(angular(&motion.velocity)), false);
            }
        }
    }
}

impl LinkedShape {
    fn remove_forces_of_links(&self, world: &mut World) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid).filter(|rigid| rigid.is_dynamic()) {
            rigid.reset_forces(false);
            rigid.reset_torques(false);
            rigid.add_force(to_vector(linear(&self.external)), false);
            rigid.add_torque(to_vector(angular(&self.external)), false);
        }
    }
}

fn body_state(rigid: &RigidBody, is_dynamic: bool, step: f64) -> BodyState {
    let motion = motion(rigid);
    if !is_dynamic {
        let target = rigid.is_kinematic().then(|| from_pose(rigid.next_position()));
        return BodyState {
            motion,
            force: Vector6::zeros(),
            gyroscopic_velocity: angular(&motion.velocity).into(),
            target,
        };
    }
    let force = spatial(from_vector(rigid.user_force()).into(), from_vector(rigid.user_torque()).into());
    let gyroscopic_velocity = from_vector(rigid.angvel_with_gyroscopic_forces(step)).into();
    BodyState { motion, force, gyroscopic_velocity, target: None }
}

fn motion(rigid: &RigidBody) -> BodyMotion {
    let velocity = spatial(from_vector(rigid.linvel()).into(), from_vector(rigid.angvel()).into());
    BodyMotion { pose: from_pose(rigid.position()), velocity }
}

fn joint_state(link: &Link) -> JointState {
    let motor = link.drive.map(|drive| articulation::Motor { velocity: drive.velocity, max_force: drive.force });
    JointState { position: link.motion.position, velocity: link.motion.velocity, motor, limits: link.stops }
}

fn linear(v: &Vector6<f64>) -> [f64; 3] {
    [v[0], v[1], v[2]]
}

fn angular(v: &Vector6<f64>) -> [f64; 3] {
    [v[3], v[4], v[5]]
}
