//! `sim.*`: the groups of inverse kinematics of scenes from before 4.2. They have handles, and are not computed: simIK is for that.

use api_macro::api;

use super::calculation_objects::{handle_of, with_explicit};
use crate::api::{ApiFn, Cx, Result, functions};
use crate::scene::SceneError;
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

/// Handles groups of inverse kinematics of old scenes, which are not computed.
///
/// @param ikGroupHandle a group that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @return result 0: none was computed
#[api("sim.handleIkGroup")]
fn handle_ik_group(cx: &mut Cx, ik_group_handle: Number) -> Result<i64> {
    if with_explicit(ik_group_handle.0).is_none() {
        let explicit = cx.scene().ik_groups().get(ik_group_handle.0).map(|group| group.explicit);
        if !explicit.ok_or(SceneError::NoSuchIkGroup)? {
            return Err(SceneError::NotExplicit.into());
        }
    }
    Ok(NOT_PERFORMED)
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
