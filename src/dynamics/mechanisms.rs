//! Bodies linked by joints, between rapier and the crate that solves them.
//!
//! Before each sub-step the forces of all links are found by [`articulation`], for the velocities bodies would have after gravity,
//! scripts' forces and the contacts of the sub-step before, and applied to the bodies. rapier then finds its joints satisfied, and its
//! iterations only answer what contacts change. Links that hang together by bodies that move are a mechanism, a system of its own: what
//! one does costs the others nothing.

use std::collections::{BTreeMap, BTreeSet};

use articulation::{BodyMotion, BodyProperties, BodyState, JointProperties, JointState, Mechanism, spatial};
use geometry::{Finite, partition};
use nalgebra::Vector6;
use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};

use super::bodies::{Bodies, Body};
use super::contacts;
use super::convert::{from_pose, from_vector, to_pose, to_vector};
use super::links::{Link, Links};
use super::plan::LinkPlan;
use super::world::World;
use crate::scene::Handle;
use crate::scene::joint::JointSolver;

/// Iterations of rapier's solver over linked bodies that touch something, beside the usual ones: what a contact changes has to find its
/// way along the chain.
const SHARED_ITERATIONS: usize = 48;

/// The mechanisms of a scene.
#[derive(Default)]
pub(super) struct Mechanisms {
    all: Vec<Linked>,
    /// The mechanism of a body that moves, and its index there.
    places: BTreeMap<Handle, (usize, usize)>,
}

/// A mechanism with what it stands for in the scene and in rapier.
struct Linked {
    mechanism: Mechanism,
    bodies: Vec<LinkedShape>,
    /// In the order of the mechanism's joints.
    links: Vec<Handle>,
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
        of_rapier.iter().for_each(|builder| share(&builder.shapes, &builder.links, true, links, world));
        self.all = exact.into_iter().map(Builder::build).collect();
        self.all.iter().for_each(|linked| linked.enable_engine_gyration(false, world));
        self.places = BTreeMap::new();
        for (number, linked) in self.all.iter().enumerate() {
            let dynamic = linked.bodies.iter().enumerate().filter(|(_, body)| body.is_dynamic);
            self.places.extend(dynamic.map(|(index, body)| (body.shape, (number, index))));
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Finds the forces for a sub-step of `step` seconds, and applies them to bodies and links.
    pub(super) fn apply_forces(&mut self, links: &mut Links, world: &mut World, gravity: [f64; 3], step: f64) {
        let begun: Vec<bool> =
            self.all.iter_mut().map(|linked| linked.begin(links, world, gravity, step).is_some()).collect();
        self.add_contact_impulses(world);
        let near = contacts::shapes_near(world);
        for (linked, begun) in self.all.iter_mut().zip(begun) {
            let solved = begun && linked.mechanism.solve();
            share(&linked.bodies, &linked.links, !solved || linked.touches(&near), links, world);
            if solved {
                linked.apply_forces(links, world);
            }
        }
    }

    /// Adds the impulses that contacts are expected to exert: those rapier starts from.
    fn add_contact_impulses(&mut self, world: &World) {
        for push in contacts::expected(world, |shape| self.places.contains_key(&shape)) {
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
        Linked { mechanism: Mechanism::new(self.bodies, self.joints), bodies: self.shapes, links: self.links }
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

/// Lets rapier hold the links as well, or not: where nothing touches the mechanism there is nothing to add.
fn share(bodies: &[LinkedShape], handles: &[Handle], with_engine: bool, links: &mut Links, world: &mut World) {
    let iterations = if with_engine { SHARED_ITERATIONS } else { 0 };
    for body in bodies.iter().filter(|body| body.is_dynamic) {
        if let Some(rigid) = world.bodies.get_mut(body.rigid) {
            rigid.set_additional_pgs_iterations(iterations);
        }
    }
    for handle in handles {
        if let Some(link) = links.get_mut(handle) {
            link.share(with_engine, world);
        }
    }
}

impl Linked {
    /// Whether one of these shapes is a body of the mechanism that moves.
    fn touches(&self, near: &BTreeSet<Handle>) -> bool {
        self.bodies.iter().any(|body| body.is_dynamic && near.contains(&body.shape))
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
        for body in &mut self.bodies {
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
        for (body, load) in self.bodies.iter().zip(self.mechanism.body_loads()) {
            if let (Some(load), Some(rigid)) = (load, world.bodies.get_mut(body.rigid)) {
                rigid.add_force(to_vector(linear(&load)), true);
                rigid.add_torque(to_vector(angular(&load)), true);
            }
        }
    }

    fn correct_positions(&mut self, links: &Links, world: &mut World) {
        self.bodies.iter().for_each(|body| body.remove_forces_of_links(world));
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
