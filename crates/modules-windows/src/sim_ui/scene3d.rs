//! `simUI.*`: scenes in windows. Their nodes are kept, not drawn.

use api_macro::api;

use super::arguments::WindowHandle;
use crate::{ApiFn, Cx, Result, functions};
use scene::Data;
use ui::Scene3d;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    add_scene_3d_node,
    remove_scene_3d_node,
    set_scene_3d_node_enabled,
    set_scene_3d_node_int_param,
    set_scene_3d_node_float_param,
    set_scene_3d_node_string_param,
    set_scene_3d_node_vector2_param,
    set_scene_3d_node_vector3_param,
    set_scene_3d_node_vector4_param,
];

/// Adds a node to a scene.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param parentNodeId -1 for the root
/// @param type simUI.scene3d_node_type
#[api("simUI.addScene3DNode")]
fn add_scene_3d_node(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    parent_node_id: i64,
    r#type: i64,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Scene3d>(id)?
            .add(node_id, parent_node_id, r#type)
    })
}

/// Looks whether there is such a node, and does nothing, as in CoppeliaSim.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
#[api("simUI.removeScene3DNode")]
fn remove_scene_3d_node(cx: &mut Cx, handle: WindowHandle, id: i64, node_id: i64) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Scene3d>(id)?.node_mut(node_id).map(|_| ())
    })
}

/// Switches a node on or off.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param enabled
#[api("simUI.setScene3DNodeEnabled")]
fn set_scene_3d_node_enabled(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    enabled: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Scene3d>(id)?.node_mut(node_id)?.enabled = enabled;
        Ok(())
    })
}

fn set_param(
    cx: &mut Cx,
    handle: &WindowHandle,
    id: i64,
    node: i64,
    name: String,
    value: Data,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Scene3d>(id)?
            .node_mut(node)?
            .params
            .insert(name, value);
        Ok(())
    })
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param value
#[api("simUI.setScene3DNodeIntParam")]
fn set_scene_3d_node_int_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    value: i64,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, Data::Int(value))
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param value
#[api("simUI.setScene3DNodeFloatParam")]
fn set_scene_3d_node_float_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    value: f64,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, Data::Float(value))
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param value
#[api("simUI.setScene3DNodeStringParam")]
fn set_scene_3d_node_string_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    value: String,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, Data::text(&value))
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param x
/// @param y
#[api("simUI.setScene3DNodeVector2Param")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_scene_3d_node_vector2_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    x: f64,
    y: f64,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, [x, y].into())
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param x
/// @param y
/// @param z
#[api("simUI.setScene3DNodeVector3Param")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_scene_3d_node_vector3_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    x: f64,
    y: f64,
    z: f64,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, [x, y, z].into())
}

/// Sets a parameter of a node.
///
/// @param handle the window
/// @param id the scene3d widget
/// @param nodeId its number
/// @param paramName
/// @param x
/// @param y
/// @param z
/// @param w
#[api("simUI.setScene3DNodeVector4Param")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_scene_3d_node_vector4_param(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    node_id: i64,
    param_name: String,
    x: f64,
    y: f64,
    z: f64,
    w: f64,
) -> Result<()> {
    set_param(cx, &handle, id, node_id, param_name, [x, y, z, w].into())
}
