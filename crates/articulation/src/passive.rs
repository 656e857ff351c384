//! What acts along the free axis of a joint beside its motor: a spring, a damper, the inertia of a rotor, dry friction.
//!
//! Forces along one axis that depend on its velocity `v` at the end of the step are `push - inertia * v`, as impulses. So a joint needs two
//! numbers, which the articulated-body algorithm adds to the force and to the inertia along the axis (R. Featherstone, *Rigid Body Dynamics
//! Algorithms*, 2008, section 9.6), and which are a compliant row in mechanisms with loops.
//!
//! The damper is implicit: no damping is too strong for the step. The spring is that of Newmark's average acceleration (beta 1/4), which adds a quarter
//! of `stiffness * step^2` to the inertia: it conserves energy, and a spring that is too stiff for the step swings more slowly, and never gains energy.

/// What acts along the free axis of a joint beside its motor and limits; nothing by default. Of a revolute joint: N m, rad; of a prismatic one: N, m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Passive {
    /// Inertia of a rotor that turns with the axis, reflected to it: kg m² or kg.
    pub armature: f64,
    /// Torque or force per distance from `rest`.
    pub stiffness: f64,
    /// Position where the spring exerts no force, rad or m.
    pub rest: f64,
    /// Torque or force against each rad/s or m/s.
    pub damping: f64,
    /// Largest torque or force of dry friction.
    pub friction: f64,
    /// A torque or force that is always there.
    pub effort: f64,
}

/// The same over a step, as impulses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PassiveStep {
    /// At velocity 0 at the end of the step.
    pub push: f64,
    /// What it decreases by with that velocity.
    pub inertia: f64,
    /// The largest impulse of dry friction.
    pub friction: f64,
}

impl Passive {
    /// Over a step that begins at that position and velocity along the axis. Numbers that are negative or not finite count as 0.
    pub(crate) fn over(&self, step: f64, position: f64, velocity: f64) -> Option<PassiveStep> {
        if *self == Self::default() {
            return None;
        }
        let [armature, stiffness, damping, friction] =
            [self.armature, self.stiffness, self.damping, self.friction].map(usable);
        let inertia = armature + stiffness * step * step / 4.0;
        let stretched = if stiffness > 0.0 {
            self.rest - position
        } else {
            0.0
        };
        let push = (stiffness * stretched + self.effort) * step + inertia * velocity;
        Some(PassiveStep {
            push: if push.is_finite() { push } else { 0.0 },
            inertia: inertia + damping * step,
            friction: friction * step,
        })
    }
}

fn usable(number: f64) -> f64 {
    if number.is_finite() && number > 0.0 {
        number
    } else {
        0.0
    }
}
