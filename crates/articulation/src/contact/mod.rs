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

mod restitution;
mod states;
mod sweeps;

use nalgebra::{Matrix3, Matrix6x3, Vector3, Vector6};

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
/// A contact of a mechanism gives way to larger forces, N, as even hard bodies do: else what turns a motor of any strength would be wedged in for ever.
const MAX_RIGID_FORCE: f64 = 2000.0;
/// Stiffness beyond it, N/m.
const YIELD_STIFFNESS: f64 = 1e6;
/// The compliance beyond it is at most this part of the response of the bodies without joints, so that heavy ones do not sink in.
const MAX_YIELD_PART: f64 = 0.02;

/// A contact holds while its friction is below this fraction of what it transmits.
const HOLDING: f64 = 1.0 - 1e-9;

/// What a contact does.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum State {
    Open,
    Holds,
    Slides,
}

/// A contact as three rows: along the normal and two tangents.
pub(crate) struct Row {
    pub sides: [Option<Side>; 2],
    axes: Matrix3<f64>,
    pub impulse: Vector3<f64>,
    /// The least normal velocity, and the tangential velocities of the obstacle.
    pub target: Vector3<f64>,
    /// The velocities of the obstacle, and the velocity by which the bodies leave it after an impact with restitution; 0 without one.
    pub obstacle: Vector3<f64>,
    pub restitution_velocity: f64,
    pub friction: f64,
    /// Normal velocity per impulse.
    pub compliance: f64,
    /// The same beyond the impulse to which the contact gives way.
    yield_compliance: f64,
    rigid_impulse: f64,
    /// The same for what rebounds too, as far as a direct solution needs it.
    pub least_compliance: f64,
}

/// A body at a contact.
pub(crate) struct Side {
    pub body: usize,
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

impl State {
    fn of(row: &Row, approach: f64) -> Self {
        let [normal, first, second] = row.impulse.into();
        if normal <= 0.0 && approach > 0.0 {
            return Self::Open;
        }
        let most = row.friction * normal;
        if normal <= 0.0 || (first * first + second * second).sqrt() < most * HOLDING {
            Self::Holds
        } else {
            Self::Slides
        }
    }
}

impl Row {
    fn new(
        contact: &Contact,
        places: &mut Vec<usize>,
        bodies: &[LinkedBody],
        step: f64,
        is_free: bool,
    ) -> Self {
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
            obstacle: axes * Vector3::from(contact.velocity),
            restitution_velocity: 0.0,
            friction: contact.friction,
            compliance: 0.0,
            yield_compliance: 0.0,
            rigid_impulse: MAX_RIGID_FORCE * step,
            least_compliance: 0.0,
        };
        let rebounds = row.set_target(contact, bodies, step, is_free);
        let response = row.free_response(bodies);
        row.least_compliance = COMPLIANCE * response;
        // What rebounds keeps its energy.
        if !rebounds {
            row.compliance = row.least_compliance;
        }
        if !is_free {
            row.yield_compliance = yield_compliance(step, response);
        }
        row
    }

    /// Sets the velocities to be reached; whether the bodies rebound.
    fn set_target(
        &mut self,
        contact: &Contact,
        bodies: &[LinkedBody],
        step: f64,
        is_free: bool,
    ) -> bool {
        let mut target = self.obstacle;
        let approach = self.velocity(|body| bodies[body].present_velocity())[0] - target[0];
        let share = if contact.distance < 0.0 {
            PENETRATION_CORRECTION
        } else {
            1.0
        };
        let closing = (-contact.distance * share / step).min(MAX_CORRECTION_VELOCITY);
        let rebounds =
            contact.restitution > 0.0 && approach < -RESTITUTION_THRESHOLD && approach < closing;
        if rebounds {
            self.restitution_velocity = -approach * contact.restitution;
            if is_free {
                self.restitution_velocity =
                    self.free_restitution_velocity(contact, approach, bodies, step);
            }
        }
        let rebounds = self.restitution_velocity > 0.0;
        target[0] += if rebounds {
            self.restitution_velocity
        } else {
            closing
        };
        self.target = target;
        rebounds
    }

    /// How fast bodies rebound that only gravity moves: so that they rise to the square of the restitution of the height from which they fell, though they turn
    /// back before the surface or beyond it. Follows from the energy that the integration keeps, `(v - g h / 2)^2 / 2 + g z`.
    fn free_restitution_velocity(
        &self,
        contact: &Contact,
        approach: f64,
        bodies: &[LinkedBody],
        step: f64,
    ) -> f64 {
        let falling = self.velocity(|body| bodies[body].free_velocity())[0] - self.obstacle[0];
        let gravity = (approach - falling) / step;
        let square = contact.restitution.powi(2);
        let half = gravity * step / 2.0;
        let before = (half - approach).powi(2) * square;
        let risen = 2.0 * gravity * contact.distance * (1.0 - square);
        ((before - risen).max(0.0).sqrt() - half).max(0.0)
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

    /// The normal impulse that leads to no velocity beyond what the contact gives way by. `rigid`: the impulse if it did not, `response`: the velocity by an impulse.
    fn yielded(&self, rigid: f64, response: f64) -> f64 {
        let beyond = (rigid - self.rigid_impulse).max(0.0);
        rigid
            - beyond * self.yield_compliance / (response + self.compliance + self.yield_compliance)
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

/// Normal velocity per impulse by which a contact gives way, so that a force pushes bodies into each other by what it has beyond `MAX_RIGID_FORCE` over `YIELD_STIFFNESS`.
fn yield_compliance(step: f64, response: f64) -> f64 {
    let elastic = PENETRATION_CORRECTION / (YIELD_STIFFNESS * step * step);
    elastic.min(MAX_YIELD_PART * response)
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
