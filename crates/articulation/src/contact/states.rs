//! Contacts of bodies without joints: the impulses if each is open or holds.
//!
//! Gauss-Seidel sweeps need a hundred passes for a box on four corners, since its load can be shared between them in many ways. With the compliance of the
//! contacts the velocities are the solution of a linear system of six unknowns a body, in which contacts that hold are stiff dampers. Which contacts hold is
//! assumed as it was, and corrected by what the solution says: a semi-smooth Newton method (compare A. Castro, F. Permenter and X. Han, *An unconstrained convex
//! formulation of compliant contact*, 2022). Where something slides the sweeps do it all.

use nalgebra::{Cholesky, DMatrix, DVector, Matrix6, Vector3, Vector6};

use crate::contact::{Contacts, Row, State};
use crate::linked_body::LinkedBody;

/// Largest number of corrections of the states.
const MAX_ITERATIONS: usize = 12;

impl Contacts {
    /// Finds impulses and velocities by the states of the contacts; false, and all as it was, where something slides, or states change for ever.
    pub(crate) fn solve_by_states(&mut self, bodies: &[LinkedBody]) -> bool {
        let before: Vec<Vector3<f64>> = self.rows.iter().map(|row| row.impulse).collect();
        let free = self.velocities_without();
        let mut states = self.states();
        for _ in 0..MAX_ITERATIONS {
            if states.contains(&State::Slides) {
                break;
            }
            let Some(velocities) = self.velocities_by(&states, &free, bodies) else {
                break;
            };
            self.take_impulses(&states, &velocities);
            self.set_velocities(&free);
            let now = self.states();
            if now == states {
                return true;
            }
            states = now;
        }
        self.rows
            .iter_mut()
            .zip(before)
            .for_each(|(row, impulse)| row.impulse = impulse);
        self.set_velocities(&free);
        false
    }

    fn states(&self) -> Vec<State> {
        let state = |(index, row)| State::of(row, self.slip(index, 0));
        self.rows.iter().enumerate().map(state).collect()
    }

    /// The velocities of the touching bodies without the impulses of the contacts.
    pub(crate) fn velocities_without(&self) -> Vec<Vector6<f64>> {
        let mut velocities = self.velocities.clone();
        self.add_impulses(&mut velocities, -1.0);
        velocities
    }

    fn set_velocities(&mut self, free: &[Vector6<f64>]) {
        let mut velocities = free.to_vec();
        self.add_impulses(&mut velocities, 1.0);
        self.velocities = velocities;
    }

    fn add_impulses(&self, velocities: &mut [Vector6<f64>], sign: f64) {
        for (index, row) in self.rows.iter().enumerate() {
            for change in self.changes_of(index) {
                velocities[change.place] += change.velocity * (row.impulse * sign);
            }
        }
    }

    /// The velocities if every contact does as its state says.
    fn velocities_by(
        &self,
        states: &[State],
        free: &[Vector6<f64>],
        bodies: &[LinkedBody],
    ) -> Option<Vec<Vector6<f64>>> {
        if let [velocity] = free {
            let mass = bodies[self.bodies[0]].mass_matrix();
            return self.velocity_by(states, velocity, &mass).map(|it| vec![it]);
        }
        let count = free.len();
        let mut matrix = DMatrix::zeros(6 * count, 6 * count);
        let mut momentum = DVector::zeros(6 * count);
        for (place, (&body, velocity)) in self.bodies.iter().zip(free).enumerate() {
            let mass = bodies[body].mass_matrix();
            matrix
                .fixed_view_mut::<6, 6>(6 * place, 6 * place)
                .copy_from(&mass);
            momentum
                .fixed_rows_mut::<6>(6 * place)
                .copy_from(&(mass * velocity));
        }
        for (row, state) in self.rows.iter().zip(states) {
            row.add_to(*state, &mut matrix, &mut momentum);
        }
        let solution = Cholesky::new(matrix)?.solve(&momentum);
        let velocity = |place| solution.fixed_rows::<6>(6 * place).into_owned();
        Some((0..count).map(velocity).collect())
    }

    /// The same for a single body: `mass`, kg and kg m2, world axes.
    fn velocity_by(
        &self,
        states: &[State],
        free: &Vector6<f64>,
        mass: &Matrix6<f64>,
    ) -> Option<Vector6<f64>> {
        let (mut matrix, mut momentum) = (*mass, mass * free);
        let holding = self.rows.iter().zip(states);
        for (row, _) in holding.filter(|(_, state)| **state == State::Holds) {
            for side in row.sides.iter().flatten() {
                let pulled = side.jacobian * (1.0 / row.least_compliance);
                matrix += pulled * side.jacobian.transpose();
                momentum += pulled * row.target;
            }
        }
        Some(Cholesky::new(matrix)?.solve(&momentum))
    }

    /// Takes the impulses that belong to the velocities.
    fn take_impulses(&mut self, states: &[State], velocities: &[Vector6<f64>]) {
        for (row, state) in self.rows.iter_mut().zip(states) {
            row.impulse = row.impulse_at(*state, velocities);
        }
    }
}

impl Row {
    /// Adds what the contact does to the momentum balance of its bodies.
    fn add_to(&self, state: State, matrix: &mut DMatrix<f64>, momentum: &mut DVector<f64>) {
        if state != State::Holds {
            return;
        }
        let stiffness = 1.0 / self.least_compliance;
        for side in self.sides.iter().flatten() {
            let pulled = side.jacobian * stiffness;
            for other in self.sides.iter().flatten() {
                let block = pulled * other.jacobian.transpose();
                let mut view = matrix.fixed_view_mut::<6, 6>(6 * side.place, 6 * other.place);
                view += block;
            }
            let mut view = momentum.fixed_rows_mut::<6>(6 * side.place);
            view += pulled * self.target;
        }
    }

    fn impulse_at(&self, state: State, velocities: &[Vector6<f64>]) -> Vector3<f64> {
        if state != State::Holds {
            return Vector3::zeros();
        }
        let velocity = self.velocity_past(velocities);
        let free = (self.target - velocity) / self.least_compliance;
        let normal = free[0].max(0.0);
        let (first, second) = self.within_cone(normal, free[1], free[2]);
        Vector3::new(normal, first, second)
    }
}
