//! Text editors and consoles: windows with a single text, which scripts know by numbers.

use std::collections::BTreeMap;

use super::error::UiResult;
use super::widgets::{TextBrowser, TextType, WidgetKind};
use super::window::WindowSource;
use super::{Ui, xml};

/// Text editors and consoles by their numbers, which both count from 0.
#[derive(Debug, Default)]
pub(super) struct Panes {
    editors: BTreeMap<i64, String>,
    opened: i64,
}

/// What scripts learn of a text editor.
#[derive(Debug, Clone, PartialEq)]
pub struct EditorState {
    /// The text in it.
    pub text: String,
    /// Position of its upper left corner on the screen, pixels.
    pub position: [i64; 2],
    /// Width and height, pixels.
    pub size: [i64; 2],
    /// Whether it is shown.
    pub visible: bool,
}

/// Largest size of the text of a console, bytes.
const MAX_CONSOLE: usize = 1 << 20;

impl Ui {
    /// Opens a text editor. Of the properties, an element in XML, `title`, `editable`, `closeable`, `position`, `size` and `on-close` count. Returns its number
    /// and the handle of its window.
    pub fn open_editor(&mut self, text: &str, properties: &str, owner: i64) -> (i64, String) {
        let properties = xml::parse(properties).unwrap_or_default();
        let attribute = |names: &[&str]| {
            let found = properties
                .attributes
                .iter()
                .find(|(name, _)| names.contains(&name.as_str()));
            found.map(|(_, value)| value.as_str())
        };
        let pair = |name: &str| -> Option<[i64; 2]> {
            let numbers: Vec<&str> = attribute(&[name])?
                .split([',', ' '])
                .filter(|part| !part.is_empty())
                .collect();
            let [first, second] = numbers.as_slice() else {
                return None;
            };
            Some([first.parse().ok()?, second.parse().ok()?])
        };
        let kind = WidgetKind::TextBrowser(TextBrowser {
            text: text.to_owned(),
            text_type: TextType::Plain,
            read_only: attribute(&["editable"]) == Some("false"),
            ..TextBrowser::default()
        });
        let handle = self.add_single(
            WindowSource::Editor,
            attribute(&["title"]).unwrap_or("Editor"),
            kind,
            owner,
        );
        let changed = self.change(&handle, |window| {
            window.closeable = attribute(&["closeable", "closable"]) != Some("false");
            window.on_close = attribute(&["on-close", "onclose", "onClose"])
                .unwrap_or_default()
                .to_owned();
            window.position = pair("position").unwrap_or(window.position);
            window.size = pair("size").unwrap_or(window.size);
            Ok(())
        });
        debug_assert!(changed.is_ok(), "the window was just made");
        let number = self.panes.opened;
        self.panes.opened += 1;
        self.panes.editors.insert(number, handle.clone());
        (number, handle)
    }

    /// What an editor shows; None without such an editor.
    pub fn editor(&self, number: i64) -> Option<EditorState> {
        let window = self.window(self.panes.editors.get(&number)?).ok()?;
        let text = window.get::<TextBrowser>(1).ok()?.text.clone();
        Some(EditorState {
            text,
            position: window.position,
            size: window.size,
            visible: window.visible,
        })
    }

    /// Shows or hides an editor; false if there is none with that number.
    pub fn show_editor(&mut self, number: i64, visible: bool) -> bool {
        let Some(handle) = self.panes.editors.get(&number).cloned() else {
            return false;
        };
        self.set_visible(&handle, visible).is_ok()
    }

    /// Closes an editor, and returns what it showed; None without such an editor.
    pub fn close_editor(&mut self, number: i64) -> Option<EditorState> {
        let state = self.editor(number);
        if let Some(handle) = self.panes.editors.remove(&number) {
            // The window may be gone with its script.
            let _ = self.destroy(&handle);
        }
        state
    }

    /// Opens a console; the handle of its window.
    pub fn open_console(
        &mut self,
        title: &str,
        position: Option<[i64; 2]>,
        size: Option<[i64; 2]>,
    ) -> String {
        let kind = WidgetKind::TextBrowser(TextBrowser {
            text_type: TextType::Plain,
            read_only: true,
            ..TextBrowser::default()
        });
        // A console is the simulator's: it stays when its script ends.
        let handle = self.add_single(WindowSource::Console, title, kind, -1);
        let changed = self.change(&handle, |window| {
            window.position = position.unwrap_or(window.position);
            window.size = size.unwrap_or(window.size);
            Ok(())
        });
        debug_assert!(changed.is_ok(), "the window was just made");
        handle
    }

    /// Adds a text to a console, of which at most the last `lines` lines stay; clears it for None.
    ///
    /// # Errors
    /// When the window is gone.
    pub fn print_to_console(
        &mut self,
        handle: &str,
        text: Option<&str>,
        lines: usize,
    ) -> UiResult<()> {
        self.change(handle, |window| {
            let shown = &mut window.get_mut::<TextBrowser>(1)?.text;
            match text {
                Some(text) => shown.push_str(text),
                None => shown.clear(),
            }
            let ended = shown.strip_suffix('\n').unwrap_or(shown).len();
            let place = shown[..ended]
                .rmatch_indices('\n')
                .nth(lines.max(1) - 1)
                .map_or(0, |(at, _)| at + 1);
            let least = shown.len().saturating_sub(MAX_CONSOLE);
            let place = (place.max(least)..=shown.len())
                .find(|at| shown.is_char_boundary(*at))
                .unwrap_or(0);
            shown.drain(..place);
            Ok(())
        })
    }

    /// Shows or hides a window.
    ///
    /// # Errors
    /// When the window is gone.
    pub fn set_visible(&mut self, handle: &str, visible: bool) -> UiResult<()> {
        self.change(handle, |window| {
            window.visible = visible;
            Ok(())
        })
    }
}
