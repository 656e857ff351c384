//! Windows of scripts without a display: what they consist of, what they show, what persons do with them. Knows no Lua and draws nothing.
//!
//! A window is made from a text in XML and belongs to a script. Scripts change it; a page shows it and sends what a person does; what that
//! calls is queued as an [`Event`] until the simulator delivers it.
//!
//! # What a page gets
//!
//! [`Ui::snapshot`] is an object with
//!
//! - `revision`: a number that grows with every change
//! - `windows`: a list, in the order of creation
//! - `dialogs`: the last dialogs of scripts and what was answered, each with `number`, `kind` (`msgBox`, `fileDialog`, `colorDialog`,
//!   `inputDialog`), `title`, `text`, `answer` (text for people)
//! - `banners`: those that are shown, each with `id`, `text`, `buttons` (a list of `key` and `label`)
//! - `views`: floating views, each with `id`, `position` (of its centre) and `size` as parts of the main view, `object` (-1: none), `label`
//!
//! [`Ui::changes_since`] is the same with the windows that have changed since a revision only, and `removed`, the ids of those that are gone.
//! `complete` is true when all windows are in it, because too much was removed meanwhile: those that are not in it are gone.
//!
//! A window has `id` (text), `revision` (of its last change), `source` (`simUI`, `console`, `editor`, `program`), `owner` (handle of the script), `title`,
//! `visible`, `enabled`, `modal`, `resizable`, `closeable`, `activate`, `placement` (`center`, `relative`, `absolute`), `position` and `size`
//! (two integers, pixels), `style` (a style sheet of Qt), `content` (a container).
//!
//! A container has `layout` (`vbox`, `hbox`, `grid`, `form`, `none`), `margins` (left, top, right, bottom), `spacing` (-1: the default), `items`: widgets,
//! and `{"kind": "br"}` (the next row of a grid), `{"kind": "stretch", "factor": 1}`. Items of a form are label and field by turns.
//!
//! A widget has `id` (integer, unique in its window), `kind`, `enabled`, `visible`, `style`, `stretch` (-1: none), `geometry` (x, y, width, height
//! in the layout `none`, else null), `handlers` (the attributes that have one, such as `on-click`), and by `kind`
//!
//! | kind | more |
//! |---|---|
//! | `group` | `flat`, `content` |
//! | `tabs` | `current` (from 0), `position`, `pages`: widgets of the kind `tab` with `title`, `content` |
//! | `button` | `text`, `checkable`, `checked`, `autoExclusive`, `icon`, `repeat` (delay and interval in ms, or null) |
//! | `checkbox` | `text`, `value` (0, 1 partially, 2), `checkable` |
//! | `radiobutton` | `text`, `value` (0, 1), `checkable`, `autoExclusive` |
//! | `combobox` | `items`, `value` (index, -1 for none) |
//! | `edit` | `value`, `password`, `selected` |
//! | `hslider`, `vslider` | `value`, `minimum`, `maximum`, `vertical`, `tickInterval`, `tickPosition`, `inverted` |
//! | `spinbox` | `value`, `minimum`, `maximum`, `step`, `decimals` (null: integers), `prefix`, `suffix` |
//! | `label` | `text` (may be HTML: do not trust it), `wordWrap` |
//! | `progressbar` | `value`, `minimum`, `maximum`, `vertical`, `inverted`, `textVisible` |
//! | `text-browser` | `text`, `type` (`plain`, `html`, `markdown`), `readOnly`, `wordWrap`, `url` |
//! | `image` | `width`, `height`, `pixels` (base64 of red, green, blue, opacity, the top row first), `scaledContents`, `keepAspectRatio` |
//! | `svg` | `text` |
//! | `table` | `rowCount`, `columnCount`, `cells` (those that are there: `row`, `column`, `text`, `editable`, `image`), `rowHeaders` and `columnHeaders` (objects, by index), `rowHeight`, `columnWidth` (least and most, or null), `showHorizontalHeader`, `showVerticalHeader`, `autosizeHorizontalHeader`, `autosizeVerticalHeader`, `showGrid`, `editable`, `sortable`, `selectionMode` (`item`, `row`, `column`), `selection` (row, column; -1) |
//! | `tree` | `items` (parents' order: `id`, `parent` (0: top), `texts`, `expanded`), `columnCount`, `columnHeaders` (a list), `showHeader`, `autosizeHeader`, `sortable`, `selected` (0: none) |
//! | `plot` | `curves` (`name`, `type`, `color` (0 to 255), `style`, `scatterShape`, `scatterSize`, `lineSize`, `lineStyle`, `inLegend`, `selectable`, `track`, `x`, `y`), `xRange`, `yRange`, `xLabel`, `yLabel`, `xTicks`, `yTicks`, `xTickLabels`, `yTickLabels`, `legendVisible`, `square`, `colors`, `panX`, `panY`, `zoomX`, `zoomY`, `replots` |
//! | `properties` | `rows` (`name`, `type`, `value`, `flags`, `displayedName`, `displayedValue`, `icon`, `description`), `selected`, `menu` (key and title) |
//! | `canvas` | `width`, `height`, `picture` (base64 of a PNG file; empty before the first one): all of a window that a program draws |
//! | `scene3d` | `nodes` (`id`, `type`, `parent`, `enabled`, `params`), `clearColor` |
//!
//! # What a page sends
//!
//! [`Ui::input`] takes an object with `type`, mostly `window` (the id) and `widget` (the id), and
//!
//! | type | of | more |
//! |---|---|---|
//! | `click` | button, radiobutton, checkbox | |
//! | `value` | all with a value | `value`: a number, a text or a bool; of combobox and tabs an index or a text |
//! | `finish` | edit: return, or the focus is lost | |
//! | `select` | table; tree; properties | `row` and `column`; `item`; `row` |
//! | `cell` | table | `row`, `column`, and `text` if it was changed |
//! | `expand` | tree | `item`, `expanded` |
//! | `key` | table, properties | `key` (of Qt), `text`, `modifiers` (`shift`, `control`, `alt`) |
//! | `mouse` | image, svg | `event` (`down`, `up`, `move`), `x`, `y`, `modifiers` |
//! | `pointer` | canvas | `event` (`down`, `up`, `move`, `wheel`), `x`, `y`, `button` (0 left, 1 middle, 2 right), `buttons` (bits: 1 left, 2 right, 4 middle), `dx`, `dy` (of the wheel, pixels), `modifiers` |
//! | `stroke` | canvas | `down`, `key` (of Qt), `text`, `modifiers` |
//! | `link` | label, text-browser | `href` |
//! | `point`, `legend` | plot | `curve`, and of a point `index`, `x`, `y` |
//! | `node` | scene3d | `node` |
//! | `menu`, `doubleClick`, `property` | properties | `key`; `row`, `column`; `name`, `text` |
//! | `close` | the window: its button, or with `escape` the key | |
//! | `move`, `resize` | the window | `position`; `size` |
//! | `banner` | without window | `banner`, `key` |

mod build;
mod canvas;
mod dialogs;
mod editors;
mod error;
mod input;
mod json;
mod question;
mod search;
#[cfg(test)]
mod tests;
mod values;
mod views;
mod widgets;
mod window;
mod xml;

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use serde_json::{Value, json};

use build::Warning;
use canvas::CANVAS;
use editors::Panes;
use json::{Action, action};
use scene::Data;
use views::FloatingViews;

pub use canvas::{Canvas, CanvasInput, Pointer, PointerAction};
pub use dialogs::{Banner, DialogKind, Dialogs};
pub use editors::EditorState;
pub use error::{UiError, UiResult};
pub use input::{Input, InputValue, Modifiers};
pub use question::{Question, QuestionDetails, answer_of_page};
pub use widgets::{
    Button, Cell, Checkbox, Combobox, Curve, CurveOptions, CurveType, Edit, Image, Label, Plot,
    Properties, Property, Radiobutton, Scene3d, Slider, Spinbox, Svg, Table, Tabs, TextBrowser,
    Tree, WidgetKind,
};
use widgets::{Container, Item, Widget};
pub use window::{Event, Window, WindowSource};

/// Inputs that may wait for the simulator; further ones are refused.
const MAX_WAITING: usize = 10_000;
/// Largest side that a person gives a window, pixels.
const MAX_SIDE: i64 = 8192;
/// Removals that are remembered for pages.
const MAX_REMOVED: usize = 1000;

/// All windows of a simulator.
#[derive(Debug, Default)]
pub struct Ui {
    windows: BTreeMap<u64, Window>,
    /// The number of the last window.
    last: u64,
    /// The last id of a widget without one.
    anonymous: i64,
    revision: u64,
    /// Windows that are gone, with the revision of that; the oldest first.
    removed: VecDeque<(u64, u64)>,
    /// The revision up to which removals are no longer remembered.
    forgotten: u64,
    events: VecDeque<Event>,
    warned: BTreeSet<String>,
    /// A page has asked for changes.
    asked: std::cell::Cell<bool>,
    /// The keys that were held down at the last input.
    pub modifiers: Modifiers,
    /// What a script has put there.
    pub clipboard: String,
    /// Dialogs and banners.
    pub dialogs: Dialogs,
    /// Floating views of the scene.
    pub views: FloatingViews,
    /// Text editors and consoles.
    panes: Panes,
}

impl Ui {
    /// Opens the window that a text describes, for a script. Returns its handle, and what is to be logged about the text.
    ///
    /// # Errors
    /// When the text is wrong.
    pub fn create(
        &mut self,
        text: &str,
        owner: i64,
        names: BTreeMap<String, i64>,
    ) -> UiResult<(String, Vec<String>)> {
        let (mut window, warnings) =
            build::window(text, &mut self.anonymous).map_err(UiError::Xml)?;
        window.names = names
            .into_iter()
            .filter(|(_, id)| window.widgets.contains_key(id))
            .collect();
        window.visible = true;
        let handle = self.add(window, owner);
        Ok((
            handle,
            warnings
                .into_iter()
                .filter_map(|warning| self.first_time(&warning))
                .collect(),
        ))
    }

    /// The text of a warning; None for an old name that was warned of before.
    fn first_time(&mut self, warning: &Warning) -> Option<String> {
        let text = warning.text();
        match warning {
            Warning::Deprecated { .. } => self.warned.insert(text.clone()).then_some(text),
            Warning::Unknown { .. } => Some(text),
        }
    }

    /// Opens a window for a script; its handle.
    pub(crate) fn add(&mut self, mut window: Window, owner: i64) -> String {
        self.last += 1;
        self.revision += 1;
        (window.id, window.owner, window.revision) = (self.last, owner, self.revision);
        let handle = window.handle();
        self.windows.insert(self.last, window);
        handle
    }

    /// Opens a window with a single widget, whose id is 1; its handle.
    pub(crate) fn add_single(
        &mut self,
        source: WindowSource,
        title: &str,
        kind: WidgetKind,
        owner: i64,
    ) -> String {
        let mut window = Window {
            source,
            title: title.to_owned(),
            enabled: true,
            visible: true,
            ..Window::default()
        };
        (window.resizable, window.closeable, window.activate) = (true, true, true);
        window.place([0; 2], [-1; 2]);
        window.root = Container {
            items: vec![Item::Widget(1)],
            margins: [7; 4],
            spacing: -1,
            ..Container::default()
        };
        window.widgets.insert(
            1,
            Widget {
                id: 1,
                parent: None,
                enabled: true,
                visible: true,
                style: String::new(),
                stretch: -1,
                geometry: None,
                handlers: BTreeMap::new(),
                kind,
            },
        );
        self.add(window, owner)
    }

    fn number(&self, handle: &str) -> UiResult<u64> {
        let number = handle
            .strip_suffix(":UI")
            .and_then(|digits| u64::from_str_radix(digits, 16).ok());
        let known = number.filter(|number| {
            self.windows
                .get(number)
                .is_some_and(|window| window.handle() == handle)
        });
        known.ok_or(UiError::NoSuchWindow)
    }

    /// The window with that handle.
    ///
    /// # Errors
    /// When there is no such window.
    pub fn window(&self, handle: &str) -> UiResult<&Window> {
        let number = self.number(handle)?;
        self.windows.get(&number).ok_or(UiError::NoSuchWindow)
    }

    /// All windows, in the order of their creation.
    pub(crate) fn windows(&self) -> impl Iterator<Item = &Window> {
        self.windows.values()
    }

    /// Changes a window; what it raises is queued.
    ///
    /// # Errors
    /// When there is no such window, or those of `change`.
    pub fn change<T>(
        &mut self,
        handle: &str,
        change: impl FnOnce(&mut Window) -> UiResult<T>,
    ) -> UiResult<T> {
        let number = self.number(handle)?;
        let window = self.windows.get_mut(&number).ok_or(UiError::NoSuchWindow)?;
        let outcome = change(window);
        self.revision += 1;
        window.revision = self.revision;
        self.events.extend(window.raised.drain(..));
        outcome
    }

    /// Closes a window for good.
    ///
    /// # Errors
    /// When there is no such window.
    pub fn destroy(&mut self, handle: &str) -> UiResult<()> {
        let number = self.number(handle)?;
        self.windows.remove(&number);
        self.revision += 1;
        self.removed.push_back((self.revision, number));
        if self.removed.len() > MAX_REMOVED {
            self.forgotten = self
                .removed
                .pop_front()
                .map_or(self.revision, |(revision, _)| revision);
        }
        Ok(())
    }

    /// Something that is not in a window has changed.
    pub fn touch(&mut self) {
        self.revision += 1;
    }

    /// How many events wait.
    pub fn waiting(&self) -> usize {
        self.events.len()
    }

    /// The next event; of those that are about something that is gone, the text of a warning.
    pub fn next_event(&mut self) -> Option<Result<Event, String>> {
        let event = self.events.pop_front()?;
        let Some(window) = event.window else {
            return Some(Ok(event));
        };
        let exists = self.windows.get(&window).is_some_and(|window| {
            event
                .widget
                .is_none_or(|widget| window.widgets.contains_key(&widget))
        });
        Some(if exists {
            Ok(event)
        } else {
            Err(format!(
                "event of a widget that is gone ('{}')",
                event.handler
            ))
        })
    }

    /// Goes on with an edit whose text was evaluated: it becomes the result, and its handlers run.
    pub fn replace_by_result(&mut self, window: u64, widget: i64, result: String) {
        let handle = format!("{window:x}:UI");
        // The window may have been destroyed by the evaluation: then there is nothing to do.
        let _ = self.change(&handle, |window| {
            window.set_edit(widget, result.clone(), true)?;
            window.raise(widget, "on-editing-finished", [Data::text(&result)]);
            Ok(())
        });
    }

    /// Everything a page shows. The head of this module describes it.
    pub fn snapshot(&self) -> Value {
        self.asked.set(true);
        json!({
            "revision": self.revision,
            "windows": self.windows.values().map(Window::json).collect::<Vec<_>>(),
            "dialogs": self.dialogs.json(),
            "banners": self.dialogs.banners_json(),
            "views": self.views.json(),
        })
    }

    /// What has changed since a revision; None for nothing. The head of this module describes it.
    pub fn changes_since(&self, since: u64) -> Option<Value> {
        self.asked.set(true);
        if since == self.revision {
            return None;
        }
        // A page that is ahead has seen another simulator.
        let complete = since < self.forgotten || since > self.revision;
        let changed = self
            .windows
            .values()
            .filter(|window| complete || window.revision > since);
        let removed = self
            .removed
            .iter()
            .filter(|(revision, _)| *revision > since);
        Some(json!({
            "revision": self.revision,
            "complete": complete,
            "windows": changed.map(Window::json).collect::<Vec<_>>(),
            "removed": removed.map(|(_, number)| format!("{number:x}:UI")).collect::<Vec<_>>(),
            "dialogs": self.dialogs.json(),
            "banners": self.dialogs.banners_json(),
            "views": self.views.json(),
        }))
    }

    /// Does what a page asks for. The head of this module describes it.
    ///
    /// # Errors
    /// What is wrong with the request, or why it is refused.
    pub fn input(&mut self, json: &Value) -> Result<(), String> {
        match action(json)? {
            Action::Widget {
                window,
                widget,
                input,
            } => self.widget_input(&window, widget, input),
            Action::Close { window, escape } => self.close(&window, escape),
            Action::Move { window, position } => {
                self.rearrange(&window, |window| window.position = position)
            }
            Action::Resize { window, size } => {
                self.resize(&window, size.map(|side| side.clamp(1, MAX_SIDE)))
            }
            Action::Banner { banner, key } => {
                let event = self.dialogs.press_banner(banner, &key)?;
                self.touch();
                self.events.extend(event);
                Ok(())
            }
        }
    }

    /// What a person does with a widget.
    ///
    /// # Errors
    /// Why it is refused.
    pub fn widget_input(&mut self, window: &str, widget: i64, input: Input) -> Result<(), String> {
        self.check_reachable(window)?;
        match input {
            Input::Key { modifiers, .. } | Input::Mouse { modifiers, .. } => {
                self.modifiers = modifiers;
            }
            Input::Canvas(input) => return self.canvas_input(window, widget, input),
            _ => {}
        }
        self.change(window, |window| {
            window.input(widget, input).map_err(UiError::Other)
        })
        .map_err(|error| error.to_string())
    }

    /// Inputs reach visible windows; of those, only a modal one if there is one.
    fn check_reachable(&self, handle: &str) -> Result<(), String> {
        if self.events.len() >= MAX_WAITING {
            return Err("too many inputs are waiting for the simulator".into());
        }
        let window = self
            .window(handle)
            .map_err(|_| format!("there is no window '{handle}'"))?;
        if !window.is_visible() {
            return Err(format!("window '{}' is not visible", window.title));
        }
        let modal = self
            .windows
            .values()
            .rfind(|other| other.modal && other.is_visible() && other.id != window.id);
        match modal.filter(|_| !window.modal) {
            Some(modal) => Err(format!(
                "window '{}' waits for '{}'",
                window.title, modal.title
            )),
            None => Ok(()),
        }
    }

    /// The close button of a window, which calls its handler, or hides it without one; or Escape, which only does the first.
    ///
    /// # Errors
    /// When the window cannot be closed by persons.
    pub fn close(&mut self, handle: &str, escape: bool) -> Result<(), String> {
        self.check_reachable(handle)?;
        if self.is_canvas(handle) {
            // Its program says what becomes of it.
            return self.canvas_input(handle, CANVAS, CanvasInput::Close);
        }
        self.change(handle, |window| {
            if !escape && !window.closeable {
                return Err(UiError::other(format!(
                    "window '{}' cannot be closed",
                    window.title
                )));
            }
            // An editor is closed for good: its handler gets the text.
            if (!window.raise_close() || window.source == WindowSource::Editor) && !escape {
                window.visible = false;
            }
            Ok(())
        })
        .map_err(|error| error.to_string())
    }

    fn resize(&mut self, handle: &str, size: [i64; 2]) -> Result<(), String> {
        if self.is_canvas(handle) {
            return self.canvas_input(handle, CANVAS, CanvasInput::Resize(size));
        }
        self.rearrange(handle, |window| window.size = size)
    }

    fn rearrange(&mut self, handle: &str, change: impl FnOnce(&mut Window)) -> Result<(), String> {
        let changed = self.change(handle, |window| {
            change(window);
            Ok(())
        });
        changed.map_err(|error| error.to_string())
    }
}
