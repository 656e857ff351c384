//! Joints.

use super::Pose;

/// What connects two links.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name, unique in the robot.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// The index of the link that carries the joint.
    pub parent: usize,
    /// The index of the link that it moves.
    pub child: usize,
    /// The frame of the joint in the parent's frame.
    pub origin: Pose,
    /// The frame of the child in the joint's frame, at position 0. URDF has none: the child's frame is the joint's.
    pub child_pose: Pose,
    /// As written, in the joint's frame: not necessarily of length 1.
    pub axis: [f64; 3],
    /// Where and how fast it may move.
    pub limits: Limits,
    /// What resists its motion.
    pub dynamics: Dynamics,
    /// The joint whose position decides its own, if there is one.
    pub mimic: Option<Mimic>,
    /// Where it is at first.
    pub reference: f64,
    /// Its line in the file, from 1; 0 if it is in none.
    pub line: u32,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Does not move.
    Fixed,
    /// Turns about the axis within limits.
    Revolute,
    /// Turns about the axis without end.
    Continuous,
    /// Moves along the axis.
    Prismatic,
    /// Turns about its origin.
    Spherical,
    /// Moves across the axis, and turns about it.
    Planar,
    /// Moves freely.
    Floating,
}

impl JointKind {
    /// How many numbers a position of the joint has: a rotation is a quaternion (x, y, z, w), a floating joint has a place before it, and a planar
    /// one two distances along the perpendiculars of the axis and an angle.
    pub fn numbers(self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute | Self::Continuous | Self::Prismatic => 1,
            Self::Planar => 3,
            Self::Spherical => 4,
            Self::Floating => 7,
        }
    }
}

/// Where and how fast a joint may move. What a file does not say is `None`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Limits {
    /// Radians or metres.
    pub lower: Option<f64>,
    /// Radians or metres.
    pub upper: Option<f64>,
    /// Greatest torque or force of its motor.
    pub effort: Option<f64>,
    /// Greatest speed, per second.
    pub velocity: Option<f64>,
}

/// What resists the motion of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dynamics {
    /// Torque or force per speed.
    pub damping: f64,
    /// Torque or force.
    pub friction: f64,
    /// Torque or force per distance from `rest`.
    pub stiffness: f64,
    /// Position where the spring exerts no force, radians or metres.
    pub rest: f64,
    /// Inertia of the motor's rotor, reflected to the axis: kg m² or kg.
    pub armature: f64,
}

/// A joint whose position is `multiplier` times that of another one, plus `offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// The index of the other joint.
    pub joint: usize,
    /// Change of position with that of the other joint.
    pub multiplier: f64,
    /// Position where that of the other joint is 0, radians or metres.
    pub offset: f64,
}
