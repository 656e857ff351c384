//! `simUI.*`: widgets with one value.

use api_macro::api;

use super::arguments::WindowHandle;
use crate::{ApiFn, Cx, Result, functions};
use ui::{Button, Checkbox, Edit, Label, Radiobutton, Slider, Spinbox, TextBrowser};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    set_button_text,
    set_button_pressed,
    get_slider_value,
    set_slider_value,
    get_spinbox_value,
    set_spinbox_value,
    get_edit_value,
    set_edit_value,
    get_current_edit_widget,
    set_current_edit_widget,
    get_checkbox_value,
    set_checkbox_value,
    get_radiobutton_value,
    set_radiobutton_value,
    get_label_text,
    set_label_text,
    set_progress,
    set_text,
    append_text,
    set_url,
];

/// Sets the text of a button.
///
/// @param handle the window
/// @param id the button
/// @param text
#[api("simUI.setButtonText")]
fn set_button_text(cx: &mut Cx, handle: WindowHandle, id: i64, text: String) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Button>(id)?.text = text;
        Ok(())
    })
}

/// Presses or releases a checkable button. Handlers do not learn of it.
///
/// @param handle the window
/// @param id the button
/// @param pressed
#[api("simUI.setButtonPressed")]
fn set_button_pressed(cx: &mut Cx, handle: WindowHandle, id: i64, pressed: bool) -> Result<()> {
    cx.change_window(&handle.0, |window| window.set_button_pressed(id, pressed))
}

/// The value of a slider.
///
/// @param handle the window
/// @param id the slider
/// @return value
#[api("simUI.getSliderValue")]
fn get_slider_value(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| Ok(window.get::<Slider>(id)?.value))
}

/// Sets the value of a slider, within its limits.
///
/// @param handle the window
/// @param id the slider
/// @param value
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setSliderValue")]
fn set_slider_value(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    value: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_slider(id, value, !suppress_events)
    })
}

/// The value of a spin box.
///
/// @param handle the window
/// @param id the spin box
/// @return value
#[api("simUI.getSpinboxValue")]
fn get_spinbox_value(cx: &Cx, handle: WindowHandle, id: i64) -> Result<f64> {
    cx.read_window(&handle.0, |window| Ok(window.get::<Spinbox>(id)?.value))
}

/// Sets the value of a spin box, within its limits; one of integers drops the fraction.
///
/// @param handle the window
/// @param id the spin box
/// @param value
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setSpinboxValue")]
fn set_spinbox_value(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    value: f64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_spinbox(id, value, !suppress_events)
    })
}

/// The text of an edit.
///
/// @param handle the window
/// @param id the edit
/// @return value
#[api("simUI.getEditValue")]
fn get_edit_value(cx: &Cx, handle: WindowHandle, id: i64) -> Result<String> {
    cx.read_window(&handle.0, |window| {
        Ok(window.get::<Edit>(id)?.value.clone())
    })
}

/// Sets the text of an edit.
///
/// @param handle the window
/// @param id the edit
/// @param value
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setEditValue")]
fn set_edit_value(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    value: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_edit(id, value, !suppress_events)
    })
}

/// The edit whose text is selected.
///
/// @param handle the window
/// @return id -1 for none
#[api("simUI.getCurrentEditWidget")]
fn get_current_edit_widget(cx: &Cx, handle: WindowHandle) -> Result<i64> {
    cx.read_window(&handle.0, |window| {
        Ok(window
            .all::<Edit>()
            .find(|(_, edit)| edit.selected)
            .map_or(-1, |(id, _)| id))
    })
}

/// Selects the text of an edit.
///
/// @param handle the window
/// @param id the edit; -1 changes nothing
#[api("simUI.setCurrentEditWidget")]
fn set_current_edit_widget(cx: &mut Cx, handle: WindowHandle, id: i64) -> Result<()> {
    cx.change_window(&handle.0, |window| window.select_edit(id))
}

/// Whether a check box is checked.
///
/// @param handle the window
/// @param id the check box
/// @return value 0, 1 for partially, 2
#[api("simUI.getCheckboxValue")]
fn get_checkbox_value(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| Ok(window.get::<Checkbox>(id)?.value))
}

/// Checks a check box or clears it.
///
/// @param handle the window
/// @param id the check box
/// @param value 0, 1 for partially, 2
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setCheckboxValue")]
fn set_checkbox_value(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    value: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_checkbox(id, value, !suppress_events)
    })
}

/// Whether a radio button is checked.
///
/// @param handle the window
/// @param id the radio button
/// @return value 0 or 1
#[api("simUI.getRadiobuttonValue")]
fn get_radiobutton_value(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| {
        Ok(window.get::<Radiobutton>(id)?.checked.into())
    })
}

/// Checks a radio button, which clears those beside it.
///
/// @param handle the window
/// @param id the radio button
/// @param value 1; 0 has no effect on one that excludes others
/// @param suppressEvents without effect
#[api("simUI.setRadiobuttonValue")]
fn set_radiobutton_value(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    value: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| window.set_radiobutton(id, value))
}

/// The text of a label.
///
/// @param handle the window
/// @param id the label
/// @return text
#[api("simUI.getLabelText")]
fn get_label_text(cx: &Cx, handle: WindowHandle, id: i64) -> Result<String> {
    cx.read_window(&handle.0, |window| {
        Ok(window.get::<Label>(id)?.text.clone())
    })
}

/// Sets the text of a label.
///
/// @param handle the window
/// @param id the label
/// @param text may be HTML
/// @param suppressEvents without effect
#[api("simUI.setLabelText")]
fn set_label_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    text: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| window.set_label(id, text))
}

/// Sets the value of a progress bar; one outside of its limits is ignored.
///
/// @param handle the window
/// @param id the progress bar
/// @param value
#[api("simUI.setProgress")]
fn set_progress(cx: &mut Cx, handle: WindowHandle, id: i64, value: i64) -> Result<()> {
    cx.change_window(&handle.0, |window| window.set_progress(id, value))
}

/// Sets the text of a text browser.
///
/// @param handle the window
/// @param id the text browser
/// @param text in the language of the browser's type
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setText")]
fn set_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    text: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_browser_text(id, text, !suppress_events)
    })
}

/// Adds to the text of a text browser. No new line begins.
///
/// @param handle the window
/// @param id the text browser
/// @param text
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.appendText")]
fn append_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    text: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        let longer = format!("{}{text}", window.get::<TextBrowser>(id)?.text);
        window.set_browser_text(id, longer, !suppress_events)
    })
}

/// Shows what is at an address in a text browser. The address is kept for pages; nothing is loaded.
///
/// @param handle the window
/// @param id the text browser
/// @param url
#[api("simUI.setUrl")]
fn set_url(cx: &mut Cx, handle: WindowHandle, id: i64, url: String) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<TextBrowser>(id)?.url = url;
        Ok(())
    })
}
