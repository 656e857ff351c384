//! Contacts of the bodies of a mechanism with obstacles, with guests (free bodies that touch it) and with each other: the impulses that
//! keep them apart, with friction.
//!
//! A foot answers an impulse with all that stands on it: contacts and joints are solved at once, by Newton's method ([`newton`]). Where that finds
//! nothing in its number of iterations, projected Gauss-Seidel sweeps over the contacts find their impulses with all joints holding: normal impulses push,
//! tangential ones lie in the friction cone (M. Jean, *The non-smooth contact dynamics method*, 1999). The response of the touching bodies follows from the
//! factor of the system of the joints ([`System::responses`](crate::system::System::responses)); for a tree only the path between a touching body and the
//! root is visited.
//!
//! Neighbours at a joint that overlap where the joint lets neither of them escape do not push each other: neither where its motion does not
//! separate them, nor where what separates them at one point brings them together at another one, as around a ball joint between two faces.

mod axis_velocities;
mod friction_limits;
mod line_search;
mod linear_system;
mod linearization;
mod neighbours;
mod newton;
mod restitution;
mod row;
mod sweeps;
mod unknowns;

use axis_velocities::AxisVelocities;
use nalgebra::{Matrix3, Matrix6x3, Vector3, Vector6};
pub(crate) use row::{Row, Side};

use crate::jacobian::InverseMass;
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
    pub changes: Vec<Change>,
    /// Where the changes of a contact end.
    pub ends: Vec<usize>,
    /// Response of every contact to itself.
    pub own: Vec<Matrix3<f64>>,
    /// Impulses before a sweep, and the directions in which they change.
    pub before: Vec<Vector3<f64>>,
    pub directions: Vec<Vector3<f64>>,
    /// Whether contacts cannot be solved with the joints in this step.
    pub are_swept: bool,
    /// The unknowns of trees with few free axes.
    pub along_axes: AxisVelocities,
}

impl Mechanism {
    /// Sets the contacts for the step that has begun; [`solve`](Self::solve) finds their impulses.
    pub fn set_contacts(&mut self, contacts: &[Contact]) {
        let possible: Vec<bool> = contacts
            .iter()
            .map(|contact| self.can_separate(contact, contacts))
            .collect();
        let is_free = self.joints.is_empty();
        let Self {
            bodies,
            contacts: system,
            step,
            ..
        } = self;
        let Contacts {
            rows,
            bodies: places,
            are_swept,
            ..
        } = system;
        places.clear();
        rows.clear();
        *are_swept = false;
        for (contact, possible) in contacts.iter().zip(possible) {
            let contact = if possible {
                *contact
            } else {
                Contact {
                    bodies: [None; 2],
                    ..*contact
                }
            };
            rows.push(Row::new(&contact, places, bodies, *step, is_free));
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
        if !self.has_contacts() || !self.solve_by_newton() {
            self.solve_free_by_sweeps();
        }
        self.limit_restitution();
        self.bodies
            .iter()
            .all(|body| body.velocity.iter().all(|x| x.is_finite()))
    }

    fn solve_free_by_sweeps(&mut self) {
        self.apply_contact_impulses();
        for body in &mut self.bodies {
            body.joint_impulse = Vector6::zeros();
            body.velocity = body.free_velocity() + body.inverse_mass().times(&body.known_impulse());
        }
        if self.has_contacts() {
            self.prepare_sweeps();
            self.contacts.sweep_to_rest();
            self.take_swept();
        }
    }

    /// Finds the responses to the contacts of bodies without joints, and takes their velocities.
    fn prepare_sweeps(&mut self) {
        let masses: Vec<InverseMass> = self.bodies.iter().map(LinkedBody::inverse_mass).collect();
        self.contacts.find_changes(&masses);
        self.take_velocities();
    }

    /// Takes what sweeps found.
    fn take_swept(&mut self) {
        self.apply_contact_impulses();
        let Contacts {
            bodies, velocities, ..
        } = &self.contacts;
        for (&body, velocity) in bodies.iter().zip(velocities) {
            self.bodies[body].velocity = *velocity;
        }
    }

    fn take_velocities(&mut self) {
        let Contacts {
            bodies, velocities, ..
        } = &mut self.contacts;
        velocities.clear();
        velocities.extend(bodies.iter().map(|&body| self.bodies[body].velocity));
    }

    /// Makes rebounds of free bodies smaller if they gain energy.
    fn limit_restitution(&mut self) {
        if self.contacts.rows.iter().any(Row::has_restitution) {
            self.prepare_sweeps();
            self.contacts.limit_restitution();
            self.take_swept();
        }
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
        self.take_velocities();
        self.contacts.sweep_to_rest()
    }
}
