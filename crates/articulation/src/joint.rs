//! A link as six rows of the system: three along and three about the axes of its base.

use nalgebra::{Matrix6, Vector3};

use super::axis::{Axis, Motor};
use super::block_cholesky::Segment;
use super::mover::Mover;
use super::spatial;
use crate::dynamics::links::Link;
use crate::dynamics::plan::LinkKind;
use crate::scene::Handle;

/// A link in the system.
pub(super) struct Node {
    pub link: Handle,
    pub ends: [usize; 2],
    /// How the velocities of the two bodies move the link's rows.
    pub jacobians: [Matrix6<f64>; 2],
    /// Where the forces of the link act.
    pub point: Vector3<f64>,
    pub locked: [bool; 6],
    pub axis: Option<Axis>,
    pub impulse: Segment,
    /// The rows that act, and what they make of the answers of the bodies; other rows are zero.
    pub acting: [Matrix6<f64>; 2],
    pub weighted: [Matrix6<f64>; 2],
}

impl Node {
    pub(super) fn new(link: Handle, kind: LinkKind, ends: [usize; 2]) -> Self {
        let none = [Matrix6::zeros(); 2];
        let (locked, axis) = (locked(kind), Axis::of(kind));
        let (point, impulse) = (Vector3::zeros(), Segment::zeros());
        Self { link, ends, jacobians: none, point, locked, axis, impulse, acting: none, weighted: none }
    }

    /// Reads where the link is.
    pub(super) fn place(&mut self, link: &Link, movers: &[Mover]) {
        let [first, second] = self.ends.map(|end| &movers[end]);
        let axes = (first.pose.rotation * link.plan.base.rotation).to_rotation_matrix();
        let point = (second.pose * link.plan.tip).translation.vector;
        self.point = point;
        for row in 0..3 {
            let direction = axes.matrix().column(row).into_owned();
            for (side, (mover, sign)) in [(first, -1.0), (second, 1.0)].into_iter().enumerate() {
                let lever = point - mover.com;
                let along = spatial(direction, lever.cross(&direction)) * sign;
                self.jacobians[side].set_row(row, &along.transpose());
                self.jacobians[side].set_row(row + 3, &spatial(Vector3::zeros(), direction * sign).transpose());
            }
        }
        for jacobian in self.jacobians.iter_mut().filter(|_| link.plan.pitch != 0.0) {
            let screwed = jacobian.row(2) - jacobian.row(5) * link.plan.pitch;
            jacobian.set_row(2, &screwed);
        }
    }

    /// Velocity along a row.
    fn velocity(&self, row: usize, movers: &[Mover]) -> f64 {
        (0..2).map(|side| (self.jacobians[side].row(row) * movers[self.ends[side]].velocity)[0]).sum()
    }

    /// How far the moving side is from where the rows that act want it: metres and radians.
    pub(super) fn gap(&self, link: &Link, movers: &[Mover]) -> Segment {
        let [base, tip] =
            [(0, &link.plan.base), (1, &link.plan.tip)].map(|(side, frame)| movers[self.ends[side]].pose * frame);
        let apart = base.inverse() * tip;
        let turn = match link.plan.kind {
            // Where the axis of the tip points.
            LinkKind::Revolute => {
                let axis = apart.rotation * Vector3::z();
                Vector3::new(-axis.y, axis.x, 0.0)
            }
            _ => apart.rotation.scaled_axis(),
        };
        let mut gap = spatial(apart.translation.vector, turn);
        if link.plan.pitch != 0.0 {
            gap[2] -= link.plan.pitch * link.position_near(&apart);
        }
        for row in (0..6).filter(|&row| !self.locked[row]) {
            gap[row] = 0.0;
        }
        gap
    }

    /// Makes the rows that act ready.
    pub(super) fn weigh(&mut self, movers: &[Mover]) {
        for side in 0..2 {
            let mut rows = self.jacobians[side];
            for row in (0..6).filter(|&row| !self.acts(row)) {
                rows.row_mut(row).fill(0.0);
            }
            self.acting[side] = rows;
            self.weighted[side] = rows * movers[self.ends[side]].response;
        }
    }

    pub(super) fn acts(&self, row: usize) -> bool {
        match &self.axis {
            Some(axis) if axis.row == row => axis.acts(),
            _ => self.locked[row],
        }
    }

    /// What the velocities of the acting rows lack.
    pub(super) fn lacking(&self, movers: &[Mover]) -> Segment {
        Segment::from_fn(|row, _| match (self.acts(row), &self.axis) {
            (false, _) => 0.0,
            (true, Some(axis)) if axis.row == row => axis.wanted() - self.velocity(row, movers),
            (true, _) => -self.velocity(row, movers),
        })
    }

    /// The impulse of a motor that gives all it has.
    pub(super) fn spent(&self) -> Segment {
        let mut impulse = Segment::zeros();
        if let Some(Axis { row, motor: Motor::Spent(all), .. }) = self.axis {
            impulse[row] = all;
        }
        impulse
    }

    pub(super) fn motor_impulse(&self) -> f64 {
        match self.axis {
            Some(Axis { motor: Motor::Spent(all), .. }) => all,
            Some(Axis { motor: Motor::Holds, row, .. }) => self.impulse[row],
            _ => 0.0,
        }
    }

    pub(super) fn push(&self, movers: &mut [Mover], impulse: &Segment) {
        for side in 0..2 {
            let mover = &mut movers[self.ends[side]];
            mover.velocity += mover.response * (self.jacobians[side].transpose() * impulse);
        }
    }

    /// Looks whether motor and stop do what they can and may; true when the system must be solved again.
    pub(super) fn correct(&mut self, link: &Link, movers: &[Mover], step: f64) -> bool {
        let Some(mut axis) = self.axis else { return false };
        let changed = axis.correct(link, self.velocity(axis.row, movers), self.impulse[axis.row], step);
        self.axis = Some(axis);
        changed
    }
}

/// The rows a link locks: linear, then angular.
fn locked(kind: LinkKind) -> [bool; 6] {
    match kind {
        LinkKind::Revolute => [true, true, true, true, true, false],
        LinkKind::Prismatic => [true, true, false, true, true, true],
        LinkKind::Spherical => [true, true, true, false, false, false],
        LinkKind::Sensor | LinkKind::Weld => [true; 6],
    }
}
