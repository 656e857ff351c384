//! A window: where it is, its widgets, and the events they have raised.

use std::collections::BTreeMap;

use super::error::{UiError, UiResult};
use super::widgets::{Container, TextBrowser, Widget, WidgetKind, WidgetType};
use scene::Data;

/// Where a window without a position of its own would be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Placement {
    #[default]
    Center,
    Relative,
    Absolute,
}

impl Placement {
    pub(super) const NAMES: [&'static str; 3] = ["center", "relative", "absolute"];

    pub(super) fn named(name: &str) -> Self {
        match name {
            "relative" => Self::Relative,
            "absolute" => Self::Absolute,
            _ => Self::Center,
        }
    }

    pub(super) fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// Who shows a window: what a page may say about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WindowSource {
    /// `simUI.create`.
    #[default]
    SimUi,
    /// `sim.auxiliaryConsoleOpen`.
    Console,
    /// `sim.textEditorOpen`.
    Editor,
    /// A program beside the simulator, which draws it.
    Program,
}

impl WindowSource {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::SimUi => "simUI",
            Self::Console => "console",
            Self::Editor => "editor",
            Self::Program => "program",
        }
    }
}

/// Size of the assumed screen and main window that positions refer to, pixels: there are none without a display.
const SCREEN: [i64; 2] = [1280, 800];
/// Size of a window that has none of its own, pixels.
const DEFAULT_SIZE: [i64; 2] = [320, 240];

/// What a person did, or a script that wants handlers to run: the name of a function of the owner's, and its arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// The window it is about; None for banners.
    pub window: Option<u64>,
    /// The widget it is about, if it is about one: without it nothing is called.
    pub widget: Option<i64>,
    /// The handle of the script whose function it is.
    pub script: i64,
    /// The name of the function.
    pub handler: String,
    /// Its arguments: the window, the widget, and what it is about.
    pub args: Vec<Data>,
    /// The text of an edit is to be evaluated before.
    pub evaluates: bool,
}

/// A window with its widgets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Window {
    pub(super) id: u64,
    /// The handle of the script it belongs to.
    pub(super) owner: i64,
    pub(super) source: WindowSource,
    /// The title.
    pub title: String,
    /// Whether it takes inputs.
    pub enabled: bool,
    /// Whether it is shown.
    pub visible: bool,
    pub(super) modal: bool,
    pub(super) style: String,
    pub(super) resizable: bool,
    pub(super) closeable: bool,
    pub(super) placement: Placement,
    pub(super) activate: bool,
    pub(super) on_close: String,
    /// Position of its upper left corner on the screen, pixels.
    pub position: [i64; 2],
    /// Width and height, pixels.
    pub size: [i64; 2],
    pub(super) root: Container,
    pub(super) widgets: BTreeMap<i64, Widget>,
    /// Names a script has for ids.
    pub(super) names: BTreeMap<String, i64>,
    /// The number of its last change.
    pub(super) revision: u64,
    pub(super) raised: Vec<Event>,
}

impl Window {
    /// The text scripts know it by.
    pub(crate) fn handle(&self) -> String {
        format!("{:x}:UI", self.id)
    }

    /// Whether it is seen.
    pub fn is_visible(&self) -> bool {
        self.visible
    }

    /// Sets size and position from what the text of the window says.
    pub(super) fn place(&mut self, position: [i64; 2], size: [i64; 2]) {
        self.size = if size[0] > 0 && size[1] > 0 {
            size
        } else {
            DEFAULT_SIZE
        };
        self.position = std::array::from_fn(|axis| match self.placement {
            Placement::Center => (SCREEN[axis] - self.size[axis]) / 2,
            Placement::Relative if position[axis] < 0 => {
                SCREEN[axis] + position[axis] - self.size[axis]
            }
            Placement::Relative | Placement::Absolute => position[axis],
        });
    }

    /// Resets its size to the default.
    pub fn adjust_size(&mut self) {
        self.size = DEFAULT_SIZE;
    }

    /// The widget with that id.
    ///
    /// # Errors
    /// When there is no such widget.
    pub fn widget(&self, id: i64) -> UiResult<&Widget> {
        self.widgets.get(&id).ok_or(UiError::NoSuchWidget(id))
    }

    /// The widget with that id, to change it.
    ///
    /// # Errors
    /// When there is no such widget.
    pub fn widget_mut(&mut self, id: i64) -> UiResult<&mut Widget> {
        self.widgets.get_mut(&id).ok_or(UiError::NoSuchWidget(id))
    }

    /// What is special about a widget of type `T`.
    ///
    /// # Errors
    /// When there is no such widget, or it is of another kind.
    pub fn get<T: WidgetType>(&self, id: i64) -> UiResult<&T> {
        T::of(&self.widget(id)?.kind).ok_or(UiError::WidgetType(T::CLASS))
    }

    /// What is special about a widget of type `T`, to change it.
    ///
    /// # Errors
    /// When there is no such widget, or it is of another kind.
    pub fn get_mut<T: WidgetType>(&mut self, id: i64) -> UiResult<&mut T> {
        T::of_mut(&mut self.widget_mut(id)?.kind).ok_or(UiError::WidgetType(T::CLASS))
    }

    /// The widgets of a kind, in the order of their ids.
    pub fn all<'a, T: WidgetType + 'a>(&'a self) -> impl Iterator<Item = (i64, &'a T)> {
        self.widgets
            .iter()
            .filter_map(|(id, widget)| Some((*id, T::of(&widget.kind)?)))
    }

    /// Whether a widget is seen, with all that is around it.
    pub fn is_widget_visible(&self, id: i64) -> bool {
        self.is_visible() && self.with_parents(id).all(|widget| widget.visible)
    }

    /// Whether a widget takes inputs, with all that is around it.
    pub(super) fn is_widget_enabled(&self, id: i64) -> bool {
        self.enabled && self.with_parents(id).all(|widget| widget.enabled)
    }

    fn with_parents(&self, id: i64) -> impl Iterator<Item = &Widget> {
        std::iter::successors(self.widgets.get(&id), |widget| {
            self.widgets.get(&widget.parent?)
        })
    }

    /// All widgets in the order of reading: those in a container after it.
    pub(super) fn in_reading_order(&self) -> Vec<&Widget> {
        let mut order = Vec::new();
        let mut waiting: Vec<i64> = self.root.widgets().collect();
        waiting.reverse();
        while let Some(id) = waiting.pop() {
            if let Some(widget) = self.widgets.get(&id) {
                order.push(widget);
                waiting.extend(widget.children().into_iter().rev());
            }
        }
        order
    }

    /// Queues a call of the function that an attribute of a widget names, with the window, the widget and `args`. Nothing without one.
    pub(super) fn raise(&mut self, id: i64, attribute: &str, args: impl IntoIterator<Item = Data>) {
        self.raise_event(id, attribute, args, false);
    }

    pub(super) fn raise_event(
        &mut self,
        id: i64,
        attribute: &str,
        args: impl IntoIterator<Item = Data>,
        evaluates: bool,
    ) {
        let handler = self
            .widgets
            .get(&id)
            .and_then(|widget| widget.handlers.get(attribute))
            .cloned();
        if handler.is_none() && !evaluates {
            return;
        }
        let mut all = vec![Data::text(&self.handle()), Data::Int(id)];
        all.extend(args);
        let (window, script) = (Some(self.id), self.owner);
        let handler = handler.unwrap_or_default();
        self.raised.push(Event {
            window,
            widget: Some(id),
            script,
            handler,
            args: all,
            evaluates,
        });
    }

    /// Queues a call of the handler of the close button; false without one.
    pub(super) fn raise_close(&mut self) -> bool {
        if self.on_close.is_empty() {
            return false;
        }
        let (window, script, handler) = (Some(self.id), self.owner, self.on_close.clone());
        let args = match (self.source, self.get::<TextBrowser>(1)) {
            (WindowSource::Editor, Ok(editor)) => {
                vec![
                    Data::text(&editor.text),
                    self.position.into(),
                    self.size.into(),
                ]
            }
            _ => vec![Data::text(&self.handle())],
        };
        self.raised.push(Event {
            window,
            widget: None,
            script,
            handler,
            args,
            evaluates: false,
        });
        true
    }

    /// The kind of a widget.
    pub(super) fn kind(&self, id: i64) -> UiResult<&WidgetKind> {
        self.widget(id).map(|widget| &widget.kind)
    }
}
