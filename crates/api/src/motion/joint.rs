//! `sim.*`: joints: type, mode, position, interval, targets, dependencies.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::joint::{Joint, JointMode, JointType};
use scene::{Handle, Kind, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_joint,
    get_joint_type,
    get_joint_mode,
    set_joint_mode,
    get_joint_interval,
    set_joint_interval,
    get_joint_position,
    set_joint_position,
    get_joint_velocity,
    get_joint_dependency,
    set_joint_dependency,
    get_joint_target_position,
    set_joint_target_position,
    get_joint_target_velocity,
    set_joint_target_velocity,
    get_joint_target_force,
    set_joint_target_force,
];

/// Reads a joint.
fn joint<R>(cx: &Cx, handle: Handle, read: impl FnOnce(&Joint) -> R) -> Result<R> {
    Ok(cx.scene().object(handle)?.joint().map(read)?)
}

/// A new joint at the world's origin; its axis is z.
///
/// @param jointType sim.joint_revolute, sim.joint_prismatic or sim.joint_spherical
/// @param jointMode sim.jointmode_*
/// @param options not used
/// @param sizes length and diameter, metres, for display
/// @return jointHandle the joint
#[api("sim.createJoint")]
fn create_joint(
    cx: &mut Cx,
    joint_type: Number,
    joint_mode: Number,
    options: Number,
    #[default(None)] sizes: Option<[f64; 2]>,
) -> Result<Handle> {
    let _ = options;
    let joint_type = JointType::from_code(joint_type.0).ok_or(SceneError::InvalidArgument)?;
    let mode = JointMode::from_code(joint_mode.0).ok_or(SceneError::InvalidArgument)?;
    let mut joint = Joint::new(joint_type, JointMode::Kinematic);
    joint.set_mode(mode);
    if let Some(size) = sizes {
        joint.size = size;
    }
    cx.add_object(joint_type.alias(), Kind::Joint(Box::new(joint)))
}

/// Type of a joint.
///
/// @param objectHandle the joint
/// @return jointType sim.joint_*
#[api("sim.getJointType")]
fn get_joint_type(cx: &Cx, object_handle: Handle) -> Result<i64> {
    joint(cx, object_handle, |joint| joint.joint_type as i64)
}

/// Mode of a joint.
///
/// @param jointHandle the joint
/// @return jointMode sim.jointmode_*
/// @return options always 0
#[api("sim.getJointMode")]
fn get_joint_mode(cx: &Cx, joint_handle: Handle) -> Result<(i64, i64)> {
    joint(cx, joint_handle, |joint| (joint.mode as i64, 0))
}

/// Changes the mode of a joint. Leaving the dependent mode ends the dependency.
///
/// @param jointHandle the joint
/// @param jointMode sim.jointmode_*
/// @param options bit 0, with sim.jointmode_ik: the physics moves the joint to where inverse kinematics wants it
/// @return result 1
#[api("sim.setJointMode")]
fn set_joint_mode(
    cx: &mut Cx,
    joint_handle: Handle,
    joint_mode: Number,
    #[default(0)] options: Number,
) -> Result<i64> {
    let mode = JointMode::from_code(joint_mode.0).ok_or(SceneError::InvalidArgument)?;
    let mut scene = cx.scene_mut();
    scene.set_joint_mode(joint_handle, mode)?;
    if mode == JointMode::InverseKinematics && options.0 & 1 == 1 {
        scene.modify_joint(joint_handle, |joint| joint.hybrid = true)?;
    }
    Ok(1)
}

/// Interval of a joint.
///
/// @param objectHandle the joint
/// @return cyclic whether it has no limits
/// @return interval lower limit and range (not the upper limit), rad or metres
#[api("sim.getJointInterval")]
fn get_joint_interval(cx: &Cx, object_handle: Handle) -> Result<(bool, [f64; 2])> {
    joint(cx, object_handle, |joint| {
        (joint.cyclic, [joint.min, joint.range])
    })
}

/// Changes the interval of a joint; the position follows.
///
/// @param objectHandle the joint
/// @param cyclic whether it has no limits
/// @param interval lower limit and range (not the upper limit), rad or metres
/// @return result 1
#[api("sim.setJointInterval")]
fn set_joint_interval(
    cx: &mut Cx,
    object_handle: Handle,
    cyclic: bool,
    interval: [f64; 2],
) -> Result<i64> {
    cx.scene_mut()
        .set_joint_interval(object_handle, cyclic, interval)?;
    Ok(1)
}

/// Position of a joint.
///
/// @param objectHandle the joint, revolute or prismatic
/// @return position rad or metres
#[api("sim.getJointPosition")]
fn get_joint_position(cx: &Cx, object_handle: Handle) -> Result<f64> {
    joint(cx, object_handle, |joint| {
        joint.single_axis().map(|()| joint.position)
    })?
    .map_err(Into::into)
}

/// Moves a joint, within its interval.
///
/// @param objectHandle the joint, revolute or prismatic
/// @param position rad or metres
/// @return result 1, or 0 when the joint is moving towards a target and was left alone
#[api("sim.setJointPosition")]
fn set_joint_position(cx: &mut Cx, object_handle: Handle, position: f64) -> Result<i64> {
    Ok(i64::from(
        cx.scene_mut().set_joint_position(object_handle, position)?,
    ))
}

/// Velocity of a joint.
///
/// @param jointHandle the joint
/// @return velocity rad/s or m/s
#[api("sim.getJointVelocity")]
fn get_joint_velocity(cx: &Cx, joint_handle: Handle) -> Result<f64> {
    Ok(cx.scene().joint_velocity(joint_handle)?)
}

/// The dependency of a joint: position = offset + multCoeff * position of the master.
///
/// @param jointHandle the joint
/// @return masterJointHandle -1 if there is none; offset and factor are those of the last one then
/// @return offset rad or metres
/// @return multCoeff the factor
#[api("sim.getJointDependency")]
fn get_joint_dependency(cx: &Cx, joint_handle: Handle) -> Result<(i64, f64, f64)> {
    joint(cx, joint_handle, |joint| {
        let master = joint.dependency.map_or(-1, |law| law.master.raw());
        let [offset, coefficient] = joint.dependency_law();
        (master, offset, coefficient)
    })
}

/// Makes a joint in dependent mode follow another.
///
/// @param jointHandle the joint
/// @param masterJointHandle the joint to follow, -1 for none
/// @param offset rad or metres
/// @param multCoeff factor on the master's position
/// @return result 0
#[api("sim.setJointDependency")]
fn set_joint_dependency(
    cx: &mut Cx,
    joint_handle: Handle,
    master_joint_handle: Number,
    offset: f64,
    mult_coeff: f64,
) -> Result<i64> {
    let master = Some(master_joint_handle.0).filter(|&raw| raw >= 0);
    let master = master
        .map(|raw| Handle::from_raw(raw).ok_or(SceneError::NoSuchObject))
        .transpose()?;
    cx.scene_mut()
        .set_joint_dependency(joint_handle, master, offset, mult_coeff)?;
    Ok(0)
}

/// Target position of a joint.
///
/// @param objectHandle the joint, revolute or prismatic
/// @return targetPosition rad or metres
#[api("sim.getJointTargetPosition")]
fn get_joint_target_position(cx: &Cx, object_handle: Handle) -> Result<f64> {
    joint(cx, object_handle, |joint| {
        joint.single_axis().map(|()| joint.target_position)
    })?
    .map_err(Into::into)
}

/// Sets the target position of a joint. A kinematic joint starts to move there.
///
/// @param objectHandle the joint, revolute or prismatic
/// @param targetPosition rad or metres
/// @param motionParams highest velocity, acceleration and jerk; may be shorter
/// @return result 1
#[api("sim.setJointTargetPosition")]
fn set_joint_target_position(
    cx: &mut Cx,
    object_handle: Handle,
    target_position: f64,
    #[default(Vec::new())] motion_params: Vec<f64>,
) -> Result<i64> {
    cx.scene_mut()
        .set_joint_target_position(object_handle, target_position, &motion_params)?;
    Ok(1)
}

/// Target velocity of a joint.
///
/// @param objectHandle the joint, revolute or prismatic
/// @return targetVelocity rad/s or m/s
#[api("sim.getJointTargetVelocity")]
fn get_joint_target_velocity(cx: &Cx, object_handle: Handle) -> Result<f64> {
    joint(cx, object_handle, |joint| {
        joint.single_axis().map(|()| joint.target_velocity)
    })?
    .map_err(Into::into)
}

/// Sets the target velocity of a joint. A kinematic joint starts to move.
///
/// @param objectHandle the joint, revolute or prismatic
/// @param targetVelocity rad/s or m/s
/// @param motionParams highest acceleration and jerk; may be shorter
/// @param initVel velocity to start from
/// @return result 1
#[api("sim.setJointTargetVelocity")]
fn set_joint_target_velocity(
    cx: &mut Cx,
    object_handle: Handle,
    target_velocity: f64,
    #[default(Vec::new())] motion_params: Vec<f64>,
    #[default(None)] init_vel: Option<f64>,
) -> Result<i64> {
    cx.scene_mut().set_joint_target_velocity(
        object_handle,
        target_velocity,
        &motion_params,
        init_vel,
    )?;
    Ok(1)
}

/// Target force of a joint.
///
/// @param jointHandle the joint
/// @return forceOrTorque signed, N or N m
#[api("sim.getJointTargetForce")]
fn get_joint_target_force(cx: &Cx, joint_handle: Handle) -> Result<f64> {
    joint(cx, joint_handle, |joint| joint.target_force)
}

/// Sets the target force of a joint: what it drives with, or may drive with at most.
///
/// @param objectHandle the joint
/// @param forceOrTorque N or N m
/// @param signedValue whether the sign counts; otherwise it follows the target velocity
#[api("sim.setJointTargetForce")]
fn set_joint_target_force(
    cx: &mut Cx,
    object_handle: Handle,
    force_or_torque: f64,
    #[default(true)] signed_value: bool,
) -> Result<()> {
    if force_or_torque.is_nan() {
        return Err(SceneError::InvalidData.into());
    }
    Ok(cx.scene_mut().control_joint(object_handle, |joint| {
        joint.set_target_force(force_or_torque, signed_value);
    })?)
}
