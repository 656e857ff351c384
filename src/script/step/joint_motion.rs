//! Kinematic motion of joints: scripts compute every step (`sysCall_joint`, spec: callbacks 5).

use std::rc::Rc;

use crate::scene::joint::motion::JointStep;
use crate::scene::joint::{Joint, Motion};
use crate::scene::{Data, Handle, Key};
use crate::script::calls::callback::SysCall;
use crate::script::sim::Sim;

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
        let Some(data) = self.motion_data(handle) else { return };
        if let Some(answer) = self.first_answer(&self.joint_chain(handle), SysCall::Joint, &[data]) {
            // A script may have removed the joint: then there is nothing to move.
            let _ = self.scene.borrow_mut().step_joint(handle, read_step(&answer));
        }
    }

    /// The argument of `sysCall_joint` for a joint in motion; None when it does not move any more.
    fn motion_data(&self, handle: Handle) -> Option<Data> {
        let scene = self.scene.borrow();
        let joint = scene.object(handle).ok()?.joint().ok()?;
        let motion = joint.motion?;
        let Data::Map(mut entries) = describe(handle, joint) else { return None };
        let mut add = |key: &str, value: f64| entries.push((Key::Text(key.as_bytes().to_vec()), value.into()));
        match motion {
            Motion::ToPosition => {
                let error = joint.position_error(joint.position);
                add("targetPos", joint.target_position);
                add("error", error);
                add("errorValue", error);
            }
            Motion::AtVelocity { initial } => {
                add("targetVel", joint.target_velocity);
                initial.into_iter().for_each(|velocity| add("initVel", velocity));
            }
        }
        Some(Data::Map(entries))
    }
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
    let number = |names: [&str; 2]| names.iter().find_map(|name| answer.field(name)).and_then(Data::as_f64);
    JointStep {
        position: number(["pos", "position"]),
        velocity: number(["vel", "velocity"]).unwrap_or(0.0),
        accel: number(["accel", "acceleration"]).unwrap_or(0.0),
        immobile: answer.field("immobile").is_some_and(Data::truthy),
    }
}
