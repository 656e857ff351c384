//! The kinds of widgets, and what each keeps: its values, and what a page needs to show it.

mod inputs;
mod picture;
mod plot;
mod properties;
mod scene3d;
mod table;
mod tree;

use std::collections::BTreeMap;

use super::canvas::Canvas;

pub use inputs::{
    Button, Checkbox, Combobox, Edit, Label, ProgressBar, Radiobutton, Slider, Spinbox,
    TextBrowser, TextType,
};
pub use picture::{Image, Svg};
pub use plot::{Curve, CurveOptions, CurveType, Plot};
pub use properties::{Properties, Property};
pub(crate) use scene3d::NODE_TYPES;
pub use scene3d::{Node, Scene3d};
pub use table::{Cell, SelectionMode, Table};
pub use tree::Tree;

/// How the widgets in a container are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Layout {
    /// One below the other.
    #[default]
    VerticalBox,
    /// Side by side.
    HorizontalBox,
    /// Cells from left to right; breaks begin the next row.
    Grid,
    /// Pairs of a label and a field.
    Form,
    /// Each widget has a geometry of its own.
    None,
}

impl Layout {
    pub(super) const NAMES: [&'static str; 5] = ["vbox", "hbox", "grid", "form", "none"];
    const ALL: [Self; 5] = [
        Self::VerticalBox,
        Self::HorizontalBox,
        Self::Grid,
        Self::Form,
        Self::None,
    ];

    pub(super) fn named(name: &str) -> Self {
        let found = Self::NAMES
            .iter()
            .zip(Self::ALL)
            .find(|(known, _)| **known == name);
        found.map_or_else(Self::default, |(_, layout)| layout)
    }

    pub(super) fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    pub(super) fn is_box(self) -> bool {
        matches!(self, Self::VerticalBox | Self::HorizontalBox)
    }
}

/// What stands in a container.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A widget, by its id.
    Widget(i64),
    /// The next row of a grid begins.
    Break,
    /// Space that grows by this factor.
    Stretch(i64),
}

/// Widgets with their layout.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Container {
    /// How the widgets are placed.
    pub layout: Layout,
    /// Left, top, right, bottom, pixels.
    pub margins: [i64; 4],
    /// Distance between widgets, pixels; -1 for the default.
    pub spacing: i64,
    /// What is in it, in order.
    pub items: Vec<Item>,
}

impl Container {
    /// The widgets in it, in their order.
    pub(crate) fn widgets(&self) -> impl Iterator<Item = i64> {
        self.items.iter().filter_map(|item| {
            if let Item::Widget(id) = item {
                Some(*id)
            } else {
                None
            }
        })
    }
}

/// A frame around widgets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Group {
    /// The widgets in it.
    pub container: Container,
    /// Without the frame.
    pub flat: bool,
}

/// Pages of which one is seen.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tabs {
    /// The ids of the pages.
    pub pages: Vec<i64>,
    /// Counts from 0.
    pub current: usize,
    /// Where the titles are: `north`, `south`, `east`, `west`.
    pub position: &'static str,
}

/// A page of tabs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tab {
    /// The title.
    pub title: String,
    /// The widgets in it.
    pub container: Container,
}

macro_rules! kinds {
    ($($kind:ident $tag:literal $class:literal;)*) => {
        /// What a widget is.
        #[derive(Debug, Clone, PartialEq)]
        pub enum WidgetKind {$(
            #[doc = concat!("The element `", $tag, "`.")]
            $kind($kind),
        )*}

        impl WidgetKind {
            /// The name of its element.
            pub fn tag(&self) -> &'static str {
                match self {
                    Self::Slider(slider) if slider.vertical => "vslider",
                    $(Self::$kind(_) => $tag),*
                }
            }
        }

        $(impl WidgetType for $kind {
            const CLASS: &'static str = $class;

            /// The widget as this type, if it is one.
            fn of(kind: &WidgetKind) -> Option<&Self> {
                if let WidgetKind::$kind(widget) = kind { Some(widget) } else { None }
            }

            /// The widget as this type, to change it, if it is one.
            fn of_mut(kind: &mut WidgetKind) -> Option<&mut Self> {
                if let WidgetKind::$kind(widget) = kind { Some(widget) } else { None }
            }
        })*
    };
}

kinds! {
    Button "button" "button";
    Checkbox "checkbox" "checkbox";
    Radiobutton "radiobutton" "radiobutton";
    Combobox "combobox" "combobox";
    Edit "edit" "edit";
    Slider "hslider" "slider";
    Spinbox "spinbox" "spinbox";
    Label "label" "label";
    Group "group" "group";
    Tabs "tabs" "tabs";
    Tab "tab" "tab";
    ProgressBar "progressbar" "progressbar";
    Image "image" "image";
    Svg "svg" "svg";
    Table "table" "table";
    Tree "tree" "tree";
    TextBrowser "text-browser" "text-browser";
    Canvas "canvas" "canvas";
    Plot "plot" "plot";
    Properties "properties" "properties";
    Scene3d "scene3d" "scene3d";
}

/// A kind of widget as a type.
pub trait WidgetType: Sized {
    /// The name errors call it by.
    const CLASS: &'static str;

    fn of(kind: &WidgetKind) -> Option<&Self>;
    fn of_mut(kind: &mut WidgetKind) -> Option<&mut Self>;
}

/// A widget of a window.
#[derive(Debug, Clone, PartialEq)]
pub struct Widget {
    /// Positive from the text; negative for one without.
    pub id: i64,
    /// The widget around it; None directly in the window.
    pub parent: Option<i64>,
    /// Whether it takes inputs.
    pub enabled: bool,
    /// Whether it is shown.
    pub visible: bool,
    /// A style sheet of Qt.
    pub style: String,
    /// Its share in a box; -1 for none.
    pub stretch: i64,
    /// Position and size in a container without layout, pixels.
    pub geometry: Option<[i64; 4]>,
    /// Names of functions of the owner's, by the attribute.
    pub handlers: BTreeMap<&'static str, String>,
    /// What it is.
    pub kind: WidgetKind,
}

impl Widget {
    /// The widgets directly in it.
    pub(crate) fn children(&self) -> Vec<i64> {
        match &self.kind {
            WidgetKind::Group(group) => group.container.widgets().collect(),
            WidgetKind::Tab(tab) => tab.container.widgets().collect(),
            WidgetKind::Tabs(tabs) => tabs.pages.clone(),
            _ => Vec::new(),
        }
    }
}
