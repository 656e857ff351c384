//! `simIK.*`: joints.

use std::f64::consts::TAU;

use api_macro::api;
use geometry::pose::{pose_from_matrix, quaternion_from_array};
use kinematics::{Joint, JointMode, JointType, Law, ObjectId};

use super::{ApiFn, Cx, Result, finite, functions, object, raw, refused, rotation, with};
use scene::Data;
use script::{Number, ScriptCallback, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_joint_type,
    get_joint_position,
    set_joint_position,
    get_joint_mode,
    set_joint_mode,
    get_joint_interval,
    set_joint_interval,
    get_joint_screw_lead,
    set_joint_screw_lead,
    get_joint_screw_pitch,
    set_joint_screw_pitch,
    get_joint_weight,
    set_joint_weight,
    get_joint_max_step_size,
    set_joint_max_step_size,
    get_joint_limit_margin,
    set_joint_limit_margin,
    get_joint_dependency,
    set_joint_dependency,
    set_spherical_joint_matrix,
    set_spherical_joint_rotation,
    set_joint_quaternion,
];

fn read<R>(
    cx: &Cx,
    environment: Number,
    joint: Number,
    read: impl FnOnce(&Joint) -> R,
) -> Result<R> {
    with(cx, environment.0, |held| {
        held.env.joint(object(joint.0)?).map(read)
    })
}

fn change(
    cx: &Cx,
    environment: Number,
    joint: Number,
    change: impl FnOnce(&mut Joint),
) -> Result<()> {
    with(cx, environment.0, |held| {
        held.env.joint_mut(object(joint.0)?).map(change)
    })
}

/// Type of a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return jointType simIK.jointtype_*
#[api("simIK.getJointType")]
fn get_joint_type(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<i64> {
    read(cx, environment_handle, joint_handle, |joint| {
        joint.joint_type as i64
    })
}

/// Position of a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return position rad, m
#[api("simIK.getJointPosition")]
fn get_joint_position(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| joint.position)
}

/// Moves a joint within its limits, and those that depend on it.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint, not spherical
/// @param position rad, m
#[api("simIK.setJointPosition")]
fn set_joint_position(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    position: f64,
) -> Result<()> {
    with(cx, environment_handle.0, |held| {
        held.env
            .set_joint_position(object(joint_handle.0)?, position)
    })
}

/// Whether calculations move a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return jointMode simIK.jointmode_passive or simIK.jointmode_ik
#[api("simIK.getJointMode")]
fn get_joint_mode(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<i64> {
    read(cx, environment_handle, joint_handle, |joint| {
        joint.mode as i64
    })
}

/// Sets whether calculations move a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param jointMode simIK.jointmode_passive or simIK.jointmode_ik
#[api("simIK.setJointMode")]
fn set_joint_mode(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    joint_mode: Number,
) -> Result<()> {
    let mode = match joint_mode.0 {
        0 => JointMode::Passive,
        2 => JointMode::Ik,
        _ => return Err(refused("invalid joint mode.")),
    };
    change(cx, environment_handle, joint_handle, |joint| {
        joint.mode = mode;
    })
}

/// Limits of a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return cyclic whether it has none
/// @return interval the lower one, and the width between both
#[api("simIK.getJointInterval")]
fn get_joint_interval(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<(bool, [f64; 2])> {
    read(cx, environment_handle, joint_handle, |joint| {
        (joint.cyclic, [joint.min, joint.range])
    })
}

/// Sets the limits of a joint; its position stays within them.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param cyclic whether it has none; revolute joints only
/// @param interval the lower one, and the width between both; as they are if empty
#[api("simIK.setJointInterval")]
fn set_joint_interval(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    cyclic: bool,
    #[default(Vec::new())] interval: Vec<f64>,
) -> Result<()> {
    let interval = interval
        .first_chunk::<2>()
        .map(|interval| finite(*interval))
        .transpose()?;
    with(cx, environment_handle.0, |held| {
        let id = object(joint_handle.0)?;
        let joint = held.env.joint_mut(id)?;
        joint.cyclic = cyclic && joint.joint_type != JointType::Prismatic;
        if let Some([min, range]) = interval {
            (joint.min, joint.range) = (min, range.max(0.0));
        }
        let position = joint.position;
        if joint.joint_type == JointType::Spherical {
            Ok(())
        } else {
            held.env.set_joint_position(id, position)
        }
    })
}

/// How far a screw goes in one turn.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return lead metres per turn
#[api("simIK.getJointScrewLead")]
fn get_joint_screw_lead(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| {
        joint.screw_lead
    })
}

fn set_lead(cx: &Cx, environment: Number, joint: Number, lead: f64) -> Result<()> {
    let lead = finite(lead)?;
    change(cx, environment, joint, |joint| {
        if joint.joint_type == JointType::Revolute {
            joint.screw_lead = lead;
        }
    })
}

/// Makes a revolute joint a screw.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint; one that is not revolute stays as it is
/// @param lead metres per turn; 0 for none
#[api("simIK.setJointScrewLead")]
fn set_joint_screw_lead(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    lead: f64,
) -> Result<()> {
    set_lead(cx, environment_handle, joint_handle, lead)
}

/// How far a screw goes in one radian.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return pitch metres per radian
#[api("simIK.getJointScrewPitch")]
fn get_joint_screw_pitch(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| {
        joint.screw_lead / TAU
    })
}

/// As simIK.setJointScrewLead, by the radian.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param pitch metres per radian
#[api("simIK.setJointScrewPitch")]
fn set_joint_screw_pitch(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    pitch: f64,
) -> Result<()> {
    set_lead(cx, environment_handle, joint_handle, pitch * TAU)
}

/// How much calculations prefer a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return weight 1 by default
#[api("simIK.getJointWeight")]
fn get_joint_weight(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| joint.weight)
}

/// Sets how much calculations prefer a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param weight 0: it stays where it is
#[api("simIK.setJointWeight")]
fn set_joint_weight(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    weight: f64,
) -> Result<()> {
    let weight = finite(weight)?;
    change(cx, environment_handle, joint_handle, |joint| {
        joint.weight = weight;
    })
}

/// Largest change of a joint in one iteration.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return stepSize rad, m
#[api("simIK.getJointMaxStepSize")]
fn get_joint_max_step_size(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| joint.max_step)
}

/// Sets the largest change of a joint in one iteration.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param stepSize rad, m
#[api("simIK.setJointMaxStepSize")]
fn set_joint_max_step_size(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    step_size: f64,
) -> Result<()> {
    let step_size = finite(step_size)?;
    change(cx, environment_handle, joint_handle, |joint| {
        joint.max_step = step_size;
    })
}

/// Distance to a limit from which simIK.group_avoidlimits pushes a joint away.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return margin rad, m
#[api("simIK.getJointLimitMargin")]
fn get_joint_limit_margin(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<f64> {
    read(cx, environment_handle, joint_handle, |joint| {
        joint.limit_margin
    })
}

/// Sets the distance to a limit from which simIK.group_avoidlimits pushes a joint away.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param margin rad, m
#[api("simIK.setJointLimitMargin")]
fn set_joint_limit_margin(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    margin: f64,
) -> Result<()> {
    let margin = finite(margin)?;
    change(cx, environment_handle, joint_handle, |joint| {
        joint.limit_margin = margin;
    })
}

/// What a joint depends on.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return depJointHandle its master, -1 if it has none
/// @return offset rad, m
/// @return mult factor of the master's position
#[api("simIK.getJointDependency")]
fn get_joint_dependency(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<(i64, f64, f64)> {
    read(cx, environment_handle, joint_handle, |joint| {
        match &joint.dependency {
            None => (-1, 0.0, 1.0),
            Some(dependency) => match dependency.law {
                Law::Linear { offset, factor } => (raw(Some(dependency.master)), offset, factor),
                Law::Function(_) => (raw(Some(dependency.master)), 0.0, 1.0),
            },
        }
    })
}

/// Makes a joint depend on another one: q = offset + mult * q of the master, or what a function says.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param masterJointHandle its master, -1 for none
/// @param offset rad, m
/// @param mult factor of the master's position
/// @param callback float position = callback(int environmentHandle, int jointHandle, float masterPosition); it must not use the environment
#[api("simIK.setJointDependency")]
fn set_joint_dependency(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    master_joint_handle: Number,
    #[default(0.0)] offset: f64,
    #[default(1.0)] mult: f64,
    callback: Option<ScriptFunction>,
) -> Result<()> {
    let law = match callback {
        Some(function) => by_function(
            ScriptCallback::new(cx, function),
            [environment_handle.0, joint_handle.0],
        ),
        None => Law::Linear {
            offset: finite(offset)?,
            factor: finite(mult)?,
        },
    };
    with(cx, environment_handle.0, |held| {
        let master = if master_joint_handle.0 < 0 {
            None
        } else {
            Some(object(master_joint_handle.0)?)
        };
        held.env.set_dependency(
            object(joint_handle.0)?,
            master.map(|master: ObjectId| (master, law)),
        )
    })
}

/// A function that fails has no position: the joint stays.
fn by_function(callback: ScriptCallback, [environment, joint]: [i64; 2]) -> Law {
    Law::Function(std::rc::Rc::new(move |master| {
        let results = callback.call(&[environment.into(), joint.into(), master.into()]);
        results
            .ok()
            .and_then(|results| results.first().and_then(Data::as_f64))
            .unwrap_or(f64::NAN)
    }))
}

fn set_rotation(
    cx: &Cx,
    environment: Number,
    joint: Number,
    to: nalgebra::UnitQuaternion<f64>,
) -> Result<()> {
    with(cx, environment.0, |held| {
        held.env.set_rotation(object(joint.0)?, to)
    })
}

/// Position of a spherical joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param matrix 3 rows of 4; its translation does not count
#[api("simIK.setSphericalJointMatrix")]
fn set_spherical_joint_matrix(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    matrix: [f64; 12],
) -> Result<()> {
    set_rotation(
        cx,
        environment_handle,
        joint_handle,
        pose_from_matrix(&finite(matrix)?).rotation,
    )
}

/// Position of a spherical joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param eulerOrQuaternion alpha, beta, gamma, or qx, qy, qz, qw
#[api("simIK.setSphericalJointRotation")]
fn set_spherical_joint_rotation(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    euler_or_quaternion: Vec<f64>,
) -> Result<()> {
    set_rotation(
        cx,
        environment_handle,
        joint_handle,
        rotation(&euler_or_quaternion)?,
    )
}

/// Position of a spherical joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @param quaternion qx, qy, qz, qw
#[api("simIK.setJointQuaternion")]
fn set_joint_quaternion(
    cx: &mut Cx,
    environment_handle: Number,
    joint_handle: Number,
    quaternion: [f64; 4],
) -> Result<()> {
    set_rotation(
        cx,
        environment_handle,
        joint_handle,
        quaternion_from_array(&finite(quaternion)?),
    )
}
