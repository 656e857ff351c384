//! The custom user interfaces of V-REP: grids of buttons, labels, sliders and edit boxes. Files of old scenes contain them; no function makes
//! new ones (spec: vrep-era 2.6).

mod input;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use crate::{Handle, Scene, SceneError, SceneResult};
use input::Events;
pub use input::{ButtonEvent, ButtonInput};

const FIRST_HANDLE: i64 = 2_060_006;
/// Of the attributes of a button: its type.
const TYPE_BITS: i32 = 3;
const LABEL: i32 = 1;
const SLIDER: i32 = 2;
const EDIT_BOX: i32 = 3;

/// Further bits of a button: `sim.buttonproperty_*`.
pub mod button_property {
    /// It stays down when it is pressed, until it is pressed again.
    pub const STAY_DOWN: i32 = 0x8;
    /// It takes inputs.
    pub const ENABLED: i32 = 0x10;
    /// It is drawn without a border.
    pub const BORDERLESS: i32 = 0x20;
    /// Mouse clicks pass through it.
    pub const IGNORE_MOUSE: i32 = 0x80;
    /// It is down.
    pub const IS_DOWN: i32 = 0x100;
    /// What is behind it can be seen.
    pub const TRANSPARENT: i32 = 0x200;
    /// It is drawn without a background colour.
    pub const NO_BACKGROUND_COLOR: i32 = 0x400;
    /// It rolls the user interface up.
    pub const ROLL_UP_ACTION: i32 = 0x800;
    /// It closes the user interface.
    pub const CLOSE_ACTION: i32 = 0x1000;
    /// It has an event when it goes down too, not only when it goes up.
    pub const DOWN_UP_EVENT: i32 = 0x4000;
}

/// Bits of a user interface: `sim.ui_property_*`.
pub mod ui_property {
    /// It is shown.
    pub const VISIBLE: i32 = 0x1;
    /// Only its title is shown.
    pub const ROLLED_UP: i32 = 0x80;
    /// A click on it selects the object it belongs to.
    pub const SELECT_ASSOCIATED_OBJECT: i32 = 0x100;
    /// It is shown only while the object it belongs to is selected.
    pub const VISIBLE_WHEN_OBJECT_SELECTED: i32 = 0x200;
}
/// Half of the range that scripts see, 0 to 1000.
const SLIDER_HALF: f64 = 500.0;

/// A user interface. Sizes and positions are in pixels of the window unless they are counted in cells.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ButtonInterface {
    /// Unique among the user interfaces of the scene.
    pub name: String,
    /// `sim.ui_property_*`.
    pub attributes: i32,
    /// Columns and rows.
    pub cells: [i32; 2],
    /// Where it is in the window.
    pub position: [i32; 2],
    /// Width and height of a cell.
    pub cell_size: [i32; 2],
    /// The page of the window on which it is.
    pub view: i32,
    /// It is removed together with this object.
    pub object: Option<Handle>,
    /// Where it was before it was rolled up.
    pub rollup: [i32; 4],
    /// Buttons, labels, sliders and edit boxes.
    pub buttons: Vec<Button>,
}

/// A button, label, slider or edit box of a user interface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Button {
    /// Which scripts call it by.
    pub number: i32,
    /// Bits 0 and 1: 0 button, 1 label, 2 slider, 3 edit box; then `0x8` stays down, `0x10` enabled, `0x20` borderless, `0x100` is down.
    pub attributes: i32,
    /// Column and row.
    pub cell: [i32; 2],
    /// Columns and rows it covers.
    pub span: [i32; 2],
    /// Text on the button, or in the edit box.
    pub label: String,
    /// Shown while it is down.
    pub down_label: String,
    /// Of the slider, -1 to 1.
    pub slider: f64,
    /// Red, green, blue of the button when up, when down, and of the label, 0 to 1.
    pub colours: [f32; 9],
}

/// What a button is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ButtonKind {
    /// Can be pressed.
    Button,
    /// Only shows a text.
    Label,
    /// Has a position that can be changed.
    Slider,
    /// Contains a text that can be changed.
    EditBox,
}

impl Button {
    /// What it is, by the lowest two bits of its attributes.
    pub fn kind(&self) -> ButtonKind {
        match self.attributes & TYPE_BITS {
            LABEL => ButtonKind::Label,
            SLIDER => ButtonKind::Slider,
            EDIT_BOX => ButtonKind::EditBox,
            _ => ButtonKind::Button,
        }
    }

    /// Whether it has all bits of `property`, one of [`button_property`].
    pub fn has(&self, property: i32) -> bool {
        self.attributes & property == property
    }

    /// Whether it is a slider.
    fn is_slider(&self) -> bool {
        self.attributes & TYPE_BITS == SLIDER
    }

    /// The position of a slider from 0 to 1000.
    ///
    /// # Errors
    /// When it is no slider.
    pub fn slider_position(&self) -> SceneResult<i64> {
        if self.is_slider() {
            Ok(((self.slider + 1.0) * SLIDER_HALF) as i64)
        } else {
            Err(SceneError::NotASlider)
        }
    }

    /// Moves a slider to a position from 0 to 1000; others mean the nearest of these.
    ///
    /// # Errors
    /// When it is no slider.
    pub fn set_slider_position(&mut self, position: i64) -> SceneResult<()> {
        if !self.is_slider() {
            return Err(SceneError::NotASlider);
        }
        self.slider = (position as f64 / SLIDER_HALF - 1.0).clamp(-1.0, 1.0);
        Ok(())
    }
}

impl ButtonInterface {
    /// The button with that number.
    ///
    /// # Errors
    /// When no button has that number.
    pub fn button(&self, number: i64) -> SceneResult<&Button> {
        let found = self
            .buttons
            .iter()
            .find(|button| i64::from(button.number) == number);
        found.ok_or(SceneError::NoSuchButton)
    }

    /// The button with that number, to be changed.
    ///
    /// # Errors
    /// When no button has that number.
    pub fn button_mut(&mut self, number: i64) -> SceneResult<&mut Button> {
        let found = self
            .buttons
            .iter_mut()
            .find(|button| i64::from(button.number) == number);
        found.ok_or(SceneError::NoSuchButton)
    }

    /// Width and height of a button, pixels.
    ///
    /// # Errors
    /// When no button has that number.
    pub fn button_size(&self, number: i64) -> SceneResult<[i64; 2]> {
        let span = self.button(number)?.span;
        Ok([0, 1].map(|axis| i64::from(span[axis]) * i64::from(self.cell_size[axis])))
    }
}

/// All user interfaces of a scene, by their handles.
#[derive(Debug, Clone, Default)]
pub struct ButtonInterfaces {
    by_handle: BTreeMap<i64, ButtonInterface>,
    /// Ever made: no handle is used twice.
    made: i64,
    /// Grows with every change.
    revision: u64,
    /// Events for scripts, by handle.
    events: BTreeMap<i64, Events>,
}

impl ButtonInterfaces {
    /// Adds one; where its name is taken it gets a number.
    pub fn add(&mut self, mut interface: ButtonInterface) -> i64 {
        interface.name =
            super::old_names::free_name(interface.name, |name| self.named(name).is_some());
        let handle = FIRST_HANDLE + self.made;
        self.made += 1;
        self.revision += 1;
        self.by_handle.insert(handle, interface);
        handle
    }

    /// The handle of the one with that name.
    pub fn named(&self, name: &str) -> Option<i64> {
        self.by_handle
            .iter()
            .find(|(_, interface)| interface.name == name)
            .map(|(handle, _)| *handle)
    }

    /// The user interface with that handle.
    ///
    /// # Errors
    /// When there is no such user interface.
    pub fn get(&self, handle: i64) -> SceneResult<&ButtonInterface> {
        self.by_handle
            .get(&handle)
            .ok_or(SceneError::NoSuchInterface)
    }

    /// The user interface with that handle, to be changed.
    ///
    /// # Errors
    /// When there is no such user interface.
    pub fn get_mut(&mut self, handle: i64) -> SceneResult<&mut ButtonInterface> {
        self.revision += 1;
        self.by_handle
            .get_mut(&handle)
            .ok_or(SceneError::NoSuchInterface)
    }

    /// With their handles, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &ButtonInterface)> {
        self.by_handle
            .iter()
            .map(|(handle, interface)| (*handle, interface))
    }

    /// A number that grows with every change.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Removes a user interface.
    ///
    /// # Errors
    /// When there is no such user interface.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        self.revision += 1;
        self.events.remove(&handle);
        self.by_handle
            .remove(&handle)
            .map(|_| ())
            .ok_or(SceneError::NoSuchInterface)
    }

    /// Removes all user interfaces.
    pub fn remove_all(&mut self) {
        self.revision += 1;
        self.events.clear();
        self.by_handle.clear();
    }

    /// Removes those of objects that are removed.
    pub(crate) fn forget(&mut self, removed: &BTreeSet<Handle>) {
        let before = self.by_handle.len();
        self.by_handle.retain(|_, interface| {
            !interface
                .object
                .is_some_and(|object| removed.contains(&object))
        });
        if self.by_handle.len() != before {
            self.revision += 1;
            let kept = &self.by_handle;
            self.events.retain(|handle, _| kept.contains_key(handle));
        }
    }
}

impl Scene {
    /// The user interfaces of the scene.
    pub fn button_interfaces(&self) -> &ButtonInterfaces {
        &self.button_interfaces
    }

    /// The user interfaces of the scene, to be changed.
    pub fn button_interfaces_mut(&mut self) -> &mut ButtonInterfaces {
        &mut self.button_interfaces
    }
}
