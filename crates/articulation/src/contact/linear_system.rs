//! The velocities if contacts act as they do near the last ones: a linear system.
//!
//! A contact with an obstacle resists like a damper. In a tree it adds to the inertia of its body, which costs next to nothing. Contacts between two bodies,
//! and all of a mechanism with loops, couple the system of the joints, of which they know the response `G`: with the slopes `K` of the contacts their impulses
//! follow from `(1 + K G) p = offset + K (target - v)`. Free bodies have a dense system of six unknowns each.

use nalgebra::{Cholesky, DMatrix, DVector, Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};

use crate::contact::Row;
use crate::contact::row::Side;
use crate::contact::unknowns::Unknowns;
use crate::mechanism::Mechanism;
use crate::spatial_inertia::SpatialInertia;

/// Largest number of contacts that couple the system of the joints.
const MAX_COUPLING_CONTACTS: usize = 48;

/// The velocities of all bodies as unknowns: the bodies have their present values.
#[derive(Default)]
pub(super) struct BodyVelocities {
    before: Vec<Vector6<f64>>,
}

impl Unknowns for BodyVelocities {
    fn solve(&mut self, mechanism: &mut Mechanism, is_first: bool) -> bool {
        mechanism.solve_linear(is_first)
    }

    fn at_contacts(&self, mechanism: &Mechanism, velocities: &mut Vec<Vector3<f64>>) {
        let rows = mechanism.contacts.rows.iter();
        velocities.clear();
        velocities.extend(rows.map(|row| row.velocity(|body| mechanism.bodies[body].velocity)));
    }

    fn keep(&mut self, mechanism: &Mechanism) {
        self.before.clear();
        self.before
            .extend(mechanism.bodies.iter().map(|body| body.velocity));
    }

    fn square_of_step(&self, mechanism: &Mechanism) -> f64 {
        let change = |body: usize| mechanism.bodies[body].velocity - self.before[body];
        let of_body = |body: usize| {
            let moved = change(body);
            moved.dot(&mechanism.bodies[body].momentum(&moved))
        };
        let moving = (0..self.before.len()).filter(|&body| mechanism.bodies[body].is_dynamic());
        let joints = mechanism.joints.iter();
        let of_joints = joints.map(|joint| joint.soft_square(change));
        moving.map(of_body).sum::<f64>() + of_joints.sum::<f64>()
    }

    fn shorten(&mut self, mechanism: &mut Mechanism, share: f64) {
        for (body, before) in mechanism.bodies.iter_mut().zip(&self.before) {
            body.velocity = before + (body.velocity - before) * share;
        }
    }

    fn finish(&mut self, _: &mut Mechanism) {}
}

impl Mechanism {
    /// Finds the velocities; false where there is no solution. `is_first`: for these joints and places of the bodies.
    fn solve_linear(&mut self, is_first: bool) -> bool {
        if self.joints.is_empty() {
            return self.solve_free_bodies();
        }
        self.add_contact_inertia();
        // Only trees have contacts in their factor.
        let is_known = !is_first && self.system.as_tree().is_none();
        if !is_known && !self.system.factorize(&self.joints, &self.bodies) {
            return false;
        }
        self.find_velocities();
        let coupling = self.coupling_contacts();
        if coupling.is_empty() {
            return true;
        }
        let is_solved = coupling.len() <= MAX_COUPLING_CONTACTS && self.add_coupling(&coupling);
        if is_solved {
            self.find_velocities();
        }
        is_solved
    }

    /// Finds the impulses of the joints for velocities that were found with the impulses of the contacts.
    pub(super) fn find_joint_impulses(&mut self) {
        let (joints, bodies) = (&mut self.joints, &mut self.bodies);
        match self.system.as_tree() {
            Some(tree) => tree.find_joint_impulses(joints, bodies),
            None if joints.is_empty() => {}
            None => self.system.find_impulses(joints, bodies),
        }
    }

    fn find_velocities(&mut self) {
        let (joints, bodies) = (&mut self.joints, &mut self.bodies);
        match self.system.as_tree() {
            Some(tree) => tree.find_body_velocities(joints, bodies),
            None => self.system.find_impulses(joints, bodies),
        }
    }

    /// Lets contacts with obstacles act on their bodies as they do near the last velocities.
    fn add_contact_inertia(&mut self) {
        self.remove_contact_inertia();
        self.bodies
            .iter_mut()
            .for_each(|body| body.contact_impulse.fill(0.0));
        if self.system.as_tree().is_none() {
            return;
        }
        for row in self.contacts.rows.iter().filter(|row| !row.couples()) {
            for side in row.sides.iter().flatten() {
                let body = &mut self.bodies[side.body];
                body.contact_impulse += side.jacobian * row.linear.impulse_at(&row.target);
                let inertia = body
                    .contact_inertia
                    .get_or_insert_with(SpatialInertia::zero);
                inertia.add_rows(&side.jacobian, &row.linear.slope);
            }
        }
    }

    /// Whether there was any.
    pub(crate) fn remove_contact_inertia(&mut self) -> bool {
        let mut was_there = false;
        for body in &mut self.bodies {
            was_there |= body.contact_inertia.take().is_some();
        }
        was_there
    }

    /// The contacts that act and are not part of the inertia of a body.
    fn coupling_contacts(&mut self) -> Vec<usize> {
        let is_tree = self.system.as_tree().is_some();
        let couples = |row: &Row| row.acts() && row.linear.acts() && (row.couples() || !is_tree);
        let rows = self.contacts.rows.iter().enumerate();
        rows.filter(|(_, row)| couples(row))
            .map(|(index, _)| index)
            .collect()
    }

    /// Lets contacts act that couple the system; false where there is no solution.
    fn add_coupling(&mut self, coupling: &[usize]) -> bool {
        let Some(impulses) = self.coupling_impulses(coupling) else {
            return false;
        };
        for (number, &index) in coupling.iter().enumerate() {
            let impulse = impulses.fixed_rows::<3>(3 * number);
            for side in self.contacts.rows[index].sides.iter().flatten() {
                self.bodies[side.body].contact_impulse += side.jacobian * impulse;
            }
        }
        true
    }

    /// Their impulses, three along the axes of each contact.
    fn coupling_impulses(&mut self, coupling: &[usize]) -> Option<DVector<f64>> {
        let touching = self.touching(coupling);
        let responses = self.system.responses(&self.joints, &touching);
        let place = |side: &Side| touching.partition_point(|&body| body < side.body);
        let response = |to: &Side, from: &Side| responses[place(to) * touching.len() + place(from)];
        let rows = |number: usize| &self.contacts.rows[coupling[number]];
        let size = 3 * coupling.len();
        let (mut matrix, mut known) = (DMatrix::identity(size, size), DVector::zeros(size));
        for i in 0..coupling.len() {
            let to = rows(i);
            let lag = to.target - to.velocity(|body| self.bodies[body].velocity);
            let mut part = known.fixed_rows_mut::<3>(3 * i);
            part += to.linear.impulse_at(&lag);
            for j in 0..coupling.len() {
                let mut block = matrix.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                block += to.linear.slope * to.response_to(rows(j), response);
            }
        }
        matrix.lu().solve(&known)
    }

    /// The bodies of contacts.
    fn touching(&self, contacts: &[usize]) -> Vec<usize> {
        let sides = contacts
            .iter()
            .flat_map(|&index| self.contacts.rows[index].sides.iter().flatten());
        let mut touching: Vec<usize> = sides.map(|side| side.body).collect();
        touching.sort_unstable();
        touching.dedup();
        touching
    }

    /// The same for bodies without joints.
    fn solve_free_bodies(&mut self) -> bool {
        if let [body] = &mut self.bodies[..] {
            let (mut matrix, mut momentum) = (body.mass_matrix(), body.external_momentum());
            for row in &self.contacts.rows {
                for side in row.sides.iter().flatten() {
                    matrix += side.jacobian * row.linear.slope * side.jacobian.transpose();
                    momentum += side.jacobian * row.linear.impulse_at(&row.target);
                }
            }
            let factor = Cholesky::new(matrix);
            body.velocity = factor
                .as_ref()
                .map_or(body.velocity, |it| it.solve(&momentum));
            return factor.is_some();
        }
        self.solve_many_free_bodies()
    }

    fn solve_many_free_bodies(&mut self) -> bool {
        let size = 6 * self.bodies.len();
        let (mut matrix, mut momentum) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (index, body) in self.bodies.iter().enumerate() {
            let mut block = matrix.fixed_view_mut::<6, 6>(6 * index, 6 * index);
            block.copy_from(&body.mass_matrix());
            let mut part = momentum.fixed_rows_mut::<6>(6 * index);
            part.copy_from(&body.external_momentum());
        }
        for row in &self.contacts.rows {
            row.add_to(&mut matrix, &mut momentum);
        }
        let Some(factor) = Cholesky::new(matrix) else {
            return false;
        };
        factor.solve_mut(&mut momentum);
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.velocity = momentum.fixed_rows::<6>(6 * index).into_owned();
        }
        true
    }
}

impl Row {
    /// Whether the contact is one between two bodies that move.
    fn couples(&self) -> bool {
        self.sides.iter().all(Option::is_some)
    }

    /// Velocity along the axes by unit impulses of another contact; `response`: of a body to another.
    fn response_to(
        &self,
        other: &Self,
        response: impl Fn(&Side, &Side) -> Matrix6<f64>,
    ) -> Matrix3<f64> {
        let mut sum = Matrix3::zeros();
        for to in self.sides.iter().flatten() {
            for from in other.sides.iter().flatten() {
                sum += to.jacobian.tr_mul(&(response(to, from) * from.jacobian));
            }
        }
        sum
    }

    /// Adds what the contact does to the momentum balance of its bodies.
    fn add_to(&self, matrix: &mut DMatrix<f64>, momentum: &mut DVector<f64>) {
        let known = self.linear.impulse_at(&self.target);
        for side in self.sides.iter().flatten() {
            let pulled: Matrix6x3<f64> = side.jacobian * self.linear.slope;
            for other in self.sides.iter().flatten() {
                let mut block = matrix.fixed_view_mut::<6, 6>(6 * side.body, 6 * other.body);
                block += pulled * other.jacobian.transpose();
            }
            let mut part = momentum.fixed_rows_mut::<6>(6 * side.body);
            part += side.jacobian * known;
        }
    }
}

impl SpatialInertia {
    /// Adds `rows factor rows^T`.
    fn add_rows(&mut self, rows: &Matrix6x3<f64>, factor: &Matrix3<f64>) {
        let (linear, angular) = (rows.fixed_rows::<3>(0), rows.fixed_rows::<3>(3));
        let (of_linear, of_angular) = (linear * factor, angular * factor);
        self.linear += of_linear * linear.transpose();
        self.coupling += of_linear * angular.transpose();
        self.angular += of_angular * angular.transpose();
    }
}
