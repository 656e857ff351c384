//! Canvases: windows that a program beside the simulator draws. It sends pictures, and gets what a person does with them.

use std::collections::VecDeque;

use super::error::{UiError, UiResult};
use super::input::{Input, InputResult, Modifiers};
use super::widgets::WidgetKind;
use super::window::{Window, WindowSource};
use super::{MAX_WAITING, Ui};

/// The widget of a window that a program draws.
pub(super) const CANVAS: i64 = 1;

/// A picture that a program draws, and what it has not been told yet.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Canvas {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// A PNG file; empty before the first one.
    pub picture: Vec<u8>,
    waiting: VecDeque<CanvasInput>,
}

/// What the pointer does above a canvas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointerAction {
    /// A button is pressed.
    Down,
    /// A button is released.
    Up,
    /// The pointer moves.
    Move,
    /// The wheel turns.
    Wheel,
}

impl PointerAction {
    /// The action of that name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "down" => Self::Down,
            "up" => Self::Up,
            "move" => Self::Move,
            "wheel" => Self::Wheel,
            _ => return None,
        })
    }

    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Down => "down",
            Self::Up => "up",
            Self::Move => "move",
            Self::Wheel => "wheel",
        }
    }
}

/// What a person does with a canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pointer {
    /// What the pointer does.
    pub action: PointerAction,
    /// Pixels from the upper left corner.
    pub at: [f64; 2],
    /// The button that is pressed or released: 0 left, 1 middle, 2 right.
    pub button: i64,
    /// The buttons that are down then, as bits: 1 left, 2 right, 4 middle.
    pub buttons: i64,
    /// How far the wheel turns, pixels of a page: to the right and down.
    pub delta: [f64; 2],
    /// Modifier keys that are held down.
    pub modifiers: Modifiers,
}

/// An input for the program that draws a canvas.
#[derive(Debug, Clone, PartialEq)]
pub enum CanvasInput {
    /// The mouse, a pen or a finger.
    Pointer(Pointer),
    /// A key.
    Key {
        /// It is pressed, not released.
        down: bool,
        /// Its number in Qt.
        key: i64,
        /// The text it would enter.
        text: String,
        /// Modifier keys that are held down.
        modifiers: Modifiers,
    },
    /// The window is to have this size, pixels.
    Resize([i64; 2]),
    /// The close button.
    Close,
}

impl CanvasInput {
    /// The modifier keys that are held down.
    pub(super) fn modifiers(&self) -> Modifiers {
        match self {
            Self::Pointer(pointer) => pointer.modifiers,
            Self::Key { modifiers, .. } => *modifiers,
            Self::Resize(_) | Self::Close => Modifiers::default(),
        }
    }

    /// Whether nothing is lost when only the later one of two is known.
    fn is_overtaken_by(&self, later: &Self) -> bool {
        match (self, later) {
            (Self::Pointer(old), Self::Pointer(new)) => {
                let both_move = [old, new].map(|one| one.action) == [PointerAction::Move; 2];
                both_move && old.buttons == new.buttons && old.modifiers == new.modifiers
            }
            (Self::Resize(_), Self::Resize(_)) => true,
            _ => false,
        }
    }
}

impl Canvas {
    /// Keeps an input for the program.
    ///
    /// # Errors
    /// When too many wait.
    pub(super) fn push(&mut self, input: CanvasInput) -> Result<(), String> {
        if let Some(last) = self.waiting.back_mut()
            && last.is_overtaken_by(&input)
        {
            *last = input;
            return Ok(());
        }
        if self.waiting.len() >= MAX_WAITING {
            return Err("too many inputs are waiting for the program that draws the window".into());
        }
        self.waiting.push_back(input);
        Ok(())
    }
}

impl Window {
    pub(super) fn canvas_input(&mut self, id: i64, input: CanvasInput) -> Option<InputResult> {
        Some(self.get_mut::<Canvas>(id).ok()?.push(input))
    }
}

impl Ui {
    pub(super) fn is_canvas(&self, handle: &str) -> bool {
        let window = self.window(handle);
        window.is_ok_and(|window| window.get::<Canvas>(CANVAS).is_ok())
    }

    /// Keeps an input for the program that draws a window. Nothing has changed for pages: what does comes as a picture.
    pub(super) fn canvas_input(
        &mut self,
        handle: &str,
        widget: i64,
        input: CanvasInput,
    ) -> Result<(), String> {
        self.modifiers = input.modifiers();
        let number = self.number(handle).map_err(|error| error.to_string())?;
        let window = self.windows.get_mut(&number);
        let window = window.ok_or_else(|| UiError::NoSuchWindow.to_string())?;
        window.input(widget, Input::Canvas(input))
    }

    /// Opens a window that a program draws; its handle.
    pub fn open_canvas(&mut self, title: &str, owner: i64) -> String {
        let kind = WidgetKind::Canvas(Canvas::default());
        let handle = self.add_single(WindowSource::Program, title, kind, owner);
        if let Ok(number) = self.number(&handle)
            && let Some(window) = self.windows.get_mut(&number)
        {
            window.root.margins = [0; 4];
        }
        handle
    }

    /// Title, whether it is seen, size and whether that can be changed, of a window that a program draws.
    ///
    /// # Errors
    /// When there is no such window.
    pub fn arrange_canvas(
        &mut self,
        handle: &str,
        title: &str,
        visible: bool,
        size: [u32; 2],
        resizable: bool,
    ) -> UiResult<()> {
        self.change(handle, |window| {
            title.clone_into(&mut window.title);
            (window.visible, window.resizable) = (visible, resizable);
            window.size = size.map(i64::from);
            Ok(())
        })
    }

    /// Changes the canvas of a window.
    ///
    /// # Errors
    /// When there is no such window, or no program draws it.
    pub fn change_canvas(
        &mut self,
        handle: &str,
        change: impl FnOnce(&mut Canvas),
    ) -> UiResult<()> {
        self.change(handle, |window| {
            change(window.get_mut::<Canvas>(CANVAS)?);
            Ok(())
        })
    }

    /// What persons did with a window that a program draws, since the last time.
    pub fn take_canvas_inputs(&mut self, handle: &str) -> Vec<CanvasInput> {
        let window = self.number(handle).ok();
        let window = window.and_then(|number| self.windows.get_mut(&number));
        let canvas = window.and_then(|window| window.get_mut::<Canvas>(CANVAS).ok());
        canvas.map_or_else(Vec::new, |canvas| canvas.waiting.drain(..).collect())
    }

    /// Whether a page has asked for changes since the last time: otherwise nobody sees pictures.
    pub fn take_asked(&self) -> bool {
        self.asked.take()
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn opened() -> (Ui, String) {
        let mut ui = Ui::default();
        let handle = ui.open_canvas("Dials", 7);
        (ui, handle)
    }

    fn send(ui: &mut Ui, window: &str, mut fields: Value) -> Result<(), String> {
        fields["window"] = json!(window);
        fields["widget"] = json!(CANVAS);
        ui.input(&fields)
    }

    fn pointer(event: &str, x: f64, buttons: i64) -> Value {
        json!({"type": "pointer", "event": event, "x": x, "y": 2, "buttons": buttons})
    }

    #[test]
    fn pages_get_pictures() {
        let (mut ui, handle) = opened();
        ui.arrange_canvas(&handle, "Meters", true, [30, 20], false)
            .expect("there is a window");
        ui.change_canvas(&handle, |canvas| {
            (canvas.size, canvas.picture) = ([3, 2], vec![0, 1, 2]);
        })
        .expect("there is a canvas");
        let window = &ui.snapshot()["windows"][0];
        let canvas = &window["content"]["items"][0];
        assert_eq!(
            (window["source"].clone(), window["title"].clone()),
            (json!("program"), json!("Meters"))
        );
        assert_eq!(
            (&window["size"], &window["resizable"]),
            (&json!([30, 20]), &json!(false))
        );
        assert_eq!(canvas["kind"], "canvas");
        assert_eq!(canvas["picture"], "AAEC");
        assert_eq!([&canvas["width"], &canvas["height"]], [3, 2]);
    }

    #[test]
    fn inputs_wait_for_the_program_in_their_order() {
        let (mut ui, handle) = opened();
        let revision = ui.snapshot()["revision"].clone();
        for event in [pointer("down", 1.5, 1), pointer("up", 3.0, 0)] {
            send(&mut ui, &handle, event).expect("it is taken");
        }
        let key = json!({"type": "stroke", "down": true, "key": 65, "text": "a", "modifiers": {"shift": true}});
        send(&mut ui, &handle, key).expect("it is taken");
        assert!(ui.modifiers.shift);
        ui.close(&handle, false).expect("it is taken");
        let inputs = ui.take_canvas_inputs(&handle);
        let CanvasInput::Pointer(first) = &inputs[0] else {
            panic!("{inputs:?}");
        };
        assert_eq!(
            (first.action, first.at, first.buttons),
            (PointerAction::Down, [1.5, 2.0], 1)
        );
        let shift = Modifiers {
            shift: true,
            ..Modifiers::default()
        };
        let key = CanvasInput::Key {
            down: true,
            key: 65,
            text: "a".into(),
            modifiers: shift,
        };
        assert_eq!(inputs[2..], [key, CanvasInput::Close]);
        // Its program closes it, and draws it anew.
        assert!(ui.window(&handle).is_ok_and(|window| window.is_visible()));
        assert_eq!(ui.snapshot()["revision"], revision);
        assert!(ui.take_canvas_inputs(&handle).is_empty());
    }

    #[test]
    fn movements_and_sizes_overtake_earlier_ones() {
        let (mut ui, handle) = opened();
        for (x, buttons) in [(1.0, 0), (2.0, 0), (3.0, 1), (4.0, 1)] {
            send(&mut ui, &handle, pointer("move", x, buttons)).expect("it is taken");
        }
        for side in [100, 200, 1_000_000] {
            let resize = json!({"type": "resize", "size": [side, 50]});
            send(&mut ui, &handle, resize).expect("it is taken");
        }
        let inputs = ui.take_canvas_inputs(&handle);
        let places: Vec<f64> = inputs
            .iter()
            .filter_map(|input| match input {
                CanvasInput::Pointer(pointer) => Some(pointer.at[0]),
                _ => None,
            })
            .collect();
        assert_eq!(places, [2.0, 4.0]);
        assert_eq!(inputs[2..], [CanvasInput::Resize([8192, 50])]);
    }

    #[test]
    fn inputs_that_are_none_are_refused() {
        let (mut ui, handle) = opened();
        let simple = ui.create("<ui><label id=\"1\"/></ui>", 7, Default::default());
        let (other, _) = simple.expect("a window");
        for (window, fields) in [
            (&handle, pointer("jump", 1.0, 0)),
            (&handle, json!({"type": "pointer", "event": "down", "x": 1})),
            (&handle, json!({"type": "stroke", "down": true})),
            (&other, pointer("down", 1.0, 0)),
            (&handle, json!({"type": "click"})),
        ] {
            assert!(send(&mut ui, window, fields.clone()).is_err(), "{fields}");
        }
        assert!(ui.take_canvas_inputs(&handle).is_empty());
        assert!(ui.take_canvas_inputs(&other).is_empty());
        assert!(ui.change_canvas(&other, |_| ()).is_err());
    }

    #[test]
    fn inputs_that_nobody_fetches_are_bounded() {
        let (mut ui, handle) = opened();
        let mut down = || send(&mut ui, &handle, pointer("down", 1.0, 1));
        assert!((0..MAX_WAITING).all(|_| down().is_ok()));
        assert!(down().is_err());
    }

    #[test]
    fn pictures_are_wanted_when_pages_ask() {
        let (ui, _) = opened();
        assert!(!ui.take_asked());
        assert!(ui.changes_since(0).is_some());
        assert!(ui.take_asked());
        assert!(!ui.take_asked());
    }
}
