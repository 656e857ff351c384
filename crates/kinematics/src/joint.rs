//! Joints: kind, position, limits, and what the solver may do with them.

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::rc::Rc;

use geometry::Pose;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::object::ObjectId;

/// The degrees of freedom of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointType {
    /// With a screw lead it moves along its axis as well.
    Revolute = 10,
    /// Moves along its axis.
    Prismatic = 11,
    /// Turns about any axis.
    Spherical = 12,
}

/// Who moves a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointMode {
    /// The solver leaves it where it is.
    Passive = 0,
    /// The solver moves it.
    Ik = 2,
}

/// A joint: revolute values in rad, prismatic ones in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The degrees of freedom.
    pub joint_type: JointType,
    /// Whether the solver moves it.
    pub mode: JointMode,
    /// Coordinate along or about the axis; not used by spherical joints.
    pub position: f64,
    /// Position of a spherical joint.
    pub rotation: UnitQuaternion<f64>,
    /// Without limits.
    pub cyclic: bool,
    /// Lower limit and width of the interval.
    pub min: f64,
    /// Width of the interval.
    pub range: f64,
    /// Metres per turn; revolute joints only.
    pub screw_lead: f64,
    /// A larger one makes the solver prefer this joint. Negative ones count as zero.
    pub weight: f64,
    /// Largest change in one iteration.
    pub max_step: f64,
    /// Distance to a limit from which `avoid_limits` pushes it away.
    pub limit_margin: f64,
    /// What decides its position, if that is another joint.
    pub dependency: Option<Dependency>,
}

/// The position of a joint is a function of that of its master.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependency {
    /// The joint it depends on.
    pub master: ObjectId,
    /// How it depends on it.
    pub law: Law,
}

/// From the position of a master to that of a dependent joint.
#[derive(Clone)]
pub enum Law {
    /// A linear function.
    Linear {
        /// Position where the master is at zero, rad or m.
        offset: f64,
        /// Change with that of the master.
        factor: f64,
    },
    /// Any function of the master's position.
    Function(Rc<dyn Fn(f64) -> f64>),
}

impl Law {
    /// The position of the dependent joint for that of its master.
    pub fn position(&self, master: f64) -> f64 {
        match self {
            Self::Linear { offset, factor } => offset + factor * master,
            Self::Function(function) => function(master),
        }
    }

    /// Change of the position with that of the master; by central differences where it is a function.
    pub(crate) fn slope(&self, master: f64) -> f64 {
        const STEP: f64 = 1e-6;
        match self {
            Self::Linear { factor, .. } => *factor,
            Self::Function(function) => {
                (function(master + STEP) - function(master - STEP)) / (2.0 * STEP)
            }
        }
    }
}

impl fmt::Debug for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Linear { offset, factor } => write!(f, "{offset} + {factor} q"),
            Self::Function(_) => f.write_str("function"),
        }
    }
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (
                Self::Linear { offset, factor },
                Self::Linear {
                    offset: o,
                    factor: f,
                },
            ) => (offset, factor) == (o, f),
            (Self::Function(function), Self::Function(other)) => Rc::ptr_eq(function, other),
            _ => false,
        }
    }
}

impl Joint {
    /// A joint in IK mode at zero: revolute ones cyclic, prismatic ones from -0.5 m to 0.5 m.
    pub fn new(joint_type: JointType) -> Self {
        let (cyclic, min, range) = match joint_type {
            JointType::Prismatic => (false, -0.5, 1.0),
            JointType::Revolute => (true, -PI, TAU),
            JointType::Spherical => (true, 0.0, PI),
        };
        let prismatic = joint_type == JointType::Prismatic;
        Self {
            joint_type,
            mode: JointMode::Ik,
            position: 0.0,
            rotation: UnitQuaternion::identity(),
            cyclic,
            min,
            range,
            screw_lead: 0.0,
            weight: 1.0,
            max_step: if prismatic { 0.1 } else { 10_f64.to_radians() },
            limit_margin: if prismatic { 0.01 } else { 5_f64.to_radians() },
            dependency: None,
        }
    }

    /// From the resting side to the moving side.
    pub fn motion(&self) -> Pose {
        match self.joint_type {
            JointType::Revolute => {
                let (sine, cosine) = libm::sincos(0.5 * self.position);
                let turn = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(
                    cosine, 0.0, 0.0, sine,
                ));
                Isometry3::from_parts(
                    Translation3::new(0.0, 0.0, self.position * self.screw_lead / TAU),
                    turn,
                )
            }
            JointType::Prismatic => Isometry3::translation(0.0, 0.0, self.position),
            JointType::Spherical => Isometry3::from_parts(Translation3::identity(), self.rotation),
        }
    }

    /// The interval of positions; None where there are no limits.
    pub fn limits(&self) -> Option<[f64; 2]> {
        let limited = self.joint_type != JointType::Spherical && !self.cyclic;
        limited.then_some([self.min, self.min + self.range])
    }

    /// The position of the interval that is closest; cyclic joints stay within half a turn of zero.
    pub(crate) fn within_limits(&self, position: f64) -> f64 {
        match self.limits() {
            // Not `clamp`, which panics on an empty interval.
            Some([low, high]) => position.min(high).max(low),
            None if self.joint_type == JointType::Revolute => wrapped(position),
            None => position,
        }
    }

    /// Turns a spherical joint by a rotation vector in its resting frame.
    pub(crate) fn turn(&mut self, by: Vector3<f64>) {
        let turned = UnitQuaternion::from_scaled_axis(by) * self.rotation;
        self.rotation = UnitQuaternion::new_normalize(turned.into_inner());
    }
}

/// An angle in (-pi, pi]; what is there already keeps its bits.
pub(crate) fn wrapped(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}
