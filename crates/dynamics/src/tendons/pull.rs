//! What acts along a tendon in a sub-step, as a function of the rate at its end.

use articulation::Passive;

use crate::motors::Motion;

/// The force that lengthens a tendon at the rate `u` at the end of the sub-step: `push - resistance u`, with dry friction, and with what keeps the rate in bounds. The damper is implicit, the
/// spring is that of Newmark's average acceleration, as those of joints (`articulation::Passive`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pull {
    push: f64,
    resistance: f64,
    friction: f64,
    /// The rates that lead to the smallest and the largest length.
    bounds: [f64; 2],
}

impl Pull {
    /// `now`: length and rate at the begin of the sub-step; `range`: the smallest and the largest length.
    pub(super) fn new(passive: &Passive, range: Option<[f64; 2]>, now: Motion, step: f64) -> Self {
        let inertia = passive.armature / step + passive.stiffness * step / 4.0;
        let stretched = if passive.stiffness > 0.0 {
            passive.rest - now.position
        } else {
            0.0
        };
        let push = passive.stiffness * stretched + passive.effort + inertia * now.velocity;
        let bounds = range.map(|range| range.map(|end| (end - now.position) / step));
        Self {
            push: if push.is_finite() { push } else { 0.0 },
            resistance: inertia + passive.damping,
            friction: passive.friction,
            bounds: bounds.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
        }
    }

    /// The force, where the rate would be `free` without it, and is more by `mobility` for each newton.
    pub(crate) fn force(&self, free: f64, mobility: f64) -> f64 {
        let implicit = 1.0 + self.resistance * mobility;
        if mobility <= 0.0 {
            return (self.push - self.resistance * free).clamp(-f64::MAX, f64::MAX);
        }
        // Friction holds where it can.
        let sticking = -free / mobility - self.push;
        let friction = sticking.max(-self.friction).min(self.friction);
        let force = (self.push + friction - self.resistance * free) / implicit;
        let rate = free + mobility * force;
        let [low, high] = self.bounds;
        let beyond = rate - rate.min(high).max(low);
        force - beyond / mobility
    }

    /// The force that does not depend on the rate, if no other acts with that one.
    pub(crate) fn constant_force(&self, rate: f64) -> Option<f64> {
        let [low, high] = self.bounds;
        let is_free = self.resistance == 0.0 && self.friction == 0.0;
        (is_free && (low..=high).contains(&rate)).then_some(self.push)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 0.01;
    const NOW: Motion = Motion {
        position: 2.0,
        velocity: 0.0,
    };

    /// A mass of 1 kg that pulls at a tendon with 10 N for a step.
    fn rate(passive: &Passive, range: Option<[f64; 2]>) -> f64 {
        let pull = Pull::new(passive, range, NOW, STEP);
        0.1 + STEP * pull.force(0.1, STEP)
    }

    #[test]
    fn dry_friction_holds_up_to_its_force() {
        let friction = |friction: f64| {
            let passive = Passive {
                friction,
                ..Passive::default()
            };
            rate(&passive, None)
        };
        assert_eq!(friction(10.5), 0.0);
        assert!((friction(4.0) - 0.06).abs() < 1e-15);
    }

    #[test]
    fn dampers_and_springs_hold_back_however_strong_they_are() {
        let damper = Passive {
            damping: 1e9,
            ..Passive::default()
        };
        assert!(rate(&damper, None).abs() < 1e-6);
        let spring = Passive {
            stiffness: 1e12,
            rest: 2.0,
            ..Passive::default()
        };
        assert!(rate(&spring, None).abs() < 1e-6);
        let rotor = Passive {
            armature: 1.0,
            ..Passive::default()
        };
        assert!((rate(&rotor, None) - 0.05).abs() < 1e-15);
    }

    #[test]
    fn a_range_is_not_left() {
        let free = Passive::default();
        assert_eq!(rate(&free, Some([0.0, 2.0])), 0.0);
        assert!((rate(&free, Some([0.0, 3.0])) - 0.1).abs() < 1e-15);
        // What is too short is made longer.
        assert!((rate(&free, Some([2.5, 3.0])) - 50.0).abs() < 1e-9);
        let pull = Pull::new(&free, Some([0.0, 3.0]), NOW, STEP);
        assert_eq!(pull.constant_force(0.1), Some(0.0));
        assert_eq!(pull.constant_force(101.0), None);
    }

    #[test]
    fn an_end_that_nothing_moves_is_pulled_at_by_the_spring_alone() {
        let spring = Passive {
            stiffness: 100.0,
            rest: 1.0,
            ..Passive::default()
        };
        let pull = Pull::new(&spring, None, NOW, STEP);
        assert_eq!(pull.force(0.0, 0.0), -100.0);
    }
}
