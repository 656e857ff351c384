//! Kinematic motion of joints: scripts compute every step (`sysCall_joint`, spec: callbacks 5); joints that none of them moves follow a
//! profile.

use std::rc::Rc;

use motion::ruckig_plan::{position_step, velocity_step};

use crate::host::Sim;
use crate::sys_call::SysCall;
use scene::joint::motion::JointStep;
use scene::joint::{Joint, JointMotion};
use scene::{Data, Handle, Key, SceneResult};

impl Sim {
    /// One step of every joint that is on its way to a target.
    pub(crate) fn handle_joint_motion(self: &Rc<Self>) {
        let joints = self.scene.borrow_mut().joints_in_motion();
        for joint in joints {
            self.move_joint(joint);
        }
    }

    /// Calls the scripts above a joint, then those without an object, for its next step.
    fn move_joint(self: &Rc<Self>, handle: Handle) {
        let Some(data) = self.motion_data(handle) else {
            return;
        };
        let answer = self.first_answer(&self.joint_chain(handle), SysCall::Joint, &[data]);
        let time_step = self.scene.borrow().settings().time_step;
        // A script may have removed the joint: then there is nothing to move.
        let _ = match answer {
            Some(answer) => self
                .scene
                .borrow_mut()
                .step_joint(handle, read_step(&answer)),
            None => self.follow_profile(handle, time_step),
        };
    }

    /// Moves a joint on its way to a target by `dt` seconds, without asking scripts; others stay where they are.
    ///
    /// # Errors
    /// When there is no such joint.
    pub(crate) fn follow_profile(&self, handle: Handle, dt: f64) -> SceneResult<()> {
        let mut scene = self.scene.borrow_mut();
        let joint = scene.object(handle)?.joint()?;
        let Some(motion) = joint.motion else {
            return Ok(());
        };
        let step = profile_step(joint, motion, dt);
        scene.step_joint(handle, step)
    }

    /// The argument of `sysCall_joint` for a joint in motion; None when it does not move any more.
    fn motion_data(&self, handle: Handle) -> Option<Data> {
        let scene = self.scene.borrow();
        let joint = scene.object(handle).ok()?.joint().ok()?;
        let motion = joint.motion?;
        let Data::Map(mut entries) = describe(handle, joint) else {
            return None;
        };
        let mut add = |key: &str, value: f64| {
            entries.push((Key::Text(key.as_bytes().to_vec()), value.into()));
        };
        match motion {
            JointMotion::ToPosition => {
                let error = joint.position_error(joint.position);
                add("targetPos", joint.target_position);
                add("error", error);
                add("errorValue", error);
            }
            JointMotion::AtVelocity { initial } => {
                add("targetVel", joint.target_velocity);
                initial
                    .into_iter()
                    .for_each(|velocity| add("initVel", velocity));
            }
        }
        Some(Data::Map(entries))
    }
}

const AT_REST: JointStep = JointStep {
    position: None,
    velocity: 0.0,
    accel: 0.0,
    immobile: true,
};

/// The first step of a planned motion. Where the limits allow no plan, the joint comes to rest.
fn step_of(planned: Option<(f64, f64, f64)>) -> JointStep {
    let moved = |(position, velocity, accel)| JointStep {
        position: Some(position),
        velocity,
        accel,
        immobile: false,
    };
    planned.map_or(AT_REST, moved)
}

/// The step of a joint that no script moves.
fn profile_step(joint: &Joint, motion: JointMotion, dt: f64) -> JointStep {
    match motion {
        JointMotion::ToPosition => step_to_position(joint, dt),
        JointMotion::AtVelocity { initial } => {
            step_at_velocity(joint, initial.unwrap_or(joint.velocity), dt)
        }
    }
}

fn step_to_position(joint: &Joint, dt: f64) -> JointStep {
    let error = joint.position_error(joint.position);
    let tolerance = if joint.is_revolute() {
        0.01_f64.to_radians()
    } else {
        0.0001
    };
    if error.abs() <= tolerance && joint.velocity == 0.0 && joint.accel == 0.0 {
        return AT_REST;
    }
    let (position, velocity, accel) = (joint.position, joint.velocity, joint.accel);
    let limits = [joint.max_vel, joint.max_accel, joint.max_jerk];
    step_of(
        position_step(
            position,
            velocity,
            accel,
            position + error,
            limits[0],
            limits[1],
            limits[2],
            dt,
        )
        .ok(),
    )
}

fn step_at_velocity(joint: &Joint, velocity: f64, dt: f64) -> JointStep {
    let (position, target) = (joint.position, joint.target_velocity);
    if velocity == target && joint.accel == 0.0 {
        return if target == 0.0 {
            AT_REST
        } else {
            step_of(Some((position + target * dt, target, 0.0)))
        };
    }
    step_of(
        velocity_step(
            position,
            velocity,
            joint.accel,
            target,
            joint.max_accel,
            joint.max_jerk,
            dt,
        )
        .ok(),
    )
}

fn describe(handle: Handle, joint: &Joint) -> Data {
    Data::map([
        ("mode", (joint.mode as i64).into()),
        ("handle", handle.raw().into()),
        ("revolute", joint.is_revolute().into()),
        ("cyclic", joint.cyclic.into()),
        ("lowLimit", joint.min.into()),
        ("highLimit", joint.max().into()),
        ("pos", joint.position.into()),
        ("currentPos", joint.position.into()),
        ("vel", joint.velocity.into()),
        ("currentVel", joint.velocity.into()),
        ("maxVel", joint.max_vel.into()),
        ("maxAccel", joint.max_accel.into()),
        ("maxJerk", joint.max_jerk.into()),
    ])
}

fn read_step(answer: &Data) -> JointStep {
    let number = |names: [&str; 2]| {
        names
            .iter()
            .find_map(|name| answer.field(name))
            .and_then(Data::as_f64)
    };
    JointStep {
        position: number(["pos", "position"]),
        velocity: number(["vel", "velocity"]).unwrap_or(0.0),
        accel: number(["accel", "acceleration"]).unwrap_or(0.0),
        immobile: answer.field("immobile").is_some_and(Data::truthy),
    }
}

#[cfg(test)]
mod tests {
    use scene::joint::{JointMode, JointType};

    use super::*;

    const DT: f64 = 0.05;

    /// A joint at rest whose target is `error` away.
    fn joint(joint_type: JointType, error: f64) -> Joint {
        Joint {
            target_position: error,
            ..Joint::new(joint_type, JointMode::Kinematic)
        }
    }

    #[test]
    fn a_joint_has_arrived_within_a_hundredth_of_a_degree_or_a_tenth_of_a_millimetre() {
        let degree = 1_f64.to_radians();
        for (joint_type, error, has_arrived) in [
            (JointType::Revolute, 0.0099 * degree, true),
            (JointType::Revolute, -0.0099 * degree, true),
            (JointType::Revolute, 0.0101 * degree, false),
            (JointType::Revolute, 0.5 * degree, false),
            (JointType::Prismatic, 0.99e-4, true),
            (JointType::Prismatic, -1.01e-4, false),
            (JointType::Prismatic, 5e-3, false),
        ] {
            let step = profile_step(&joint(joint_type, error), JointMotion::ToPosition, DT);
            assert_eq!(step == AT_REST, has_arrived, "{joint_type:?} {error}");
            assert!(has_arrived || step.position.is_some_and(|to| to * error > 0.0));
        }
    }

    #[test]
    fn a_joint_that_moves_through_its_target_has_not_arrived() {
        let moving = Joint {
            velocity: 0.1,
            ..joint(JointType::Prismatic, 0.0)
        };
        assert!(profile_step(&moving, JointMotion::ToPosition, DT) != AT_REST);
        let accelerated = Joint {
            accel: 0.1,
            ..joint(JointType::Prismatic, 0.0)
        };
        assert!(profile_step(&accelerated, JointMotion::ToPosition, DT) != AT_REST);
    }

    /// With a constant jerk j from rest: v = v0 + j t^2 / 2, and x = v0 t + j t^3 / 6.
    #[test]
    fn a_motion_at_a_velocity_begins_with_the_initial_velocity_if_there_is_one() {
        let slider = Joint {
            velocity: 0.2,
            target_velocity: 10.0,
            max_accel: 100.0,
            max_jerk: 6.0,
            ..joint(JointType::Prismatic, 0.0)
        };
        for (initial, begin) in [(None, 0.2), (Some(0.5), 0.5), (Some(0.0), 0.0)] {
            let step = profile_step(&slider, JointMotion::AtVelocity { initial }, DT);
            let expected = (begin * DT + DT.powi(3), begin + 3.0 * DT * DT, 6.0 * DT);
            let position = step.position.unwrap_or(f64::NAN);
            assert!((position - expected.0).abs() < 1e-12, "{step:?}");
            assert!((step.velocity - expected.1).abs() < 1e-12, "{step:?}");
            assert!((step.accel - expected.2).abs() < 1e-9, "{step:?}");
        }
    }

    #[test]
    fn a_velocity_that_is_reached_is_kept_and_zero_is_the_end() {
        let at = |velocity: f64| Joint {
            position: 0.1,
            velocity,
            target_velocity: velocity,
            ..joint(JointType::Prismatic, 0.0)
        };
        let motion = JointMotion::AtVelocity { initial: None };
        let step = profile_step(&at(0.2), motion, DT);
        assert_eq!((step.position, step.velocity), (Some(0.1 + 0.2 * DT), 0.2));
        assert_eq!(profile_step(&at(0.0), motion, DT), AT_REST);
    }

    #[test]
    fn without_possible_limits_a_joint_comes_to_rest() {
        let stuck = Joint {
            max_accel: 0.0,
            ..joint(JointType::Prismatic, 0.3)
        };
        assert_eq!(profile_step(&stuck, JointMotion::ToPosition, DT), AT_REST);
    }
}
