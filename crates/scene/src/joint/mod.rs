//! Joints as data: type, mode, limits, position, control parameters.

mod actuation;
pub mod control;
pub(crate) mod dependency;
pub mod motion;
mod numbers;
#[cfg(test)]
mod tests;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};

pub use actuation::{ACTUATOR, Actuation, Actuator, ActuatorKind, Actuators, Passive};

use super::parameters::engine::Engine;
use super::{Handle, InertValues, Pose};

/// Type of a joint; its number is `sim.joint_*`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointType {
    /// Turns about z; with a screw lead it moves along z too.
    Revolute = 10,
    /// Moves along z.
    Prismatic = 11,
    /// Turns about any axis.
    Spherical = 12,
}

/// What moves a joint; its number is `sim.jointmode_*`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointMode {
    /// Scripts set the position, or a target that it moves to.
    Kinematic = 0,
    /// As kinematic; only scenes of old releases have it.
    Motion = 1,
    /// As kinematic; joints of inverse kinematics in scenes before 4.2.
    InverseKinematics = 2,
    /// The position follows that of another joint.
    Dependent = 4,
    /// The physics moves the joint.
    Dynamic = 5,
}

/// How a dynamic joint is driven (`sim.jointdynctrl_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// No motor.
    Free = 0,
    /// The motor exerts the target force.
    Force = 1,
    /// The motor seeks the target velocity.
    Velocity = 4,
    /// The motor seeks the target position, by a PID controller.
    Position = 8,
    /// Position control, unless a script answers; only old scenes have it.
    PositionOrCallback = 9,
    /// The motor is a spring and damper about the target position.
    Spring = 12,
    /// Spring control, unless a script answers; only old scenes have it.
    SpringOrCallback = 13,
    /// A script decides in every sub-step.
    Callback = 16,
}

/// Solver for a chain of dynamic joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum JointSolver {
    /// All joints of the chain are solved at once, exactly.
    #[default]
    Exact,
    /// The engine's impulse joints, one after the other.
    Impulse,
}

impl JointSolver {
    /// As scripts call it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Impulse => "impulse",
        }
    }

    /// The solver that scripts call by `word`.
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Exact, Self::Impulse]
            .into_iter()
            .find(|solver| solver.word() == word)
    }
}

/// A joint: revolute values in rad, prismatic ones in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Revolute, prismatic or spherical.
    pub joint_type: JointType,
    /// What moves it.
    pub mode: JointMode,
    /// Moved by the physics whatever its mode, as old scenes have it for inverse kinematics: its motor seeks the target position.
    pub hybrid: bool,
    /// How its motor is driven in dynamic mode.
    pub control: Control,
    /// It has no limits: angles are kept within half a turn of zero.
    pub cyclic: bool,
    /// Lower limit and width of the interval.
    pub min: f64,
    /// Width of the interval of positions.
    pub range: f64,
    /// Positions that the physics reports are limited to the interval.
    pub enforce_limits: bool,
    /// Position of a revolute or prismatic joint.
    pub position: f64,
    /// Position of a spherical joint.
    pub spherical: UnitQuaternion<f64>,
    /// Last known velocity: of the profile, of the physics, or of the master.
    pub velocity: f64,
    /// Last known acceleration of a kinematic motion, rad/s^2 or m/s^2.
    pub accel: f64,
    /// Position that a motion or a motor seeks.
    pub target_position: f64,
    /// Velocity that a motion or a motor seeks, rad/s or m/s.
    pub target_velocity: f64,
    /// Signed, N or N m.
    pub target_force: f64,
    /// Largest velocity of motions, rad/s or m/s.
    pub max_vel: f64,
    /// Largest acceleration of motions, rad/s^2 or m/s^2.
    pub max_accel: f64,
    /// Largest jerk of motions, rad/s^3 or m/s^3.
    pub max_jerk: f64,
    /// Gains of position control, P, I, D, by the number of the engine they are meant for.
    pub gains: [[f64; 3]; Engine::ALL.len()],
    /// K and C of spring control.
    pub spring: [f64; 2],
    /// Velocity control keeps to the limits of acceleration and jerk.
    pub velocity_profile: bool,
    /// Position control keeps to the limits of velocity, acceleration and jerk.
    pub position_profile: bool,
    /// Velocity control holds the position at target velocity 0.
    pub motor_lock: bool,
    /// Metres per turn; revolute joints only.
    pub screw_lead: f64,
    /// The joint it follows in dependent mode, and how.
    pub dependency: Option<JointDependency>,
    /// Offset and coefficient while it follows none: those of its last dependency.
    pub idle_law: [f64; 2],
    /// How the physics solves it.
    pub solver: JointSolver,
    /// Tagged for explicit handling by a script.
    pub explicit: bool,
    /// What groups of inverse kinematics of V-REP know about it.
    pub ik: IkSettings,
    /// The kinematic motion in progress.
    pub motion: Option<JointMotion>,
    /// Length and diameter, for display.
    pub size: [f64; 2],
    /// Deviation of the physics engine's result from the ideal joint.
    pub error: Option<Pose>,
    /// Effort of the last dynamics call: mean over its sub-steps, and of the last sub-step.
    pub force: Option<f64>,
    /// Effort of the last sub-step of the physics, N m or N.
    pub raw_force: Option<f64>,
    /// Parameters of physics engines that have no field, as they were set.
    pub engine_values: InertValues,
}

/// How a joint takes part in inverse kinematics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkSettings {
    /// A joint with a larger one moves more.
    pub weight: f64,
    /// Largest change in one iteration, rad or m.
    pub max_step: f64,
}

/// q = offset + coefficient * position of the master.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointDependency {
    /// The joint that is followed.
    pub master: Handle,
    /// Position at position 0 of the master, rad or m.
    pub offset: f64,
    /// Change of position per change of the master's.
    pub coefficient: f64,
}

/// Target of a kinematic joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointMotion {
    /// It moves to the target position.
    ToPosition,
    /// It reaches and keeps the target velocity.
    AtVelocity {
        /// Velocity to start from, rad/s or m/s; None for the present one.
        initial: Option<f64>,
    },
}

impl Joint {
    /// A joint as `sim.createJoint` makes it.
    pub fn new(joint_type: JointType, mode: JointMode) -> Self {
        let revolute = joint_type == JointType::Revolute;
        let (min, range, force, limits) = match joint_type {
            JointType::Revolute => (-PI, TAU, 2.5, TAU),
            JointType::Prismatic => (-0.5, 1.0, 50.0, 1.0),
            JointType::Spherical => (0.0, PI, 0.0, TAU),
        };
        Self {
            joint_type,
            mode,
            hybrid: false,
            control: Control::Free,
            cyclic: revolute || joint_type == JointType::Spherical,
            min,
            range,
            enforce_limits: false,
            position: 0.0,
            spherical: UnitQuaternion::identity(),
            velocity: 0.0,
            accel: 0.0,
            target_position: 0.0,
            target_velocity: 0.0,
            target_force: force,
            max_vel: limits,
            max_accel: limits,
            max_jerk: limits,
            gains: [[0.1, 0.0, 0.0]; Engine::ALL.len()],
            spring: [0.1, 0.0],
            velocity_profile: false,
            position_profile: false,
            motor_lock: false,
            screw_lead: 0.0,
            dependency: None,
            idle_law: [0.0, 1.0],
            solver: JointSolver::Exact,
            explicit: false,
            ik: IkSettings {
                weight: 1.0,
                max_step: if revolute { 10_f64.to_radians() } else { 0.1 },
            },
            motion: None,
            size: [0.15, 0.02],
            error: None,
            force: None,
            raw_force: None,
            engine_values: InertValues::default(),
        }
    }

    /// Transform from the joint frame to its moving (child) side, physics error included.
    pub fn intrinsic_pose(&self) -> Pose {
        let ideal = self.ideal_pose();
        self.error.map_or(ideal, |error| ideal * error)
    }

    /// Transform from the joint frame to its moving side, by the joint position alone.
    pub fn ideal_pose(&self) -> Pose {
        match self.joint_type {
            JointType::Revolute => Isometry3::from_parts(
                Translation3::new(0.0, 0.0, self.position * self.screw_lead / TAU),
                UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.position),
            ),
            JointType::Prismatic => Isometry3::translation(0.0, 0.0, self.position),
            JointType::Spherical => Isometry3::from_parts(Translation3::identity(), self.spherical),
        }
    }

    /// Gains of position control (P, I, D) when that engine is selected.
    pub fn gains_with(&self, engine: Engine) -> [f64; 3] {
        self.gains[engine as usize]
    }

    /// Whether its position is an angle about one axis.
    pub fn is_revolute(&self) -> bool {
        self.joint_type == JointType::Revolute
    }
}
