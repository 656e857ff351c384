//! Elements of tables, trees, pictures, plots and scenes.

use std::collections::BTreeMap;

use super::super::widgets::{
    Cell, Image, NODE_TYPES, Node, Plot, Properties, Scene3d, SelectionMode, Svg, Table, Tree,
    WidgetKind,
};
use super::super::xml::Element;
use super::attributes::{Attributes, Result, bool_of};
use scene::Data;

/// The colours of a plot that its text may set: those of both axes, and of one.
const COLORS: [&str; 14] = [
    "background-color",
    "foreground-color",
    "axis-color",
    "axis-x-color",
    "axis-y-color",
    "grid-color",
    "grid-x-color",
    "grid-y-color",
    "label-color",
    "label-x-color",
    "label-y-color",
    "tick-label-color",
    "tick-label-x-color",
    "tick-label-y-color",
];

pub(super) fn image(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let image = Image::blank(attributes.int("width", -1)?, attributes.int("height", -1)?);
    Ok(WidgetKind::Image(Image {
        file: attributes.text("file", ""),
        scaled_contents: attributes.bool("scaled-contents", false)?,
        keep_aspect_ratio: attributes.bool("keep-aspect-ratio", false)?,
        ..image
    }))
}

pub(super) fn svg(element: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let drawing = element.children.iter().find(|child| child.name == "svg");
    let text = drawing
        .map(|child| child.source.clone())
        .unwrap_or_default();
    let file = attributes.text("file", "");
    Ok(WidgetKind::Svg(Svg {
        file: if drawing.is_some() {
            String::new()
        } else {
            file
        },
        text,
    }))
}

/// The texts of the items in an element.
fn items(element: &Element) -> impl Iterator<Item = &Element> {
    element.children.iter().filter(|child| child.name == "item")
}

fn header(element: &Element) -> BTreeMap<i64, String> {
    let headers = element
        .children
        .iter()
        .filter(|child| child.name == "header")
        .flat_map(items);
    (0..).zip(headers.map(|item| item.text.clone())).collect()
}

fn rows(element: &Element) -> impl Iterator<Item = &Element> {
    element.children.iter().filter(|child| child.name == "row")
}

pub(super) fn table(element: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let mut table = Table {
        show_header: [
            attributes.bool("show-horizontal-header", true)?,
            attributes.bool("show-vertical-header", false)?,
        ],
        autosize_header: [
            attributes.bool("autosize-horizontal-header", true)?,
            attributes.bool("autosize-vertical-header", true)?,
        ],
        show_grid: attributes.bool("show-grid", true)?,
        editable: attributes.bool("editable", true)?,
        sortable: attributes.bool("sortable", false)?,
        selection_mode: SelectionMode::named(attributes.choice(
            "selection-mode",
            &SelectionMode::NAMES,
            "item",
        )?),
        selection: [-1; 2],
        ..Table::default()
    };
    for (row, element) in (0..).zip(rows(element)) {
        table.row_count = row + 1;
        let label = element.attributes.iter().find(|(name, _)| name == "label");
        table
            .row_headers
            .extend(label.map(|(_, text)| (row, text.clone())));
        for (column, item) in (0..).zip(items(element)) {
            table.column_count = table.column_count.max(column + 1);
            table.cells.insert((row, column), cell(item)?);
        }
    }
    let columns = table.column_count;
    table.column_headers = header(element)
        .into_iter()
        .filter(|(column, _)| *column < columns)
        .collect();
    Ok(WidgetKind::Table(table))
}

fn cell(item: &Element) -> Result<Cell> {
    let editable = item.attributes.iter().find(|(name, _)| name == "editable");
    let editable = editable.map_or(Ok(true), |(name, value)| bool_of(value, name))?;
    Ok(Cell {
        editable,
        ..Cell::of_text(item.text.clone())
    })
}

pub(super) fn tree(element: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let mut tree = Tree {
        show_header: attributes.bool("show-header", true)?,
        autosize_header: attributes.bool("autosize-header", true)?,
        sortable: attributes.bool("sortable", false)?,
        column_headers: header(element),
        ..Tree::default()
    };
    let mut found = BTreeMap::new();
    for (anonymous, row) in (1..).zip(rows(element)) {
        let attribute = |name: &str| {
            row.attributes
                .iter()
                .find(|(key, _)| key == name)
                .map(|(_, value)| value)
        };
        let number = |name: &str, default: i64| match attribute(name) {
            Some(value) => value.parse::<i32>().map(i64::from).map_err(|_| {
                "bad lexical cast: source type value could not be interpreted as target".to_owned()
            }),
            None => Ok(default),
        };
        let id = number("id", -anonymous)?;
        if attribute("id").is_some() && id <= 0 {
            return Err("'id' attribute of element <row> must be positive".into());
        }
        let expanded =
            attribute("expanded").map_or(Ok(false), |value| bool_of(value, "expanded"))?;
        let texts: Vec<String> = items(row).map(|item| item.text.clone()).collect();
        tree.column_count = tree.column_count.max(texts.len() as i64);
        found.insert(id, (number("parent-id", 0)?, texts, expanded));
    }
    tree.column_count = tree.column_count.max(tree.column_headers.len() as i64);
    for (id, (parent, texts, expanded)) in found {
        tree.add(id, parent, texts, expanded);
    }
    Ok(WidgetKind::Tree(tree))
}

pub(super) fn plot(_: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let plot_type = attributes.get("type").unwrap_or("time");
    if !["time", "xy"].contains(&plot_type) {
        return Err("the value for the 'type' attribute must be one of 'time', 'xy'".into());
    }
    let mut colors = BTreeMap::new();
    for name in COLORS {
        if let Some(color) = attributes.ints(name)? {
            colors.insert(name, color);
        }
    }
    let of_axes = |both: &'static str, axes: [&'static str; 2]| -> Result<[bool; 2]> {
        let default = attributes.bool(both, true)?;
        Ok([
            attributes.bool(axes[0], default)?,
            attributes.bool(axes[1], default)?,
        ])
    };
    Ok(WidgetKind::Plot(Plot {
        colors,
        square: attributes.bool("square", false)?,
        max_buffer_size: attributes.int("max-buffer-size", 1000)?,
        cyclic_buffer: attributes.bool("cyclic-buffer", false)?,
        ticks: of_axes("ticks", ["x-ticks", "y-ticks"])?,
        tick_labels: of_axes("tick-labels", ["x-tick-labels", "y-tick-labels"])?,
        ..Plot::default()
    }))
}

pub(super) fn properties(_: &Element, _: &Attributes<'_>) -> Result<WidgetKind> {
    Ok(WidgetKind::Properties(Properties {
        selected: -1,
        ..Properties::default()
    }))
}

pub(super) fn scene3d(element: &Element, attributes: &Attributes<'_>) -> Result<WidgetKind> {
    let mut scene = Scene3d {
        clear_color: attributes.text("clear-color", ""),
        ..Scene3d::default()
    };
    let mut anonymous = -1;
    add_nodes(&mut scene, element, -1, &mut anonymous)?;
    Ok(WidgetKind::Scene3d(scene))
}

/// Adds the nodes in an element. Those without an id get the negative ones below `anonymous`.
fn add_nodes(
    scene: &mut Scene3d,
    element: &Element,
    parent: i64,
    anonymous: &mut i64,
) -> Result<()> {
    for child in &element.children {
        let node_type = NODE_TYPES.iter().find(|known| **known == child.name);
        let node_type = node_type.ok_or_else(|| format!("invalid node type '{}'", child.name))?;
        let id = child
            .attributes
            .iter()
            .find(|(name, _)| name == "id")
            .and_then(|(_, value)| value.parse().ok());
        let id = id.filter(|id: &i64| *id > 0).unwrap_or_else(|| {
            *anonymous -= 1;
            *anonymous
        });
        if scene.nodes.contains_key(&id) {
            return Err("node id already exists".into());
        }
        let params = child
            .attributes
            .iter()
            .filter(|(name, _)| !["id", "enabled"].contains(&name.as_str()));
        let params = params
            .map(|(name, value)| (name.clone(), Data::text(value)))
            .collect();
        let enabled = !child
            .attributes
            .iter()
            .any(|(name, value)| name == "enabled" && value == "false");
        scene.nodes.insert(
            id,
            Node {
                node_type,
                parent,
                enabled,
                params,
            },
        );
        add_nodes(scene, child, id, anonymous)?;
    }
    Ok(())
}
