//! `simIK.*`: elements of groups.

use api_macro::api;
use kinematics::{Constraints, Element, ElementId, Environment, GroupId, KinematicsError};

use super::groups::group;
use super::{ApiFn, Cx, Result, finite, functions, object, optional, raw, with};
use crate::ApiError;
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    add_element,
    get_element_base,
    set_element_base,
    get_element_constraints,
    set_element_constraints,
    get_element_flags,
    set_element_flags,
    get_element_precision,
    set_element_precision,
    get_element_weights,
    set_element_weights,
];

/// `simIK.handleflag_tipdummy`: the handle is that of the tip.
const TIP: i64 = 0x40_0000;

fn element(env: &Environment, group: GroupId, raw: i64) -> kinematics::Result<ElementId> {
    if raw >= 0 && raw & TIP != 0 {
        return env.element_of_tip(group, object(raw & !TIP)?);
    }
    ElementId::from_raw(raw).ok_or(KinematicsError::NoSuchElement)
}

fn read<R>(cx: &Cx, place: [Number; 3], read: impl FnOnce(&Element) -> R) -> Result<R> {
    with(cx, place[0].0, |held| {
        let group = group(place[1].0)?;
        held.env
            .element(group, element(&held.env, group, place[2].0)?)
            .map(read)
    })
}

fn change(cx: &Cx, place: [Number; 3], change: impl FnOnce(&mut Element)) -> Result<()> {
    with(cx, place[0].0, |held| {
        let group = group(place[1].0)?;
        let id = element(&held.env, group, place[2].0)?;
        held.env.element_mut(group, id).map(change)
    })
}

/// Adds a tip to a group. Its target is its linked dummy: simIK.setTargetDummy.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param tipDummyHandle the tip
/// @return elementHandle the element
#[api("simIK.addElement")]
fn add_element(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    tip_dummy_handle: Number,
) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        held.env
            .add_element(group(ik_group_handle.0)?, object(tip_dummy_handle.0)?)
            .map(ElementId::raw)
    })
}

/// Where the chain of an element begins.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @return baseHandle -1 for the world
/// @return constraintsBaseHandle the frame of the constraints, -1 for the base
#[api("simIK.getElementBase")]
fn get_element_base(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
) -> Result<(i64, i64)> {
    read(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| (raw(element.base), raw(element.constraint_base)),
    )
}

/// Sets where the chain of an element begins.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @param baseHandle an object below which the chain begins, -1 for the world
/// @param constraintsBaseHandle the frame of the constraints, -1 for the base
#[api("simIK.setElementBase")]
fn set_element_base(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
    base_handle: Number,
    #[default(-1)] constraints_base_handle: Number,
) -> Result<()> {
    let bases = with(cx, environment_handle.0, |held| {
        let bases = [
            optional(base_handle.0)?,
            optional(constraints_base_handle.0)?,
        ];
        bases
            .into_iter()
            .flatten()
            .try_for_each(|base| held.env.object(base).map(drop))?;
        Ok(bases)
    })?;
    change(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| {
            [element.base, element.constraint_base] = bases;
        },
    )
}

/// What a tip has in common with its target.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @return constraints simIK.constraint_*
#[api("simIK.getElementConstraints")]
fn get_element_constraints(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
) -> Result<i64> {
    read(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.constraints.0.into(),
    )
}

/// Sets what a tip has in common with its target.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @param constraints simIK.constraint_*
#[api("simIK.setElementConstraints")]
fn set_element_constraints(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
    constraints: Number,
) -> Result<()> {
    change(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| {
            element.constraints = Constraints(constraints.0 as u32 & Constraints::POSE.0);
        },
    )
}

/// Flags of an element.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @return flags 1 if it is enabled, else 0
#[api("simIK.getElementFlags")]
fn get_element_flags(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
) -> Result<i64> {
    read(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.enabled.into(),
    )
}

/// Sets the flags of an element.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @param flags bit 0: it is enabled
#[api("simIK.setElementFlags")]
fn set_element_flags(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
    flags: Number,
) -> Result<()> {
    change(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.enabled = flags.0 & 1 != 0,
    )
}

/// How close a tip has to come to its target.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @return precision metres, radians
#[api("simIK.getElementPrecision")]
fn get_element_precision(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
) -> Result<[f64; 2]> {
    read(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.precision,
    )
}

/// Sets how close a tip has to come to its target.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @param precision metres, radians
#[api("simIK.setElementPrecision")]
fn set_element_precision(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
    precision: [f64; 2],
) -> Result<()> {
    let precision = finite(precision)?;
    change(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.precision = precision,
    )
}

/// How much errors of an element count.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @return weights factors of linear errors, of angular errors, of both
#[api("simIK.getElementWeights")]
fn get_element_weights(
    cx: &Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
) -> Result<[f64; 3]> {
    read(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| element.weights,
    )
}

/// Sets how much errors of an element count.
///
/// @param environmentHandle the environment
/// @param ikGroupHandle the group
/// @param elementHandle the element; or its tip, with simIK.handleflag_tipdummy
/// @param weights factors of linear errors, of angular errors, and, if there is a third, of both
#[api("simIK.setElementWeights")]
fn set_element_weights(
    cx: &mut Cx,
    environment_handle: Number,
    ik_group_handle: Number,
    element_handle: Number,
    weights: Vec<f64>,
) -> Result<()> {
    finite(weights.as_slice())?;
    let [linear, angular] = *weights.first_chunk::<2>().ok_or(ApiError::TableSize)?;
    let both = weights.get(2).copied().unwrap_or(1.0);
    change(
        cx,
        [environment_handle, ik_group_handle, element_handle],
        |element| {
            element.weights = [linear, angular, both];
        },
    )
}
