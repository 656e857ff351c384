//! The action along the free axis of a joint: a motor, a limit, or none.

use crate::joint::{JointKind, JointState};

/// Velocities that differ by less count as equal, rad/s and m/s.
const VELOCITY_TOLERANCE: f64 = 1e-9;
/// Fraction of the violation of a limit that is corrected in one step.
const LIMIT_CORRECTION: f64 = 0.2;

/// The action along the free axis of a joint.
#[derive(Clone, Copy)]
pub(crate) struct FreeAxis {
    pub row: usize,
    pub motor: MotorState,
    /// Velocity the motor is to reach.
    target: f64,
    max_impulse: f64,
    pub limit: Option<ActiveLimit>,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum MotorState {
    Off,
    /// Holds its target velocity: a row of the system.
    Tracking,
    /// Exerts this impulse, its largest: a known force.
    Saturated(f64),
}

/// A limit the joint has reached: the velocity that leads there, and the sign of the impulses it may exert.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ActiveLimit {
    pub velocity: f64,
    pub sign: f64,
}

impl FreeAxis {
    /// The axis of a joint with one degree of freedom.
    pub(crate) fn of(kind: JointKind) -> Option<Self> {
        let row = match kind {
            JointKind::Revolute => 5,
            JointKind::Prismatic => 2,
            JointKind::Spherical | JointKind::Fixed => return None,
        };
        Some(Self {
            row,
            motor: MotorState::Off,
            target: 0.0,
            max_impulse: 0.0,
            limit: None,
        })
    }

    /// Whether the axis is constrained.
    pub(crate) fn is_active(&self) -> bool {
        self.limit.is_some() || self.motor == MotorState::Tracking
    }

    /// Whether the active set can change: there is a motor or a limit.
    pub(crate) fn can_change(&self, joint: &JointState) -> bool {
        self.limit.is_some() || self.motor != MotorState::Off || joint.limits.is_some()
    }

    pub(crate) fn target_velocity(&self) -> f64 {
        self.limit.map_or(self.target, |limit| limit.velocity)
    }

    /// Begins with the active set of the step before.
    pub(crate) fn warm_start(&mut self, joint: &JointState, step: f64) {
        self.limit = self
            .limit
            .and_then(|limit| limit_at(joint, limit.sign, step));
        let Some(motor) = joint.motor else {
            self.motor = MotorState::Off;
            return;
        };
        (self.target, self.max_impulse) = (motor.velocity, motor.max_force * step);
        self.motor = match self.motor {
            MotorState::Saturated(_) => self.saturated(self.target - joint.velocity),
            _ if self.limit.is_some() => self.saturated(self.target),
            _ => MotorState::Tracking,
        };
    }

    /// Changes the active set where `velocity` and `impulse` violate it; true when they do.
    pub(crate) fn update_active_set(
        &mut self,
        joint: &JointState,
        velocity: f64,
        impulse: f64,
        step: f64,
        is_cautious: bool,
    ) -> bool {
        if let Some(limit) = self.limit {
            let pulls = impulse * limit.sign < 0.0;
            let leaves = (pulls || self.overdrives(limit.velocity)) && !is_cautious;
            if leaves {
                self.limit = None;
            }
            return leaves;
        }
        // Before limits: one far away would stop what the motor drives too fast.
        if self.overdrives(velocity) && !is_cautious {
            self.motor = MotorState::Tracking;
            return true;
        }
        if let Some(limit) = reached_limit(joint, velocity, step) {
            self.limit = Some(limit);
            if self.motor == MotorState::Tracking {
                self.motor = self.saturated(self.target - limit.velocity);
            }
            return true;
        }
        let motor = match self.motor {
            MotorState::Tracking if impulse.abs() > self.max_impulse => self.saturated(impulse),
            same => same,
        };
        let changed = motor != self.motor;
        self.motor = motor;
        changed
    }

    /// Whether a saturated motor drives the joint beyond its velocity.
    fn overdrives(&self, velocity: f64) -> bool {
        match self.motor {
            MotorState::Saturated(all) => {
                (velocity - self.target) * all.signum() > VELOCITY_TOLERANCE
            }
            _ => false,
        }
    }

    /// The motor at its largest impulse, in the direction of `sign`.
    fn saturated(&self, sign: f64) -> MotorState {
        MotorState::Saturated(self.max_impulse.copysign(sign))
    }
}

/// The limit a joint runs into at that velocity.
fn reached_limit(joint: &JointState, velocity: f64, step: f64) -> Option<ActiveLimit> {
    let sign = match joint.limits? {
        // One at rest has no direction: it may be beyond the lower limit.
        [low, _] if velocity == 0.0 => (low - joint.position).signum(),
        _ => -velocity.signum(),
    };
    let limit = limit_at(joint, sign, step)?;
    ((velocity - limit.velocity) * sign < -VELOCITY_TOLERANCE).then_some(limit)
}

/// The upper limit, which pushes with a negative sign, or the lower one.
fn limit_at(joint: &JointState, sign: f64, step: f64) -> Option<ActiveLimit> {
    let [low, high] = joint.limits?;
    let distance = if sign < 0.0 {
        high - joint.position
    } else {
        low - joint.position
    };
    let is_beyond = distance * sign > 0.0;
    let share = if is_beyond { LIMIT_CORRECTION } else { 1.0 };
    Some(ActiveLimit {
        velocity: distance * share / step,
        sign,
    })
}
