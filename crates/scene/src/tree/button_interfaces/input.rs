//! What users do with user interfaces of V-REP, and the events that scripts read of it.

use std::collections::VecDeque;

use super::{Button, ButtonInterface, ButtonInterfaces, ButtonKind, button_property, ui_property};
use crate::{Handle, Scene};

/// Events of a user interface that may wait for scripts; further inputs are refused.
const MAX_WAITING: usize = 1000;

/// What a user does with a button, slider or edit box.
#[derive(Debug, Clone, PartialEq)]
pub enum ButtonInput {
    /// The button goes down (true) or up.
    Hold(bool),
    /// Down and up again.
    Click,
    /// A slider goes to a position, 0 to 1000.
    Slide(i64),
    /// A text is entered into an edit box.
    Enter(String),
}

/// A button that a user operated, in its state after that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ButtonEvent {
    /// Which scripts call the button by.
    pub number: i32,
    /// Attributes of the button after the event, see [`Button::attributes`].
    pub attributes: i32,
    /// Of a slider its position, 0 to 1000; else 0.
    pub slider: i64,
}

/// Events of one user interface: scripts see one for each pass of the simulator.
#[derive(Debug, Clone, Default)]
pub(super) struct Events {
    current: Option<ButtonEvent>,
    waiting: VecDeque<ButtonEvent>,
}

impl Button {
    /// Applies an input and returns whether scripts get an event. None if it takes no such input.
    fn take(&mut self, input: ButtonInput) -> Option<bool> {
        match (self.kind(), input) {
            (ButtonKind::Button, ButtonInput::Hold(down)) => Some(self.hold(down)),
            (ButtonKind::Slider, ButtonInput::Slide(position)) => {
                self.set_slider_position(position).ok().map(|()| true)
            }
            (ButtonKind::EditBox, ButtonInput::Enter(text)) => {
                self.label = text;
                Some(true)
            }
            _ => None,
        }
    }

    /// One that stays down changes when it is pressed. Others are down while they are held, and have an event when they are released.
    fn hold(&mut self, down: bool) -> bool {
        let was_down = self.has(button_property::IS_DOWN);
        if self.has(button_property::STAY_DOWN) {
            self.attributes ^= if down { button_property::IS_DOWN } else { 0 };
            return down;
        }
        if down {
            self.attributes |= button_property::IS_DOWN;
            return !was_down && self.has(button_property::DOWN_UP_EVENT);
        }
        self.attributes &= !button_property::IS_DOWN;
        was_down
    }

    fn event(&self) -> ButtonEvent {
        let slider = self.slider_position().unwrap_or(0);
        ButtonEvent {
            number: self.number,
            attributes: self.attributes,
            slider,
        }
    }

    fn refusal(&self) -> Option<String> {
        let what = self.number;
        if !self.has(button_property::ENABLED) {
            return Some(format!("button {what} is disabled"));
        }
        self.has(button_property::IGNORE_MOUSE)
            .then(|| format!("button {what} takes no inputs"))
    }
}

impl ButtonInterface {
    /// What a button does to the user interface itself when it is released.
    fn act(&mut self, attributes: i32) {
        if attributes & button_property::CLOSE_ACTION != 0 {
            self.attributes &= !ui_property::VISIBLE;
        }
        if attributes & button_property::ROLL_UP_ACTION != 0 {
            self.attributes ^= ui_property::ROLLED_UP;
        }
    }
}

impl Scene {
    /// Whether a page shows a user interface: some only while their object is selected.
    pub fn shows_button_interface(&self, interface: &ButtonInterface) -> bool {
        let has = |property| interface.attributes & property != 0;
        let is_selected = |object: Handle| self.selection().contains(&object);
        has(ui_property::VISIBLE)
            && (!has(ui_property::VISIBLE_WHEN_OBJECT_SELECTED)
                || interface.object.is_none_or(is_selected))
    }

    /// Applies what a user does with a button; scripts see the event in the next pass (spec: vrep-era 2.6).
    ///
    /// # Errors
    /// Why it is refused.
    pub fn use_button(
        &mut self,
        handle: i64,
        number: i64,
        input: ButtonInput,
    ) -> Result<(), String> {
        let interface = self
            .button_interfaces
            .get(handle)
            .map_err(|error| error.to_string())?;
        if !self.shows_button_interface(interface) {
            return Err(format!("'{}' is not visible", interface.name));
        }
        let object = interface
            .object
            .filter(|_| interface.attributes & ui_property::SELECT_ASSOCIATED_OBJECT != 0);
        if input == ButtonInput::Click {
            self.button_interfaces
                .take(handle, number, ButtonInput::Hold(true))?;
            self.button_interfaces
                .take(handle, number, ButtonInput::Hold(false))?;
        } else {
            self.button_interfaces.take(handle, number, input)?;
        }
        if let Some(object) = object {
            self.select(&[object]);
        }
        Ok(())
    }
}

impl ButtonInterfaces {
    fn take(&mut self, handle: i64, number: i64, input: ButtonInput) -> Result<(), String> {
        let waiting = self
            .events
            .get(&handle)
            .map_or(0, |events| events.waiting.len());
        if waiting >= MAX_WAITING {
            return Err("too many inputs are waiting for the simulator".into());
        }
        let is_release = input == ButtonInput::Hold(false);
        let interface = self.get_mut(handle).map_err(|error| error.to_string())?;
        let button = interface
            .button_mut(number)
            .map_err(|error| error.to_string())?;
        if let Some(reason) = button.refusal() {
            return Err(reason);
        }
        let raises = button
            .take(input)
            .ok_or_else(|| format!("button {number} does not take this input"))?;
        let event = button.event();
        if is_release {
            interface.act(event.attributes);
        }
        if raises {
            self.events
                .entry(handle)
                .or_default()
                .waiting
                .push_back(event);
        }
        Ok(())
    }

    /// The event that scripts see in this pass.
    pub fn event(&self, handle: i64) -> Option<ButtonEvent> {
        self.events.get(&handle)?.current
    }

    /// A new pass begins: of each user interface scripts see the next event, if there is one.
    pub fn next_pass(&mut self) {
        self.events.retain(|_, events| {
            events.current = events.waiting.pop_front();
            events.current.is_some()
        });
    }
}
