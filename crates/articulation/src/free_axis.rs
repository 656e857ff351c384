//! The action along the free axis of a joint: a motor, a limit, or none.

use crate::joint::{JointKind, JointState};
use crate::passive::PassiveStep;

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
    /// Spring, damper and rotor over this step, if there are any.
    passive: Option<PassiveStep>,
    friction: FrictionState,
}

/// Dry friction, which opposes motion with at most its largest impulse.
#[derive(Clone, Copy, PartialEq)]
enum FrictionState {
    Off,
    /// Holds the axis: a row of the system.
    Sticking,
    /// Exerts this impulse, its largest: a known force.
    Sliding(f64),
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
            passive: None,
            friction: FrictionState::Off,
        })
    }

    /// Whether the axis is constrained.
    pub(crate) fn is_active(&self) -> bool {
        self.limit.is_some()
            || self.motor == MotorState::Tracking
            || self.friction == FrictionState::Sticking
    }

    /// The inertia that spring, damper and rotor add to an axis that nothing constrains; 0 for others.
    pub(crate) fn soft_inertia(&self) -> f64 {
        match self.passive {
            Some(passive) if !self.is_active() => passive.inertia,
            _ => 0.0,
        }
    }

    /// The impulses along the axis that do not depend on its velocity: of a saturated motor, of what is passive, of friction that slides. Where the velocity is
    /// imposed, all that is passive is known.
    pub(crate) fn known_impulse(&self) -> f64 {
        let motor = match self.motor {
            MotorState::Saturated(all) => all,
            MotorState::Tracking | MotorState::Off => 0.0,
        };
        let Some(passive) = self.passive else {
            return motor;
        };
        let imposed = if self.is_active() {
            self.target_velocity()
        } else {
            0.0
        };
        let friction = match self.friction {
            FrictionState::Sliding(all) => all,
            FrictionState::Sticking | FrictionState::Off => 0.0,
        };
        motor + friction + passive.push - passive.inertia * imposed
    }

    /// Whether the active set can change: there is a motor or a limit.
    pub(crate) fn can_change(&self, joint: &JointState) -> bool {
        self.limit.is_some()
            || self.motor != MotorState::Off
            || joint.limits.is_some()
            || self.friction != FrictionState::Off
    }

    pub(crate) fn target_velocity(&self) -> f64 {
        match self.limit {
            Some(limit) => limit.velocity,
            None if self.friction == FrictionState::Sticking => 0.0,
            None => self.target,
        }
    }

    /// Begins with the active set of the step before. `velocity`: along the axis, as the bodies have it.
    pub(crate) fn warm_start(&mut self, joint: &JointState, velocity: f64, step: f64) {
        self.passive = joint.passive.over(step, joint.position, velocity);
        self.warm_start_motor(joint, step);
        let friction = self.passive.map_or(0.0, |passive| passive.friction);
        self.warm_start_friction(friction, velocity);
    }

    fn warm_start_motor(&mut self, joint: &JointState, step: f64) {
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

    /// Friction begins as it was: that of an axis at rest holds it, unless a motor does.
    fn warm_start_friction(&mut self, largest: f64, velocity: f64) {
        let is_held = self.limit.is_some() || self.motor == MotorState::Tracking;
        self.friction = match self.friction {
            _ if largest == 0.0 => FrictionState::Off,
            _ if is_held => sliding(largest, self.target_velocity()),
            FrictionState::Sliding(before) if before != 0.0 => {
                FrictionState::Sliding(largest.copysign(before))
            }
            FrictionState::Off if velocity != 0.0 => sliding(largest, velocity),
            _ => FrictionState::Sticking,
        };
    }

    /// Lets friction hold an axis that it would turn back, and slip where it cannot hold it; whether that changes anything.
    fn update_friction(&mut self, velocity: f64, impulse: f64, is_cautious: bool) -> bool {
        let largest = self.largest_friction();
        let friction = match self.friction {
            FrictionState::Sticking if impulse.abs() > largest => {
                FrictionState::Sliding(largest.copysign(impulse))
            }
            FrictionState::Sliding(_) if self.motor == MotorState::Tracking => {
                sliding(largest, self.target)
            }
            FrictionState::Sliding(0.0) => FrictionState::Sticking,
            FrictionState::Sliding(all)
                if !is_cautious && velocity * all.signum() > VELOCITY_TOLERANCE =>
            {
                FrictionState::Sticking
            }
            same => same,
        };
        let changed = friction != self.friction;
        self.friction = friction;
        changed
    }

    /// Friction against a velocity that a motor or a limit imposes.
    fn release_friction(&mut self, velocity: f64) {
        if self.friction == FrictionState::Sticking {
            self.friction = sliding(self.largest_friction(), velocity);
        }
    }

    fn largest_friction(&self) -> f64 {
        self.passive.map_or(0.0, |passive| passive.friction)
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
            self.release_friction(limit.velocity);
            return true;
        }
        let motor = match self.motor {
            MotorState::Tracking if impulse.abs() > self.max_impulse => self.saturated(impulse),
            same => same,
        };
        let changed = motor != self.motor;
        self.motor = motor;
        if motor == MotorState::Tracking {
            self.release_friction(self.target);
        }
        if self.friction == FrictionState::Off {
            return changed;
        }
        changed || self.update_friction(velocity, impulse, is_cautious)
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

/// Friction at its largest impulse against a velocity; of none, what imposes the velocity needs no help.
fn sliding(largest: f64, velocity: f64) -> FrictionState {
    let is_moving = velocity != 0.0;
    FrictionState::Sliding(if is_moving {
        largest.copysign(-velocity)
    } else {
        0.0
    })
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
