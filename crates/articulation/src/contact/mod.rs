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

mod neighbours;
mod restitution;
mod row;
mod states;
mod sweeps;

use nalgebra::{Matrix3, Matrix6x3, Vector3, Vector6};
pub(crate) use row::{Row, Side, State};

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
    /// Whether contacts that hold yield to friction, too, as they are without joints.
    pub holding_yields: bool,
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
        contacts.holding_yields = joints.is_empty();
        if !contacts.holding_yields {
            return contacts.sweep_to_rest();
        }
        if !contacts.solve_by_states(bodies) {
            contacts.sweep_to_rest();
        }
        contacts.limit_restitution();
        true
    }
}
