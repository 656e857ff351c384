//! A mechanism with what it stands for in the scene and in rapier: reads the state of the bodies, solves, applies what was found. Only what
//! reads and applies needs the world, so that mechanisms can be solved at the same time.

pub(super) mod builder;
mod tendons;

use std::collections::BTreeMap;

use articulation::{BodyMotion, BodyState, Contact, JointState, Mechanism};
use geometry::Finite;
use nalgebra::{Matrix6, Vector6};
use rapier3d_f64::prelude::{ColliderHandle, RigidBody};

use super::linked_shape::{
    LinkedShape, angular, body_state, joint_state, linear, motion, properties,
};
use super::reach::Reach;
use super::search::Touching;
use crate::bodies::{Bodies, Body, SLEEP_THRESHOLD};
use crate::convert::{to_pose, to_vector};
use crate::free_rotation::LINKED;
use crate::links::Links;
use crate::world::World;
use scene::Handle;
use tendons::Strand;

/// Iterations of rapier's solver over linked bodies in each part of a sub-step, beside the usual ones: what a contact changes has to find
/// its way along the chain.
const CONTACT_ITERATIONS: usize = 10;
/// The same where bodies touch nothing, and the sub-step is not divided.
const FREE_ITERATIONS: usize = 50;

/// Speed that a body gets by an impulse with which its mechanism is probed, if nothing holds it: m/s and rad/s.
const PROBED_SPEED: f64 = 1e-3;

/// A mechanism.
pub(super) struct Linked {
    mechanism: Mechanism,
    bodies: Vec<LinkedShape>,
    /// Free bodies that touch the mechanism.
    guests: Vec<LinkedShape>,
    /// The places of the links, in the order of the mechanism's joints.
    links: Vec<usize>,
    /// The colliders of the bodies that move, and the indices of the shapes that do not.
    colliders: Vec<ColliderHandle>,
    bases: BTreeMap<Handle, usize>,
    /// Whether rapier solves the links as well.
    pub shared: bool,
    input: Input,
    /// The tendons of this sub-step.
    strands: Vec<Strand>,
    /// Whether the forces of this sub-step were found.
    pub is_solved: bool,
    corrected: Vec<Option<BodyMotion>>,
}

/// What the solution of a sub-step starts from.
#[derive(Default)]
struct Input {
    bodies: Vec<BodyState>,
    joints: Vec<JointState>,
    contacts: Vec<Contact>,
    /// Impulses of contacts that rapier solves: body, impulse and place.
    pushes: Vec<(usize, [f64; 3], [f64; 3])>,
    gravity: [f64; 3],
    step: f64,
    /// After the step.
    motions: Vec<BodyMotion>,
    turned: Vec<f64>,
}

/// Lets rapier hold the links as well, or not: where the mechanism solves its contacts there is nothing to add.
pub(super) fn share(places: &[usize], with_engine: bool, links: &mut Links, world: &mut World) {
    places
        .iter()
        .for_each(|&place| links.at_mut(place).share(with_engine, world));
}

/// Notes in how many parts rapier makes the next sub-step for linked bodies, and lets it iterate accordingly if it holds the links.
pub(super) fn divide(
    bodies: &[LinkedShape],
    places: &[usize],
    with_engine: bool,
    links: &mut Links,
    world: &mut World,
) {
    let moving = || bodies.iter().filter(|body| body.is_dynamic);
    let parts = moving()
        .map(|body| world.parts_of(body.rigid))
        .max()
        .unwrap_or(1);
    places
        .iter()
        .for_each(|&place| links.at_mut(place).parts = parts);
    let iterations = match (with_engine, parts) {
        (false, _) => 0,
        (true, 1) => FREE_ITERATIONS,
        (true, _) => CONTACT_ITERATIONS,
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
    pub(super) fn new(
        mechanism: Mechanism,
        mut shapes: Vec<LinkedShape>,
        links: Vec<usize>,
        bodies: &Bodies,
        world: &World,
    ) -> Self {
        let mut colliders = Vec::new();
        for shape in shapes.iter_mut().filter(|shape| shape.is_dynamic) {
            let Some(body) = bodies.get(shape.shape) else {
                continue;
            };
            colliders.extend(&body.colliders);
            shape.reach = Reach::of(&body.colliders, &world.colliders);
        }
        let resting = shapes
            .iter()
            .enumerate()
            .filter(|(_, body)| !body.is_dynamic);
        let bases = resting.map(|(index, body)| (body.shape, index)).collect();
        Self {
            mechanism,
            bodies: shapes,
            guests: Vec::new(),
            links,
            colliders,
            bases,
            shared: false,
            input: Input::default(),
            strands: Vec::new(),
            is_solved: false,
            corrected: Vec::new(),
        }
    }

    /// No mechanism, only guests.
    pub(super) fn without_links() -> Self {
        Self {
            mechanism: Mechanism::new(Vec::new(), Vec::new()),
            bodies: Vec::new(),
            guests: Vec::new(),
            links: Vec::new(),
            colliders: Vec::new(),
            bases: BTreeMap::new(),
            shared: false,
            input: Input::default(),
            strands: Vec::new(),
            is_solved: false,
            corrected: Vec::new(),
        }
    }

    pub(super) fn links(&self) -> &[usize] {
        &self.links
    }

    pub(super) fn bodies(&self) -> &[LinkedShape] {
        &self.bodies
    }

    /// The colliders of the bodies that move.
    pub(super) fn colliders(&self) -> &[ColliderHandle] {
        &self.colliders
    }

    /// A shape that moves.
    pub(super) fn moving_shape(&self) -> Option<Handle> {
        let moving = self.bodies.iter().find(|body| body.is_dynamic);
        moving.map(|body| body.shape)
    }

    /// What the search for contacts has to know of the mechanism.
    pub(super) fn touching(&self, mechanism: usize) -> Touching<'_> {
        Touching {
            mechanism,
            linked: self.bodies.len(),
            colliders: &self.colliders,
            bases: &self.bases,
        }
    }

    /// Takes free bodies in for a sub-step.
    pub(super) fn receive(&mut self, guests: Vec<Handle>, bodies: &Bodies) {
        let guests: Vec<(Handle, &Body)> = guests
            .into_iter()
            .filter_map(|shape| Some((shape, bodies.get(shape)?)))
            .collect();
        let is_as_before =
            |(guest, (shape, body)): (&LinkedShape, &(Handle, &Body))| guest.is(*shape, body);
        if guests.len() == self.guests.len() && self.guests.iter().zip(&guests).all(is_as_before) {
            return;
        }
        self.mechanism
            .set_guests(guests.iter().map(|(_, body)| properties(body)));
        self.guests = guests
            .into_iter()
            .map(|(shape, body)| LinkedShape::new(shape, body))
            .collect();
    }

    /// Whether rapier applies the gyroscopic torque; to linked bodies the mechanism does, since rapier would apply it to what the links
    /// do as well.
    pub(super) fn enable_engine_gyration(&self, on: bool, world: &mut World) {
        for body in self.bodies.iter().filter(|body| body.is_dynamic) {
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.enable_gyroscopic_forces(on);
                rigid.user_data = if on { 0 } else { LINKED };
            }
        }
    }

    /// Reads where bodies and links are, and what acts on them; `contacts`: those that the mechanism solves. Without a body that
    /// rapier lacks there is nothing to be solved.
    pub(super) fn read(
        &mut self,
        links: &Links,
        world: &World,
        gravity: [f64; 3],
        step: f64,
        contacts: impl Iterator<Item = Contact>,
    ) {
        let Input {
            bodies,
            joints,
            contacts: known,
            pushes,
            ..
        } = &mut self.input;
        bodies.clear();
        joints.clear();
        known.clear();
        known.extend(contacts);
        pushes.clear();
        self.strands.clear();
        for body in self.bodies.iter_mut().chain(&mut self.guests) {
            let Some(rigid) = world.bodies.get(body.rigid) else {
                continue;
            };
            let state = body_state(rigid, body.is_dynamic, step);
            body.external = state.force;
            bodies.push(state);
        }
        joints.extend(self.links.iter().map(|&place| joint_state(links.at(place))));
        (self.input.gravity, self.input.step) = (gravity, step);
    }

    /// Adds the impulse of a contact that rapier solves.
    pub(super) fn add_push(&mut self, body: usize, impulse: [f64; 3], point: [f64; 3]) {
        self.input.pushes.push((body, impulse, point));
    }

    /// Of a body that was solved: the velocity that it gets, and what an impulse changes of that, by a small one in each direction. What was solved has to be
    /// solved again.
    pub(super) fn response(&mut self, body: usize) -> Option<(Vector6<f64>, Matrix6<f64>)> {
        let velocity = self.velocity(body)?;
        let shape = self.bodies.iter().chain(&self.guests).nth(body)?;
        let (mass, mut response) = (shape.mass(), Matrix6::zeros());
        for axis in 0..6 {
            let mut impulse = Vector6::zeros();
            impulse[axis] = mass[axis] * PROBED_SPEED;
            self.find_forces(Some((body, impulse)));
            let changed = self.velocity(body)? - velocity;
            response.set_column(axis, &(changed / impulse[axis]));
        }
        Some((velocity, response))
    }

    /// The velocity that a body gets, of what was solved.
    pub(super) fn velocity(&self, body: usize) -> Option<Vector6<f64>> {
        let is_known = self.is_solved && !self.shared;
        let velocity = self.mechanism.velocities().nth(body).copied();
        velocity.filter(|_| is_known)
    }

    /// Finds the forces for what was read.
    pub(super) fn solve(&mut self) {
        self.find_forces(None);
    }

    /// The same with one more impulse on a body.
    fn find_forces(&mut self, probe: Option<(usize, Vector6<f64>)>) {
        if self.strands.is_empty() {
            self.solve_once(probe);
        } else {
            self.solve_with_tendons(probe);
        }
    }

    /// Finds the forces of joints and contacts, for the forces that tendons have.
    fn solve_once(&mut self, probe: Option<(usize, Vector6<f64>)>) {
        let joints = self.joints_with_tendons();
        let loads: Vec<(usize, Vector6<f64>)> = self.tendon_loads().collect();
        let Input {
            bodies,
            joints: without_tendons,
            contacts,
            pushes,
            gravity,
            step,
            ..
        } = &self.input;
        let joints = joints.as_ref().unwrap_or(without_tendons);
        self.is_solved = bodies.len() == self.bodies.len() + self.guests.len();
        if self.is_solved {
            self.mechanism.begin(bodies, joints, *gravity, *step);
            pushes.iter().for_each(|&(body, impulse, point)| {
                self.mechanism.add_impulse(body, impulse, point);
            });
            let pulls = loads.iter().map(|(body, load)| (*body, load * *step));
            for (body, impulse) in pulls.chain(probe) {
                self.mechanism.add_spatial_impulse(body, &impulse);
            }
            self.mechanism.set_contacts(contacts);
            self.is_solved = self.mechanism.solve();
        }
    }

    /// Whether nothing but the mechanism acts on its bodies in this sub-step, and nothing could be in the way of a fast one.
    pub(super) fn can_integrate(&self) -> bool {
        let is_usual = |body: &LinkedShape, velocity| {
            !body.is_dynamic
                || !body.is_damped && !body.reach.is_exceeded(velocity, self.input.step)
        };
        let mut moving = self.bodies.iter().zip(self.mechanism.velocities());
        self.is_solved
            && !self.shared
            && self.guests.is_empty()
            && moving.all(|(body, velocity)| is_usual(body, velocity))
    }

    /// Finds where the bodies are after the sub-step, for [`apply_positions`](Self::apply_positions).
    pub(super) fn integrate(&mut self) {
        let Input {
            motions, turned, ..
        } = &mut self.input;
        motions.clear();
        motions.extend(self.mechanism.integrate());
        turned.clear();
        turned.extend(self.mechanism.turns());
        self.corrected = self.mechanism.correct_positions(motions, turned);
        for (corrected, motion) in self.corrected.iter_mut().zip(motions) {
            corrected.get_or_insert(*motion);
        }
    }

    /// Moves the shapes to where the bodies are before the correction, as the engine would, and tells the links how far they turned.
    pub(super) fn apply_motions(&self, links: &mut Links, world: &mut World) {
        for (&place, turned) in self.links.iter().zip(&self.input.turned) {
            links.at_mut(place).turned = *turned;
        }
        let solid = self
            .bodies
            .iter()
            .zip(&self.input.motions)
            .filter(|(body, _)| body.is_dynamic && body.reach.is_solid());
        for (body, motion) in solid {
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.set_position(to_pose(&motion.pose), false);
            }
        }
    }

    /// The free bodies of which the mechanism solves the contacts.
    pub(super) fn guests(&self) -> impl Iterator<Item = Handle> {
        self.guests.iter().map(|guest| guest.shape)
    }

    /// The impulses of the contacts.
    pub(super) fn contact_impulses(&self) -> impl Iterator<Item = [f64; 3]> {
        self.mechanism.contact_impulses()
    }

    /// Tells the links what they bear.
    pub(super) fn apply_loads(&self, links: &mut Links, world: &mut World) {
        for (&place, load) in self.links.iter().zip(self.mechanism.joint_loads()) {
            links.at_mut(place).set_solution(&load, world);
        }
    }

    /// Whether the guests are to move in the sub-step; those that do not may fall asleep.
    pub(super) fn moves(&self, world: &World) -> bool {
        let velocities = self.mechanism.velocities().skip(self.bodies.len());
        self.guests.iter().zip(velocities).any(|(guest, velocity)| {
            let extent = world
                .bodies
                .get(guest.rigid)
                .map_or(0.0, |rigid| rigid.mass_properties().max_extent());
            let [linear, angular] = [0, 3].map(|first| velocity.fixed_rows::<3>(first).norm());
            linear + angular * extent > SLEEP_THRESHOLD.0
        })
    }

    /// Applies the forces to the bodies; `wakes`: to sleepers too.
    pub(super) fn apply_forces(&self, world: &mut World, wakes: bool) {
        for (body, load) in self
            .bodies
            .iter()
            .chain(&self.guests)
            .zip(self.mechanism.body_loads())
        {
            if let (Some(load), Some(rigid)) = (load, world.bodies.get_mut(body.rigid)) {
                rigid.add_force(to_vector(linear(&load)), wakes);
                rigid.add_torque(to_vector(angular(&load)), wakes);
            }
        }
        for (body, load) in self.tendon_loads() {
            if let Some(rigid) = world.bodies.get_mut(self.bodies[body].rigid) {
                rigid.add_force(to_vector(linear(&load)), wakes);
                rigid.add_torque(to_vector(angular(&load)), wakes);
            }
        }
    }

    /// Removes the forces from the bodies.
    pub(super) fn remove_forces(&self, world: &mut World) {
        self.bodies
            .iter()
            .chain(&self.guests)
            .for_each(|body| body.remove_forces_of_links(world));
    }

    /// Reads how the bodies moved, and removes the forces.
    pub(super) fn read_motions(&mut self, links: &Links, world: &mut World) {
        self.remove_forces(world);
        let Input {
            motions, turned, ..
        } = &mut self.input;
        motions.clear();
        motions.extend(
            self.bodies
                .iter()
                .filter_map(|body| world.bodies.get(body.rigid).map(motion)),
        );
        turned.clear();
        turned.extend(self.links.iter().map(|&place| links.at(place).turned));
    }

    /// Corrects the positions so that the links hold.
    pub(super) fn correct_positions(&mut self) {
        let Input {
            motions, turned, ..
        } = &self.input;
        self.corrected.clear();
        if motions.len() == self.bodies.len() {
            self.corrected = self.mechanism.correct_positions(motions, turned);
        }
    }

    /// Tells the links what they bear, with what kept bodies on their paths.
    pub(super) fn correct_loads(&self, links: &mut Links) {
        if self.is_solved {
            for (&place, load) in self.links.iter().zip(self.mechanism.joint_loads()) {
                links.at_mut(place).correct_solution(&load);
            }
        }
    }

    /// Moves the bodies to the corrected positions.
    pub(super) fn apply_positions(&self, world: &mut World) {
        for (body, corrected) in self
            .bodies
            .iter()
            .zip(&self.corrected)
            .filter(|(body, _)| body.is_dynamic)
        {
            let Some(motion) = corrected.filter(|motion| motion.pose.is_finite()) else {
                continue;
            };
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.set_position(to_pose(&motion.pose), false);
                rigid.set_linvel(to_vector(linear(&motion.velocity)), false);
                rigid.set_angvel(to_vector(angular(&motion.velocity)), false);
            }
        }
    }
}
