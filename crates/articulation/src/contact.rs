//! Contacts of the bodies of a mechanism with obstacles, with guests (free bodies that touch it) and with each other: the impulses that
//! keep them apart, with friction.
//!
//! A foot answers an impulse with all that stands on it. The response of the touching bodies with all joints holding is found from the
//! factor of the system of the joints, `R = M^-1 - (L^-1 J M^-1)^T (L^-1 J M^-1)`, of which only the part between a touching body and the
//! root of the tree is computed. In the space of the contacts, `G = N R N^T`, impulses are then found by projected Gauss-Seidel sweeps until
//! they do not change any more: normal impulses push, tangential ones lie in the friction cone (M. Jean, *The non-smooth contact dynamics
//! method*, 1999).

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use crate::block_cholesky::Block;
use crate::linked_body::LinkedBody;
use crate::mechanism::Mechanism;

/// A point where two bodies touch, or may do so within the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Indices of the bodies; None for obstacles, which no force moves.
    pub bodies: [Option<usize>; 2],
    /// World.
    pub point: [f64; 3],
    /// Unit vector from the second body to the first, world.
    pub normal: [f64; 3],
    /// Between the surfaces, metres; negative where they overlap.
    pub distance: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Velocity of an obstacle that is second at the point, or the opposite of that of one that is first, world.
    pub velocity: [f64; 3],
    /// The impulse the contact is expected to exert on the first body (N s, world): that of the step before.
    pub impulse: [f64; 3],
}

/// The part of an overlap that is undone in a step.
const RECOVERY: f64 = 0.2;
/// Bodies are pushed out of obstacles no faster, m/s.
const FASTEST_RECOVERY: f64 = 1.0;
/// Slower impacts do not rebound, m/s.
const REBOUND: f64 = 0.05;
/// Compliance of a contact as a part of its own response: shares the load between points where it is not determined.
const COMPLIANCE: f64 = 1e-5;
/// Largest number of sweeps.
const SWEEPS: usize = 200;
/// Impulses that change by less than this part of the largest one are found.
const FOUND: f64 = 1e-7;

type Jacobian = SMatrix<f64, 3, 6>;

/// A contact as three rows: along the normal and two tangents.
struct Row {
    sides: [Option<Side>; 2],
    axes: Matrix3<f64>,
    impulse: Vector3<f64>,
    /// The least normal velocity, and the tangential velocities of the obstacle.
    target: Vector3<f64>,
    friction: f64,
}

/// A body at a contact.
struct Side {
    body: usize,
    /// Place of the body among the touching ones.
    place: usize,
    /// From the velocity of the body to its part of the relative velocity.
    jacobian: Jacobian,
}

/// The contacts of a step.
#[derive(Default)]
pub(crate) struct Contacts {
    rows: Vec<Row>,
    /// The touching bodies.
    bodies: Vec<usize>,
    /// For each of them: its response to the joints next to it, carried along the factor. By column.
    carried: Vec<Vec<Option<Block>>>,
    /// Response of contacts to contacts, row by row.
    response: Vec<Matrix3<f64>>,
    /// Change of the velocities in the last sweep.
    velocities: Vec<Vector3<f64>>,
}

impl Row {
    fn new(contact: &Contact, places: &mut Vec<usize>, bodies: &[LinkedBody], step: f64) -> Self {
        let normal = Vector3::from(contact.normal);
        let (first, second) = tangents(&normal);
        let axes = Matrix3::from_rows(&[normal.transpose(), first.transpose(), second.transpose()]);
        let sides = [0, 1].map(|side| {
            let body = contact.bodies[side].filter(|&body| bodies.get(body).is_some_and(LinkedBody::is_dynamic))?;
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let lever = Vector3::from(contact.point) - bodies[body].com;
            let mut jacobian = Jacobian::zeros();
            jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&(axes * sign));
            jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&(axes * lever.cross_matrix() * -sign));
            Some(Side { body, place: place_of(places, body), jacobian })
        });
        let impulse = axes * Vector3::from(contact.impulse);
        let mut row = Self { sides, axes, impulse, target: Vector3::zeros(), friction: contact.friction };
        row.target = row.target(contact, bodies, step);
        row
    }

    fn target(&self, contact: &Contact, bodies: &[LinkedBody], step: f64) -> Vector3<f64> {
        let mut target = self.axes * Vector3::from(contact.velocity);
        let approach = self.velocity(|body| bodies[body].present_velocity())[0] - target[0];
        let share = if contact.distance < 0.0 { RECOVERY } else { 1.0 };
        let closing = (-contact.distance * share / step).min(FASTEST_RECOVERY);
        let rebounds = contact.restitution > 0.0 && approach < -REBOUND && approach < closing;
        target[0] += if rebounds { -approach * contact.restitution } else { closing };
        target
    }

    /// Velocity of the first body relative to the second along the axes.
    fn velocity(&self, of_body: impl Fn(usize) -> Vector6<f64>) -> Vector3<f64> {
        self.sides.iter().flatten().map(|side| side.jacobian * of_body(side.body)).sum()
    }

    /// Tangential impulses within what friction transmits.
    fn within_cone(&self, first: f64, second: f64) -> (f64, f64) {
        let (largest, length) = (self.friction * self.impulse[0], first.hypot(second));
        let scale = if length > largest { largest / length } else { 1.0 };
        (first * scale, second * scale)
    }
}

/// Place of a body among those that touch something, the last one if it is new.
fn place_of(places: &mut Vec<usize>, body: usize) -> usize {
    places.iter().position(|&other| other == body).unwrap_or_else(|| {
        places.push(body);
        places.len() - 1
    })
}

/// Two unit vectors across a unit vector.
fn tangents(normal: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let helper = if normal.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    let first = normal.cross(&helper).normalize();
    (first, normal.cross(&first))
}

impl Mechanism {
    /// Sets the contacts for the step that has begun; [`solve`](Self::solve) finds their impulses.
    pub fn set_contacts(&mut self, contacts: &[Contact]) {
        let Self { bodies, contacts: system, step, .. } = self;
        let Contacts { rows, bodies: places, .. } = system;
        places.clear();
        rows.clear();
        rows.extend(contacts.iter().map(|contact| Row::new(contact, places, bodies, *step)));
    }

    /// The impulses of the contacts on their first bodies in the order of [`set_contacts`](Self::set_contacts), N s, world.
    pub fn contact_impulses(&self) -> impl Iterator<Item = [f64; 3]> {
        self.contacts.rows.iter().map(|row| row.axes.tr_mul(&row.impulse).into())
    }

    /// The impulses of the contacts by body: force and torque about the centre of mass, times the step.
    pub(crate) fn add_contact_impulses(&self, impulses: &mut [Vector6<f64>]) {
        for row in &self.contacts.rows {
            for side in row.sides.iter().flatten() {
                impulses[side.body] += side.jacobian.tr_mul(&row.impulse);
            }
        }
    }

    pub(crate) fn has_contacts(&self) -> bool {
        !self.contacts.rows.is_empty()
    }

    /// Finds how contacts respond to each other while the joints hold, from the factor of the system.
    pub(crate) fn find_contact_response(&mut self) {
        let mut carried = std::mem::take(&mut self.contacts.carried);
        carried.resize_with(self.contacts.bodies.len(), Vec::new);
        for (&body, blocks) in self.contacts.bodies.iter().zip(&mut carried) {
            blocks.clear();
            blocks.resize(self.joints.len(), None);
            for (joint, block) in self.joints.iter().zip(blocks.iter_mut()) {
                for side in (0..2).filter(|&side| joint.body(side) == body) {
                    *block.get_or_insert_with(Block::zeros) += joint.active_inverse_mass[side];
                }
            }
            self.matrix.carry(&self.pattern, blocks);
        }
        let count = carried.len();
        let mut bodies = Vec::with_capacity(count * count);
        for (i, first) in carried.iter().enumerate() {
            for (j, second) in carried.iter().enumerate() {
                let own =
                    if i == j { self.bodies[self.contacts.bodies[i]].inverse_mass_matrix } else { Matrix6::zeros() };
                let shared = first.iter().zip(second).filter_map(|(a, b)| Some(a.as_ref()?.tr_mul(b.as_ref()?)));
                bodies.push(shared.fold(own, |sum, product| sum - product));
            }
        }
        self.contacts.carried = carried;
        self.contacts.update_response(&bodies);
    }

    /// Finds the impulses of the contacts, the joints having been solved for those assumed so far; true when they changed.
    pub(crate) fn find_contact_impulses(&mut self) -> bool {
        let bodies = &self.bodies;
        let velocity = |row: &Row| row.velocity(|body| bodies[body].velocity) - row.target;
        let velocities = self.contacts.rows.iter().map(velocity).collect();
        self.contacts.velocities = velocities;
        let mut changed = false;
        for _ in 0..SWEEPS {
            let (change, largest) = self.contacts.sweep();
            changed |= change > 0.0;
            if change <= FOUND * largest {
                break;
            }
        }
        changed
    }
}

impl Contacts {
    fn update_response(&mut self, bodies: &[Matrix6<f64>]) {
        let count = self.bodies.len();
        self.response.clear();
        let mut of_places = vec![Jacobian::zeros(); count];
        for row in &self.rows {
            for (place, of_place) in of_places.iter_mut().enumerate() {
                let response = |side: &Side| side.jacobian * bodies[side.place * count + place];
                *of_place = row.sides.iter().flatten().map(response).sum();
            }
            for column in &self.rows {
                let of_side = |side: &Side| of_places[side.place] * side.jacobian.transpose();
                self.response.push(column.sides.iter().flatten().map(of_side).sum());
            }
        }
    }

    /// One visit of every contact; returns the largest change of an impulse, and the largest impulse.
    fn sweep(&mut self) -> (f64, f64) {
        let (mut change, mut largest) = (0.0, 0.0);
        for index in 0..self.rows.len() {
            let by_normal = self.push(index);
            let by_friction = self.rub(index);
            change = f64::max(change, by_normal.max(by_friction));
            largest = f64::max(largest, self.rows[index].impulse[0].abs());
        }
        (change, largest)
    }

    /// Lets a contact push; returns the change of its impulse.
    fn push(&mut self, index: usize) -> f64 {
        let count = self.rows.len();
        let response = self.response[index * count + index][(0, 0)];
        let row = &mut self.rows[index];
        let missing = self.velocities[index][0] + COMPLIANCE * response * row.impulse[0];
        let impulse = (row.impulse[0] - missing / (response * (1.0 + COMPLIANCE))).max(0.0);
        let change = impulse - row.impulse[0];
        if change == 0.0 || !change.is_finite() {
            return 0.0;
        }
        row.impulse[0] = impulse;
        for (other, velocity) in self.velocities.iter_mut().enumerate() {
            *velocity += self.response[other * count + index].column(0) * change;
        }
        change.abs()
    }

    /// Lets the friction of a contact slow down its tangential velocity; returns the change of its impulse.
    fn rub(&mut self, index: usize) -> f64 {
        let count = self.rows.len();
        let own = &self.response[index * count + index];
        // The same for all directions, so that friction opposes the motion.
        let response = own[(1, 1)].max(own[(2, 2)]) + own[(1, 2)].abs();
        let (row, velocity) = (&mut self.rows[index], self.velocities[index]);
        let free = [1, 2].map(|axis| row.impulse[axis] - velocity[axis] / (response * (1.0 + COMPLIANCE)));
        let (first, second) = row.within_cone(free[0], free[1]);
        let change = [first - row.impulse[1], second - row.impulse[2]];
        if change == [0.0; 2] || !change.iter().all(|x| x.is_finite()) {
            return 0.0;
        }
        (row.impulse[1], row.impulse[2]) = (first, second);
        for (other, velocity) in self.velocities.iter_mut().enumerate() {
            let of_other = &self.response[other * count + index];
            *velocity += of_other.column(1) * change[0] + of_other.column(2) * change[1];
        }
        change[0].abs().max(change[1].abs())
    }
}
