//! Properties of joints.

use super::access::{Accessor, object_properties};
use super::{PoseArray, Quaternion};
use crate::scene::pose::{pose_to_array, quaternion_to_array};
use crate::scene::{Handle, Pose};

pub(super) const JOINT: &[Accessor] = object_properties! {
    "jointLength": f64, |o| o.joint()?.size[0], Appearance |o, length| o.joint_mut()?.size[0] = length;
    "jointDiameter": f64, |o| o.joint()?.size[1], Appearance |o, diameter| o.joint_mut()?.size[1] = diameter;
    "jointPosition": f64, |o| o.joint()?.position;
    "quaternion": Quaternion, |o| Quaternion(quaternion_to_array(&o.joint()?.spherical));
    "screwLead": f64, |o| o.joint()?.screw_lead, Joint |o, lead| o.joint_mut()?.screw_lead = lead;
    "intrinsicError": PoseArray, |o| PoseArray(pose_to_array(&o.joint()?.error.unwrap_or_else(Pose::identity)));
    "intrinsicPose": PoseArray, |o| PoseArray(pose_to_array(&o.joint()?.intrinsic_pose()));
    "calcVelocity": f64, |o| o.joint()?.velocity;
    "jointType": i64, |o| o.joint()?.joint_type as i64;
    "cyclic": bool, |o| o.joint()?.cyclic;
    "enforceLimits": bool, |o| o.joint()?.enforce_limits, Joint |o, on| o.joint_mut()?.enforce_limits = on;
    "interval": Vec<f64>, |o| { let joint = o.joint()?; vec![joint.min, joint.min + joint.range] };
    "jointMode": i64, |o| o.joint()?.mode as i64;
    "dependencyMasterHandle": i64, |o| o.joint()?.dependency.map_or(-1, |dependency| Handle::raw(dependency.master));
};

pub(super) const CONTROL: &[Accessor] = object_properties! {
    "targetPos": f64, |o| o.joint()?.target_position;
    "targetVel": f64, |o| o.joint()?.target_velocity;
    "targetForce": f64, |o| o.joint()?.target_force, Joint |o, force| o.joint_mut()?.target_force = force;
    "jointForce": f64, |o| o.joint()?.raw_force.unwrap_or_default();
    "averageJointForce": f64, |o| o.joint()?.force.unwrap_or_default();
    "dynCtrlMode": i64, |o| o.joint()?.control as i64;
    "maxVelAccelJerk": Vec<f64>, |o| { let joint = o.joint()?; vec![joint.max_vel, joint.max_accel, joint.max_jerk] },
        Joint |o, limits| {
            let joint = o.joint_mut()?;
            if let [vel, accel, jerk, ..] = limits[..] {
                (joint.max_vel, joint.max_accel, joint.max_jerk) = (vel, accel, jerk);
            }
        };
    "springDamperParams": Vec<f64>, |o| o.joint()?.spring.to_vec(),
        Joint |o, spring| if let [stiffness, damping, ..] = spring[..] {
            o.joint_mut()?.spring = [stiffness, damping];
        };
    "bullet.posPid": Vec<f64>, |o| o.joint()?.pid.to_vec(), Joint |o, pid| if let [p, i, d, ..] = pid[..] {
        o.joint_mut()?.pid = [p, i, d];
    };
};
