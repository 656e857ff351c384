//! What a person does with a window, and what that changes. Handlers of scripts run later, when the queue of events is delivered.

use super::canvas::CanvasInput;
use super::widgets::{
    Button, Checkbox, Combobox, Edit, Image, Plot, Properties, Radiobutton, Scene3d, Slider,
    Spinbox, Svg, Table, Tabs, TextBrowser, Tree, WidgetKind,
};
use super::window::Window;
use scene::Data;

/// A value as a person enters it.
#[derive(Debug, Clone, PartialEq)]
pub enum InputValue {
    /// A switch.
    Bool(bool),
    /// A number, or an index.
    Number(f64),
    /// A text.
    Text(String),
}

/// Modifier keys that are held down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Modifiers {
    /// Shift.
    pub shift: bool,
    /// Ctrl.
    pub control: bool,
    /// Alt.
    pub alt: bool,
}

impl Modifiers {
    /// As handlers get them.
    pub fn data(self) -> Data {
        Data::map([
            ("shift", Data::Bool(self.shift)),
            ("control", Data::Bool(self.control)),
            ("alt", Data::Bool(self.alt)),
        ])
    }
}

/// What the left mouse button does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MouseAction {
    /// It is pressed.
    Down,
    /// It is released.
    Up,
    /// The pointer moves while it is held down.
    Move,
}

impl MouseAction {
    /// The handler's attribute, and the number it gets (simUI.mouse).
    fn described(self) -> (&'static str, i64) {
        match self {
            Self::Down => ("on-mouse-down", 20400),
            Self::Up => ("on-mouse-up", 20401),
            Self::Move => ("on-mouse-move", 20402),
        }
    }
}

/// What a person does with a widget.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// A click on a button, a radio button or a check box.
    Click,
    /// A new value, text or choice.
    Value(InputValue),
    /// The end of editing a text: return, or the focus is lost.
    Finish,
    /// A cell of a table is selected; -1 for both selects nothing.
    SelectCell([i64; 2]),
    /// A selection: of a tree an item, 0 for none; of properties a row, -1 for none.
    Select(i64),
    /// A cell was activated, or changed to a text.
    Cell([i64; 2], Option<String>),
    /// An item of a tree is opened or closed.
    Expand(i64, bool),
    /// A key, by its number in Qt.
    Key {
        /// Its number in Qt.
        key: i64,
        /// The text it would enter.
        text: String,
        /// Modifier keys that are held down.
        modifiers: Modifiers,
    },
    /// The mouse on an image or a drawing.
    Mouse {
        /// What the left button does.
        mouse: MouseAction,
        /// Pixels from the upper left corner of the widget.
        at: [i64; 2],
        /// Modifier keys that are held down.
        modifiers: Modifiers,
    },
    /// The pointer or a key on a canvas, for the program that draws it.
    Canvas(CanvasInput),
    /// A link of a label or a text is followed.
    Link(String),
    /// A point of a curve is clicked.
    Point {
        /// The name of the curve.
        curve: String,
        /// Which point, from 0.
        index: i64,
        /// Its x and y.
        at: [f64; 2],
    },
    /// A curve is clicked in the legend of a plot.
    Legend(String),
    /// A node of a scene is clicked.
    Node(i64),
    /// An entry of the context menu of properties is chosen, by its key.
    Menu(String),
    /// A double click on a cell of properties: row and column.
    DoubleClick([i64; 2]),
    /// A property gets another value.
    Property {
        /// The name of the property.
        name: String,
        /// The text that was entered.
        text: String,
    },
}

/// Why an input changes nothing.
pub(super) type InputResult = Result<(), String>;

impl Window {
    /// Does what a person does with a widget.
    ///
    /// # Errors
    /// When the widget takes no inputs, or none of that sort.
    pub(super) fn input(&mut self, id: i64, input: Input) -> InputResult {
        let kind = self.kind(id).map_err(|error| error.to_string())?;
        if !self.is_widget_visible(id) {
            return Err(format!("widget {id} is not visible"));
        }
        if !self.is_widget_enabled(id) {
            return Err(format!("widget {id} is disabled"));
        }
        let refused = format!("{} {id} does not take this input", kind.tag());
        let done = match input {
            Input::Click => self.click(id),
            Input::Value(value) => return self.enter(id, &value).ok_or(refused)?,
            Input::Finish => self.finish_editing(id),
            Input::SelectCell([row, column]) => self.select_cell(id, row, column, true).ok(),
            Input::Select(item) => self.select(id, item),
            Input::Cell(place, text) => return self.edit_cell(id, place, text).ok_or(refused)?,
            Input::Expand(item, expanded) => self.expand(id, item, expanded),
            Input::Key {
                key,
                text,
                modifiers,
            } => self.press_key(id, key, &text, modifiers),
            Input::Mouse {
                mouse,
                at,
                modifiers,
            } => self.move_mouse(id, mouse, at, modifiers),
            Input::Canvas(input) => return self.canvas_input(id, input).ok_or(refused)?,
            Input::Link(href) => self.activate_link(id, &href),
            Input::Point { curve, index, at } => self.click_point(id, &curve, index, at),
            Input::Legend(curve) => self.click_legend(id, &curve),
            Input::Node(node) => self.click_node(id, node),
            Input::Menu(key) => {
                self.of_properties(id, "on-context-menu-triggered", [Data::text(&key)])
            }
            Input::DoubleClick(place) => {
                self.of_properties(id, "on-double-click", place.map(Data::Int))
            }
            Input::Property { name, text } => self.of_properties(
                id,
                "on-property-edit",
                [Data::text(&name), Data::text(&text)],
            ),
        };
        done.ok_or(refused)
    }

    fn click(&mut self, id: i64) -> Option<()> {
        match self.kind(id).ok()? {
            WidgetKind::Button(button) => {
                // One that excludes its neighbours stays down when it is pressed again.
                let pressed = !button.checked || button.auto_exclusive;
                self.set_button_pressed(id, pressed).ok()?;
                self.raise(id, "on-click", []);
            }
            WidgetKind::Radiobutton(_) => {
                self.set_radiobutton(id, 1).ok()?;
                self.raise(id, "on-click", []);
            }
            WidgetKind::Checkbox(checkbox) => {
                let value = if checkbox.value == 2 { 0 } else { 2 };
                self.set_checkbox(id, value, true).ok()?;
            }
            _ => return None,
        }
        Some(())
    }

    /// A new value; None where a widget has none of that type.
    fn enter(&mut self, id: i64, value: &InputValue) -> Option<InputResult> {
        match (self.kind(id).ok()?, value) {
            (WidgetKind::Slider(_), InputValue::Number(value)) => {
                self.set_slider(id, *value as i64, true).ok()?;
            }
            (WidgetKind::Spinbox(_), InputValue::Number(value)) => {
                self.set_spinbox(id, *value, true).ok()?;
            }
            (WidgetKind::Edit(_), value) => self.set_edit(id, text_of(value), true).ok()?,
            (WidgetKind::TextBrowser(TextBrowser { read_only, .. }), InputValue::Text(text)) => {
                if *read_only {
                    return Some(Err(format!("the text of widget {id} cannot be changed")));
                }
                self.set_browser_text(id, text.clone(), true).ok()?;
            }
            (WidgetKind::Checkbox(_), value) => self.set_checkbox(id, switch(value)?, true).ok()?,
            (
                WidgetKind::Button(Button {
                    checkable: true,
                    checked,
                    ..
                }),
                value,
            ) => {
                if (switch(value)? != 0) != *checked {
                    self.click(id)?;
                }
            }
            (WidgetKind::Radiobutton(Radiobutton { .. }), value) if switch(value)? != 0 => {
                self.click(id)?;
            }
            (WidgetKind::Combobox(Combobox { items, .. }), value) => {
                return Some(self.choose(id, items.clone(), value));
            }
            (WidgetKind::Tabs(Tabs { pages, .. }), value) => {
                let titles = pages.iter().map(|page| match self.kind(*page) {
                    Ok(WidgetKind::Tab(tab)) => tab.title.clone(),
                    _ => String::new(),
                });
                let index = place_of(value, &titles.collect::<Vec<_>>());
                return Some(
                    index.and_then(|index| {
                        self.set_tab(id, index).map_err(|error| error.to_string())
                    }),
                );
            }
            _ => return None,
        }
        Some(Ok(()))
    }

    fn choose(&mut self, id: i64, items: Vec<String>, value: &InputValue) -> InputResult {
        let index = place_of(value, &items)?;
        let select = |combobox: &mut Combobox| combobox.selected = usize::try_from(index).ok();
        self.change_combobox(id, true, select)
            .map_err(|error| error.to_string())
    }

    fn finish_editing(&mut self, id: i64) -> Option<()> {
        let Edit {
            value, evaluates, ..
        } = self.get::<Edit>(id).ok()?.clone();
        self.raise_event(id, "on-editing-finished", [Data::text(&value)], evaluates);
        Some(())
    }

    fn select(&mut self, id: i64, item: i64) -> Option<()> {
        match self.kind(id).ok()? {
            WidgetKind::Tree(_) => self.select_item(id, item, true).ok(),
            WidgetKind::Properties(_) => self.select_property(id, item, true).ok(),
            _ => None,
        }
    }

    fn edit_cell(
        &mut self,
        id: i64,
        [row, column]: [i64; 2],
        text: Option<String>,
    ) -> Option<InputResult> {
        let table = self.get::<Table>(id).ok()?;
        if !table.contains(row, column) {
            return Some(Err(format!("table {id} has no cell {row}, {column}")));
        }
        let editable = table.editable
            && table
                .cells
                .get(&(row, column))
                .is_none_or(|cell| cell.editable);
        let before = table.text(row, column).to_owned();
        match text {
            Some(_) if !editable => {
                return Some(Err(format!(
                    "cell {row}, {column} of table {id} cannot be changed"
                )));
            }
            Some(text) => self.set_cell(id, [row, column], text, true).ok()?,
            None => self.raise_cell(id, [row, column], &before),
        }
        Some(Ok(()))
    }

    fn expand(&mut self, id: i64, item: i64, expanded: bool) -> Option<()> {
        self.get_mut::<Tree>(id)
            .ok()?
            .items
            .get_mut(&item)?
            .expanded = expanded;
        Some(())
    }

    fn press_key(&mut self, id: i64, key: i64, text: &str, modifiers: Modifiers) -> Option<()> {
        if !matches!(
            self.kind(id).ok()?,
            WidgetKind::Table(_) | WidgetKind::Properties(_)
        ) {
            return None;
        }
        self.raise(
            id,
            "on-key-press",
            [Data::Int(key), Data::text(text), modifiers.data()],
        );
        Some(())
    }

    fn move_mouse(
        &mut self,
        id: i64,
        mouse: MouseAction,
        [x, y]: [i64; 2],
        modifiers: Modifiers,
    ) -> Option<()> {
        if !matches!(
            self.kind(id).ok()?,
            WidgetKind::Image(Image { .. }) | WidgetKind::Svg(Svg { .. })
        ) {
            return None;
        }
        let (attribute, code) = mouse.described();
        self.raise(
            id,
            attribute,
            [
                Data::Int(code),
                modifiers.data(),
                Data::Int(x),
                Data::Int(y),
            ],
        );
        Some(())
    }

    fn activate_link(&mut self, id: i64, href: &str) -> Option<()> {
        if !matches!(
            self.kind(id).ok()?,
            WidgetKind::Label(_) | WidgetKind::TextBrowser(_)
        ) {
            return None;
        }
        self.raise(id, "on-link-activated", [Data::text(href)]);
        Some(())
    }

    fn click_point(&mut self, id: i64, curve: &str, index: i64, at: [f64; 2]) -> Option<()> {
        self.get::<Plot>(id).ok()?.curve(curve).ok()?;
        // The original hands them on as numbers of single precision.
        let [x, y] = at.map(|coordinate| Data::Float(f64::from(coordinate as f32)));
        self.raise(id, "on-click", [Data::text(curve), Data::Int(index), x, y]);
        Some(())
    }

    fn click_legend(&mut self, id: i64, curve: &str) -> Option<()> {
        self.get::<Plot>(id).ok()?.curve(curve).ok()?;
        self.raise(id, "on-legend-click", [Data::text(curve)]);
        Some(())
    }

    fn click_node(&mut self, id: i64, node: i64) -> Option<()> {
        self.get::<Scene3d>(id).ok()?.nodes.get(&node)?;
        self.raise(id, "on-click", [Data::Int(node)]);
        Some(())
    }

    fn of_properties<const N: usize>(
        &mut self,
        id: i64,
        attribute: &str,
        args: [Data; N],
    ) -> Option<()> {
        self.get::<Properties>(id).ok()?;
        self.raise(id, attribute, args);
        Some(())
    }

    /// The value of a widget, as a person sees it; None for one without.
    pub fn value(&self, id: i64) -> Option<Data> {
        Some(match self.kind(id).ok()? {
            WidgetKind::Slider(Slider { value, .. })
            | WidgetKind::Checkbox(Checkbox { value, .. }) => Data::Int(*value),
            WidgetKind::Spinbox(Spinbox {
                value,
                decimals: None,
                ..
            }) => Data::Int(*value as i64),
            WidgetKind::Spinbox(Spinbox { value, .. }) => Data::Float(*value),
            WidgetKind::Edit(Edit { value, .. }) => Data::text(value),
            WidgetKind::Label(label) => Data::text(&label.text),
            WidgetKind::Radiobutton(button) => Data::Int(button.checked.into()),
            WidgetKind::Button(Button {
                checkable: true,
                checked,
                ..
            }) => Data::Bool(*checked),
            WidgetKind::Combobox(Combobox { items, selected }) => Data::text(
                selected
                    .and_then(|selected| items.get(selected))
                    .map_or("", String::as_str),
            ),
            WidgetKind::ProgressBar(bar) => Data::Int(bar.value),
            WidgetKind::TextBrowser(browser) => Data::text(&browser.text),
            WidgetKind::Tabs(tabs) => Data::Int(tabs.current as i64),
            WidgetKind::Tree(Tree { selected, .. }) => Data::Int(*selected),
            WidgetKind::Table(table) => table.selection.map(Data::Int).to_vec().into(),
            _ => return None,
        })
    }
}

impl From<Data> for InputValue {
    fn from(data: Data) -> Self {
        match data {
            Data::Bool(on) => Self::Bool(on),
            Data::Text(bytes) | Data::Buffer(bytes) => {
                Self::Text(String::from_utf8_lossy(&bytes).into_owned())
            }
            other => Self::Number(other.as_f64().unwrap_or(f64::NAN)),
        }
    }
}

fn text_of(value: &InputValue) -> String {
    match value {
        InputValue::Text(text) => text.clone(),
        InputValue::Number(number) => number.to_string(),
        InputValue::Bool(on) => on.to_string(),
    }
}

/// 0 or 2, or a number as it is.
fn switch(value: &InputValue) -> Option<i64> {
    match value {
        InputValue::Bool(on) => Some(if *on { 2 } else { 0 }),
        InputValue::Number(number) => Some(*number as i64),
        InputValue::Text(_) => None,
    }
}

/// The place of a choice among texts, by its number or its text.
fn place_of(value: &InputValue, texts: &[String]) -> Result<i64, String> {
    match value {
        InputValue::Number(index) if (0..texts.len() as i64).contains(&(*index as i64)) => {
            Ok(*index as i64)
        }
        InputValue::Text(text) if texts.contains(text) => Ok(texts
            .iter()
            .position(|known| known == text)
            .map_or(-1, |place| place as i64)),
        _ => Err(format!("there is no such choice: it is one of {texts:?}")),
    }
}
