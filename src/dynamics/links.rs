//! Joints, force sensors and welds as constraints between bodies.
//!
//! All of them are rapier's impulse joints, not its multibodies: loops, moving bases and readings of every link then work the same
//! way. The price is convergence: rapier's warm start of joints is undone by the first sweep over unbounded rows, so each sub-step
//! begins from nothing and linked bodies get about a hundred sweeps, as Bullet does. A stretched arm of six equal links sags by 0.01 rad
//! in its second joint. rapier knows no screw: a lead does not act in the dynamics.

use std::collections::BTreeMap;

use rapier3d_f64::prelude::{GenericJoint, ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel, RigidBodyHandle};

use super::bodies::Bodies;
use super::convert::{from_pose, to_pose};
use super::load::{Load, Rows};
use super::motors::{Drive, Motion, Motor, wrap};
use super::plan::{LinkKind, LinkPlan};
use super::world::World;
use crate::scene::joint::Joint;
use crate::scene::{Handle, Pose, Scene};

/// Damping that makes a velocity motor rigid within its force.
const RIGID: f64 = 1e12;
/// A revolute joint with a wider range has no stops, radians.
const WIDEST_STOPS: f64 = 359.0 * std::f64::consts::PI / 180.0;

/// The links by the object that stands for them.
pub(super) type Links = BTreeMap<Handle, Link>;

/// A constraint in the engine.
pub(super) struct Link {
    pub plan: LinkPlan,
    joint: ImpulseJointHandle,
    bodies: [RigidBodyHandle; 2],
    pub motor: Motor,
    /// Position, turns counted, and its change over the last sub-step.
    pub motion: Motion,
    /// No sub-step has run yet since the link was made.
    pub fresh: bool,
    motor_on: bool,
    /// Effort of the motor on the parent in each sub-step of this call.
    pub efforts: Vec<f64>,
    /// What a force sensor felt in each sub-step of this call.
    pub loads: Vec<Load>,
    rows: Option<Rows>,
}

/// Makes the engine's constraints those of the plan.
pub(super) fn follow(
    links: &mut Links,
    plans: BTreeMap<Handle, LinkPlan>,
    bodies: &Bodies,
    world: &mut World,
    scene: &Scene,
) {
    let mut old = std::mem::take(links);
    for (handle, plan) in plans {
        let (Some(first), Some(second)) = (bodies.get(plan.first), bodies.get(plan.second)) else { continue };
        let ends = [first.rigid, second.rigid];
        let kept = old.remove(&handle).filter(|link| link.plan == plan && link.bodies == ends);
        let mut link = match kept {
            Some(link) => link,
            None => Link::insert(plan, ends, world),
        };
        if let Ok(joint) = scene.object(handle).and_then(|object| object.joint()) {
            link.take_limits(joint, world);
            if link.fresh {
                link.motion.position = joint.position + wrap(link.motion.position - joint.position);
            }
        }
        links.insert(handle, link);
    }
    for link in old.into_values() {
        world.joints.remove(link.joint, true);
    }
}

impl Link {
    fn insert(plan: LinkPlan, bodies: [RigidBodyHandle; 2], world: &mut World) -> Self {
        let mut data = GenericJoint::new(locked_axes(plan.kind));
        data.set_local_frame1(to_pose(&plan.base)).set_local_frame2(to_pose(&plan.tip));
        let joint = world.joints.insert(bodies[0], bodies[1], data, true);
        let mut link = Self {
            plan,
            joint,
            bodies,
            motor: Motor::default(),
            motion: Motion { position: 0.0, velocity: 0.0 },
            fresh: true,
            motor_on: false,
            efforts: Vec::new(),
            loads: Vec::new(),
            rows: None,
        };
        link.motion.position = link.deviation(world).map_or(0.0, |relative| link.coordinate(&relative));
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

    fn take_limits(&mut self, joint: &Joint, world: &mut World) {
        let (Some(axis), Some(link)) = (self.axis(), world.joints.get_mut(self.joint, false)) else { return };
        let stops = !joint.cyclic && (self.plan.kind == LinkKind::Prismatic || joint.range < WIDEST_STOPS);
        if stops {
            link.data.set_limits(axis, [joint.min, joint.min + joint.range]);
        } else {
            link.data.limit_axes.remove(axis.into());
        }
    }

    /// Sets the motor for the next sub-step; None switches it off.
    pub(super) fn set_drive(&mut self, drive: Option<Drive>, world: &mut World) {
        let (Some(axis), Some(link)) = (self.axis(), world.joints.get_mut(self.joint, true)) else { return };
        let drive = drive.filter(|drive| drive.velocity.is_finite() && drive.force.is_finite());
        self.motor_on = drive.is_some();
        match drive {
            Some(Drive { velocity, force }) => {
                link.data.set_motor_model(axis, MotorModel::AccelerationBased);
                link.data.set_motor(axis, 0.0, velocity, 0.0, RIGID);
                link.data.set_motor_max_force(axis, force);
            }
            None => link.data.motor_axes.remove(axis.into()),
        }
    }

    /// Moving side of the link seen from its base, as the engine has it.
    pub(super) fn deviation(&self, world: &World) -> Option<Pose> {
        let base = self.end(0, world)? * self.plan.base;
        let tip = self.end(1, world)? * self.plan.tip;
        Some(base.inverse() * tip)
    }

    fn end(&self, index: usize, world: &World) -> Option<Pose> {
        Some(from_pose(world.bodies.get(self.bodies[index])?.position()))
    }

    /// Angle about or distance along the axis.
    fn coordinate(&self, relative: &Pose) -> f64 {
        match self.plan.kind {
            LinkKind::Revolute => wrap(2.0 * relative.rotation.k.atan2(relative.rotation.w)),
            LinkKind::Prismatic => relative.translation.z,
            _ => 0.0,
        }
    }

    /// Prepares what is needed to read the load after the sub-step.
    pub(super) fn before_step(&mut self, world: &World) {
        if self.plan.kind == LinkKind::Sensor {
            self.rows = Rows::new(world, self.bodies, &self.plan);
        }
    }

    /// Reads position, velocity, effort and load after a sub-step of `step` seconds; returns the pose of the moving side.
    pub(super) fn after_step(&mut self, world: &World, step: f64) -> Option<Pose> {
        let relative = self.deviation(world)?;
        let now = self.coordinate(&relative);
        let before = self.motion.position;
        let change = if self.plan.kind == LinkKind::Revolute { wrap(now - before) } else { now - before };
        self.motion = Motion { position: before + change, velocity: change / step };
        self.fresh = false;
        let joint = world.joints.get(self.joint)?;
        let motor = self.axis().filter(|_| self.motor_on).map(|axis| &joint.data.motors[axis as usize]);
        self.efforts.push(motor.map_or(0.0, |motor| motor.impulse / step));
        if let Some(rows) = self.rows.take() {
            self.loads.push(rows.load(&joint.impulses, step));
        }
        Some(relative)
    }
}

fn locked_axes(kind: LinkKind) -> JointAxesMask {
    let all = JointAxesMask::all();
    match kind {
        LinkKind::Revolute => all.difference(JointAxesMask::ANG_Z),
        LinkKind::Prismatic => all.difference(JointAxesMask::LIN_Z),
        LinkKind::Spherical => JointAxesMask::LIN_AXES,
        LinkKind::Sensor | LinkKind::Weld => all,
    }
}

/// Whether a script moved a link, or asks for it to be built anew.
pub(super) fn were_touched(links: &Links, scene: &Scene) -> bool {
    links.iter().any(|(&handle, link)| scene.object(handle).map_or(true, |object| object.pose() != link.plan.base))
}
