//! What acts along the free axis of a joint: a motor, a stop, or nothing.

use crate::dynamics::links::Link;
use crate::dynamics::plan::LinkKind;

/// Velocities that differ by less are equal, rad/s and m/s.
const SAME_VELOCITY: f64 = 1e-9;
/// How much of the way back behind its stop a joint is led in a sub-step.
const RETURN: f64 = 0.2;

/// What acts along the free axis of a joint.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    pub row: usize,
    pub motor: Motor,
    /// Velocity the motor wants.
    pub target: f64,
    /// Its largest impulse.
    pub most: f64,
    pub stop: Option<Stop>,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Motor {
    Off,
    /// Reaches its velocity.
    Holds,
    /// Gives all it has: this impulse.
    Spent(f64),
}

/// A stop the joint has reached: the velocity that leads there, the sign of what it may push with.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Stop {
    pub velocity: f64,
    pub sign: f64,
}

impl Axis {
    /// The axis of a joint that turns or slides.
    pub(super) fn of(kind: LinkKind) -> Option<Self> {
        let row = match kind {
            LinkKind::Revolute => 5,
            LinkKind::Prismatic => 2,
            _ => return None,
        };
        Some(Self { row, motor: Motor::Off, target: 0.0, most: 0.0, stop: None })
    }

    pub(super) fn acts(&self) -> bool {
        self.stop.is_some() || self.motor == Motor::Holds
    }

    pub(super) fn wanted(&self) -> f64 {
        self.stop.map_or(self.target, |stop| stop.velocity)
    }

    /// A guess at what will act: what acted before.
    pub(super) fn expect(&mut self, link: &Link, step: f64) {
        self.stop = self.stop.and_then(|stop| stop_at(link, stop.sign, step));
        let Some(drive) = link.drive else {
            self.motor = Motor::Off;
            return;
        };
        (self.target, self.most) = (drive.velocity, drive.force * step);
        self.motor = match self.motor {
            Motor::Spent(_) => Motor::Spent(self.most.copysign(self.target - link.motion.velocity)),
            _ if self.stop.is_some() => Motor::Spent(self.most.copysign(self.target)),
            _ => Motor::Holds,
        };
    }

    pub(super) fn correct(&mut self, link: &Link, velocity: f64, impulse: f64, step: f64) -> bool {
        if let Some(stop) = self.stop {
            let pulls = impulse * stop.sign < 0.0;
            if pulls {
                self.stop = None;
            }
            return pulls;
        }
        if let Some(stop) = reached(link, velocity, step) {
            self.stop = Some(stop);
            if self.motor == Motor::Holds {
                self.motor = Motor::Spent(self.most.copysign(self.target - stop.velocity));
            }
            return true;
        }
        let motor = match self.motor {
            Motor::Holds if impulse.abs() > self.most => Motor::Spent(self.most.copysign(impulse)),
            Motor::Spent(all) if (velocity - self.target) * all.signum() > SAME_VELOCITY => Motor::Holds,
            same => same,
        };
        let changed = motor != self.motor;
        self.motor = motor;
        changed
    }
}

/// The stop a joint runs into at that velocity.
fn reached(link: &Link, velocity: f64, step: f64) -> Option<Stop> {
    let sign = -velocity.signum();
    let stop = stop_at(link, sign, step)?;
    ((velocity - stop.velocity) * sign < -SAME_VELOCITY).then_some(stop)
}

/// The upper stop, which pushes with a negative sign, or the lower one.
fn stop_at(link: &Link, sign: f64, step: f64) -> Option<Stop> {
    let [low, high] = link.stops?;
    let way = if sign < 0.0 { high - link.motion.position } else { low - link.motion.position };
    let is_beyond = way * sign > 0.0;
    let share = if is_beyond { RETURN } else { 1.0 };
    Some(Stop { velocity: way * share / step, sign })
}
