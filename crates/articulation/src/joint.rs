//! A joint as six rows of the system: three along and three about the axes of its base.

use std::f64::consts::TAU;

use geometry::Pose;
use geometry::pose::euler::wrap_angle;
use nalgebra::{Matrix3, RealField, Vector3, Vector6};

use crate::block_cholesky::Segment;
use crate::contact::Contact;
use crate::free_axis::{FreeAxis, MotorState};
use crate::jacobian::{Jacobian, halves, times_cross_matrix};
use crate::linked_body::{BodyState, LinkedBody};
use crate::passive::Passive;
use crate::spatial;

/// The degrees of freedom a joint leaves; its axis is the z of its base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis.
    Revolute,
    /// Moves along its axis.
    Prismatic,
    /// Turns about all axes.
    Spherical,
    /// Does not move.
    Fixed,
}

/// The constant properties of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointProperties {
    /// The degrees of freedom.
    pub kind: JointKind,
    /// Indices of the body that carries the base and of the one that carries the tip.
    pub bodies: [usize; 2],
    /// Base of the joint in the frame of the first body.
    pub base: Pose,
    /// Moving side of the joint in the frame of the second body. Where all coordinates are zero it coincides with the base.
    pub tip: Pose,
    /// Metres along the axis per radian about it: a screw; 0 for a plain revolute joint.
    pub pitch: f64,
}

/// The input of a joint for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointState {
    /// Coordinate along the free axis, whole turns included (rad or m).
    pub position: f64,
    /// Velocity along the free axis at the begin of the step, rad/s or m/s.
    pub velocity: f64,
    /// What drives the free axis, if anything does.
    pub motor: Option<Motor>,
    /// Lowest and highest position.
    pub limits: Option<[f64; 2]>,
    /// What acts along the free axis beside motor and limits.
    pub passive: Passive,
}

/// A motor: it reaches `velocity` (rad/s or m/s) with at most `max_force` (N m or N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Target velocity, rad/s or m/s.
    pub velocity: f64,
    /// Largest torque or force, N m or N.
    pub max_force: f64,
}

/// Forces a joint exerts in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLoad {
    /// Forces (N), then torques (N m), on the second body along the axes of the base.
    pub rows: Segment,
    /// The part of it that is the motor's, along the free axis.
    pub motor: f64,
}

impl JointKind {
    /// The rows a joint locks: linear, then angular.
    fn locked_rows(self) -> [bool; 6] {
        match self {
            Self::Revolute => [true, true, true, true, true, false],
            Self::Prismatic => [true, true, false, true, true, true],
            Self::Spherical => [true, true, true, false, false, false],
            Self::Fixed => [true; 6],
        }
    }

    /// The coordinate along the free axis of a joint whose tip lies at `tip_in_base`: radians within half a turn, or metres.
    pub fn coordinate(self, tip_in_base: &Pose) -> f64 {
        match self {
            // nalgebra's arc tangent has the same bits on every processor, that of the C library has not.
            Self::Revolute => {
                wrap_angle(2.0 * RealField::atan2(tip_in_base.rotation.k, tip_in_base.rotation.w))
            }
            Self::Prismatic => tip_in_base.translation.z,
            Self::Spherical | Self::Fixed => 0.0,
        }
    }

    /// The coordinate with whole turns counted on from `before`, the joint having turned by about `turned` radians since.
    pub fn continued_coordinate(self, tip_in_base: &Pose, before: f64, turned: f64) -> f64 {
        let now = self.coordinate(tip_in_base);
        if self != Self::Revolute {
            return now;
        }
        let near = before + wrap_angle(now - before);
        near + TAU * ((before + turned - near) / TAU).round()
    }
}

/// A joint in the system.
pub(crate) struct Joint {
    pub properties: JointProperties,
    pub state: JointState,
    /// The axes of the base: rows.
    pub axes: Matrix3<f64>,
    /// The point at which the forces of the joint act, world.
    pub point: Vector3<f64>,
    /// From there to the centres of mass of the bodies.
    pub levers: [Vector3<f64>; 2],
    locked: [bool; 6],
    pub axis: Option<FreeAxis>,
    pub impulse: Segment,
    /// What the correction of positions added to it: half of the centripetal impulse, since it turns velocities half of the way.
    pub correction: Segment,
    /// The axis of the joint in the frame of the second body.
    tip_axis: Vector3<f64>,
}

/// The rotation vector by which the z axis would have to turn to lie along `axis`, both along the axes of the base, if it is small.
fn misaligned(axis: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(-axis.y, axis.x, 0.0)
}

impl Joint {
    pub(crate) fn new(properties: JointProperties) -> Self {
        Self {
            properties,
            state: JointState {
                position: 0.0,
                velocity: 0.0,
                motor: None,
                limits: None,
                passive: Passive::default(),
            },
            axes: Matrix3::zeros(),
            point: Vector3::zeros(),
            levers: [Vector3::zeros(); 2],
            locked: properties.kind.locked_rows(),
            axis: FreeAxis::of(properties.kind),
            impulse: Segment::zeros(),
            correction: Segment::zeros(),
            tip_axis: properties.tip.rotation * Vector3::z(),
        }
    }

    /// The body that carries the base, or the tip.
    pub(crate) fn body(&self, side: usize) -> usize {
        self.properties.bodies[side]
    }

    /// Finds the axes and the point for where the bodies are.
    pub(crate) fn place(&mut self, bodies: &[LinkedBody]) {
        let JointProperties { base, tip, .. } = &self.properties;
        let [first, second] = self.properties.bodies.map(|body| &bodies[body]);
        self.axes = (first.pose.rotation * base.rotation)
            .to_rotation_matrix()
            .into_inner()
            .transpose();
        self.point = (second.pose.transform_point(&tip.translation.vector.into())).coords;
        self.levers = [first.com - self.point, second.com - self.point];
    }

    /// The Jacobian of the joint: from the velocity of one of its bodies to its rows.
    pub(crate) fn jacobian(&self, side: usize) -> Jacobian {
        let axes = if side == 0 { -self.axes } else { self.axes };
        let mut lever = times_cross_matrix(&axes, &self.levers[side]);
        if self.properties.pitch != 0.0 {
            let screwed = lever.row(2) - axes.row(2) * self.properties.pitch;
            lever.set_row(2, &screwed);
        }
        Jacobian {
            linear: axes,
            lever,
            angular: axes,
        }
    }

    /// The motions of the second body at the point of the joint that the joint leaves free if no motor and no limit acts, at unit velocity.
    pub(crate) fn free_motions(&self) -> impl Iterator<Item = Vector6<f64>> {
        let axis = |row: usize| self.axes.row(row).transpose();
        let motion = move |row| match row {
            0..3 => spatial(axis(row), Vector3::zeros()),
            _ => spatial(axis(row - 3) * self.properties.pitch, axis(row - 3)),
        };
        (0..6).filter(|&row| !self.locked[row]).map(motion)
    }

    /// A twist given along the rows, at the point of the joint.
    pub(crate) fn along_axes(&self, rows: &Segment) -> Vector6<f64> {
        let (linear, angular) = halves(rows);
        spatial(self.axes.tr_mul(&linear), self.axes.tr_mul(&angular))
    }

    /// Takes the impulse on the second body at the point of the joint as that of the rows.
    pub(crate) fn set_impulse(&mut self, impulse: &Vector6<f64>) {
        let rows = self.rows_of(impulse) - self.known_rows();
        self.impulse = self.with_active(rows);
        if let Some((row, _)) = self.soft_row() {
            self.impulse[row] = rows[row];
        }
    }

    /// Takes the impulse on the second body at the point of the joint as that of the correction.
    pub(crate) fn set_correction(&mut self, impulse: &Vector6<f64>) {
        self.correction = self.with_active(self.rows_of(impulse));
    }

    fn rows_of(&self, impulse: &Vector6<f64>) -> Segment {
        let (linear, angular) = halves(impulse);
        let mut rows = spatial(self.axes * linear, self.axes * angular);
        rows[5] += self.properties.pitch * rows[2];
        rows
    }

    /// Velocity of the second body relative to the first at the point of the joint.
    fn relative_velocity(
        &self,
        of_body: impl Fn(usize) -> Vector6<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let [first, second] = [0, 1].map(|side| {
            let (linear, angular) = halves(&of_body(self.body(side)));
            (linear + self.levers[side].cross(&angular), angular)
        });
        (second.0 - first.0, second.1 - first.1)
    }

    /// Velocities along the rows.
    fn velocity(&self, bodies: &[LinkedBody]) -> Segment {
        self.rows_of_velocity(|body| bodies[body].velocity)
    }

    /// Along the active rows, what the correction moved the second body against the first.
    pub(crate) fn corrected(&self, bodies: &[LinkedBody]) -> Segment {
        self.with_active(self.rows_of_velocity(|body| bodies[body].correction))
    }

    fn rows_of_velocity(&self, of_body: impl Fn(usize) -> Vector6<f64>) -> Segment {
        let (linear, angular) = self.relative_velocity(of_body);
        let mut rows = spatial(self.axes * linear, self.axes * angular);
        rows[2] -= self.properties.pitch * rows[5];
        rows
    }

    /// Velocity along the free axis of a joint with one degree of freedom.
    pub(crate) fn axis_velocity(&self, row: usize, bodies: &[LinkedBody]) -> f64 {
        self.axis_velocity_of(row, |body| bodies[body].velocity)
    }

    fn axis_velocity_of(&self, row: usize, of_body: impl Fn(usize) -> Vector6<f64>) -> f64 {
        let (linear, angular) = self.relative_velocity(of_body);
        let along = if row < 3 { linear } else { angular };
        self.axes.row(row % 3).tr_dot(&along)
    }

    /// Velocity of the second body about the axis relative to the first.
    pub(crate) fn turning_velocity(&self, bodies: &[LinkedBody]) -> f64 {
        self.axis_velocity(5, bodies)
    }

    /// By how much the locked rows are violated: metres and radians. `turned`: how far the joint turned in this step.
    pub(crate) fn position_error(&self, bodies: &[LinkedBody], turned: f64) -> Segment {
        let JointProperties {
            kind,
            base,
            tip,
            pitch,
            ..
        } = &self.properties;
        let [first, second] = self.properties.bodies.map(|body| &bodies[body].pose);
        let base = first * base;
        if *kind == JointKind::Revolute && *pitch == 0.0 {
            let linear = base
                .inverse_transform_point(&second.transform_point(&tip.translation.vector.into()));
            let axis = base.inverse_transform_vector(&(second.rotation * self.tip_axis));
            return spatial(linear.coords, misaligned(&axis));
        }
        let apart = base.inverse() * (second * tip);
        let angular = match kind {
            JointKind::Revolute => misaligned(&(apart.rotation * Vector3::z())),
            _ => apart.rotation.scaled_axis(),
        };
        let mut error = spatial(apart.translation.vector, angular);
        if *pitch != 0.0 {
            error[2] -= pitch * kind.continued_coordinate(&apart, self.state.position, turned);
        }
        self.locked_part(error)
    }

    /// With zeros in the rows that are not locked.
    pub(crate) fn locked_part(&self, mut rows: Segment) -> Segment {
        (0..6)
            .filter(|&row| !self.locked[row])
            .for_each(|row| rows[row] = 0.0);
        rows
    }

    /// Which rows have impulses: those that are constrained, and that of an axis with something passive.
    pub(crate) fn active_rows(&self) -> [bool; 6] {
        let soft = self.soft_row().map(|(row, _)| row);
        std::array::from_fn(|row| self.is_active(row) || soft == Some(row))
    }

    /// With zeros in the rows that are not active.
    fn with_active(&self, mut rows: Segment) -> Segment {
        (0..6)
            .filter(|&row| !self.is_active(row))
            .for_each(|row| rows[row] = 0.0);
        rows
    }

    fn is_active(&self, row: usize) -> bool {
        match &self.axis {
            Some(axis) if axis.row == row => axis.is_active(),
            _ => self.locked[row],
        }
    }

    /// Whether a motor or a limit imposes a velocity along the free axis.
    pub(crate) fn imposes_velocity(&self) -> bool {
        self.axis.as_ref().is_some_and(FreeAxis::is_active)
    }

    /// The velocity along the free axis that a motor or a limit requires.
    pub(crate) fn imposed_velocity(&self) -> f64 {
        self.axis.as_ref().map_or(0.0, FreeAxis::target_velocity)
    }

    /// The change of velocity that the active rows require; along a soft axis that to rest, which its compliance allows a part of.
    pub(crate) fn missing_velocity(&self, bodies: &[LinkedBody]) -> Segment {
        let mut missing = -self.velocity(bodies);
        let soft = self.soft_row().map(|(row, _)| (row, missing[row]));
        if let Some(axis) = &self.axis {
            missing[axis.row] += axis.target_velocity();
        }
        let mut missing = self.with_active(missing);
        if let Some((row, velocity)) = soft {
            missing[row] = velocity;
        }
        missing
    }

    /// The row of the free axis, and the inertia of what is passive along it, where no motor and no limit imposes a velocity.
    pub(crate) fn soft_row(&self) -> Option<(usize, f64)> {
        let axis = self.axis.as_ref()?;
        let inertia = axis.soft_inertia();
        (inertia > 0.0).then_some((axis.row, inertia))
    }

    /// The square of the velocity along a soft axis times its inertia.
    pub(crate) fn soft_square(&self, of_body: impl Fn(usize) -> Vector6<f64>) -> f64 {
        self.soft_row().map_or(0.0, |(row, inertia)| {
            inertia * self.axis_velocity_of(row, of_body).powi(2)
        })
    }

    /// The impulses along the free axis that are known: of a saturated motor, and what is passive.
    pub(crate) fn known_impulse(&self) -> f64 {
        self.axis.as_ref().map_or(0.0, FreeAxis::known_impulse)
    }

    /// The same by rows.
    pub(crate) fn known_rows(&self) -> Segment {
        let mut rows = Segment::zeros();
        if let Some(axis) = &self.axis {
            rows[axis.row] = axis.known_impulse();
        }
        rows
    }

    /// Begins with the active set of the step before.
    pub(crate) fn warm_start(&mut self, bodies: &[BodyState], step: f64) {
        let Some(mut axis) = self.axis else { return };
        let velocity = if self.state.passive == Passive::default() {
            self.state.velocity
        } else {
            self.axis_velocity_of(axis.row, |body| bodies[body].motion.velocity)
        };
        axis.warm_start(&self.state, velocity, step);
        self.axis = Some(axis);
    }

    fn motor_impulse(&self) -> f64 {
        match self.axis {
            Some(FreeAxis {
                motor: MotorState::Saturated(all),
                ..
            }) => all,
            Some(FreeAxis {
                motor: MotorState::Tracking,
                row,
                ..
            }) => self.impulse[row],
            _ => 0.0,
        }
    }

    /// The part of the correction that a motor bears which holds its velocity.
    fn motor_correction(&self) -> f64 {
        match self.axis {
            Some(FreeAxis {
                motor: MotorState::Tracking,
                row,
                ..
            }) => self.correction[row],
            _ => 0.0,
        }
    }

    /// All impulses of the rows.
    pub(crate) fn total_impulse(&self) -> Segment {
        self.impulse + self.known_rows()
    }

    pub(crate) fn load(&self, step: f64) -> JointLoad {
        JointLoad {
            rows: (self.total_impulse() + self.correction) / step,
            motor: (self.motor_impulse() + self.motor_correction()) / step,
        }
    }

    /// Lets motor and limit change sides where the solution violates their bounds; true when the system must be solved again. With caution
    /// nothing leaves its bound again.
    pub(crate) fn update_active_set(
        &mut self,
        bodies: &[LinkedBody],
        step: f64,
        is_cautious: bool,
    ) -> bool {
        let Some(mut axis) = self.axis.filter(|axis| axis.can_change(&self.state)) else {
            return false;
        };
        let velocity = self.axis_velocity(axis.row, bodies);
        let changed = axis.update_active_set(
            &self.state,
            velocity,
            self.impulse[axis.row],
            step,
            is_cautious,
        );
        self.axis = Some(axis);
        changed
    }

    /// How the motions of the joint separate its bodies at a contact: the one that does so fastest, as a part of the speed of the point. For one
    /// axis the first coordinate, for a spherical joint a vector of rotation.
    pub(crate) fn separation(&self, contact: &Contact) -> Vector3<f64> {
        let normal = Vector3::from(contact.normal);
        let lever = Vector3::from(contact.point) - self.point;
        // Motions are those of the joint's second body: the first one of the contact may be the other one.
        let sign = if contact.bodies[0].or(contact.base) == Some(self.properties.bodies[1]) {
            1.0
        } else {
            -1.0
        };
        let along = |velocity: Vector3<f64>| {
            let speed = velocity.norm();
            Vector3::x()
                * if speed > 0.0 {
                    sign * velocity.dot(&normal) / speed
                } else {
                    0.0
                }
        };
        let axis = self.axes.row(2).transpose();
        match self.properties.kind {
            JointKind::Revolute => along(axis.cross(&lever)),
            JointKind::Prismatic => along(axis),
            JointKind::Spherical if lever != Vector3::zeros() => {
                sign * lever.cross(&normal) / lever.norm()
            }
            JointKind::Spherical | JointKind::Fixed => Vector3::zeros(),
        }
    }

    /// Whether the joint holds a point of one body to a point of the other.
    pub(crate) fn holds_point(&self) -> bool {
        self.locked[..3].iter().all(|&locked| locked)
    }

    /// The axes its bodies may turn about against each other, world.
    pub(crate) fn free_rotation_axes(&self) -> impl Iterator<Item = Vector3<f64>> {
        let axis = |row: usize| self.axes.row(row - 3).transpose();
        (3..6).filter(|&row| !self.is_active(row)).map(axis)
    }
}
