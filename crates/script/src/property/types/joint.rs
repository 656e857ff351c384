//! Properties of joints.

use geometry::pose::{pose_to_array, quaternion_from_array, quaternion_to_array};

use super::access::{Accessor, object_properties, placed_properties};
use super::{PoseArray, Quaternion};
use crate::error::ApiError;
use scene::joint::{Control, JointMode, JointSolver};
use scene::{Handle, Pose, Scene, SceneError, SceneResult};

pub(in crate::property) const JOINT: &[Accessor] = object_properties! {
    "jointLength": f64, |o| o.joint()?.size[0], Appearance |o, length| o.joint_mut()?.size[0] = length;
    "jointDiameter": f64, |o| o.joint()?.size[1], Appearance |o, diameter| o.joint_mut()?.size[1] = diameter;
    "quaternion": Quaternion, |o| Quaternion(quaternion_to_array(&o.joint()?.spherical)),
        JointPosition |o, turned| o.joint_mut()?.spherical = quaternion_from_array(&turned.0);
    "screwLead": f64, |o| o.joint()?.screw_lead, Joint |o, lead| o.joint_mut()?.set_screw_lead(lead);
    "intrinsicError": PoseArray, |o| PoseArray(pose_to_array(&o.joint()?.error.unwrap_or_else(Pose::identity)));
    "intrinsicPose": PoseArray, |o| PoseArray(pose_to_array(&o.joint()?.intrinsic_pose()));
    "calcVelocity": f64, |o| o.joint()?.velocity;
    "jointType": i64, |o| o.joint()?.joint_type as i64;
    "enforceLimits": bool, |o| o.joint()?.enforce_limits, Joint |o, on| o.joint_mut()?.enforce_limits = on;
};

pub(in crate::property) const CONTROL: &[Accessor] = object_properties! {
    "jointForce": f64, |o| o.joint()?.raw_force.unwrap_or_default();
    "averageJointForce": f64, |o| o.joint()?.force.unwrap_or_default();
    "maxVelAccelJerk": Vec<f64>, |o| { let joint = o.joint()?; vec![joint.max_vel, joint.max_accel, joint.max_jerk] },
        Joint |o, limits| {
            let [vel, accel, jerk, ..] = limits[..] else { return Err(SceneError::InvalidData) };
            let joint = o.joint_mut()?;
            (joint.max_vel, joint.max_accel, joint.max_jerk) = (vel, accel, jerk);
        };
    "springDamperParams": Vec<f64>, |o| o.joint()?.spring.to_vec(),
        Joint |o, spring| {
            let [stiffness, damping, ..] = spring[..] else { return Err(SceneError::InvalidData) };
            o.joint_mut()?.spring = [stiffness, damping];
        };
};

/// Properties whose change has consequences for the joint or for those that follow it.
pub(in crate::property) const STATE: &[Accessor] = placed_properties! {
    "jointPosition": f64, |s, h| s.object(h)?.joint()?.position, |s, h, position| s.set_joint_position(h, position)?;
    "cyclic": bool, |s, h| s.object(h)?.joint()?.cyclic, |s, h, cyclic| {
        let interval = interval_of(&s, h)?;
        s.set_joint_interval(h, cyclic, interval)?;
    };
    // Here the limits themselves; sim.setJointInterval takes the lower one and the range.
    "interval": Vec<f64>, |s, h| interval_of(&s, h).map(|[min, range]| vec![min, min + range])?, |s, h, limits| {
        let &[low, high, ..] = &limits[..] else { return Err(SceneError::InvalidData.into()) };
        let cyclic = s.object(h)?.joint()?.cyclic;
        s.set_joint_interval(h, cyclic, [low, high - low])?;
    };
    "targetPos": f64, |s, h| s.object(h)?.joint()?.target_position,
        |s, h, target| s.set_joint_target_position(h, target, &[])?;
    "targetVel": f64, |s, h| s.object(h)?.joint()?.target_velocity,
        |s, h, target| s.set_joint_target_velocity(h, target, &[], None)?;
    "targetForce": f64, |s, h| s.object(h)?.joint()?.target_force,
        |s, h, force| s.control_joint(h, |joint| joint.set_target_force(force, true))?;
    "jointMode": i64, |s, h| s.object(h)?.joint()?.mode as i64, |s, h, mode| {
        let mode = JointMode::from_code(mode).ok_or(SceneError::InvalidData)?;
        s.set_joint_mode(h, mode)?;
    };
    "rapier.solver": String, |s, h| s.object(h)?.joint()?.solver.word().to_owned(), |s, h, word| {
        let solver = JointSolver::from_word(&word).ok_or(ApiError::UnknownSolver(word))?;
        s.modify_joint(h, |joint| joint.solver = solver)?;
    };
    "dynCtrlMode": i64, |s, h| s.object(h)?.joint()?.control as i64, |s, h, mode| {
        let control = Control::from_code(mode).ok_or(SceneError::InvalidData)?;
        s.control_joint(h, |joint| joint.set_control(control))?;
    };
    "dynVelMode": i64, |s, h| i64::from(s.object(h)?.joint()?.velocity_profile),
        |s, h, mode| s.control_joint(h, |joint| joint.velocity_profile = mode == 1)?;
    "dynPosMode": i64, |s, h| i64::from(s.object(h)?.joint()?.position_profile),
        |s, h, mode| s.control_joint(h, |joint| joint.position_profile = mode == 1)?;
    "dependencyMasterHandle": i64, |s, h| s.object(h)?.joint()?.dependency.map_or(-1, |d| d.master.raw()),
        |s, h, master| {
            let [offset, coefficient] = law_of(&s, h)?;
            s.set_joint_dependency(h, Handle::from_raw(master), offset, coefficient)?;
        };
    "dependencyParams": Vec<f64>, |s, h| law_of(&s, h)?.to_vec(), |s, h, law| {
        let &[offset, coefficient, ..] = &law[..] else { return Err(SceneError::InvalidData.into()) };
        let master = s.object(h)?.joint()?.dependency.map(|dependency| dependency.master);
        s.set_joint_dependency(h, master, offset, coefficient)?;
    };
};

/// Lower limit and range.
fn interval_of(scene: &Scene, handle: Handle) -> SceneResult<[f64; 2]> {
    let joint = scene.object(handle)?.joint()?;
    Ok([joint.min, joint.range])
}

/// Offset and coefficient of the dependency.
fn law_of(scene: &Scene, handle: Handle) -> SceneResult<[f64; 2]> {
    Ok(scene.object(handle)?.joint()?.dependency_law())
}
