//! From the text of a window to its widgets (spec: simui 2, spec: simui 3).

mod attributes;
mod collections;
mod inputs;

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::widgets::{Container, Group, Item, Layout, Tab, Tabs, Widget, WidgetKind};
use super::window::{Placement, Window};
use super::xml::{self, Element};
pub(crate) use attributes::Warning;
use attributes::{Attributes, Result};

/// A function that reads what is special about a kind of widget.
type Read = fn(&Element, &Attributes<'_>) -> Result<WidgetKind>;

/// The elements that contain no others, with the attributes for handlers of each.
const SIMPLE: &[(&str, Read, &[&str])] = &[
    ("button", inputs::button, &["on-click"]),
    ("checkbox", inputs::checkbox, &["on-change"]),
    ("radiobutton", inputs::radiobutton, &["on-click"]),
    ("combobox", inputs::combobox, &["on-change"]),
    ("edit", inputs::edit, &["on-change", "on-editing-finished"]),
    ("hslider", inputs::slider, &["on-change"]),
    ("vslider", inputs::slider, &["on-change"]),
    ("spinbox", inputs::spinbox, &["on-change"]),
    ("label", inputs::label, &["on-link-activated"]),
    ("progressbar", inputs::progress_bar, &[]),
    (
        "text-browser",
        inputs::text_browser,
        &["on-change", "on-link-activated"],
    ),
    (
        "image",
        collections::image,
        &["on-mouse-down", "on-mouse-up", "on-mouse-move"],
    ),
    (
        "svg",
        collections::svg,
        &["on-mouse-down", "on-mouse-up", "on-mouse-move"],
    ),
    (
        "table",
        collections::table,
        &["on-cell-activate", "on-selection-change", "on-key-press"],
    ),
    ("tree", collections::tree, &["on-selection-change"]),
    ("plot", collections::plot, &["on-click", "on-legend-click"]),
    (
        "properties",
        collections::properties,
        &[
            "on-selection-change",
            "on-key-press",
            "on-double-click",
            "on-context-menu-triggered",
            "on-property-edit",
        ],
    ),
    ("scene3d", collections::scene3d, &["on-click"]),
];

/// A window from its text, and what is to be said about the text. Widgets without an id get the negative ones below `anonymous`.
///
/// # Errors
/// In the words of the original, with the elements around the mistake.
pub(super) fn window(text: &str, anonymous: &mut i64) -> Result<(Window, Vec<Warning>)> {
    let root = xml::parse(text).ok_or("XML parse error")?;
    if root.name != "ui" {
        return Err("root element must be <ui>".into());
    }
    let builder = Builder {
        widgets: BTreeMap::new(),
        anonymous,
        warnings: RefCell::default(),
    };
    builder.window(&root)
}

/// Whether a name is that of an element for a widget.
fn is_widget(name: &str) -> bool {
    matches!(name, "group" | "tabs") || SIMPLE.iter().any(|(known, ..)| *known == name)
}

/// A window as it grows.
struct Builder<'a> {
    widgets: BTreeMap<i64, Widget>,
    anonymous: &'a mut i64,
    warnings: RefCell<Vec<Warning>>,
}

impl Builder<'_> {
    fn window(mut self, root: &Element) -> Result<(Window, Vec<Warning>)> {
        // Names of attributes that the root does not have are never looked for.
        let warnings = RefCell::default();
        let attributes = Attributes::new(root, &warnings);
        let mut window = Window {
            title: attributes.text("title", "Custom UI"),
            enabled: attributes.bool("enabled", true)?,
            modal: attributes.bool("modal", false)?,
            style: attributes.text("style", ""),
            resizable: attributes.bool("resizable", false)?,
            closeable: attributes.bool("closeable", false)?,
            placement: Placement::named(attributes.choice(
                "placement",
                &Placement::NAMES,
                "center",
            )?),
            activate: attributes.bool("activate", true)?,
            on_close: attributes.text("on-close", ""),
            ..Window::default()
        };
        attributes.bool("keep-in-visible-area", true)?;
        let position = attributes.ints("position")?.unwrap_or([50, 50]);
        window.place(position, attributes.ints("size")?.unwrap_or([-1, -1]));
        window.root = self.container(root, &attributes, None)?;
        window.widgets = self.widgets;
        let mut all = warnings.into_inner();
        all.extend(self.warnings.into_inner());
        Ok((window, all))
    }

    /// The attributes and children of an element that contains widgets.
    fn container(
        &mut self,
        element: &Element,
        attributes: &Attributes<'_>,
        parent: Option<i64>,
    ) -> Result<Container> {
        let mut container = Container {
            layout: Layout::named(attributes.choice("layout", &Layout::NAMES, "vbox")?),
            margins: attributes.ints("content-margins")?.unwrap_or([7; 4]),
            spacing: attributes.int("spacing", -1)?,
            items: Vec::new(),
        };
        for child in &element.children {
            let item = self.item(child, container.layout, parent)?;
            container.items.push(item);
        }
        if container.layout == Layout::Form && container.widgets().count() % 2 == 1 {
            return Err("extra elements in layout".into());
        }
        self.check_last_radiobutton(&container);
        Ok(container)
    }

    fn item(&mut self, element: &Element, layout: Layout, parent: Option<i64>) -> Result<Item> {
        match element.name.as_str() {
            "br" if layout == Layout::Grid => Ok(Item::Break),
            "stretch" if layout.is_box() => {
                let attributes = Attributes::new(element, &self.warnings);
                attributes
                    .int("factor", 0)
                    .map(Item::Stretch)
                    .map_err(|error| format!("stretch: {error}"))
            }
            "stretch" => Err("stretch must be placed in a widget with vbox/hbox layout".into()),
            name if is_widget(name) => self.widget(element, layout, parent).map(Item::Widget),
            name => Err(format!("invalid element <{name}>")),
        }
    }

    /// Adds the widget of an element with those in it; its id.
    fn widget(&mut self, element: &Element, layout: Layout, parent: Option<i64>) -> Result<i64> {
        let warnings = RefCell::default();
        let attributes = Attributes::new(element, &warnings);
        let id = attributes.int("id", i64::MAX);
        let tag = match &id {
            Ok(id) if *id > 0 && *id < i64::MAX => format!("{}[id={id}]", element.name),
            _ => element.name.clone(),
        };
        let added = id.and_then(|id| self.id(id)).and_then(|id| {
            self.add(id, element, &attributes, layout, parent)?;
            Ok(id)
        });
        attributes.warn_of_unknown();
        drop(attributes);
        self.warnings.borrow_mut().extend(warnings.into_inner());
        added.map_err(|error| format!("{tag}: {error}"))
    }

    /// The id of a widget whose attribute says `id`; `i64::MAX` without one.
    fn id(&mut self, id: i64) -> Result<i64> {
        match id {
            i64::MAX => {
                *self.anonymous -= 1;
                Ok(*self.anonymous)
            }
            ..=0 => Err("id must be a positive integer".into()),
            _ if self.widgets.contains_key(&id) => Err(format!(
                "id must be unique (within ui scope). duplicate id: {id}"
            )),
            _ => Ok(id),
        }
    }

    fn add(
        &mut self,
        id: i64,
        element: &Element,
        attributes: &Attributes<'_>,
        layout: Layout,
        parent: Option<i64>,
    ) -> Result<()> {
        let geometry = attributes.ints("geometry")?;
        if geometry.is_some() && layout != Layout::None {
            return Err("cannot set geometry with current layout".into());
        }
        let widget = Widget {
            id,
            parent,
            enabled: attributes.bool("enabled", true)?,
            visible: attributes.bool("visible", true)?,
            style: attributes.text("style", ""),
            stretch: attributes.int("stretch", -1)?,
            geometry,
            handlers: BTreeMap::new(),
            // A place for what follows: children must find that the id is in use.
            kind: WidgetKind::Group(Group::default()),
        };
        self.widgets.insert(id, widget);
        let (kind, handlers) = self.kind(id, element, attributes)?;
        if let Some(widget) = self.widgets.get_mut(&id) {
            (widget.kind, widget.handlers) = (kind, handlers);
        }
        Ok(())
    }

    fn kind(
        &mut self,
        id: i64,
        element: &Element,
        attributes: &Attributes<'_>,
    ) -> Result<(WidgetKind, BTreeMap<&'static str, String>)> {
        let kind = match element.name.as_str() {
            "group" => {
                let flat = attributes.bool("flat", false)?;
                WidgetKind::Group(Group {
                    container: self.container(element, attributes, Some(id))?,
                    flat,
                })
            }
            "tab" => {
                let title = attributes.text("title", "???");
                WidgetKind::Tab(Tab {
                    title,
                    container: self.container(element, attributes, Some(id))?,
                })
            }
            "tabs" => self.tabs(id, element, attributes)?,
            name => {
                let found = SIMPLE.iter().find(|(known, ..)| *known == name);
                let (_, read, handlers) =
                    found.ok_or_else(|| format!("invalid element <{name}>"))?;
                let named = |attribute: &&'static str| {
                    Some((*attribute, attributes.get(attribute)?.to_owned()))
                };
                let handlers = handlers
                    .iter()
                    .filter_map(named)
                    .filter(|(_, name)| !name.is_empty())
                    .collect();
                return Ok((read(element, attributes)?, handlers));
            }
        };
        Ok((kind, BTreeMap::new()))
    }

    fn tabs(
        &mut self,
        id: i64,
        element: &Element,
        attributes: &Attributes<'_>,
    ) -> Result<WidgetKind> {
        let positions = ["north", "south", "east", "west"];
        let mut tabs = Tabs {
            position: attributes.choice("tab-position", &positions, "north")?,
            current: 0,
            pages: Vec::new(),
        };
        attributes.bool("document-mode", false)?;
        attributes.choice("tab-shape", &["rounded", "triangular"], "rounded")?;
        for child in &element.children {
            if child.name != "tab" {
                return Err("element must be <tab>".into());
            }
            tabs.pages
                .push(self.widget(child, Layout::VerticalBox, Some(id))?);
        }
        Ok(WidgetKind::Tabs(tabs))
    }

    /// Of exclusive radio buttons side by side only the last that says so is checked.
    fn check_last_radiobutton(&mut self, container: &Container) {
        let mut found = false;
        for id in container.widgets().collect::<Vec<_>>().into_iter().rev() {
            if let Some(WidgetKind::Radiobutton(button)) =
                self.widgets.get_mut(&id).map(|widget| &mut widget.kind)
                && button.auto_exclusive
                && button.checked
            {
                button.checked = !found;
                found = true;
            }
        }
    }
}
