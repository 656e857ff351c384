//! `sim.*`: kinematic motion of joints, and the functions of V-REP for it.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::{Handle, Object, SceneError, special};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![handle_joint_motion, sim_handle_joint, sim_reset_joint];

/// Moves kinematic joints towards their targets by one step. For the main script.
#[api("sim.handleJointMotion")]
fn handle_joint_motion(cx: &mut Cx) -> Result<()> {
    crate::scripts::simulation::main_script_only(cx)?;
    cx.handle_joint_motion();
    Ok(())
}

/// The joints that a number means: all, or one, which must be tagged for explicit handling.
fn handled_joints(cx: &Cx, number: i64) -> Result<Vec<Handle>> {
    let scene = cx.scene();
    let joints = |with_explicit: bool| {
        let joints = scene
            .objects()
            .filter(move |object| object.joint().is_ok_and(|j| with_explicit || !j.explicit));
        joints.map(Object::handle).collect()
    };
    Ok(match number {
        special::ALL => joints(true),
        special::ALL_EXCEPT_EXPLICIT => joints(false),
        _ => {
            let joint = Handle::from_raw(number).ok_or(SceneError::NoSuchObject)?;
            if !scene.object(joint)?.joint()?.explicit {
                return Err(SceneError::NotExplicit.into());
            }
            vec![joint]
        }
    })
}

/// Moves kinematic joints towards their targets, without asking scripts. Main scripts of V-REP call it; the default one of today calls
/// sim.handleJointMotion.
///
/// @param jointHandle a joint that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @param deltaTime seconds
/// @return result 1
#[api("simHandleJoint")]
fn sim_handle_joint(cx: &mut Cx, joint_handle: Number, delta_time: f64) -> Result<i64> {
    if !(delta_time.is_finite() && delta_time >= 0.0) {
        return Err(SceneError::InvalidArgument.into());
    }
    for joint in handled_joints(cx, joint_handle.0)? {
        cx.follow_profile(joint, delta_time)?;
    }
    Ok(1)
}

/// Ends motions of kinematic joints; they stay where they are.
///
/// @param jointHandle as for simHandleJoint
/// @return result 1
#[api("simResetJoint")]
fn sim_reset_joint(cx: &mut Cx, joint_handle: Number) -> Result<i64> {
    for joint in handled_joints(cx, joint_handle.0)? {
        cx.scene_mut().modify_joint(joint, |joint| {
            joint.motion = None;
            (joint.velocity, joint.accel) = (0.0, 0.0);
        })?;
    }
    Ok(1)
}
