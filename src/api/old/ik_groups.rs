//! `sim.*`: the groups of inverse kinematics of scenes from before 4.2 (spec: kinematics 7).

use std::collections::BTreeSet;

use api_macro::api;

use super::calculation_objects::{handle_of, with_explicit};
use crate::api::{ApiFn, Cx, Result, functions};
use crate::ik::groups::SolvedGroup;
use crate::scene::{Handle, SceneError};
use crate::script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![get_ik_group_handle, handle_ik_group, remove_ik_group];

/// What handling one group returns: it was not performed.
const NOT_PERFORMED: i64 = 0;

/// A group of inverse kinematics of an old scene.
///
/// @param ikGroupName its name; with `@silentError`: -1 if there is none
/// @return ikGroupHandle its handle
#[api("sim.getIkGroupHandle")]
fn get_ik_group_handle(cx: &Cx, ik_group_name: String) -> Result<i64> {
    handle_of(cx, &ik_group_name, |scene, name| scene.ik_groups().named(name), SceneError::NoSuchIkGroup)
}

/// Computes groups of inverse kinematics of old scenes, and moves their joints. The usual main script does it for those that are not
/// tagged for explicit handling.
///
/// @param ikGroupHandle a group that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @return result how many were computed; of a single one 0 if it was not performed, 1 if it succeeded, 2 if it failed
#[api("sim.handleIkGroup")]
fn handle_ik_group(cx: &mut Cx, ik_group_handle: Number) -> Result<i64> {
    match with_explicit(ik_group_handle.0) {
        Some(explicit) => handle_ik_groups(cx, explicit),
        None => {
            let explicit = cx.scene().ik_groups().get(ik_group_handle.0).map(|group| group.explicit);
            if !explicit.ok_or(SceneError::NoSuchIkGroup)? {
                return Err(SceneError::NotExplicit.into());
            }
            compute(cx, ik_group_handle.0)
        }
    }
}

/// Computes all groups, or those that are not tagged for explicit handling; returns how many were performed.
pub(in crate::api) fn handle_ik_groups(cx: &mut Cx, with_explicit: bool) -> Result<i64> {
    let handles: Vec<i64> = {
        let scene = cx.scene();
        let groups = scene.ik_groups().iter().filter(|(_, group)| with_explicit || !group.explicit);
        groups.map(|(handle, _)| handle).collect()
    };
    let mut performed = 0;
    for handle in handles {
        performed += i64::from(compute(cx, handle)? > 0);
    }
    Ok(performed)
}

fn compute(cx: &mut Cx, handle: i64) -> Result<i64> {
    let solved = {
        let scene = cx.scene();
        SolvedGroup::new(&scene, scene.ik_groups().get(handle).ok_or(SceneError::NoSuchIkGroup)?)
    };
    // A file may name a tip that is no dummy.
    let Ok(solved) = solved else { return Ok(NOT_PERFORMED) };
    let dynamic: BTreeSet<Handle> = {
        let (scene, dynamics) = (cx.scene(), cx.dynamics());
        let joints = scene.objects().filter(|object| object.joint().is_ok()).map(crate::scene::Object::handle);
        joints.filter(|joint| dynamics.as_ref().is_some_and(|dynamics| dynamics.simulates(*joint))).collect()
    };
    solved.apply(&mut cx.scene_mut(), |joint| dynamic.contains(&joint))?;
    Ok(solved.result())
}

/// Removes a group of inverse kinematics of an old scene.
///
/// @param ikGroupHandle the group, or sim.handle_all
/// @return result 1
#[api("sim.removeIkGroup")]
fn remove_ik_group(cx: &mut Cx, ik_group_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    match with_explicit(ik_group_handle.0) {
        Some(_) => scene.ik_groups_mut().clear(),
        None => drop(scene.ik_groups_mut().remove(ik_group_handle.0).ok_or(SceneError::NoSuchIkGroup)?),
    }
    Ok(1)
}
