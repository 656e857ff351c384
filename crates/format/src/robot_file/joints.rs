//! Joints become joints, force sensors and dummies.

use nalgebra::{UnitQuaternion, Vector3};
use robot_description::mjcf::{Actuator, Drive, Target};
use robot_description::{Dynamics, Joint as Description, JointKind, Limits, Robot};

use super::{Import, RobotFormat, RobotImportOptions};
use scene::joint::{
    self as motor, ACTUATOR, ActuatorKind, Control, Joint, JointMode, JointType, Passive,
};
use scene::object::dummy::Dummy;
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};
use scene::{Data, Edit, Field, Handle, Kind, Layers, Namespace, Pose, SceneResult, ValueType};

/// Torque of a motor with limits, N m; force of one that slides, or that turns without end, N or N m; speed of both (spec: import 1).
const TORQUE: f64 = 2.0;
const FORCE: f64 = 200.0;
const VELOCITY: f64 = 20.0;
/// The largest force or torque of a motor whose file says none, N or N m.
const ANY_EFFORT: f64 = 1e6;
/// How far a joint of MJCF slides whose file says no limits, metres; those of others keep CoppeliaSim's.
const ANY_WAY: f64 = 500.0;
/// The speed up to which a spring pushes, rad/s or m/s.
const SPRING_SPEED: f64 = 1000.0;
/// Diameter of a dummy, metres.
pub(super) const DUMMY: f64 = 0.01;

impl Import<'_> {
    /// Adds a joint below what carries its parent.
    pub(super) fn add_joint(
        &mut self,
        index: usize,
        parent: Option<Handle>,
    ) -> SceneResult<Handle> {
        let joint = &self.robot.joints[index];
        let origin = self.placed[joint.parent] * joint.origin;
        let kind = match joint.kind {
            JointKind::Fixed => Kind::ForceSensor(Box::new(rigid_link())),
            JointKind::Floating | JointKind::Planar => Kind::Dummy(Dummy::new(DUMMY)),
            JointKind::Revolute | JointKind::Continuous => {
                return self.add_motor(index, JointType::Revolute, origin, parent);
            }
            JointKind::Prismatic => {
                return self.add_motor(index, JointType::Prismatic, origin, parent);
            }
            JointKind::Spherical => {
                return self.add_motor(index, JointType::Spherical, origin, parent);
            }
        };
        self.add(&joint.name, kind, origin, parent)
    }

    fn add_motor(
        &mut self,
        index: usize,
        joint_type: JointType,
        origin: Pose,
        parent: Option<Handle>,
    ) -> SceneResult<Handle> {
        let description = &self.robot.joints[index];
        let mut joint = Joint::new(joint_type, JointMode::Dynamic);
        let mut actuation = None;
        if joint_type != JointType::Spherical {
            set_limits(&mut joint, description, self.first[index], self.format);
            match &self.model.actuators {
                _ if self.options.contains(RobotImportOptions::FREE_JOINTS) => {
                    set_passive(&mut joint, &description.dynamics);
                }
                None => joint.set_control(Control::Position),
                Some(actuators) => {
                    let of_joint = actuators
                        .iter()
                        .filter(|actuator| actuator.target == Target::Joint(index));
                    actuation = Some(set_actuators(&mut joint, description, of_joint));
                }
            }
        }
        let pose = origin * along_axis(description);
        let handle = self.add(
            &description.name,
            Kind::Joint(Box::new(joint)),
            pose,
            parent,
        )?;
        if let Some(actuators) = actuation {
            let text = Data::text(&actuators.to_string());
            let edit = Edit::Name(ACTUATOR, Some((ValueType::String, text)));
            self.scene
                .edit_named_values(Some(handle), Namespace::CustomData, edit)?;
        }
        if !self.options.contains(RobotImportOptions::SHOW_JOINTS) {
            self.scene.modify(handle, Field::Layer, |object| {
                object.layer = Layers::JOINTS.hidden();
            })?;
        }
        Ok(handle)
    }
}

impl Import<'_> {
    /// Says once which joints lose their damping or friction: a motor here takes no notice of them.
    pub(super) fn report_dynamics(&mut self) {
        let losing: Vec<&Description> = (self.robot.joints.iter().enumerate())
            .filter(|(index, joint)| self.loses_dynamics(*index, joint))
            .map(|(_, joint)| joint)
            .collect();
        self.report_further_actuators();
        let Some(first) = losing.first() else {
            return;
        };
        let others = match losing.len() {
            1 => String::new(),
            count => format!(" and {} others", count - 1),
        };
        self.messages.push(format!(
            "line {}, <joint>: damping or friction of joint '{}'{others} does not count: motors take no notice of it, and of a joint without motor damping counts before friction",
            first.line, first.name
        ));
    }

    /// Of actuators of a kind that act on one joint, the later ones are said: a script tells them the same.
    fn report_further_actuators(&mut self) {
        let actuators = self.model.actuators.as_deref().unwrap_or_default();
        let is_further = |(number, actuator): &(usize, &Actuator)| {
            let is_same = |other: &Actuator| {
                other.target == actuator.target && kind_of(other) == kind_of(actuator)
            };
            actuators[..*number].iter().any(is_same)
        };
        for (_, actuator) in actuators.iter().enumerate().filter(is_further) {
            self.messages.push(format!(
                "line {}: actuator '{}' and another one of its kind on the same joint or tendon are one, which is told the same",
                actuator.line, actuator.name
            ));
        }
    }

    fn loses_dynamics(&self, index: usize, joint: &Description) -> bool {
        let Dynamics {
            damping, friction, ..
        } = joint.dynamics;
        let is_passive = match &self.model.actuators {
            _ if self.options.contains(RobotImportOptions::FREE_JOINTS) => true,
            Some(_) if joint.kind.numbers() == 1 => return false,
            Some(actuators) => actuators
                .iter()
                .all(|actuator| actuator.target != Target::Joint(index)),
            None => false,
        };
        let moves = joint.kind.numbers() == 1 && joint.mimic.is_none();
        moves && (friction > 0.0 && (damping > 0.0 || !is_passive) || damping > 0.0 && !is_passive)
    }
}

/// The smallest rotation that takes z to the axis; about x, if it is half a turn.
fn along_axis(joint: &Description) -> Pose {
    let half_turn = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &joint.unit_axis())
        .unwrap_or_else(half_turn);
    Pose::from_parts(Default::default(), rotation)
}

/// Where the joints of a robot are at first.
pub(super) fn first_positions(robot: &Robot) -> Vec<f64> {
    let mut positions = robot.zero_positions();
    let mut start = 0;
    for joint in &robot.joints {
        if joint.kind.numbers() == 1 {
            positions[start] = first_position(joint);
        }
        start += joint.kind.numbers();
    }
    positions
}

/// Where the file has it at first, or the limit that is nearest to it.
fn first_position(joint: &Description) -> f64 {
    match (joint.limits.lower, joint.limits.upper, joint.kind) {
        (Some(lower), Some(upper), JointKind::Revolute | JointKind::Prismatic) => {
            joint.reference.min(upper).max(lower)
        }
        _ => joint.reference,
    }
}

fn set_limits(joint: &mut Joint, description: &Description, first: f64, format: RobotFormat) {
    let Limits {
        lower,
        upper,
        effort,
        velocity,
    } = description.limits;
    let is_limited = description.kind != JointKind::Continuous;
    if let (Some(lower), Some(upper), true) = (lower, upper, is_limited) {
        joint.set_interval(false, lower, upper - lower);
    } else if joint.joint_type == JointType::Prismatic && format == RobotFormat::Mjcf {
        joint.set_interval(false, -ANY_WAY, 2.0 * ANY_WAY);
    }
    joint.position = first;
    joint.target_position = joint.position;
    let default = if description.kind == JointKind::Revolute {
        TORQUE
    } else {
        FORCE
    };
    joint.set_target_force(effort.unwrap_or(default), false);
    joint.max_vel = velocity.unwrap_or(VELOCITY);
}

/// A joint of MJCF: what acts beside its motors are MuJoCo's parameters of it, what its motors do is the result. It has the control of the first. Their targets are 0,
/// or what is next to it, at first.
fn set_actuators<'a>(
    joint: &mut Joint,
    description: &Description,
    of_joint: impl Iterator<Item = &'a Actuator>,
) -> motor::Actuators {
    joint.set_passive(&passive_of(&description.dynamics));
    let mut made = motor::Actuators::default();
    let mut control = Control::Free;
    for actuator in of_joint {
        if made.iter().next().is_none() {
            control = kind_of(actuator).control();
            joint.set_target_force(actuator.effort.unwrap_or(ANY_EFFORT), false);
        }
        set_initial_target(joint, actuator);
        made.add(motor_of(actuator));
    }
    joint.set_control(control);
    made
}

fn kind_of(actuator: &Actuator) -> ActuatorKind {
    match actuator.drive {
        Drive::Position { .. } => ActuatorKind::Position,
        Drive::Velocity { .. } => ActuatorKind::Velocity,
        Drive::Force => ActuatorKind::Force,
    }
}

/// What a motor is told at first: 0, or what is next to it in its range.
fn set_initial_target(joint: &mut Joint, actuator: &Actuator) {
    match initial_target(actuator) {
        (Told::Force, _) => joint.set_target_force(0.0, true),
        (Told::Position, target) => joint.target_position = target,
        (Told::Velocity, target) => joint.target_velocity = target,
    }
}

/// What an actuator is told, in the order of what tendons are told.
#[derive(Debug, Clone, Copy)]
pub enum Told {
    /// A force, N, or a torque, N m.
    Force,
    /// A position, m or rad, or a length.
    Position,
    /// A speed, m/s or rad/s.
    Velocity,
}

/// What an actuator is told at first: 0, or what is next to it in its range.
pub fn initial_target(actuator: &Actuator) -> (Told, f64) {
    let target = actuator
        .control
        .map_or(0.0, |[low, high]| 0.0_f64.max(low).min(high));
    match actuator.drive {
        Drive::Position { .. } => (Told::Position, target),
        Drive::Velocity { .. } => (Told::Velocity, target),
        Drive::Force => (Told::Force, 0.0),
    }
}

/// The motor that an actuator of MJCF becomes.
pub fn motor_of(actuator: &Actuator) -> motor::Actuator {
    let mut made = motor::Actuator::new(kind_of(actuator));
    (made.bias, made.range) = (actuator.bias, actuator.range.unwrap_or(made.range));
    match actuator.drive {
        Drive::Position { stiffness, damping } => {
            (made.stiffness, made.damping) = (stiffness, damping);
        }
        Drive::Velocity { damping } => made.damping = damping,
        Drive::Force => {}
    }
    made
}

/// What acts along the axis of a joint beside its motors.
pub fn passive_of(dynamics: &Dynamics) -> Passive {
    Passive {
        armature: dynamics.armature,
        stiffness: dynamics.stiffness,
        rest: dynamics.rest,
        damping: dynamics.damping,
        friction: dynamics.friction,
    }
}

/// A joint that nothing drives is a spring and damper; else a brake that slips; else free.
fn set_passive(joint: &mut Joint, dynamics: &Dynamics) {
    if dynamics.damping > 0.0 || dynamics.stiffness > 0.0 {
        joint.spring = [dynamics.stiffness, dynamics.damping];
        if dynamics.stiffness > 0.0 {
            joint.target_position = dynamics.rest;
        }
        joint.target_velocity = SPRING_SPEED;
        joint.set_control(Control::Spring);
    } else if dynamics.friction > 0.0 {
        // A motor that keeps to speed 0 with so much force.
        joint.set_target_force(dynamics.friction, false);
        joint.target_velocity = 0.0;
        joint.set_control(Control::Velocity);
    } else {
        joint.set_control(Control::Free);
    }
}

fn rigid_link() -> ForceSensor {
    ForceSensor {
        size: 0.02,
        filter: ForceFilter::Median,
        sample_size: 4,
        ..ForceSensor::default()
    }
}
