//! Functions of V-REP that were never members of `sim`: global names only (spec: vrep-era 2.3).

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{CustomData, Data, Edit, Handle, Namespace};
use script::{Bytes, Number, PropertyTarget};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    sim_add_object_custom_data,
    sim_get_object_custom_data,
    sim_add_scene_custom_data,
    sim_get_scene_custom_data,
    sim_get_system_time_in_milliseconds,
];

fn object_tag(number: i64) -> String {
    format!("_oldObjectCustomData_{number}_")
}

fn scene_tag(number: i64) -> String {
    format!("_oldSceneCustomData_{number}_")
}

fn write(cx: &mut Cx, target: &PropertyTarget, tag: &str, data: Vec<u8>) -> Result<i64> {
    let data = Some(data).filter(|data| !data.is_empty()).map(Data::Buffer);
    cx.edit_named_values(target, Namespace::CustomData, Edit::Tag(tag, data))?;
    Ok(1)
}

fn read(cx: &Cx, target: &PropertyTarget, tag: &str) -> Result<Data> {
    let bytes = |values: &CustomData| match values.get(tag) {
        Some(Data::Buffer(bytes)) => bytes.clone(),
        _ => Vec::new(),
    };
    Ok(Data::Text(cx.named_values(
        target,
        Namespace::CustomData,
        bytes,
    )?))
}

fn object(cx: &Cx, handle: Handle) -> Result<PropertyTarget> {
    cx.scene().object(handle)?;
    Ok(PropertyTarget::Object(handle))
}

/// Writes custom data of an object under a number.
///
/// @param objectHandle the object
/// @param header the number
/// @param data empty: removes the data
/// @return result 1
#[api("simAddObjectCustomData")]
fn sim_add_object_custom_data(
    cx: &mut Cx,
    object_handle: Handle,
    header: Number,
    data: Bytes,
) -> Result<i64> {
    let target = object(cx, object_handle)?;
    write(cx, &target, &object_tag(header.0), data.0)
}

/// Custom data of an object under a number.
///
/// @param objectHandle the object
/// @param header the number
/// @return data empty if there is none
#[api("simGetObjectCustomData")]
fn sim_get_object_custom_data(cx: &Cx, object_handle: Handle, header: Number) -> Result<Data> {
    read(cx, &object(cx, object_handle)?, &object_tag(header.0))
}

/// Writes custom data of the scene under a number.
///
/// @param header the number
/// @param data empty: removes the data
/// @return result 1
#[api("simAddSceneCustomData")]
fn sim_add_scene_custom_data(cx: &mut Cx, header: Number, data: Bytes) -> Result<i64> {
    write(cx, &PropertyTarget::Scene, &scene_tag(header.0), data.0)
}

/// Custom data of the scene under a number.
///
/// @param header the number
/// @return data empty if there is none
#[api("simGetSceneCustomData")]
fn sim_get_scene_custom_data(cx: &Cx, header: Number) -> Result<Data> {
    read(cx, &PropertyTarget::Scene, &scene_tag(header.0))
}

/// Time by the wall clock in milliseconds.
///
/// @param before an earlier time: the difference is returned
/// @return time whole milliseconds
#[api("simGetSystemTimeInMilliseconds")]
fn sim_get_system_time_in_milliseconds(
    cx: &Cx,
    #[default(None)] before: Option<Number>,
) -> Result<i64> {
    let now = numbers::truncated(cx.clock().wall_seconds() * 1000.0);
    Ok(before.map_or(now, |before| now.saturating_sub(before.0)))
}
