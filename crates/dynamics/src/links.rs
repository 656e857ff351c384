//! Joints, force sensors and welds as constraints between bodies.
//!
//! The crate `articulation` solves them exactly. Those of bodies that touch something are rapier's impulse
//! joints as well, so that contacts and links can answer each other within a sub-step; those that scripts hand to rapier are nothing
//! else. rapier's multibodies would not do: they have no loops, no moving bases, and no reading of what a link or a motor bears.

use std::collections::BTreeMap;

use articulation::{JointLoad, Passive};
use geometry::Finite;
use geometry::pose::euler::wrap_angle;
use nalgebra::{Vector3, Vector6};
use rapier3d_f64::prelude::{
    GenericJoint, ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel, RigidBodyHandle,
    SpringCoefficients,
};

use super::actuators::{Orders, actuated};
use super::bodies::Bodies;
use super::convert::{from_pose, from_vector, to_pose};
use super::load::{Load, Rows};
use super::motors::{Drive, Motion, Motor};
use super::plan::{LinkKind, LinkPlan};
use super::world::World;
use scene::joint::{Actuation, Joint};
use scene::parameters::engine::Engine;
use scene::{Field, Handle, Pose, Scene};

/// Damping that makes a velocity motor rigid within its force.
const RIGID: f64 = 1e12;
/// rapier corrects a fifth of the gaps it finds in a sub-step of 5 ms.
const SOFTNESS: SpringCoefficients<f64> = SpringCoefficients {
    natural_frequency: 1.6e4,
    damping_ratio: 1000.0,
};
/// A revolute joint whose range is this or more has no stops, radians.
const MAX_STOP_RANGE: f64 = 359.0 * std::f64::consts::PI / 180.0;

/// The links, in the order of the handles of their objects. Their places last until the next plan.
#[derive(Default)]
pub(super) struct Links(Vec<(Handle, Link)>);

impl Links {
    /// The place of the link of an object.
    pub(super) fn place(&self, object: Handle) -> Option<usize> {
        self.0
            .binary_search_by_key(&object, |(handle, _)| *handle)
            .ok()
    }

    pub(super) fn contains(&self, object: Handle) -> bool {
        self.place(object).is_some()
    }

    pub(super) fn get(&self, object: Handle) -> Option<&Link> {
        self.place(object).map(|place| self.at(place))
    }

    pub(super) fn get_mut(&mut self, object: Handle) -> Option<&mut Link> {
        self.place(object).map(|place| self.at_mut(place))
    }

    pub(super) fn at(&self, place: usize) -> &Link {
        &self.0[place].1
    }

    pub(super) fn at_mut(&mut self, place: usize) -> &mut Link {
        &mut self.0[place].1
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (Handle, &Link)> {
        self.0.iter().map(|(handle, link)| (*handle, link))
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = (Handle, &mut Link)> {
        self.0.iter_mut().map(|(handle, link)| (*handle, link))
    }

    pub(super) fn values_mut(&mut self) -> impl Iterator<Item = &mut Link> {
        self.0.iter_mut().map(|(_, link)| link)
    }
}

/// A constraint in the engine.
pub(super) struct Link {
    pub plan: LinkPlan,
    joint: ImpulseJointHandle,
    bodies: [RigidBodyHandle; 2],
    pub motor: Motor,
    /// Position, turns counted, and its change over the last sub-step.
    pub motion: Motion,
    /// How far the joint turned in the last sub-step by the spins of its bodies, radians.
    pub turned: f64,
    /// No sub-step has run yet since the link was made.
    pub fresh: bool,
    pub drive: Option<Drive>,
    /// How the joint is moved beside what its control says, where that counts.
    pub actuation: Option<Actuation>,
    /// What acts along the axis beside the motor in this sub-step, and the part of it that is its actuator's, N m or N.
    pub passive: Passive,
    pub actuator_force: f64,
    /// Lowest and highest position, if the joint has stops.
    pub stops: Option<[f64; 2]>,
    /// The exact solution: what the link exerts in this sub-step.
    solution: Option<JointLoad>,
    /// Whether rapier holds the link as well.
    shared: bool,
    /// Parts in which rapier makes the sub-step.
    pub parts: usize,
    /// Effort of the motor on the parent in each sub-step of this call.
    pub efforts: Vec<f64>,
    /// Load of a force sensor in each sub-step of this call.
    pub loads: Vec<Load>,
    rows: Option<Rows>,
}

/// Takes along what hangs on joints that scripts moved, so that the joint finds it in its place: wheels of omnidirectional robots turn
/// their joints back in every step. Velocities stay.
pub(super) fn move_with_joints(
    links: &Links,
    plans: &BTreeMap<Handle, LinkPlan>,
    bodies: &Bodies,
    world: &mut World,
    scene: &Scene,
) {
    for (&handle, plan) in plans {
        let Some(old) = links.get(handle).filter(|old| old.plan.base != plan.base) else {
            continue;
        };
        let ends = [plan.first, plan.second].map(|shape| bodies.get(shape).map(|body| body.rigid));
        let [Some(first), Some(second)] = ends else {
            continue;
        };
        let Some(parent) = world
            .bodies
            .get(first)
            .filter(|_| [first, second] == old.bodies)
        else {
            continue;
        };
        let parent = from_pose(parent.position());
        let turn = parent * plan.base * old.plan.base.inverse() * parent.inverse();
        for (_, body) in bodies
            .iter()
            .filter(|(shape, _)| scene.is_ancestor_or_self(handle, *shape))
        {
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                let moved = turn * from_pose(rigid.position());
                rigid.set_position(to_pose(&moved), true);
            }
        }
    }
}

/// Makes the engine's constraints those of the plan.
pub(super) fn apply_plan(
    links: &mut Links,
    plans: BTreeMap<Handle, LinkPlan>,
    bodies: &Bodies,
    world: &mut World,
    scene: &Scene,
) {
    let mut old: BTreeMap<Handle, Link> = std::mem::take(&mut links.0).into_iter().collect();
    for (handle, plan) in plans {
        let (Some(first), Some(second)) = (bodies.get(plan.first), bodies.get(plan.second)) else {
            continue;
        };
        let ends = [first.rigid, second.rigid];
        let reset = scene
            .object(handle)
            .is_ok_and(|object| object.dynamics_reset);
        let is_unchanged = |link: &Link| link.plan == plan && link.bodies == ends && !reset;
        let existing = if old.get(&handle).is_some_and(is_unchanged) {
            old.remove(&handle)
        } else {
            None
        };
        let mut link = match existing {
            Some(link) => link,
            None => Link::insert(plan, ends, world),
        };
        let settings = &scene.settings().dynamics;
        let (engine, surrounding) = (settings.engine.engine, settings.surrounding());
        let actuation = scene.object(handle).map(|object| object.actuation(engine));
        let actuation = actuation.unwrap_or_default();
        link.actuation = actuation.map(|actuation| actuation.within(&surrounding));
        if let Ok(joint) = scene.object(handle).and_then(|object| object.joint()) {
            link.set_limits(joint, surrounding.has_joint_limits, world);
            if link.fresh {
                link.motion.position =
                    joint.position + wrap_angle(link.motion.position - joint.position);
            }
        }
        links.0.push((handle, link));
    }
    for link in old.into_values() {
        world.joints.remove(link.joint, true);
    }
}

impl Link {
    fn insert(plan: LinkPlan, bodies: [RigidBodyHandle; 2], world: &mut World) -> Self {
        let mut data = GenericJoint::new(locked_axes(&plan));
        data.softness = SOFTNESS;
        data.set_local_frame1(to_pose(&plan.base))
            .set_local_frame2(to_pose(&plan.tip));
        let joint = world.joints.insert(bodies[0], bodies[1], data, true);
        let mut link = Self {
            plan,
            joint,
            bodies,
            motor: Motor::default(),
            motion: Motion {
                position: 0.0,
                velocity: 0.0,
            },
            turned: 0.0,
            fresh: true,
            drive: None,
            actuation: None,
            passive: Passive::default(),
            actuator_force: 0.0,
            stops: None,
            solution: None,
            shared: true,
            parts: 1,
            efforts: Vec::new(),
            loads: Vec::new(),
            rows: None,
        };
        link.motion.position = link
            .deviation(world)
            .map_or(0.0, |relative| link.plan.kind.joint().coordinate(&relative));
        link
    }

    /// The axis the motor works on, if this kind has one.
    fn axis(&self) -> Option<JointAxis> {
        match self.plan.kind {
            LinkKind::Revolute => Some(JointAxis::AngZ),
            LinkKind::Prismatic => Some(JointAxis::LinZ),
            _ => None,
        }
    }

    fn set_limits(&mut self, joint: &Joint, are_on: bool, world: &mut World) {
        let (Some(axis), Some(link)) = (self.axis(), world.joints.get_mut(self.joint, false))
        else {
            return;
        };
        let has_stops = are_on
            && !joint.cyclic
            && (self.plan.kind == LinkKind::Prismatic || joint.range < MAX_STOP_RANGE);
        self.stops = has_stops.then_some([joint.min, joint.min + joint.range]);
        match self.stops {
            Some(stops) => drop(link.data.set_limits(axis, stops)),
            None => link.data.limit_axes.remove(axis.into()),
        }
    }

    /// Sets the motor for the next sub-step; None switches it off.
    pub(super) fn set_drive(&mut self, drive: Option<Drive>, world: &mut World) {
        self.drive = drive.filter(|drive| drive.velocity.is_finite() && drive.force.is_finite());
        if self.shared {
            self.set_engine_motor(world);
        }
    }

    /// Sets what the joint is to do in the next sub-step by its control, or as MuJoCo's actuators do.
    pub(super) fn set_orders(
        &mut self,
        joint: &Joint,
        engine: Engine,
        step: f64,
        world: &mut World,
    ) {
        let orders = self
            .actuation
            .map(|actuation| actuated(joint, &actuation, self.motion));
        let Orders { passive, force } = orders.unwrap_or_default();
        self.passive = passive;
        self.actuator_force = force.unwrap_or(0.0);
        let drive = match force {
            Some(_) => None,
            None => self.motor.drive(joint, engine, self.motion, step),
        };
        self.set_drive(drive, world);
    }

    /// Sets rapier's motor, which matters only where rapier solves the link as well.
    fn set_engine_motor(&self, world: &mut World) {
        let (Some(axis), Some(link)) = (self.axis(), world.joints.get_mut(self.joint, true)) else {
            return;
        };
        match self.drive {
            Some(Drive { velocity, force }) => {
                link.data
                    .set_motor_model(axis, MotorModel::AccelerationBased);
                link.data.set_motor(axis, 0.0, velocity, 0.0, RIGID);
                link.data.set_motor_max_force(axis, force);
            }
            None => link.data.motor_axes.remove(axis.into()),
        }
    }

    /// Whether rapier solves the link as well.
    pub(super) fn share(&mut self, with_engine: bool, world: &mut World) {
        if self.shared != with_engine
            && let Some(link) = world.joints.get_mut(self.joint, false)
        {
            link.data.set_enabled(with_engine);
            self.shared = with_engine;
            if with_engine {
                self.set_engine_motor(world);
            }
        }
    }

    /// Stores the exact solution; the rest is left to rapier's motor.
    pub(super) fn set_solution(&mut self, load: &JointLoad, world: &mut World) {
        self.solution = Some(*load);
        let (Some(axis), Some(drive), true) = (self.axis(), self.drive, self.shared) else {
            return;
        };
        if let Some(link) = world.joints.get_mut(self.joint, true) {
            link.data
                .set_motor_max_force(axis, (drive.force - load.motor.abs()).max(0.0));
        }
    }

    /// Stores the exact solution as it was after the step.
    pub(super) fn correct_solution(&mut self, load: &JointLoad) {
        self.solution = Some(*load);
    }

    /// Moving side of the link seen from its base, as the engine has it.
    pub(super) fn deviation(&self, world: &World) -> Option<Pose> {
        let base = self.end(0, world)? * self.plan.base;
        let tip = self.end(1, world)? * self.plan.tip;
        Some(base.inv_mul(&tip))
    }

    fn end(&self, index: usize, world: &World) -> Option<Pose> {
        Some(from_pose(world.bodies.get(self.bodies[index])?.position()))
    }

    /// Notes how far the sub-step just made turned the joint: a fast wheel makes more than half a turn in it.
    pub(super) fn note_turn(&mut self, world: &World, step: f64) {
        let [Some(first), Some(second)] = self.bodies.map(|body| world.bodies.get(body)) else {
            return;
        };
        let axis = from_pose(first.position()) * self.plan.base * Vector3::z();
        let spin = Vector3::from(from_vector(second.angvel() - first.angvel()));
        self.turned = Some(spin.dot(&axis) * step)
            .filter(|turned| turned.is_finite())
            .unwrap_or(0.0);
    }

    /// Prepares what is needed to read the load after the sub-step.
    pub(super) fn before_step(&mut self, world: &World) {
        if self.plan.kind == LinkKind::Sensor {
            self.rows = Rows::new(world, self.bodies, &self.plan);
        }
    }

    /// Reads position, velocity, effort and load after a sub-step of `step` seconds; returns the pose of the moving side.
    pub(super) fn after_step(&mut self, world: &World, step: f64) -> Option<Pose> {
        let relative = self.deviation(world).and_then(Finite::finite)?;
        let before = self.motion.position;
        let position = self
            .plan
            .kind
            .joint()
            .continued_coordinate(&relative, before, self.turned);
        self.motion = Motion {
            position,
            velocity: (position - before) / step,
        };
        self.fresh = false;
        let joint = world.joints.get(self.joint)?;
        let solution = self.solution.take().unwrap_or(JointLoad {
            rows: Vector6::zeros(),
            motor: 0.0,
        });
        let axis = self.axis().filter(|_| self.shared && self.drive.is_some());
        let impulse = axis.map_or(0.0, |axis| joint.data.motors[axis as usize].impulse);
        // Values that overflowed are not read at all.
        // rapier remembers the impulses of the last part.
        let part = step / self.parts as f64;
        self.efforts.push(
            (impulse / part - solution.motor - self.actuator_force)
                .finite()
                .unwrap_or(0.0),
        );
        if let Some(residual) = self.rows.take() {
            let impulses = if self.shared {
                joint.impulses
            } else {
                Default::default()
            };
            let (force, torque) = residual.load(&impulses, part);
            let load = |of: [f64; 3], at: usize| {
                [0, 1, 2].map(|i| (of[i] - solution.rows[at + i]).finite().unwrap_or(0.0))
            };
            self.loads.push((load(force, 0), load(torque, 3)));
        }
        Some(relative)
    }
}

/// rapier knows no screw: what ties its turns to its way, only the exact solution holds.
fn locked_axes(plan: &LinkPlan) -> JointAxesMask {
    let all = JointAxesMask::all();
    match plan.kind {
        LinkKind::Revolute if plan.pitch != 0.0 => {
            all.difference(JointAxesMask::ANG_Z | JointAxesMask::LIN_Z)
        }
        LinkKind::Revolute => all.difference(JointAxesMask::ANG_Z),
        LinkKind::Prismatic => all.difference(JointAxesMask::LIN_Z),
        LinkKind::Spherical => JointAxesMask::LIN_AXES,
        LinkKind::Sensor | LinkKind::Weld => all,
    }
}

/// Clears the reset requests of links that were rebuilt.
pub(super) fn clear_resets(links: &Links, scene: &mut Scene) {
    for (handle, _) in links.iter() {
        if scene
            .object(handle)
            .is_ok_and(|object| object.dynamics_reset)
        {
            // The handle was just read.
            let _ = scene.modify(handle, Field::Dynamics, |object| {
                object.dynamics_reset = false;
            });
        }
    }
}

/// Whether a script moved a link or requested a reset.
pub(super) fn were_touched(links: &Links, scene: &Scene) -> bool {
    links.iter().any(|(handle, link)| {
        scene.object(handle).map_or(true, |object| {
            object.pose() != link.plan.base || object.dynamics_reset
        })
    })
}
