//! Jacobian and errors of a group.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

use crate::chain::{Chain, Chains};
use crate::environment::{Environment, Frame};
use crate::error::Result;
use crate::group::{Constraints, ElementId, Group, GroupFlags};
use crate::joint::JointType;
use crate::object::ObjectId;
use crate::rigid::Rigid;

/// What a row of a Jacobian stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JacobianRow {
    /// One constraint of an element.
    Constraint {
        /// The element.
        element: ElementId,
        /// One of its constraints; ALPHA_BETA has two rows.
        constraint: Constraints,
    },
    /// A joint is pushed away from a limit.
    Limit {
        /// The joint.
        joint: ObjectId,
    },
}

/// What a column of a Jacobian stands for: a joint, of a spherical one the rotation about axis `stage` of its frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JacobianColumn {
    /// The joint.
    pub joint: ObjectId,
    /// Axis of the frame of a spherical joint, 0 to 2; 0 for other joints.
    pub stage: usize,
}

/// `jacobian * dq = errors`, to first order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Equations {
    /// What the rows stand for.
    pub rows: Vec<JacobianRow>,
    /// What the columns stand for.
    pub columns: Vec<JacobianColumn>,
    /// Row by row; in metres and radians, per metre and radian.
    pub jacobian: Vec<f64>,
    /// Without weights.
    pub errors: Vec<f64>,
    /// Largest linear (m) and angular (rad) error of all elements.
    pub(crate) precision: [f64; 2],
    pub(crate) linear_missed: bool,
    pub(crate) angular_missed: bool,
    /// Frames that do not move with the chains, one set for each.
    fixed: Vec<Frames>,
    /// Of the precisions, which errors must not exceed.
    share: f64,
    /// Of the links of one chain: the resting sides of the joints, in the world.
    resting: Vec<Rigid>,
}

/// The frames around a chain, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Frames {
    start: Rigid,
    target: Rigid,
    /// The axes of constraints; None where these are the world's.
    axes: Option<Matrix3<f64>>,
}

/// How the difference of two orientations is written as three numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Angles {
    Euler,
    RotationVector,
}

impl Equations {
    pub(crate) fn is_within(&self) -> bool {
        !self.linear_missed && !self.angular_missed
    }

    /// Forgets frames: before the first evaluation of a calculation, which asks for that share of the precisions.
    pub(crate) fn restart(&mut self, share: f64) {
        self.fixed.clear();
        self.share = share;
    }

    /// Computes everything for the present positions of the joints.
    pub(crate) fn evaluate(
        &mut self,
        env: &Environment,
        group: &Group,
        chains: &Chains,
        angles: Angles,
    ) -> Result<()> {
        if self.columns != chains.columns {
            self.columns.clone_from(&chains.columns);
        }
        self.rows.clear();
        self.jacobian.clear();
        self.errors.clear();
        (self.precision, self.linear_missed, self.angular_missed) = ([0.0; 2], false, false);
        for (i, chain) in chains.chains.iter().enumerate() {
            let frames = self.frames(env, chain, i)?;
            self.add_chain(env, group, chain, &frames, angles)?;
        }
        if angles == Angles::Euler && group.flags.contains(GroupFlags::AVOID_LIMITS) {
            self.add_limits(env)?;
        }
        Ok(())
    }

    fn frames(&mut self, env: &Environment, chain: &Chain, index: usize) -> Result<Frames> {
        if let Some(frames) = self.fixed.get(index).filter(|_| !chain.moving_frames) {
            return Ok(*frames);
        }
        let rigid = |id| env.pose(id, Frame::World).map(|pose| Rigid::from(&pose));
        let axes = chain
            .constraint_base
            .map(rigid)
            .transpose()?
            .map(|base| base.rotation);
        let frames = Frames {
            start: env.start_of(chain.base)?,
            target: rigid(chain.target)?,
            axes,
        };
        self.fixed.truncate(index);
        self.fixed.push(frames);
        Ok(frames)
    }

    fn add_chain(
        &mut self,
        env: &Environment,
        group: &Group,
        chain: &Chain,
        frames: &Frames,
        angles: Angles,
    ) -> Result<()> {
        let tip = self.place_joints(env, chain, frames.start)?;
        let difference = Difference::new(&tip, frames, chain.constraints);
        self.measure(group, chain, &difference);
        let first = self.rows.len();
        let errors = difference.errors(&tip, frames, chain.constraints, angles);
        for (bit, constraint) in SINGLE.into_iter().enumerate() {
            if chain.constraints.intersects(constraint) {
                // ALPHA_BETA has two rows.
                self.rows.push(JacobianRow::Constraint {
                    element: chain.element,
                    constraint,
                });
                self.errors.push(errors[bit]);
            }
        }
        self.jacobian
            .resize(self.rows.len() * self.columns.len(), 0.0);
        self.fill(env, chain, &tip, frames, first)
    }

    /// Forward kinematics: stores the joints and returns the tip.
    fn place_joints(&mut self, env: &Environment, chain: &Chain, start: Rigid) -> Result<Rigid> {
        self.resting.clear();
        let mut frame = start;
        for link in &chain.links {
            frame = frame.after(&link.before);
            self.resting.push(frame);
            let joint = env.joint(link.joint)?;
            match joint.joint_type {
                JointType::Revolute => {
                    frame.turn(joint.position);
                    if joint.screw_lead != 0.0 {
                        frame.shift(joint.position * joint.screw_lead / TAU);
                    }
                }
                JointType::Prismatic => frame.shift(joint.position),
                JointType::Spherical => {
                    frame.rotation *= joint.rotation.to_rotation_matrix().into_inner();
                }
            }
        }
        Ok(frame.after(&chain.to_tip))
    }

    fn measure(&mut self, group: &Group, chain: &Chain, difference: &Difference) {
        let precision = group.elements[chain.element.0]
            .as_ref()
            .map_or([0.0; 2], |element| element.precision);
        self.linear_missed |= exceeds(difference.distance, precision[0] * self.share);
        self.angular_missed |= exceeds(difference.angle, precision[1] * self.share);
        self.precision[0] = self.precision[0].max(difference.distance);
        self.precision[1] = self.precision[1].max(difference.angle);
    }

    fn fill(
        &mut self,
        env: &Environment,
        chain: &Chain,
        tip: &Rigid,
        frames: &Frames,
        first: usize,
    ) -> Result<()> {
        let angular_axes = if chain.constraints.contains(Constraints::ORIENTATION) {
            frames.axes
        } else {
            Some(tip.rotation)
        };
        for (i, link) in chain.links.iter().enumerate() {
            let Some(column) = link.column else { continue };
            let factor = if link.dependent {
                slope(env, link.joint)?
            } else {
                1.0
            };
            let resting = self.resting[i];
            let joint = env.joint(link.joint)?;
            let stages = if joint.joint_type == JointType::Spherical {
                0..3
            } else {
                2..3
            };
            for (place, axis) in stages.enumerate() {
                let z: Vector3<f64> = resting.rotation.column(axis).into();
                let (linear, angular) = match joint.joint_type {
                    JointType::Prismatic => (z, Vector3::zeros()),
                    _ => (
                        z.cross(&(tip.translation - resting.translation))
                            + z * (joint.screw_lead / TAU),
                        z,
                    ),
                };
                let linear = along(frames.axes.as_ref(), linear);
                let angular = along(angular_axes.as_ref(), angular);
                let numbers = [
                    linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
                ];
                self.add_to_column(
                    chain.constraints,
                    first,
                    column + place,
                    numbers.map(|x| x * factor),
                );
            }
        }
        Ok(())
    }

    fn add_to_column(
        &mut self,
        constraints: Constraints,
        first: usize,
        column: usize,
        numbers: [f64; 6],
    ) {
        let width = self.columns.len();
        let mut place = first * width + column;
        for (constraint, number) in SINGLE.into_iter().zip(numbers) {
            if constraints.intersects(constraint) {
                self.jacobian[place] += number;
                place += width;
            }
        }
    }

    /// A row for each joint that is close to a limit.
    fn add_limits(&mut self, env: &Environment) -> Result<()> {
        for column in 0..self.columns.len() {
            let id = self.columns[column].joint;
            let joint = env.joint(id)?;
            let Some([low, high]) = joint.limits() else {
                continue;
            };
            let (below, above) = (
                low + joint.limit_margin - joint.position,
                joint.position - high + joint.limit_margin,
            );
            for (sign, penetration) in [(1.0, below), (-1.0, above)] {
                if penetration > 0.0 {
                    self.rows.push(JacobianRow::Limit { joint: id });
                    self.errors.push(penetration);
                    let start = self.jacobian.len();
                    self.jacobian.resize(start + self.columns.len(), 0.0);
                    self.jacobian[start + column] = sign;
                }
            }
        }
        Ok(())
    }
}

/// The six rows a full pose has.
const SINGLE: [Constraints; 6] = [
    Constraints::X,
    Constraints::Y,
    Constraints::Z,
    Constraints::ALPHA_BETA,
    Constraints::ALPHA_BETA,
    Constraints::GAMMA,
];

/// What is not a number exceeds everything.
pub(crate) fn exceeds(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

/// Change of a dependent joint with its root master.
fn slope(env: &Environment, joint: ObjectId) -> Result<f64> {
    let mut slope = 1.0;
    let mut next = joint;
    while let Some(dependency) = &env.joint(next)?.dependency {
        slope *= dependency.law.slope(env.joint(dependency.master)?.position);
        next = dependency.master;
    }
    Ok(slope)
}

fn along(axes: Option<&Matrix3<f64>>, vector: Vector3<f64>) -> Vector3<f64> {
    axes.map_or(vector, |axes| axes.tr_mul(&vector))
}

/// What is between a tip and its target.
struct Difference {
    /// From tip to target, along the axes of the constraints.
    position: Vector3<f64>,
    /// The target's orientation as the tip sees it.
    rotation: Matrix3<f64>,
    /// Where it is constrained.
    distance: f64,
    angle: f64,
}

impl Difference {
    fn new(tip: &Rigid, frames: &Frames, constraints: Constraints) -> Self {
        let position = along(
            frames.axes.as_ref(),
            frames.target.translation - tip.translation,
        );
        let rotation = tip.rotation.tr_mul(&frames.target.rotation);
        let bits = [Constraints::X, Constraints::Y, Constraints::Z];
        let constrained: f64 = (0..3)
            .filter(|&i| constraints.intersects(bits[i]))
            .map(|i| position[i] * position[i])
            .sum();
        let (swing, twist) = (
            constraints.intersects(Constraints::ALPHA_BETA),
            constraints.intersects(Constraints::GAMMA),
        );
        let angle = match (swing, twist) {
            (true, true) => angle_of(&rotation),
            (true, false) => angle_of_z(&rotation),
            (false, true) => gamma(&rotation).abs(),
            (false, false) => 0.0,
        };
        Self {
            position,
            rotation,
            distance: constrained.sqrt(),
            angle,
        }
    }

    fn errors(
        &self,
        tip: &Rigid,
        frames: &Frames,
        constraints: Constraints,
        angles: Angles,
    ) -> [f64; 6] {
        let full = constraints.contains(Constraints::ORIENTATION);
        let angular = match angles {
            _ if !constraints.intersects(Constraints::ORIENTATION) => Vector3::zeros(),
            Angles::Euler => euler(&self.rotation),
            Angles::RotationVector if full => rotation_vector(&self.rotation),
            Angles::RotationVector => {
                let swing = swing_vector(&self.rotation);
                Vector3::new(swing[0], swing[1], gamma(&self.rotation))
            }
        };
        let angular = if full {
            along(frames.axes.as_ref(), tip.rotation * angular)
        } else {
            angular
        };
        let position = self.position;
        [
            position.x, position.y, position.z, angular.x, angular.y, angular.z,
        ]
    }
}

/// Alpha, beta, gamma with `R = Rx(alpha) Ry(beta) Rz(gamma)`. A turn about the own z, by which a target without constrained gamma
/// is free, changes gamma only.
fn euler(r: &Matrix3<f64>) -> Vector3<f64> {
    let beta = libm::asin(r[(0, 2)].clamp(-1.0, 1.0));
    Vector3::new(libm::atan2(-r[(1, 2)], r[(2, 2)]), beta, gamma(r))
}

fn gamma(r: &Matrix3<f64>) -> f64 {
    libm::atan2(-r[(0, 1)], r[(0, 0)])
}

/// Twice the sine times the axis.
fn vee(r: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(
        r[(2, 1)] - r[(1, 2)],
        r[(0, 2)] - r[(2, 0)],
        r[(1, 0)] - r[(0, 1)],
    )
}

fn angle_of(r: &Matrix3<f64>) -> f64 {
    libm::atan2(vee(r).norm(), r.trace() - 1.0)
}

/// Between the z axes.
fn angle_of_z(r: &Matrix3<f64>) -> f64 {
    libm::atan2(libm::hypot(r[(0, 2)], r[(1, 2)]), r[(2, 2)])
}

/// Axis times angle. For half a turn the axis is read from the symmetric part.
fn rotation_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    let axis = vee(r);
    let (sine, cosine) = (axis.norm(), r.trace() - 1.0);
    if sine > 1e-6 {
        return axis * (libm::atan2(sine, cosine) / sine);
    }
    if cosine > 0.0 {
        return axis * 0.5;
    }
    let symmetric = (r + Matrix3::identity()) * 0.5;
    let column: Vector3<f64> = symmetric.column(symmetric.diagonal().imax()).into();
    column
        .try_normalize(1e-9)
        .map_or(Vector3::zeros(), |axis| axis * PI)
}

/// The first two numbers of the rotation vector that brings the z axis of the tip to that of the target.
fn swing_vector(r: &Matrix3<f64>) -> [f64; 2] {
    let (x, y) = (r[(0, 2)], r[(1, 2)]);
    let sine = libm::hypot(x, y);
    if sine > 1e-9 {
        let scale = libm::atan2(sine, r[(2, 2)]) / sine;
        [-y * scale, x * scale]
    } else if r[(2, 2)] < 0.0 {
        [PI, 0.0]
    } else {
        [-y, x]
    }
}
