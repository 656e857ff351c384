//! A contact as rows of the solver: the velocities it asks for, and how it gives way.

use nalgebra::{Matrix3, Matrix6x3, Vector3, Vector6};

use crate::contact::Contact;
use crate::contact::linearization::Linearization;
use crate::linked_body::LinkedBody;

/// Fraction of a penetration that is corrected in one step.
const PENETRATION_CORRECTION: f64 = 0.2;
/// Greatest velocity of penetration correction, m/s: bodies keep it after they have separated.
const MAX_CORRECTION_VELOCITY: f64 = 0.2;
/// Approach velocity below which restitution is ignored, m/s.
const RESTITUTION_THRESHOLD: f64 = 0.05;
/// Compliance of a contact as a part of the response of its bodies without joints: shares the load between points where it is not determined,
/// and bounds it where joints do not let bodies escape that overlap.
const COMPLIANCE: f64 = 5e-6;
/// The compliance of friction beside that: Newton's method needs fewer iterations where rolling and sliding bodies hang together. What rests does not creep by it,
/// since friction begins with the impulse of the step before.
const FRICTION_SOFTNESS: f64 = 5.0;
/// A contact of a mechanism gives way to larger forces, N, as even hard bodies do: else what turns a motor of any strength would be wedged in for ever.
const MAX_RIGID_FORCE: f64 = 2000.0;
/// Stiffness beyond it, N/m.
const YIELD_STIFFNESS: f64 = 1e6;
/// The compliance beyond it is at most this part of the response of the bodies without joints, so that heavy ones do not sink in.
const MAX_YIELD_PART: f64 = 0.02;
/// A contact holds while its friction is below this fraction of what it transmits.
pub(super) const HOLDING: f64 = 1.0 - 1e-9;

/// A contact as three rows: along the normal and two tangents.
pub(crate) struct Row {
    pub sides: [Option<Side>; 2],
    pub axes: Matrix3<f64>,
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
    pub yield_compliance: f64,
    pub rigid_impulse: f64,
    /// The same for what rebounds too, as far as a direct solution needs it.
    pub least_compliance: f64,
    /// The impulse of the step before, and what the contact does near the last velocity.
    pub warm: Vector3<f64>,
    /// What is added to the least normal velocity so that restitution does not lose what the compliance takes.
    pub lead: f64,
    /// The largest impulse of friction, for the normal impulse that was found last.
    pub friction_limit: f64,
    pub linear: Linearization,
}

/// A body at a contact.
pub(crate) struct Side {
    pub body: usize,
    /// Place of the body among the touching ones.
    pub place: usize,
    /// 1 for the first body, -1 for the second.
    pub sign: f64,
    /// From the centre of mass of the body to the point.
    pub lever: Vector3<f64>,
    /// From impulses along the axes to that on the body; its transpose is from the velocity of the body to its part of the relative velocity.
    pub jacobian: Matrix6x3<f64>,
}

impl Row {
    pub(super) fn new(
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
                sign,
                lever,
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
            warm: impulse,
            lead: 0.0,
            friction_limit: contact.friction * impulse[0].max(0.0),
            linear: Linearization::open(),
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
        row.linear = row.expected(row.velocity(|body| bodies[body].present_velocity())[0]);
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
    pub(super) fn velocity(&self, of_body: impl Fn(usize) -> Vector6<f64>) -> Vector3<f64> {
        self.sides
            .iter()
            .flatten()
            .map(|side| side.jacobian.tr_mul(&of_body(side.body)))
            .sum()
    }

    /// The normal impulse that leads to no velocity beyond what the contact gives way by. `rigid`: the impulse if it did not, `response`: the velocity by an impulse.
    pub(super) fn yielded(&self, rigid: f64, response: f64) -> f64 {
        let beyond = (rigid - self.rigid_impulse).max(0.0);
        rigid
            - beyond * self.yield_compliance / (response + self.compliance + self.yield_compliance)
    }

    /// Tangential velocity per impulse of friction that holds.
    pub(super) fn friction_compliance(&self) -> f64 {
        self.least_compliance * FRICTION_SOFTNESS
    }

    /// Whether the bodies leave each other by restitution.
    pub(super) fn has_restitution(&self) -> bool {
        self.restitution_velocity != 0.0
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
