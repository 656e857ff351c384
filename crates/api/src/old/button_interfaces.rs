//! The custom user interfaces of V-REP, which old scenes contain: global names only (spec: vrep-era 2.6). Each function has a
//! second name, with `2DElement` instead of `UI`.

use std::cell::{Ref, RefMut};

use api_macro::api;

use crate::objects::old_name::{name_with_suffix, suffix_of_script};
use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::tree::button_interfaces::{Button, ButtonInterface};
use scene::{Scene, SceneError, special};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    sim_get_ui_handle,
    sim_get_ui_property,
    sim_set_ui_property,
    sim_get_ui_button_property,
    sim_set_ui_button_property,
    sim_get_ui_button_label,
    sim_set_ui_button_label,
    sim_get_ui_slider,
    sim_set_ui_slider,
    sim_get_ui_event_button,
    sim_get_ui_position,
    sim_set_ui_position,
    sim_get_ui_button_size,
    sim_set_ui_button_color,
    sim_remove_ui,
];

fn interface<'a>(scene: &'a Ref<'_, Scene>, handle: Number) -> Result<&'a ButtonInterface> {
    Ok(scene.button_interfaces().get(handle.0)?)
}

fn interface_mut<'a>(
    scene: &'a mut RefMut<'_, Scene>,
    handle: Number,
) -> Result<&'a mut ButtonInterface> {
    Ok(scene.button_interfaces_mut().get_mut(handle.0)?)
}

fn button<'a>(scene: &'a Ref<'_, Scene>, handle: Number, number: Number) -> Result<&'a Button> {
    Ok(interface(scene, handle)?.button(number.0)?)
}

fn button_mut<'a>(
    scene: &'a mut RefMut<'_, Scene>,
    handle: Number,
    number: Number,
) -> Result<&'a mut Button> {
    Ok(interface_mut(scene, handle)?.button_mut(number.0)?)
}

/// A custom user interface of an old scene.
///
/// @param elementName its old-style name
/// @return elementHandle its handle
#[api("simGetUIHandle")]
fn sim_get_ui_handle(cx: &Cx, element_name: String) -> Result<i64> {
    let name = name_with_suffix(&element_name, suffix_of_script(cx));
    Ok(cx
        .scene()
        .button_interfaces()
        .named(&name)
        .ok_or(SceneError::NoSuchInterface)?)
}

/// Properties of a user interface.
///
/// @param elementHandle the user interface
/// @return elementProperty sim.ui_property_*
#[api("simGetUIProperty")]
fn sim_get_ui_property(cx: &Cx, element_handle: Number) -> Result<i64> {
    Ok(interface(&cx.scene(), element_handle)?.attributes.into())
}

/// Sets properties of a user interface.
///
/// @param elementHandle the user interface
/// @param elementProperty sim.ui_property_*
/// @return result 1
#[api("simSetUIProperty")]
fn sim_set_ui_property(
    cx: &mut Cx,
    element_handle: Number,
    element_property: Number,
) -> Result<i64> {
    interface_mut(&mut cx.scene_mut(), element_handle)?.attributes =
        numbers::low_i32(element_property.0);
    Ok(1)
}

/// Properties of a button.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @return buttonProperty bits 0 and 1: 0 button, 1 label, 2 slider, 3 edit box; 0x8 stays down, 0x10 enabled, 0x20 borderless, 0x100 is down
#[api("simGetUIButtonProperty")]
fn sim_get_ui_button_property(
    cx: &Cx,
    element_handle: Number,
    button_handle: Number,
) -> Result<i64> {
    Ok(button(&cx.scene(), element_handle, button_handle)?
        .attributes
        .into())
}

/// Sets properties of a button.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @param buttonProperty as simGetUIButtonProperty returns
/// @return result 1
#[api("simSetUIButtonProperty")]
fn sim_set_ui_button_property(
    cx: &mut Cx,
    element_handle: Number,
    button_handle: Number,
    button_property: Number,
) -> Result<i64> {
    button_mut(&mut cx.scene_mut(), element_handle, button_handle)?.attributes =
        numbers::low_i32(button_property.0);
    Ok(1)
}

/// Text of a button, label or edit box.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @return buttonLabel what it shows when it is up
#[api("simGetUIButtonLabel")]
fn sim_get_ui_button_label(
    cx: &Cx,
    element_handle: Number,
    button_handle: Number,
) -> Result<String> {
    Ok(button(&cx.scene(), element_handle, button_handle)?
        .label
        .clone())
}

/// Sets the text of a button, label or edit box.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @param upStateLabel nil: stays as it is
/// @param downStateLabel of a button that is down; nil: stays as it is
/// @return result 1
#[api("simSetUIButtonLabel")]
fn sim_set_ui_button_label(
    cx: &mut Cx,
    element_handle: Number,
    button_handle: Number,
    up_state_label: Option<String>,
    down_state_label: Option<String>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let button = button_mut(&mut scene, element_handle, button_handle)?;
    if let Some(label) = up_state_label {
        button.label = label;
    }
    if let Some(label) = down_state_label {
        button.down_label = label;
    }
    Ok(1)
}

/// Position of a slider.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the slider
/// @return position 0 to 1000
#[api("simGetUISlider")]
fn sim_get_ui_slider(cx: &Cx, element_handle: Number, button_handle: Number) -> Result<i64> {
    Ok(button(&cx.scene(), element_handle, button_handle)?.slider_position()?)
}

/// Moves a slider.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the slider
/// @param position 0 to 1000
/// @return result 1
#[api("simSetUISlider")]
fn sim_set_ui_slider(
    cx: &mut Cx,
    element_handle: Number,
    button_handle: Number,
    position: Number,
) -> Result<i64> {
    button_mut(&mut cx.scene_mut(), element_handle, button_handle)?
        .set_slider_position(position.0)?;
    Ok(1)
}

/// The button that a person used on a page of the viewer: one for each pass of the simulator.
///
/// @param elementHandle the user interface
/// @return buttonHandle its number; -1 for none, without further results
/// @return auxiliaryValues its properties, and of a slider its position, 0 to 1000
#[api("simGetUIEventButton")]
fn sim_get_ui_event_button(cx: &Cx, element_handle: Number) -> Result<(i64, Option<Vec<i64>>)> {
    let scene = cx.scene();
    interface(&scene, element_handle)?;
    Ok(match scene.button_interfaces().event(element_handle.0) {
        Some(event) => (
            event.number.into(),
            Some(vec![event.attributes.into(), event.slider]),
        ),
        None => (-1, None),
    })
}

/// Position of a user interface.
///
/// @param elementHandle the user interface
/// @return position x and y, pixels
#[api("simGetUIPosition")]
fn sim_get_ui_position(cx: &Cx, element_handle: Number) -> Result<Vec<i64>> {
    Ok(interface(&cx.scene(), element_handle)?
        .position
        .map(i64::from)
        .to_vec())
}

/// Moves a user interface.
///
/// @param elementHandle the user interface
/// @param position x and y, pixels
/// @return result 1
#[api("simSetUIPosition")]
fn sim_set_ui_position(cx: &mut Cx, element_handle: Number, position: [f64; 2]) -> Result<i64> {
    interface_mut(&mut cx.scene_mut(), element_handle)?.position =
        position.map(numbers::truncated_i32);
    Ok(1)
}

/// Size of a button.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @return size width and height, pixels
#[api("simGetUIButtonSize")]
fn sim_get_ui_button_size(
    cx: &Cx,
    element_handle: Number,
    button_handle: Number,
) -> Result<Vec<i64>> {
    Ok(interface(&cx.scene(), element_handle)?
        .button_size(button_handle.0)?
        .to_vec())
}

/// Sets colours of a button, each red, green, blue from 0 to 1.
///
/// @param elementHandle the user interface
/// @param buttonHandle number of the button
/// @param upStateColor nil: stays as it is
/// @param downStateColor nil: stays as it is
/// @param labelColor nil: stays as it is
/// @return result 1
#[api("simSetUIButtonColor")]
fn sim_set_ui_button_color(
    cx: &mut Cx,
    element_handle: Number,
    button_handle: Number,
    up_state_color: Option<[f64; 3]>,
    down_state_color: Option<[f64; 3]>,
    label_color: Option<[f64; 3]>,
) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let colours = &mut button_mut(&mut scene, element_handle, button_handle)?.colours;
    for (old, new) in
        colours
            .chunks_exact_mut(3)
            .zip([up_state_color, down_state_color, label_color])
    {
        if let Some(new) = new {
            old.copy_from_slice(&new.map(|value| {
                if value.is_nan() {
                    0.0
                } else {
                    numbers::single(value.clamp(0.0, 1.0))
                }
            }));
        }
    }
    Ok(1)
}

/// Removes user interfaces.
///
/// @param elementHandle the user interface, or sim.handle_all
/// @return result 1
#[api("simRemoveUI")]
fn sim_remove_ui(cx: &mut Cx, element_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    match element_handle.0 {
        special::ALL => scene.button_interfaces_mut().remove_all(),
        handle => scene.button_interfaces_mut().remove(handle)?,
    }
    Ok(1)
}
