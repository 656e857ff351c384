//! `simIK.*`: groups.

use api_macro::api;
use kinematics::{Group, GroupFlags, GroupId, KinematicsError, Method, ObjectId};

use super::{ApiFn, Cx, Result, finite, functions, refused, with};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_group,
    does_group_exist,
    get_group_handle,
    get_group_calculation,
    set_group_calculation,
    get_group_flags,
    set_group_flags,
    get_group_joints,
    get_group_joint_limit_hits,
];

/// Iterations of one call: more would not end in a reasonable time.
const MAX_ITERATIONS: i64 = 100_000;
/// Smaller changes of the damping are ignored (spec: kinematics 2).
const MIN_CHANGE: f64 = 1e-4;

pub(super) fn group(raw: i64) -> kinematics::Result<GroupId> {
    GroupId::from_raw(raw).ok_or(KinematicsError::NoSuchGroup)
}

fn read<R>(
    cx: &Cx,
    environment: Number,
    handle: Number,
    read: impl FnOnce(&Group) -> R,
) -> Result<R> {
    with(cx, environment.0, |held| {
        held.env.group(group(handle.0)?).map(read)
    })
}

fn change(
    cx: &Cx,
    environment: Number,
    handle: Number,
    change: impl FnOnce(&mut Group),
) -> Result<()> {
    with(cx, environment.0, |held| {
        held.env.group_mut(group(handle.0)?).map(change)
    })
}

/// A new group without elements.
///
/// @param environmentHandle the environment
/// @param ikGroupName its name
/// @return ikGroupHandle the group
#[api("simIK.createGroup")]
fn create_group(
    cx: &mut Cx,
    environment_handle: Number,
    #[default(String::new())] ik_group_name: String,
) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        Ok(held.env.create_group(&ik_group_name).raw())
    })
}

/// Whether there is a group with that name.
///
/// @param environmentHandle the environment
/// @param ikGroupName the name
/// @return result
#[api("simIK.doesGroupExist")]
fn does_group_exist(cx: &Cx, environment_handle: Number, ik_group_name: String) -> Result<bool> {
    with(cx, environment_handle.0, |held| {
        Ok(held.env.group_named(&ik_group_name).is_some())
    })
}

/// The group with that name.
///
/// @param environmentHandle the environment
/// @param ikGroupName the name
/// @return ikGroupHandle the group
#[api("simIK.getGroupHandle")]
fn get_group_handle(cx: &Cx, environment_handle: Number, ik_group_name: String) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        held.env
            .group_named(&ik_group_name)
            .map(GroupId::raw)
            .ok_or(KinematicsError::NoSuchGroup)
    })
}

/// How a group is calculated.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return method simIK.method_*
/// @return damping of simIK.method_damped_least_squares
/// @return maxIterations at most that many
#[api("simIK.getGroupCalculation")]
fn get_group_calculation(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
) -> Result<(i64, f64, i64)> {
    read(cx, environment_handle, ik_group_handle, |group| {
        (group.method as i64, group.damping, group.iterations.into())
    })
}

/// Sets how a group is calculated.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param method simIK.method_*
/// @param damping of simIK.method_damped_least_squares; a change of less than 0.0001 is ignored
/// @param maxIterations at most 100000; at least one is done
#[api("simIK.setGroupCalculation")]
fn set_group_calculation(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    method: Number,
    damping: f64,
    max_iterations: Number,
) -> Result<()> {
    let method = Method::from_raw(method.0).ok_or_else(|| refused("invalid method."))?;
    let damping = finite(damping)?;
    change(cx, environment_handle, ik_group_handle, |group| {
        group.method = method;
        if (group.damping - damping).abs() >= MIN_CHANGE {
            group.damping = damping;
        }
        group.iterations = max_iterations.0.clamp(0, MAX_ITERATIONS) as u32;
    })
}

/// Flags of a group.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return flags simIK.group_*
#[api("simIK.getGroupFlags")]
fn get_group_flags(cx: &Cx, environment_handle: Number, ik_group_handle: Number) -> Result<i64> {
    read(cx, environment_handle, ik_group_handle, |group| {
        group.flags.0.into()
    })
}

/// Sets the flags of a group.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param flags simIK.group_*
#[api("simIK.setGroupFlags")]
fn set_group_flags(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    flags: Number,
) -> Result<()> {
    change(cx, environment_handle, ik_group_handle, |group| {
        group.flags = GroupFlags(flags.0 as u32);
    })
}

/// The joints that a group moves, from the bases to the tips.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return jointHandles the joints
#[api("simIK.getGroupJoints")]
fn get_group_joints(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
) -> Result<Vec<i64>> {
    with(cx, environment_handle.0, |held| {
        let joints = held.env.joints_of(group(ik_group_handle.0)?)?;
        Ok(joints.into_iter().map(ObjectId::raw).collect())
    })
}

/// The joints that were stopped at their limits in the last iteration of a group.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @return jointHandles the joints
/// @return underOrOvershots how far beyond the limits they would have gone; negative below the lower ones
#[api("simIK.getGroupJointLimitHits")]
fn get_group_joint_limit_hits(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
) -> Result<(Vec<i64>, Vec<f64>)> {
    read(cx, environment_handle, ik_group_handle, |group| {
        group
            .limit_hits()
            .iter()
            .map(|hit| (hit.joint.raw(), hit.overshoot))
            .unzip()
    })
}
