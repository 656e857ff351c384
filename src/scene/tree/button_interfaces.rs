//! The custom user interfaces of V-REP: grids of buttons, labels, sliders and edit boxes. Files of old scenes contain them; no function makes
//! new ones (spec: vrep-era 2.6).

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::{Handle, Scene, SceneError, SceneResult};

const FIRST_HANDLE: i64 = 2_060_006;
/// Of the attributes of a button: its type.
const TYPE_BITS: i32 = 3;
const SLIDER: i32 = 2;
/// Half of the range that scripts see, 0 to 1000.
const SLIDER_HALF: f64 = 500.0;

/// A user interface. Sizes and positions are in pixels of the window unless they are counted in cells.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ButtonInterface {
    pub name: String,
    /// `sim.ui_property_*`.
    pub attributes: i32,
    /// Columns and rows.
    pub cells: [i32; 2],
    pub position: [i32; 2],
    /// Width and height of a cell.
    pub cell_size: [i32; 2],
    /// The page of the window on which it is.
    pub view: i32,
    /// It is removed together with this object.
    pub object: Option<Handle>,
    /// Where it was before it was rolled up.
    pub rollup: [i32; 4],
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
    pub label: String,
    /// Shown while it is down.
    pub down_label: String,
    /// Of the slider, -1 to 1.
    pub slider: f64,
    /// Red, green, blue of the button when up, when down, and of the label, 0 to 1.
    pub colours: [f32; 9],
}

impl Button {
    pub fn is_slider(&self) -> bool {
        self.attributes & TYPE_BITS == SLIDER
    }

    /// The position of a slider from 0 to 1000.
    ///
    /// # Errors
    /// When it is no slider.
    pub fn slider_position(&self) -> SceneResult<i64> {
        if self.is_slider() { Ok(((self.slider + 1.0) * SLIDER_HALF) as i64) } else { Err(SceneError::NotASlider) }
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
    /// # Errors
    /// When no button has that number.
    pub fn button(&self, number: i64) -> SceneResult<&Button> {
        let found = self.buttons.iter().find(|button| i64::from(button.number) == number);
        found.ok_or(SceneError::NoSuchButton)
    }

    /// # Errors
    /// When no button has that number.
    pub fn button_mut(&mut self, number: i64) -> SceneResult<&mut Button> {
        let found = self.buttons.iter_mut().find(|button| i64::from(button.number) == number);
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
}

impl ButtonInterfaces {
    /// Adds one; where its name is taken it gets a number.
    pub fn add(&mut self, mut interface: ButtonInterface) -> i64 {
        interface.name = super::old_names::free_name(interface.name, |name| self.named(name).is_some());
        let handle = FIRST_HANDLE + self.made;
        self.made += 1;
        self.by_handle.insert(handle, interface);
        handle
    }

    /// The handle of the one with that name.
    pub fn named(&self, name: &str) -> Option<i64> {
        self.by_handle.iter().find(|(_, interface)| interface.name == name).map(|(handle, _)| *handle)
    }

    /// # Errors
    /// When there is no such user interface.
    pub fn get(&self, handle: i64) -> SceneResult<&ButtonInterface> {
        self.by_handle.get(&handle).ok_or(SceneError::NoSuchInterface)
    }

    /// # Errors
    /// When there is no such user interface.
    pub fn get_mut(&mut self, handle: i64) -> SceneResult<&mut ButtonInterface> {
        self.by_handle.get_mut(&handle).ok_or(SceneError::NoSuchInterface)
    }

    /// With their handles, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &ButtonInterface)> {
        self.by_handle.iter().map(|(handle, interface)| (*handle, interface))
    }

    /// # Errors
    /// When there is no such user interface.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        self.by_handle.remove(&handle).map(|_| ()).ok_or(SceneError::NoSuchInterface)
    }

    pub fn remove_all(&mut self) {
        self.by_handle.clear();
    }

    /// Removes those of objects that are removed.
    pub(in crate::scene) fn forget(&mut self, doomed: &BTreeSet<Handle>) {
        self.by_handle.retain(|_, interface| !interface.object.is_some_and(|object| doomed.contains(&object)));
    }
}

impl Scene {
    pub fn button_interfaces(&self) -> &ButtonInterfaces {
        &self.button_interfaces
    }

    pub fn button_interfaces_mut(&mut self) -> &mut ButtonInterfaces {
        &mut self.button_interfaces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliders_have_positions_and_other_buttons_have_none() {
        let mut slider = Button { attributes: SLIDER | 0x10, ..Button::default() };
        assert_eq!(slider.slider_position(), Ok(500));
        for (position, expected) in [(0, 0), (250, 250), (1000, 1000), (i64::MAX, 1000), (-7, 0)] {
            slider.set_slider_position(position).expect("a slider");
            assert_eq!(slider.slider_position(), Ok(expected));
        }
        let mut label = Button { attributes: 1, ..Button::default() };
        assert_eq!(label.slider_position(), Err(SceneError::NotASlider));
        assert_eq!(label.set_slider_position(3), Err(SceneError::NotASlider));
    }

    #[test]
    fn interfaces_are_removed_with_their_object() {
        let mut interfaces = ButtonInterfaces::default();
        let of = |object| ButtonInterface { name: "panel".into(), object, ..ButtonInterface::default() };
        let handles = [of(None), of(Some(Handle(3))), of(Some(Handle(4)))].map(|interface| interfaces.add(interface));
        assert_eq!(handles, [2_060_006, 2_060_007, 2_060_008]);
        assert_eq!(interfaces.named("panel0"), Some(2_060_007));
        interfaces.forget(&BTreeSet::from([Handle(3)]));
        assert_eq!(interfaces.iter().map(|(handle, _)| handle).collect::<Vec<_>>(), [2_060_006, 2_060_008]);
        assert_eq!(interfaces.remove(2_060_007), Err(SceneError::NoSuchInterface));
        assert_eq!(interfaces.add(of(None)), 2_060_009);
    }
}
