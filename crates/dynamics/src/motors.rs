//! Motor control law of joints, per sub-step (spec: joints 7).
//!
//! Pure functions; values in rad or m, N m or N, seconds.

use motion::{ruckig, ruckig_plan};

use scene::joint::{Control, Joint};
use scene::parameters::engine::Engine;

/// The time in which position control closes the fraction P of its error, whatever the sub-step.
const CONTROL_PERIOD: f64 = 0.005;
/// Target velocity of a motor in force control, which it never reaches, rad/s or m/s.
const FORCE_CONTROL_VELOCITY: f64 = 10_000.0;
/// Largest force where a joint callback gives a velocity only, N or N m.
const MAX_FREE_FORCE: f64 = 10_000.0;
/// Largest force of a locked motor and of a joint that follows another, N or N m.
const RIGID_FORCE: f64 = 1e9;

/// A motor's order for one sub-step: reach `velocity` with at most `force`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drive {
    pub velocity: f64,
    pub force: f64,
}

/// Where a joint is, as the engine sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub position: f64,
    pub velocity: f64,
}

/// State of a motor between sub-steps.
#[derive(Debug, Clone, Default)]
pub(super) struct Motor {
    /// Sum of error times sub-step.
    integral: f64,
    /// Velocity and acceleration of the profile being followed.
    profile: (f64, f64),
    /// Where the motor was locked.
    lock: Option<f64>,
}

impl Motor {
    /// The order for the next `step` seconds with the gains of that engine; None when the motor is off. Callback control is not decided
    /// here.
    pub(super) fn drive(
        &mut self,
        joint: &Joint,
        engine: Engine,
        now: Motion,
        step: f64,
    ) -> Option<Drive> {
        let limit = joint.target_force.abs();
        if joint.control != Control::Velocity || !joint.motor_lock || joint.target_velocity != 0.0 {
            self.lock = None;
        }
        match joint.control {
            Control::Free | Control::Callback => None,
            Control::Force => Some(push(joint.target_force)),
            Control::Velocity if joint.motor_lock && joint.target_velocity == 0.0 => {
                Some(self.hold(now, step))
            }
            Control::Velocity => Some(Drive {
                velocity: self.velocity(joint, now, step),
                force: limit,
            }),
            Control::Position | Control::PositionOrCallback => Some(Drive {
                velocity: self.approach(joint, joint.gains_with(engine), now, step),
                force: limit,
            }),
            Control::Spring | Control::SpringOrCallback => {
                let effort = joint.spring[0] * joint.position_error(now.position)
                    - joint.spring[1] * now.velocity;
                Some(Drive {
                    velocity: joint.target_velocity.abs().copysign(effort),
                    force: effort.abs(),
                })
            }
        }
    }

    fn hold(&mut self, now: Motion, step: f64) -> Drive {
        let place = *self.lock.get_or_insert(now.position);
        Drive {
            velocity: (place - now.position) / step,
            force: RIGID_FORCE,
        }
    }

    fn velocity(&mut self, joint: &Joint, now: Motion, step: f64) -> f64 {
        if !joint.velocity_profile {
            return joint.target_velocity;
        }
        let (velocity, acceleration) = self.profile;
        let (target, max_accel, max_jerk) =
            (joint.target_velocity, joint.max_accel, joint.max_jerk);
        self.advance_profile(ruckig_plan::velocity_step(
            now.position,
            velocity,
            acceleration,
            target,
            max_accel,
            max_jerk,
            step,
        ))
    }

    fn approach(&mut self, joint: &Joint, [p, i, d]: [f64; 3], now: Motion, step: f64) -> f64 {
        let error = joint.position_error(now.position);
        if joint.position_profile {
            let (velocity, acceleration) = self.profile;
            let limits = (joint.max_vel, joint.max_accel, joint.max_jerk);
            let target = now.position + error;
            let next = ruckig_plan::position_step(
                now.position,
                velocity,
                acceleration,
                target,
                limits.0,
                limits.1,
                limits.2,
                step,
            );
            return self.advance_profile(next);
        }
        self.integral = if i == 0.0 {
            0.0
        } else {
            self.integral + error * step
        };
        let velocity = (p * error + i * self.integral - d * now.velocity) / CONTROL_PERIOD;
        velocity.clamp(-joint.max_vel.abs(), joint.max_vel.abs())
    }

    /// Takes over a step of a profile; limits that allow none leave the joint where it is.
    fn advance_profile(&mut self, next: Result<(f64, f64, f64), ruckig::RuckigError>) -> f64 {
        let (_, velocity, acceleration) = next.unwrap_or_default();
        self.profile = (velocity, acceleration);
        velocity
    }
}

/// The order that a joint callback's answer means.
pub(super) fn answered(velocity: Option<f64>, force: Option<f64>) -> Option<Drive> {
    match (velocity, force) {
        (None, None) => Some(Drive {
            velocity: 0.0,
            force: 0.0,
        }),
        (None, Some(force)) => Some(push(force)),
        (Some(velocity), None) => Some(Drive {
            velocity,
            force: MAX_FREE_FORCE,
        }),
        (Some(velocity), Some(force)) => Some(Drive {
            velocity,
            force: force.abs(),
        }),
    }
}

/// A joint that depends on another one of the dynamics follows it rigidly. `master`: the other joint.
pub(super) fn coupled_drive(
    joint: &Joint,
    now: Motion,
    master: Motion,
    step: f64,
) -> Option<Drive> {
    let law = joint.dependency?;
    let error = law.offset + law.coefficient * master.position - now.position;
    Some(Drive {
        velocity: error / step + law.coefficient * master.velocity,
        force: RIGID_FORCE,
    })
}

fn push(force: f64) -> Drive {
    Drive {
        velocity: FORCE_CONTROL_VELOCITY.copysign(force),
        force: force.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::joint::{JointMode, JointType};

    fn joint(control: Control) -> Joint {
        Joint {
            control,
            ..Joint::new(JointType::Revolute, JointMode::Dynamic)
        }
    }

    const AT_ZERO: Motion = Motion {
        position: 0.0,
        velocity: 0.0,
    };

    #[test]
    fn position_control_closes_a_tenth_of_the_error_in_five_milliseconds() {
        let joint = Joint {
            target_position: 0.1,
            ..joint(Control::Position)
        };
        let drive = Motor::default()
            .drive(&joint, Engine::Bullet, AT_ZERO, 0.005)
            .expect("on");
        assert!((drive.velocity * 0.005 - 0.01).abs() < 1e-15);
    }

    #[test]
    fn a_spring_pushes_with_its_effort() {
        let joint = Joint {
            spring: [2.0, 0.1],
            target_velocity: 1000.0,
            target_position: 0.5,
            ..joint(Control::Spring)
        };
        let drive = Motor::default()
            .drive(
                &joint,
                Engine::Bullet,
                Motion {
                    position: 0.0,
                    velocity: 3.0,
                },
                0.005,
            )
            .expect("on");
        // 2 times 0.5 less 0.1 times 3.
        assert!((drive.force - 0.7).abs() < 1e-12);
        assert_eq!(drive.velocity, 1000.0);
    }

    const STEP: f64 = 0.005;

    /// What a motor is to do in the next sub-step.
    fn drive(motor: &mut Motor, joint: &Joint, now: Motion) -> Drive {
        let drive = motor.drive(joint, Engine::Bullet, now, STEP);
        drive.expect("the motor is on")
    }

    fn near(value: f64, expected: f64, tolerance: f64) {
        let is_near = (value - expected).abs() <= tolerance;
        assert!(is_near, "{value} is not {expected}");
    }

    #[test]
    fn the_errors_of_the_past_count_while_there_is_an_integral_gain() {
        let mut joint = joint(Control::Position);
        joint.target_position = 0.1;
        joint.gains[Engine::Bullet as usize] = [0.0, 0.2, 0.0];
        let mut motor = Motor::default();
        // Of a sub-step: 0.2 0.1 5 ms / 5 ms.
        near(drive(&mut motor, &joint, AT_ZERO).velocity, 0.02, 1e-12);
        near(drive(&mut motor, &joint, AT_ZERO).velocity, 0.04, 1e-12);
        joint.gains[Engine::Bullet as usize] = [0.1, 0.0, 0.0];
        near(drive(&mut motor, &joint, AT_ZERO).velocity, 2.0, 1e-12);
        joint.gains[Engine::Bullet as usize] = [0.1, 0.2, 0.0];
        near(drive(&mut motor, &joint, AT_ZERO).velocity, 2.02, 1e-12);
    }

    #[test]
    fn position_control_brakes_and_keeps_to_the_largest_velocity() {
        let mut joint = joint(Control::Position);
        (joint.max_vel, joint.target_force) = (3.0, -7.0);
        joint.gains[Engine::Bullet as usize] = [0.1, 0.0, 0.005];
        let moving = |position, velocity| Motion { position, velocity };
        let velocity = |now| -> f64 { drive(&mut Motor::default(), &joint, now).velocity };
        near(velocity(moving(0.0, 2.0)), -2.0, 1e-12);
        near(velocity(moving(0.1, -1.0)), -1.0, 1e-12);
        near(velocity(moving(1.0, 0.0)), -3.0, 1e-12);
        near(velocity(moving(-1.0, 0.0)), 3.0, 1e-12);
        assert_eq!(drive(&mut Motor::default(), &joint, AT_ZERO).force, 7.0);
    }

    #[test]
    fn a_locked_motor_returns_to_where_it_was_locked() {
        let mut joint = joint(Control::Velocity);
        (joint.motor_lock, joint.target_velocity) = (true, 0.0);
        let at = |position| Motion {
            position,
            velocity: 0.0,
        };
        let mut motor = Motor::default();
        assert_eq!(drive(&mut motor, &joint, at(0.3)).velocity, 0.0);
        let back = drive(&mut motor, &joint, at(0.31));
        near(back.velocity, -0.01 / STEP, 1e-9);
        assert!(back.force >= 1e6);
        joint.target_velocity = 1.0;
        let on = drive(&mut motor, &joint, at(0.5));
        assert_eq!((on.velocity, on.force), (1.0, joint.target_force));
        joint.target_velocity = 0.0;
        assert_eq!(drive(&mut motor, &joint, at(0.6)).velocity, 0.0);
        joint.motor_lock = false;
        let loose = drive(&mut motor, &joint, at(0.7));
        assert_eq!((loose.velocity, loose.force), (0.0, joint.target_force));
    }

    /// Where a motor that keeps to its profile is in each sub-step of so many seconds.
    fn followed(joint: &Joint, seconds: f64) -> Motion {
        let (mut motor, mut now) = (Motor::default(), AT_ZERO);
        for _ in 0..(seconds / STEP).round() as usize {
            now.velocity = drive(&mut motor, joint, now).velocity;
            now.position += now.velocity * STEP;
        }
        now
    }

    #[test]
    fn profiles_keep_to_the_largest_acceleration_and_velocity() {
        let mut joint = joint(Control::Velocity);
        (joint.max_vel, joint.max_accel, joint.max_jerk) = (1.0, 10.0, 1e7);
        (joint.velocity_profile, joint.target_velocity) = (true, 5.0);
        near(followed(&joint, 0.2).velocity, 2.0, 1e-3);
        near(followed(&joint, 1.0).velocity, 5.0, 1e-9);
        (joint.control, joint.position_profile, joint.target_position) =
            (Control::Position, true, 1.0);
        // A tenth of a second to speed up, 5 cm behind from then on, and as long to brake.
        near(followed(&joint, 0.05).velocity, 0.5, 1e-3);
        near(followed(&joint, 0.5).position, 0.45, 1e-2);
        near(followed(&joint, 0.5).velocity, 1.0, 1e-3);
        let end = followed(&joint, 1.5);
        near(end.position, 1.0, 1e-3);
        near(end.velocity, 0.0, 1e-3);
    }

    #[test]
    fn forces_and_answers_of_scripts_push_or_turn() {
        let mut joint = joint(Control::Force);
        for (force, velocity) in [(3.0, 10_000.0), (-3.0, -10_000.0)] {
            joint.target_force = force;
            let expected = Drive {
                velocity,
                force: 3.0,
            };
            assert_eq!(drive(&mut Motor::default(), &joint, AT_ZERO), expected);
            assert_eq!(answered(None, Some(force)), Some(expected));
        }
        let order = |velocity, force| Some(Drive { velocity, force });
        assert_eq!(answered(None, None), order(0.0, 0.0));
        assert_eq!(answered(Some(2.0), None), order(2.0, 10_000.0));
        assert_eq!(answered(Some(-2.0), Some(-5.0)), order(-2.0, 5.0));
    }

    #[test]
    fn a_follower_reaches_its_place_and_goes_on_with_its_master() {
        let joint = Joint {
            dependency: Some(scene::joint::JointDependency {
                master: scene::Handle(1),
                offset: 0.1,
                coefficient: 2.0,
            }),
            ..joint(Control::Free)
        };
        let [now, master] =
            [(0.65, 7.0), (0.3, 1.5)].map(|(position, velocity)| Motion { position, velocity });
        let drive = coupled_drive(&joint, now, master, STEP).expect("it follows");
        near(drive.velocity, 0.05 / STEP + 3.0, 1e-9);
        assert!(drive.force >= 1e6);
        let free = Joint {
            dependency: None,
            ..joint
        };
        assert_eq!(coupled_drive(&free, now, master, STEP), None);
    }
}
