//! Contacts of the bodies of a mechanism with obstacles, with guests (free bodies that touch it) and with each other: the impulses that
//! keep them apart, with friction.
//!
//! A foot answers an impulse with all that stands on it. The response of the touching bodies with all joints holding is found from the
//! factor of the system of the joints ([`System::responses`](crate::system::System::responses)); for a tree only the path between a touching
//! body and the root is visited. Impulses are then found by projected Gauss-Seidel sweeps over the contacts, which change the velocities of the
//! touching bodies by this response, until they do not change any more: normal impulses push, tangential ones lie in the friction cone (M. Jean,
//! *The non-smooth contact dynamics method*, 1999).
//!
//! Neighbours at a joint that overlap where the joint lets neither of them escape do not push each other: neither where its motion does not
//! separate them, nor where what separates them at one point brings them together at another one, as around a ball joint between two faces.

use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};

use crate::jacobian::InverseMass;
use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::mechanism::Mechanism;

/// A point where two bodies touch, or may do so within the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Indices of the bodies; None for obstacles, which no force moves.
    pub bodies: [Option<usize>; 2],
    /// Index of the obstacle if it is a body of the mechanism that does not move.
    pub base: Option<usize>,
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

/// Fraction of a penetration that is corrected in one step.
const PENETRATION_CORRECTION: f64 = 0.2;
/// Greatest velocity of penetration correction, m/s: bodies keep it after they have separated.
const MAX_CORRECTION_VELOCITY: f64 = 0.2;
/// Neighbours at a joint are in contact only if its motion separates them at this fraction of its speed or more.
const MIN_SEPARATION_RATE: f64 = 1e-3;
/// Distance below which points of neighbours count as touching, metres.
const TOUCHING_DISTANCE: f64 = 2e-4;
/// Passes of the perceptron that searches for a motion that separates neighbours at all of their points.
const MAX_PERCEPTRON_PASSES: usize = 8;
/// Approach velocity below which restitution is ignored, m/s.
const RESTITUTION_THRESHOLD: f64 = 0.05;
/// Compliance of a contact as a part of the response of its bodies without joints: shares the load between points where it is not determined,
/// and bounds it where joints do not let bodies escape that overlap.
const COMPLIANCE: f64 = 5e-6;
/// Largest number of iterations of the contact solver, each a sweep over all contacts.
const MAX_ITERATIONS: usize = 200;
/// The solver has converged when no impulse changes by more than this fraction of the largest one.
const TOLERANCE: f64 = 1e-7;

/// A contact as three rows: along the normal and two tangents.
pub(crate) struct Row {
    pub sides: [Option<Side>; 2],
    axes: Matrix3<f64>,
    pub impulse: Vector3<f64>,
    /// The least normal velocity, and the tangential velocities of the obstacle.
    pub target: Vector3<f64>,
    pub friction: f64,
    /// Normal velocity per impulse.
    pub compliance: f64,
    /// The same for what rebounds too, as far as a direct solution needs it.
    pub least_compliance: f64,
}

/// A body at a contact.
pub(crate) struct Side {
    body: usize,
    /// Place of the body among the touching ones.
    pub place: usize,
    /// From impulses along the axes to that on the body; its transpose is from the velocity of the body to its part of the relative velocity.
    pub jacobian: Matrix6x3<f64>,
}

/// How a touching body answers impulses along the axes of a contact.
pub(crate) struct Change {
    pub place: usize,
    pub velocity: Matrix6x3<f64>,
}

/// The contacts of a step.
#[derive(Default)]
pub(crate) struct Contacts {
    pub rows: Vec<Row>,
    /// The touching bodies: their places.
    pub bodies: Vec<usize>,
    /// Velocities of the touching bodies.
    pub velocities: Vec<Vector6<f64>>,
    /// The changes of those that an impulse along the axes of a contact reaches, contact by contact.
    changes: Vec<Change>,
    /// Where the changes of a contact end.
    ends: Vec<usize>,
    /// Response of every contact to itself.
    own: Vec<Matrix3<f64>>,
    /// Impulses before a sweep, and the directions in which they change.
    before: Vec<Vector3<f64>>,
    directions: Vec<Vector3<f64>>,
    /// Whether contacts that hold yield to friction, too, as they are without joints.
    holding_yields: bool,
}

impl Row {
    fn new(contact: &Contact, places: &mut Vec<usize>, bodies: &[LinkedBody], step: f64) -> Self {
        let normal = Vector3::from(contact.normal);
        let (first, second) = tangents(&normal);
        let axes = Matrix3::from_rows(&[normal.transpose(), first.transpose(), second.transpose()]);
        let sides = [0, 1].map(|side| {
            let body = contact.bodies[side]
                .filter(|&body| bodies.get(body).is_some_and(LinkedBody::is_dynamic))?;
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let lever = Vector3::from(contact.point) - bodies[body].com;
            let mut jacobian = Matrix6x3::zeros();
            jacobian
                .fixed_view_mut::<3, 3>(0, 0)
                .copy_from(&(axes.transpose() * sign));
            jacobian
                .fixed_view_mut::<3, 3>(3, 0)
                .copy_from(&(lever.cross_matrix() * axes.transpose() * sign));
            Some(Side {
                body,
                place: place_of(places, body),
                jacobian,
            })
        });
        let impulse = axes * Vector3::from(contact.impulse);
        let mut row = Self {
            sides,
            axes,
            impulse,
            target: Vector3::zeros(),
            friction: contact.friction,
            compliance: 0.0,
            least_compliance: 0.0,
        };
        let rebounds = row.set_target(contact, bodies, step);
        row.least_compliance = COMPLIANCE * row.free_response(bodies);
        // What rebounds keeps its energy.
        if !rebounds {
            row.compliance = row.least_compliance;
        }
        row
    }

    /// Sets the velocities to be reached; whether the bodies rebound.
    fn set_target(&mut self, contact: &Contact, bodies: &[LinkedBody], step: f64) -> bool {
        let mut target = self.axes * Vector3::from(contact.velocity);
        let approach = self.velocity(|body| bodies[body].present_velocity())[0] - target[0];
        let share = if contact.distance < 0.0 {
            PENETRATION_CORRECTION
        } else {
            1.0
        };
        let closing = (-contact.distance * share / step).min(MAX_CORRECTION_VELOCITY);
        let rebounds =
            contact.restitution > 0.0 && approach < -RESTITUTION_THRESHOLD && approach < closing;
        target[0] += if rebounds {
            -approach * contact.restitution
        } else {
            closing
        };
        self.target = target;
        rebounds
    }

    /// Normal velocity per normal impulse if there were no joints.
    fn free_response(&self, bodies: &[LinkedBody]) -> f64 {
        let of_side = |side: &Side| {
            let normal = side.jacobian.column(0).into_owned();
            normal.dot(&bodies[side.body].inverse_mass().times(&normal))
        };
        self.sides.iter().flatten().map(of_side).sum()
    }

    /// Velocity of the first body relative to the second along the axes.
    fn velocity(&self, of_body: impl Fn(usize) -> Vector6<f64>) -> Vector3<f64> {
        self.sides
            .iter()
            .flatten()
            .map(|side| side.jacobian.tr_mul(&of_body(side.body)))
            .sum()
    }

    /// Tangential impulses within what friction transmits beside a normal one.
    pub(crate) fn within_cone(&self, normal: f64, first: f64, second: f64) -> (f64, f64) {
        let (largest, length) = (
            self.friction * normal,
            (first * first + second * second).sqrt(),
        );
        let scale = if length > largest {
            largest / length
        } else {
            1.0
        };
        (first * scale, second * scale)
    }
}

fn of_contact<'a>(changes: &'a [Change], ends: &[usize], index: usize) -> &'a [Change] {
    let first = index.checked_sub(1).map_or(0, |before| ends[before]);
    &changes[first..ends[index]]
}

/// Place of a body among those that touch something, the last one if it is new.
fn place_of(places: &mut Vec<usize>, body: usize) -> usize {
    places
        .iter()
        .position(|&other| other == body)
        .unwrap_or_else(|| {
            places.push(body);
            places.len() - 1
        })
}

/// Two unit vectors across a unit vector.
fn tangents(normal: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let helper = if normal.x.abs() < 0.7 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let first = normal.cross(&helper).normalize();
    (first, normal.cross(&first))
}

impl Mechanism {
    /// Sets the contacts for the step that has begun; [`solve`](Self::solve) finds their impulses.
    pub fn set_contacts(&mut self, contacts: &[Contact]) {
        let possible: Vec<bool> = contacts
            .iter()
            .map(|contact| self.can_separate(contact, contacts))
            .collect();
        let Self {
            bodies,
            contacts: system,
            step,
            ..
        } = self;
        let Contacts {
            rows,
            bodies: places,
            ..
        } = system;
        places.clear();
        rows.clear();
        for (contact, possible) in contacts.iter().zip(possible) {
            let contact = if possible {
                *contact
            } else {
                Contact {
                    bodies: [None; 2],
                    ..*contact
                }
            };
            rows.push(Row::new(&contact, places, bodies, *step));
        }
    }

    /// The impulses of the contacts on their first bodies in the order of [`set_contacts`](Self::set_contacts), N s, world.
    pub fn contact_impulses(&self) -> impl Iterator<Item = [f64; 3]> {
        self.contacts
            .rows
            .iter()
            .map(|row| row.axes.tr_mul(&row.impulse).into())
    }

    /// Lets the impulses of the contacts act on the bodies.
    pub(crate) fn apply_contact_impulses(&mut self) {
        self.bodies
            .iter_mut()
            .for_each(|body| body.contact_impulse = Vector6::zeros());
        for row in &self.contacts.rows {
            for side in row.sides.iter().flatten() {
                self.bodies[side.body].contact_impulse += side.jacobian * row.impulse;
            }
        }
    }

    pub(crate) fn has_contacts(&self) -> bool {
        !self.contacts.rows.is_empty()
    }

    /// Finds the impulses of the contacts of bodies that hang on nothing.
    pub(crate) fn solve_without_joints(&mut self) -> bool {
        self.apply_contact_impulses();
        let masses: Vec<InverseMass> = self.bodies.iter().map(LinkedBody::inverse_mass).collect();
        for (body, mass) in self.bodies.iter_mut().zip(&masses) {
            body.joint_impulse = Vector6::zeros();
            body.velocity = body.free_velocity() + mass.times(&body.known_impulse());
        }
        self.contacts.find_changes(&masses);
        if self.has_contacts() && self.find_contact_impulses() {
            self.apply_contact_impulses();
            let Contacts {
                bodies, velocities, ..
            } = &self.contacts;
            for (&body, velocity) in bodies.iter().zip(velocities) {
                self.bodies[body].velocity = *velocity;
            }
        }
        self.bodies
            .iter()
            .all(|body| body.velocity.iter().all(|x| x.is_finite()))
    }

    /// Finds how contacts respond to each other while the joints hold, from the factor of the system.
    pub(crate) fn find_contact_response(&mut self) {
        let Self {
            system,
            joints,
            contacts,
            ..
        } = self;
        contacts.update_changes(&system.responses(joints, &contacts.bodies));
    }

    /// Finds the impulses of the contacts, the joints having been solved for those assumed so far; true when they changed.
    pub(crate) fn find_contact_impulses(&mut self) -> bool {
        let Self {
            bodies,
            contacts,
            joints,
            ..
        } = self;
        contacts.velocities.clear();
        contacts
            .velocities
            .extend(contacts.bodies.iter().map(|&body| bodies[body].velocity));
        contacts.directions.clear();
        contacts
            .directions
            .resize(contacts.rows.len(), Vector3::zeros());
        contacts.holding_yields = joints.is_empty();
        let (mut changed, mut square) = (contacts.holding_yields, f64::INFINITY);
        if contacts.holding_yields {
            contacts.solve_by_states(bodies);
        }
        for sweep in 1..=MAX_ITERATIONS {
            contacts.before.clear();
            contacts
                .before
                .extend(contacts.rows.iter().map(|row| row.impulse));
            let (change, largest) = contacts.sweep();
            changed |= change > 0.0;
            // What is found in the end lies within the friction cones, where only sweeps keep it.
            if change <= TOLERANCE * largest || sweep == MAX_ITERATIONS {
                break;
            }
            square = contacts.extrapolate(square);
        }
        changed
    }

    /// Whether the bodies of a contact can be separated: those of a joint only where its motion does so at all points where they touch.
    fn can_separate(&self, contact: &Contact, all: &[Contact]) -> bool {
        let joins = |joint: &&Joint| {
            joint
                .properties
                .bodies
                .into_iter()
                .all(|body| contact.is_of(body))
        };
        self.joints.iter().filter(joins).all(|joint| {
            let touching = all
                .iter()
                .filter(|other| other.distance < TOUCHING_DISTANCE && other.has_bodies_of(contact));
            let directions: Vec<Vector3<f64>> =
                touching.map(|contact| joint.separation(contact)).collect();
            joint.separation(contact).norm() > MIN_SEPARATION_RATE && is_separable(&directions)
        })
    }
}

/// Whether some motion has a positive part along all these directions: the perceptron finds it unless it hardly does (F. Rosenblatt, 1958).
fn is_separable(directions: &[Vector3<f64>]) -> bool {
    let mut motion: Vector3<f64> = directions.iter().sum();
    for _ in 0..MAX_PERCEPTRON_PASSES {
        let mut is_found = true;
        for direction in directions
            .iter()
            .filter(|direction| direction.norm() > MIN_SEPARATION_RATE)
        {
            if direction.dot(&motion) <= 0.0 {
                motion += direction;
                is_found = false;
            }
        }
        if is_found {
            return true;
        }
    }
    false
}

impl Contact {
    /// Whether a body of the mechanism is one of the two.
    fn is_of(&self, body: usize) -> bool {
        match self.bodies {
            [Some(first), Some(second)] => body == first || body == second,
            [Some(only), None] | [None, Some(only)] => body == only || self.base == Some(body),
            [None, None] => false,
        }
    }

    fn has_bodies_of(&self, other: &Self) -> bool {
        let ends = |contact: &Self| {
            let [first, second] = contact.bodies.map(|body| body.or(contact.base));
            (first.min(second), first.max(second))
        };
        ends(self) == ends(other)
    }
}

impl Contacts {
    /// The response of bodies without joints. `masses`: of all bodies.
    fn find_changes(&mut self, masses: &[InverseMass]) {
        self.changes.clear();
        self.ends.clear();
        self.own.clear();
        for row in &self.rows {
            let mut response = Matrix3::zeros();
            for side in row.sides.iter().flatten() {
                let mass = &masses[side.body];
                let mut velocity = side.jacobian * mass.linear;
                velocity
                    .fixed_rows_mut::<3>(3)
                    .copy_from(&(mass.angular * side.jacobian.fixed_rows::<3>(3)));
                response += side.jacobian.tr_mul(&velocity);
                self.changes.push(Change {
                    place: side.place,
                    velocity,
                });
            }
            self.ends.push(self.changes.len());
            self.own.push(response);
        }
    }

    /// `bodies`: the response of touching bodies to each other.
    fn update_changes(&mut self, bodies: &[Matrix6<f64>]) {
        let Self {
            rows,
            bodies: touching,
            changes,
            ends,
            own,
            ..
        } = self;
        let count = touching.len();
        changes.clear();
        ends.clear();
        own.clear();
        for row in rows.iter() {
            let mut response = Matrix3::zeros();
            for place in 0..count {
                let change = |side: &Side| bodies[place * count + side.place] * side.jacobian;
                let velocity: Matrix6x3<f64> = row.sides.iter().flatten().map(change).sum();
                if velocity == Matrix6x3::zeros() {
                    continue;
                }
                let here = row.sides.iter().flatten();
                response += here
                    .filter(|side| side.place == place)
                    .map(|side| side.jacobian.tr_mul(&velocity))
                    .sum::<Matrix3<f64>>();
                changes.push(Change { place, velocity });
            }
            ends.push(changes.len());
            own.push(response);
        }
    }

    /// One visit of every contact; returns the largest change of an impulse, and the largest impulse.
    fn sweep(&mut self) -> (f64, f64) {
        let (mut change, mut largest) = (0.0, 0.0);
        for index in 0..self.rows.len() {
            let changes = self.push(index).max(self.apply_friction(index));
            change = f64::max(change, changes);
            largest = f64::max(largest, self.rows[index].impulse[0].abs());
        }
        (change, largest)
    }

    /// Goes on in the direction of the sweeps before: the nonsmooth conjugate gradients of M. Silcowitz, S. Niebe and K. Erleben (*A nonsmooth
    /// nonlinear conjugate gradient method for interactive contact force problems*, 2010), which need a tenth of the sweeps where bodies bear
    /// each other by many contacts. `before`: the squared length of the last step; returns that of this one.
    fn extrapolate(&mut self, before: f64) -> f64 {
        let step =
            |contacts: &Self, index: usize| contacts.rows[index].impulse - contacts.before[index];
        let square: f64 = (0..self.rows.len())
            .map(|index| step(self, index).norm_squared())
            .sum();
        let share = Some(square / before)
            .filter(|share| *share <= 1.0)
            .unwrap_or(0.0);
        for index in 0..self.rows.len() {
            let further = self.directions[index] * share;
            self.directions[index] = further + step(self, index);
            let pushes = self.rows[index].impulse[0] + further[0] > 0.0;
            if pushes && further != Vector3::zeros() && further.iter().all(|x| x.is_finite()) {
                (0..3).for_each(|axis| self.apply(index, axis, further[axis]));
            }
        }
        square
    }

    /// What the velocity of a contact lacks, along one of its axes.
    pub(crate) fn slip(&self, index: usize, axis: usize) -> f64 {
        let row = &self.rows[index];
        let velocity = |side: &Side| side.jacobian.column(axis).dot(&self.velocities[side.place]);
        row.sides.iter().flatten().map(velocity).sum::<f64>() - row.target[axis]
    }

    /// Changes the impulse of a contact along one of its axes.
    fn apply(&mut self, index: usize, axis: usize, change: f64) {
        self.rows[index].impulse[axis] += change;
        let Self {
            changes,
            ends,
            velocities,
            ..
        } = self;
        for of_body in of_contact(changes, ends, index) {
            velocities[of_body.place] += of_body.velocity.column(axis) * change;
        }
    }

    /// How the touching bodies answer the impulses of a contact.
    pub(crate) fn changes_of(&self, index: usize) -> &[Change] {
        of_contact(&self.changes, &self.ends, index)
    }

    /// Lets a contact push; returns the change of its impulse.
    fn push(&mut self, index: usize) -> f64 {
        let (before, compliance) = (self.rows[index].impulse[0], self.rows[index].compliance);
        let missing = self.slip(index, 0) + compliance * before;
        let change = (before - missing / (self.own[index][(0, 0)] + compliance)).max(0.0) - before;
        if change == 0.0 || !change.is_finite() {
            return 0.0;
        }
        self.apply(index, 0, change);
        change.abs()
    }

    /// Lets the friction of a contact slow down its tangential velocity; returns the change of its impulse.
    fn apply_friction(&mut self, index: usize) -> f64 {
        let own = &self.own[index];
        // The same for all directions, so that friction opposes the motion.
        let response =
            own[(1, 1)].max(own[(2, 2)]) + own[(1, 2)].abs() + self.rows[index].compliance;
        let row = &self.rows[index];
        if row.impulse == Vector3::zeros() {
            return 0.0;
        }
        let yields = if self.holding_yields {
            row.compliance
        } else {
            0.0
        };
        let missing = |axis: usize| self.slip(index, axis) + yields * row.impulse[axis];
        let free = [1, 2].map(|axis| row.impulse[axis] - missing(axis) / response);
        let (first, second) = row.within_cone(row.impulse[0], free[0], free[1]);
        let change = [first - row.impulse[1], second - row.impulse[2]];
        if change == [0.0; 2] || !change.iter().all(|x| x.is_finite()) {
            return 0.0;
        }
        self.apply(index, 1, change[0]);
        self.apply(index, 2, change[1]);
        change[0].abs().max(change[1].abs())
    }
}
