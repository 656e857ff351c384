//! `simIK.*`: chains of the scene.

use api_macro::api;
use kinematics::{Constraints, GroupId};

use super::environments::environment;
use super::groups::group;
use super::{ApiFn, Cx, Result, busy, functions};
use ik::{SceneElement, SceneLinks};
use scene::{Data, Handle, Key, SceneError, special};
use script::{Number, Table};

pub(super) const FUNCTIONS: &[ApiFn] =
    functions![add_element_from_scene, sync_from_sim, sync_to_sim];

fn handle(raw: i64) -> Result<Handle> {
    Ok(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)
}

/// Adds a tip of the scene to a group: copies of the tip, of the target and of everything that they are attached to.
///
/// @param environmentHandle the environment
/// @param ikGroup the group
/// @param baseHandle where the chain begins, -1 for the world
/// @param tipHandle the tip
/// @param targetHandle the target
/// @param constraints simIK.constraint_*
/// @return ikElement the element
/// @return simToIkMap copies by the handles of the scene's objects
/// @return ikToSimMap the scene's objects by the handles of their copies
#[api("simIK.addElementFromScene")]
fn add_element_from_scene(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group: Number,
    base_handle: Number,
    tip_handle: Number,
    target_handle: Number,
    constraints: Number,
) -> Result<(i64, Table, Table)> {
    let held = environment(cx, environment_handle.0)?;
    let mut held = held.try_borrow_mut().map_err(|_| busy())?;
    let element = SceneElement {
        base: if base_handle.0 == special::WORLD {
            None
        } else {
            Some(handle(base_handle.0)?)
        },
        tip: handle(tip_handle.0)?,
        target: handle(target_handle.0)?,
        constraints: Constraints(constraints.0 as u32 & Constraints::POSE.0),
    };
    let held = &mut *held;
    let added = held
        .links
        .add_element(&cx.scene(), &mut held.env, group(ik_group.0)?, &element)?;
    let (to_ik, to_sim) = maps(&held.links);
    Ok((added.raw(), to_ik, to_sim))
}

fn maps(links: &SceneLinks) -> (Table, Table) {
    let pairs = || {
        links
            .copies()
            .map(|(handle, copy)| (handle.raw(), copy.raw()))
    };
    let to_ik = pairs()
        .map(|(handle, copy)| (Key::Int(handle), copy.into()))
        .collect();
    let to_sim = pairs()
        .map(|(handle, copy)| (Key::Int(copy), handle.into()))
        .collect();
    (Table(Data::Map(to_ik)), Table(Data::Map(to_sim)))
}

fn groups(raw: &[i64]) -> kinematics::Result<Vec<GroupId>> {
    raw.iter().map(|raw| group(*raw)).collect()
}

/// Brings joints to where they are in the scene, and targets to where they are as seen from their bases.
///
/// @param environmentHandle the environment
/// @param ikGroups groups with elements from the scene
#[api("simIK.syncFromSim")]
fn sync_from_sim(cx: &mut Cx, environment_handle: Number, ik_groups: Vec<i64>) -> Result<()> {
    let held = environment(cx, environment_handle.0)?;
    let mut held = held.try_borrow_mut().map_err(|_| busy())?;
    let held = &mut *held;
    Ok(held
        .links
        .sync_from(&cx.scene(), &mut held.env, &groups(&ik_groups)?)?)
}

/// Moves the joints of the scene to where they are in the environment; those that the physics moves get a target position.
///
/// @param environmentHandle the environment
/// @param ikGroups groups with elements from the scene
#[api("simIK.syncToSim")]
fn sync_to_sim(cx: &mut Cx, environment_handle: Number, ik_groups: Vec<i64>) -> Result<()> {
    let held = environment(cx, environment_handle.0)?;
    let held = held.try_borrow().map_err(|_| busy())?;
    let groups = groups(&ik_groups)?;
    let joints = held.links.joints_of(&cx.scene(), &groups);
    let dynamic: Vec<Handle> = {
        let dynamics = cx.dynamics();
        let simulated = |joint: &Handle| {
            dynamics
                .as_ref()
                .is_some_and(|dynamics| dynamics.simulates(*joint))
        };
        joints.into_iter().filter(simulated).collect()
    };
    let mut scene = cx.scene_mut();
    Ok(held
        .links
        .sync_to(&mut scene, &held.env, &groups, |joint| {
            dynamic.contains(&joint)
        })?)
}
