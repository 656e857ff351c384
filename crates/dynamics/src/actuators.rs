//! Joints as MuJoCo has them: springs, dampers, rotors and friction beside the motor, and motors that are springs themselves.
//!
//! The control law of CoppeliaSim's motors is in `motors`. Values in rad or m, N m or N, seconds.

use articulation::Passive;

use super::motors::Motion;
use scene::joint::{Actuation, Actuator, ActuatorKind, Actuators, Joint};

/// What acts along the axis of a joint in a sub-step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Orders {
    pub passive: Passive,
    /// The force of the actuator at the begin of the sub-step; None where the joint's motor is CoppeliaSim's.
    pub force: Option<f64>,
}

/// What is beside the motor of a joint.
pub(super) fn beside(actuation: Option<Actuation>) -> Passive {
    let Some(Actuation { passive, .. }) = actuation else {
        return Passive::default();
    };
    Passive {
        armature: passive.armature,
        stiffness: passive.stiffness,
        rest: passive.rest,
        damping: passive.damping,
        friction: passive.friction,
        effort: 0.0,
    }
}

/// What a joint is to do. Actuators act while the joint has the control of the first of them; a script that chooses another one has CoppeliaSim's motor.
pub(super) fn actuated(joint: &Joint, actuation: &Actuation, now: Motion) -> Orders {
    let passive = beside(Some(*actuation));
    let first = actuation.actuators.iter().next();
    if first.is_none_or(|first| first.kind.control() != joint.control) {
        return Orders {
            passive,
            force: None,
        };
    }
    let targets = [
        joint.target_force,
        joint.target_position,
        joint.target_velocity,
    ];
    let (passive, force) = acting(passive, &actuation.actuators, targets, now);
    Orders {
        passive,
        force: Some(force),
    }
}

/// What acts along an axis with its actuators, and their force at the begin of the sub-step. `targets`: what they are told, a force, a position and a velocity.
pub(super) fn acting(
    mut passive: Passive,
    actuators: &Actuators,
    targets: [f64; 3],
    now: Motion,
) -> (Passive, f64) {
    let mut sum = 0.0;
    for actuator in actuators.iter() {
        let spring = Spring::of(actuator, targets);
        let free = spring.force(now);
        let force = actuator.limited(free);
        sum += force;
        passive = if force == free {
            spring.beside(passive)
        } else {
            pushed(passive, force)
        };
    }
    (passive, sum)
}

/// The force of an actuator: `push + stiffness (rest - position) - damping velocity`.
struct Spring {
    push: f64,
    stiffness: f64,
    rest: f64,
    damping: f64,
}

impl Spring {
    fn of(actuator: &Actuator, [force, position, velocity]: [f64; 3]) -> Self {
        let Actuator {
            stiffness,
            damping,
            bias,
            ..
        } = *actuator;
        let (push, rest) = match actuator.kind {
            ActuatorKind::None => (0.0, 0.0),
            ActuatorKind::Force => (bias + force, 0.0),
            ActuatorKind::Position => (bias, position),
            ActuatorKind::Velocity => (bias + damping * velocity, 0.0),
        };
        Self {
            push,
            stiffness,
            rest,
            damping,
        }
    }

    fn force(&self, now: Motion) -> f64 {
        self.push + self.stiffness * (self.rest - now.position) - self.damping * now.velocity
    }

    /// The spring together with what else acts along the axis: two springs are one that rests between them.
    fn beside(&self, other: Passive) -> Passive {
        let stiffness = self.stiffness + other.stiffness;
        let moment = self.stiffness * self.rest + other.stiffness * other.rest;
        Passive {
            stiffness,
            rest: if stiffness == 0.0 {
                0.0
            } else {
                moment / stiffness
            },
            damping: self.damping + other.damping,
            effort: other.effort + self.push,
            ..other
        }
    }
}

/// With a force that is there whatever the joint does.
fn pushed(passive: Passive, force: f64) -> Passive {
    Passive {
        effort: passive.effort + force,
        ..passive
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::joint::{Control, JointMode, JointType};

    const NOW: Motion = Motion {
        position: 0.5,
        velocity: 2.0,
    };

    fn orders(control: Control, actuator: Actuator) -> Orders {
        orders_of(control, &[actuator])
    }

    fn orders_of(control: Control, several: &[Actuator]) -> Orders {
        let mut actuators = Actuators::default();
        several.iter().for_each(|actuator| actuators.add(*actuator));
        let joint = Joint {
            control,
            target_position: 1.0,
            target_velocity: 3.0,
            target_force: 4.0,
            ..Joint::new(JointType::Revolute, JointMode::Dynamic)
        };
        let passive = scene::joint::Passive {
            stiffness: 10.0,
            rest: -1.0,
            damping: 0.5,
            ..Default::default()
        };
        let actuation = Actuation { passive, actuators };
        actuated(&joint, &actuation, NOW)
    }

    fn actuator(kind: ActuatorKind) -> Actuator {
        Actuator {
            stiffness: 30.0,
            damping: 2.0,
            bias: 1.0,
            ..Actuator::new(kind)
        }
    }

    #[test]
    fn an_actuator_of_positions_is_a_spring_beside_that_of_the_joint() {
        let found = orders(Control::Position, actuator(ActuatorKind::Position));
        assert_eq!(found.force, Some(1.0 + 30.0 * 0.5 - 2.0 * 2.0));
        let Passive {
            stiffness,
            rest,
            damping,
            effort,
            ..
        } = found.passive;
        assert_eq!((stiffness, damping, effort), (40.0, 2.5, 1.0));
        assert_eq!(rest, (30.0 - 10.0) / 40.0);
    }

    #[test]
    fn beyond_its_range_an_actuator_pushes_with_its_end() {
        let weak = Actuator {
            range: [-5.0, 5.0],
            ..actuator(ActuatorKind::Position)
        };
        let found = orders(Control::Position, weak);
        assert_eq!((found.force, found.passive.effort), (Some(5.0), 5.0));
        assert_eq!(
            (found.passive.stiffness, found.passive.damping),
            (10.0, 0.5)
        );
    }

    #[test]
    fn forces_and_velocities_are_told_by_their_targets() {
        let force = Actuator::new(ActuatorKind::Force);
        assert_eq!(orders(Control::Force, force).force, Some(4.0));
        let velocity = Actuator {
            damping: 2.0,
            ..Actuator::new(ActuatorKind::Velocity)
        };
        assert_eq!(orders(Control::Velocity, velocity).force, Some(2.0));
    }

    #[test]
    fn several_actuators_act_together_each_within_its_range() {
        let weak = Actuator {
            range: [-1.5, 1.5],
            ..Actuator::new(ActuatorKind::Force)
        };
        let speed = Actuator {
            damping: 2.0,
            ..Actuator::new(ActuatorKind::Velocity)
        };
        let several = [actuator(ActuatorKind::Position), weak, speed];
        let found = orders_of(Control::Position, &several);
        // The spring, the end of the range, the damper.
        assert_eq!(found.force, Some(12.0 + 1.5 + 2.0));
        let Passive {
            stiffness,
            damping,
            effort,
            ..
        } = found.passive;
        assert_eq!((stiffness, damping, effort), (40.0, 4.5, 1.0 + 1.5 + 6.0));
        // In the control of another than the first there is CoppeliaSim's motor.
        assert_eq!(orders_of(Control::Velocity, &several).force, None);
    }

    #[test]
    fn another_control_has_the_usual_motor() {
        let found = orders(Control::Velocity, actuator(ActuatorKind::Position));
        assert_eq!((found.force, found.passive.stiffness), (None, 10.0));
    }
}
