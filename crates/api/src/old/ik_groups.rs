//! `sim.*`: the groups of inverse kinematics of V-REP, in old scenes and created by scripts (spec: kinematics 7).

use std::collections::BTreeSet;

use api_macro::api;

use super::calculation_objects::{handle_of, with_explicit};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use ik::groups::{self, GroupCopy, IkResult};
use scene::tree::ik_groups::{IkElement, IkGroup, IkGroupOptions};
use scene::{Handle, Scene, SceneError, special};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_ik_group_handle,
    handle_ik_group,
    remove_ik_group,
    create_ik_group,
    create_ik_element,
    set_ik_group_properties,
    set_ik_element_properties,
];

/// What V-REP calls a new group.
const NAME: &str = "IK_Group";

/// A group of inverse kinematics of an old scene.
///
/// @param ikGroupName its name; with `@silentError`: -1 if there is none
/// @return ikGroupHandle its handle
#[api("sim.getIkGroupHandle")]
fn get_ik_group_handle(cx: &Cx, ik_group_name: String) -> Result<i64> {
    handle_of(
        cx,
        &ik_group_name,
        |scene, name| scene.ik_groups().named(name),
        SceneError::NoSuchIkGroup,
    )
}

/// Computes groups of inverse kinematics of V-REP, and moves their joints. The default main script does it for those that are not
/// tagged for explicit handling.
///
/// @param ikGroupHandle a group that is tagged for explicit handling, sim.handle_all or sim.handle_all_except_explicit
/// @return result how many were computed; of a single one 0 if it was not performed, 1 if it succeeded, 2 if it failed
#[api("sim.handleIkGroup")]
fn handle_ik_group(cx: &mut Cx, ik_group_handle: Number) -> Result<i64> {
    match with_explicit(ik_group_handle.0) {
        Some(explicit) => handle_ik_groups(cx, explicit),
        None => {
            let explicit = group(&cx.scene(), ik_group_handle)?.explicit;
            if !explicit {
                return Err(SceneError::NotExplicit.into());
            }
            compute(cx, ik_group_handle.0).map(|result| result as i64)
        }
    }
}

/// Computes all groups, or those that are not tagged for explicit handling; returns how many were performed.
pub(crate) fn handle_ik_groups(cx: &mut Cx, with_explicit: bool) -> Result<i64> {
    let handles: Vec<i64> = {
        let scene = cx.scene();
        let groups = scene
            .ik_groups()
            .iter()
            .filter(|(_, group)| with_explicit || !group.explicit);
        groups.map(|(handle, _)| handle).collect()
    };
    let mut performed = 0;
    for handle in handles {
        performed += i64::from(compute(cx, handle)? != IkResult::NotPerformed);
    }
    Ok(performed)
}

fn compute(cx: &mut Cx, handle: i64) -> Result<IkResult> {
    let solved = {
        let scene = cx.scene();
        if !scene.settings().calculations.inverse_kinematics {
            return Ok(IkResult::NotPerformed);
        }
        let group = scene
            .ik_groups()
            .get(handle)
            .ok_or(SceneError::NoSuchIkGroup)?;
        // A file may name a tip that is no dummy.
        let Ok(mut copy) = GroupCopy::new(&scene, group, 0) else {
            return Ok(IkResult::NotPerformed);
        };
        let result = copy.solve()?;
        (result, copy.jacobian(false)?, copy)
    };
    let (result, jacobian, copy) = solved;
    let joints = dynamic_joints(cx);
    let mut scene = cx.scene_mut();
    copy.apply(&mut scene, |joint| joints.contains(&joint))?;
    if let Some(group) = scene.ik_groups_mut().get_mut(handle) {
        group.jacobian = jacobian;
    }
    Ok(result)
}

fn dynamic_joints(cx: &Cx) -> BTreeSet<Handle> {
    let (scene, dynamics) = (cx.scene(), cx.dynamics());
    let joints = scene
        .objects()
        .filter(|object| object.joint().is_ok())
        .map(scene::Object::handle);
    joints
        .filter(|joint| {
            dynamics
                .as_ref()
                .is_some_and(|dynamics| dynamics.simulates(*joint))
        })
        .collect()
}

/// # Errors
/// When there is no such group.
pub(super) fn group(scene: &Scene, handle: Number) -> Result<&IkGroup> {
    Ok(scene
        .ik_groups()
        .get(handle.0)
        .ok_or(SceneError::NoSuchIkGroup)?)
}

/// Removes a group of inverse kinematics of V-REP.
///
/// @param ikGroupHandle the group, or sim.handle_all
/// @return result 1
#[api("sim.removeIkGroup")]
fn remove_ik_group(cx: &mut Cx, ik_group_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    match with_explicit(ik_group_handle.0) {
        Some(_) => scene.ik_groups_mut().clear(),
        None => drop(
            scene
                .ik_groups_mut()
                .remove(ik_group_handle.0)
                .ok_or(SceneError::NoSuchIkGroup)?,
        ),
    }
    Ok(1)
}

/// Creates a group of inverse kinematics of V-REP. It moves joints whose mode is sim.jointmode_ik. The scene keeps it, and files do without its options.
///
/// @param options bit 0: disabled; bit 1: steps of joints are not limited; bits 2 and 3: joints return to where they were when the linear or
/// the angular precision is missed
/// @param intParams sim.ik_*_method, and at most how many iterations
/// @param floatParams the damping of damped least squares
/// @return ikGroupHandle its handle
#[api("sim.createIkGroup")]
fn create_ik_group(
    cx: &mut Cx,
    options: Number,
    #[default(None)] int_params: Option<Vec<i64>>,
    #[default(None)] float_params: Option<Vec<f64>>,
) -> Result<i64> {
    let mut group = IkGroup::new(NAME);
    let bit = |bit: u32| options.0 >> bit & 1 == 1;
    group.options = IkGroupOptions {
        enabled: !bit(0),
        ignores_max_steps: bit(1),
        restores_on_bad_linear: bit(2),
        restores_on_bad_angular: bit(3),
    };
    if let Some([method, iterations, ..]) = int_params.as_deref() {
        (group.method, group.max_iterations) = (method_of(*method)?, iterations_of(*iterations));
    }
    if let Some(damping) = float_params.as_ref().and_then(|params| params.first()) {
        group.damping = finite(*damping)?;
    }
    Ok(cx.scene_mut().ik_groups_mut().add(group))
}

fn method_of(raw: i64) -> Result<i32> {
    Ok(groups::method(raw).ok_or(SceneError::InvalidArgument)?)
}

fn iterations_of(raw: i64) -> i32 {
    i32::try_from(raw.max(1)).unwrap_or(i32::MAX)
}

fn finite(number: f64) -> Result<f64> {
    Some(number)
        .filter(|number| number.is_finite())
        .ok_or(SceneError::InvalidArgument.into())
}

/// Adds a tip to a group of inverse kinematics of V-REP. The dummy that is linked with it is its target.
///
/// @param ikGroupHandle the group
/// @param options bit 0: disabled
/// @param intParams the tip; the base of the chain, -1 for the world; the frame of the constraints, -1 for that of the base; sim.ik_*_constraint
/// @param floatParams precisions (m, rad) and weights of position and orientation
/// @return result 1
#[api("sim.createIkElement")]
fn create_ik_element(
    cx: &mut Cx,
    ik_group_handle: Number,
    options: Number,
    int_params: Vec<i64>,
    #[default(None)] float_params: Option<Vec<f64>>,
) -> Result<i64> {
    let [tip, base, frame, constraints] = *int_params.first_chunk().ok_or(ApiError::TableSize)?;
    let mut scene = cx.scene_mut();
    group(&scene, ik_group_handle)?;
    let tip = existing(&scene, tip)?;
    scene.object(tip)?.dummy()?;
    let optional = |raw| {
        if raw == special::WORLD {
            Ok(None)
        } else {
            existing(&scene, raw).map(Some)
        }
    };
    let mut element = IkElement {
        base: optional(base)?,
        constraint_base: optional(frame)?,
        constraints: groups::constraints(constraints),
        enabled: options.0 & 1 == 0,
        ..IkElement::new(tip)
    };
    if let Some(params) = float_params {
        let [linear, angular, position, orientation] =
            *params.first_chunk().ok_or(ApiError::TableSize)?;
        element.precisions = [finite(angular)?, finite(linear)?];
        element.weights = [finite(position)?, finite(orientation)?];
    }
    let all = scene.ik_groups_mut();
    all.get_mut(ik_group_handle.0)
        .ok_or(SceneError::NoSuchIkGroup)?
        .elements
        .push(element);
    Ok(1)
}

fn existing(scene: &Scene, raw: i64) -> Result<Handle> {
    let handle = Handle::from_raw(raw).filter(|handle| scene.exists(*handle));
    Ok(handle.ok_or(SceneError::NoSuchObject)?)
}

/// Sets how a group of inverse kinematics of V-REP is computed.
///
/// @param ikGroupHandle the group
/// @param resolutionMethod sim.ik_*_method
/// @param maxIterations at most that many
/// @param damping of damped least squares
/// @return result 1
#[api("sim.setIkGroupProperties")]
fn set_ik_group_properties(
    cx: &mut Cx,
    ik_group_handle: Number,
    resolution_method: Number,
    max_iterations: Number,
    damping: f64,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let group = scene
        .ik_groups_mut()
        .get_mut(ik_group_handle.0)
        .ok_or(SceneError::NoSuchIkGroup)?;
    let (method, damping) = (method_of(resolution_method.0)?, finite(damping)?);
    (group.method, group.max_iterations, group.damping) =
        (method, iterations_of(max_iterations.0), damping);
    Ok(1)
}

/// Sets what a tip of a group of inverse kinematics of V-REP has to reach.
///
/// @param ikGroupHandle the group
/// @param tipDummyHandle the tip
/// @param constraints sim.ik_*_constraint
/// @param precision of position and orientation (m, rad); nil leaves them
/// @param weight of position and orientation; nil leaves them
/// @return result 1
#[api("sim.setIkElementProperties")]
fn set_ik_element_properties(
    cx: &mut Cx,
    ik_group_handle: Number,
    tip_dummy_handle: Number,
    constraints: Number,
    #[default(None)] precision: Option<[f64; 2]>,
    #[default(None)] weight: Option<[f64; 2]>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let group = scene
        .ik_groups_mut()
        .get_mut(ik_group_handle.0)
        .ok_or(SceneError::NoSuchIkGroup)?;
    let is_meant = |element: &&mut IkElement| element.tip.raw() == tip_dummy_handle.0;
    let element = group.elements.iter_mut().find(is_meant);
    let element = element.ok_or_else(|| ApiError::Other("IK element does not exist.".into()))?;
    if precision
        .iter()
        .chain(&weight)
        .flatten()
        .any(|number| !number.is_finite())
    {
        return Err(SceneError::InvalidArgument.into());
    }
    element.constraints = groups::constraints(constraints.0);
    element.precisions =
        precision.map_or(element.precisions, |[linear, angular]| [angular, linear]);
    element.weights = weight.unwrap_or(element.weights);
    Ok(1)
}
