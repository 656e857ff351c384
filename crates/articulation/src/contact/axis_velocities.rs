//! The velocities along the free axes of a tree as unknowns: with few of them, an iteration of Newton's method is one small factorisation, and contacts between
//! two bodies of the tree cost no more than those with obstacles.

use nalgebra::Vector3;

use crate::contact::Row;
use crate::contact::unknowns::Unknowns;
use crate::mechanism::Mechanism;
use crate::tree::{JointSpace, Tree};

/// Largest number of free axes: with more, the sparse system of all bodies takes less time.
const MAX_AXES: usize = 40;

/// The velocities along the free axes.
#[derive(Default)]
pub(crate) struct AxisVelocities {
    space: JointSpace,
    /// How the relative velocity at a contact follows from the unknowns: number of the unknown and column, contact by contact.
    columns: Vec<(usize, Vector3<f64>)>,
    /// Where the columns of a contact end.
    ends: Vec<usize>,
    /// The relative velocity at each contact where all unknowns are zero.
    imposed: Vec<Vector3<f64>>,
    /// The matrix of the last linear system, and its factor.
    matrix: Vec<f64>,
    velocities: Vec<f64>,
    before: Vec<f64>,
}

impl AxisVelocities {
    /// Whether these are the unknowns to solve a mechanism for.
    pub(super) fn suit(mechanism: &mut Mechanism) -> bool {
        let tree = mechanism.system.as_tree();
        tree.is_some_and(|tree| (1..=MAX_AXES).contains(&tree.axis_count()))
    }

    /// Finds masses, momenta, and what contacts have to do with the axes.
    fn begin(&mut self, mechanism: &mut Mechanism) -> bool {
        mechanism.remove_contact_inertia();
        for body in &mut mechanism.bodies {
            body.contact_impulse.fill(0.0);
        }
        let (joints, bodies) = (&mechanism.joints, &mechanism.bodies);
        let Some(tree) = mechanism.system.as_tree() else {
            return false;
        };
        tree.project(joints, bodies, &mut self.space);
        self.columns.clear();
        self.ends.clear();
        self.imposed.clear();
        for row in &mechanism.contacts.rows {
            self.add_contact(tree, row);
        }
        true
    }

    /// Finds how the relative velocity at a contact follows from the unknowns.
    fn add_contact(&mut self, tree: &Tree, row: &Row) {
        let first = self.columns.len();
        let mut imposed = Vector3::zeros();
        for side in row.sides.iter().flatten() {
            let columns = &mut self.columns;
            tree.velocities_at(&self.space, side.body, &side.lever, |unknown, velocity| {
                let column = row.axes * velocity * side.sign;
                match columns[first..].iter_mut().find(|it| it.0 == unknown) {
                    Some(known) => known.1 += column,
                    None => columns.push((unknown, column)),
                }
            });
            let velocity = tree.imposed_velocity_at(&self.space, side.body, &side.lever);
            imposed += row.axes * velocity * side.sign;
        }
        self.imposed.push(imposed);
        self.ends.push(self.columns.len());
    }

    /// The columns of each contact.
    fn columns(&self) -> impl Iterator<Item = &[(usize, Vector3<f64>)]> {
        let firsts = std::iter::once(0).chain(self.ends.iter().copied());
        let ranges = firsts.zip(&self.ends);
        ranges.map(|(first, end)| &self.columns[first..*end])
    }

    /// Sets the system up with contacts that act as they do near the last velocities.
    fn assemble(&mut self, rows: &[Row]) {
        let mut matrix = std::mem::take(&mut self.matrix);
        let mut known = std::mem::take(&mut self.velocities);
        matrix.clone_from(&self.space.masses);
        known.clone_from(&self.space.momenta);
        let acting = rows.iter().zip(self.columns()).zip(&self.imposed);
        for ((row, columns), imposed) in acting.filter(|((row, _), _)| row.linear.acts()) {
            let impulse = row.linear.impulse_at(&(row.target - imposed));
            for (place, (unknown, column)) in columns.iter().enumerate() {
                known[*unknown] += column.dot(&impulse);
                let pulled = row.linear.slope * column;
                for (other, of_other) in &columns[place..] {
                    let (first, second) = (*unknown.min(other), *unknown.max(other));
                    matrix[first * self.space.count + second] += pulled.dot(of_other);
                }
            }
        }
        (self.matrix, self.velocities) = (matrix, known);
    }
}

impl Unknowns for AxisVelocities {
    fn solve(&mut self, mechanism: &mut Mechanism, is_first: bool) -> bool {
        if is_first && !self.begin(mechanism) {
            return false;
        }
        self.assemble(&mechanism.contacts.rows);
        solve_positive_definite(&mut self.matrix, &mut self.velocities)
    }

    fn at_contacts(&self, _: &Mechanism, velocities: &mut Vec<Vector3<f64>>) {
        velocities.clear();
        let of_contact = |(columns, imposed): (&[(usize, Vector3<f64>)], &Vector3<f64>)| {
            let moved = columns
                .iter()
                .map(|(unknown, column)| column * self.velocities[*unknown]);
            moved.fold(*imposed, |sum, velocity| sum + velocity)
        };
        velocities.extend(self.columns().zip(&self.imposed).map(of_contact));
    }

    fn keep(&mut self, _: &Mechanism) {
        self.before.clone_from(&self.velocities);
    }

    fn square_of_step(&self, _: &Mechanism) -> f64 {
        let change = |unknown: usize| self.velocities[unknown] - self.before[unknown];
        let rows = self.space.masses.chunks_exact(self.space.count.max(1));
        let of_row = |(number, masses): (usize, &[f64])| {
            let others = (number + 1..).zip(&masses[number + 1..]);
            let coupled: f64 = others.map(|(other, mass)| mass * change(other)).sum();
            change(number) * (masses[number] * change(number) + 2.0 * coupled)
        };
        rows.enumerate().map(of_row).sum()
    }

    fn shorten(&mut self, _: &mut Mechanism, share: f64) {
        for (velocity, before) in self.velocities.iter_mut().zip(&self.before) {
            *velocity = before + (*velocity - before) * share;
        }
    }

    fn finish(&mut self, mechanism: &mut Mechanism) {
        let (bodies, system) = (&mut mechanism.bodies, &mut mechanism.system);
        if let Some(tree) = system.as_tree() {
            tree.set_velocities(&self.space, &self.velocities, bodies);
        }
    }
}

/// Solves `A x = x` by `A = U^T D^-1 U`, Cholesky's factorisation without square roots; `matrix` holds the upper triangle by rows, then `U`. False where `A` is not positive
/// definite.
fn solve_positive_definite(matrix: &mut [f64], x: &mut [f64]) -> bool {
    let count = x.len();
    for pivot in 0..count {
        let (done, below) = matrix.split_at_mut((pivot + 1) * count);
        let row = &done[pivot * count..];
        let reciprocal = 1.0 / row[pivot];
        if !(reciprocal > 0.0 && reciprocal.is_finite()) {
            return false;
        }
        for (other, target) in (pivot + 1..).zip(below.chunks_exact_mut(count)) {
            let factor = row[other] * reciprocal;
            if factor != 0.0 {
                subtract(&mut target[other..], &row[other..], factor);
                x[other] -= factor * x[pivot];
            }
        }
    }
    for pivot in (0..count).rev() {
        let row = &matrix[pivot * count..(pivot + 1) * count];
        let known = row[pivot + 1..].iter().zip(&x[pivot + 1..]);
        let known: f64 = known.map(|(of_row, x)| of_row * x).sum();
        x[pivot] = (x[pivot] - known) / row[pivot];
    }
    true
}

/// `target -= row * factor`
fn subtract(target: &mut [f64], row: &[f64], factor: f64) {
    for (target, entry) in target.iter_mut().zip(row) {
        *target -= entry * factor;
    }
}

#[cfg(test)]
mod tests {
    use geometry::Pose;
    use nalgebra::{Matrix3, UnitQuaternion, Vector6};

    use super::*;
    use crate::contact::linear_system::BodyVelocities;
    use crate::{
        BodyMotion, BodyProperties, BodyState, Contact, JointKind, JointProperties, JointState,
        Motor, Passive,
    };

    const LINKS: usize = 5;

    /// Rods of 0.4 m on hinges about y, one after the other from the origin, which fall onto a floor; a motor turns one, and the last one touches the second one.
    fn chain(is_loose: bool) -> Mechanism {
        let along_y = UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
        let frame = |x: f64| Pose::from_parts(Vector3::new(x, 0.0, 0.0).into(), along_y);
        let inertia = Matrix3::from_diagonal(&Vector3::new(1e-3, 0.02, 0.02));
        let rod = BodyProperties::dynamic(1.0, inertia, Vector3::zeros());
        let mut bodies = vec![rod; LINKS + 1];
        if !is_loose {
            bodies[0] = BodyProperties::immovable(Vector3::zeros());
        }
        let joint = |number: usize| JointProperties {
            kind: JointKind::Revolute,
            bodies: [number, number + 1],
            base: frame(0.2),
            tip: frame(-0.2),
            pitch: 0.0,
        };
        let mut mechanism = Mechanism::new(bodies, (0..LINKS).rev().map(joint).collect());
        let state = |number: usize| BodyState {
            motion: BodyMotion {
                pose: Pose::translation(0.4 * number as f64, 0.0, 0.0),
                velocity: Vector6::new(0.3, 0.1, -1.0, 0.0, 0.2 * number as f64, 0.0),
            },
            force: Vector6::zeros(),
            gyroscopic_velocity: Vector3::zeros(),
            target: None,
        };
        let states: Vec<BodyState> = (0..=LINKS).map(state).collect();
        let joint_state = |number: usize| JointState {
            position: 0.0,
            velocity: 0.0,
            motor: (number == 2).then_some(Motor {
                velocity: 0.5,
                max_force: 1e6,
            }),
            limits: None,
            passive: Passive {
                armature: 0.1 * number as f64,
                ..Passive::default()
            },
        };
        let joints: Vec<JointState> = (0..LINKS).map(joint_state).collect();
        mechanism.begin(&states, &joints, [0.0, 0.0, -9.81], 0.01);
        let contact = |bodies, x: f64| Contact {
            bodies,
            base: None,
            point: [x, 0.02, -0.03],
            normal: [0.0, 0.0, 1.0],
            distance: 0.0,
            friction: 0.5,
            restitution: 0.0,
            velocity: [0.0; 3],
            impulse: [0.0; 3],
        };
        let on_floor = (1..=LINKS).map(|body| contact([Some(body), None], 0.4 * body as f64 + 0.1));
        let mut contacts: Vec<Contact> = on_floor.collect();
        contacts.push(contact([Some(LINKS), Some(2)], 0.8));
        mechanism.set_contacts(&contacts);
        mechanism
    }

    #[test]
    fn bodies_move_as_with_their_velocities_as_unknowns() {
        for is_loose in [false, true] {
            let [mut first, mut second] = [chain(is_loose), chain(is_loose)];
            assert!(first.find_minimum_of(&mut AxisVelocities::default()));
            assert!(second.find_minimum_of(&mut BodyVelocities::default()));
            for (a, b) in first.bodies.iter().zip(&second.bodies).skip(1) {
                assert!(
                    (a.velocity - b.velocity).amax() < 1e-6,
                    "{is_loose}: {} {}",
                    a.velocity,
                    b.velocity
                );
            }
            let pushes = first
                .contacts
                .rows
                .iter()
                .filter(|row| row.impulse[0] > 0.0);
            assert!(pushes.count() > 2, "{is_loose}");
        }
    }

    #[test]
    fn only_positive_definite_systems_are_solved() {
        let mut matrix = vec![4.0, 2.0, 0.0, 0.0, 3.0, 1.0, 0.0, 0.0, 2.0];
        let mut x = vec![8.0, 11.0, 8.0];
        assert!(solve_positive_definite(&mut matrix, &mut x));
        assert!(
            x.iter()
                .zip([1.0, 2.0, 3.0])
                .all(|(x, right)| (x - right).abs() < 1e-12),
            "{x:?}"
        );
        assert!(!solve_positive_definite(
            &mut [1.0, 2.0, 0.0, 1.0],
            &mut [1.0, 1.0]
        ));
    }
}
