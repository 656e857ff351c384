//! What is special about each kind of widget.

use serde_json::{Map, Value, json};

use super::super::widgets::{Curve, Image, Plot, Scene3d, Table, Tree, WidgetKind};
use super::super::window::Window;
use super::base64;
use scene::Data;

/// Columns whose headers a page gets.
const MAX_HEADERS: i64 = 1000;

impl Window {
    pub(super) fn kind_json(&self, kind: &WidgetKind) -> Value {
        match kind {
            WidgetKind::Group(group) => {
                json!({"flat": group.flat, "content": self.container_json(&group.container)})
            }
            WidgetKind::Tab(tab) => {
                json!({"title": tab.title, "content": self.container_json(&tab.container)})
            }
            WidgetKind::Tabs(tabs) => {
                let pages = tabs.pages.iter().filter_map(|page| self.widgets.get(page));
                let pages: Vec<Value> = pages.map(|page| self.widget_json(page)).collect();
                json!({"current": tabs.current, "position": tabs.position, "pages": pages})
            }
            WidgetKind::Button(button) => json!({
                "text": button.text, "checkable": button.checkable, "checked": button.checked,
                "autoExclusive": button.auto_exclusive, "icon": button.icon, "repeat": button.repeat,
            }),
            WidgetKind::Checkbox(checkbox) => json!({
                "text": checkbox.text, "value": checkbox.value, "checkable": checkbox.checkable,
            }),
            WidgetKind::Radiobutton(button) => json!({
                "text": button.text, "value": i64::from(button.checked), "checkable": button.checkable,
                "autoExclusive": button.auto_exclusive,
            }),
            WidgetKind::Combobox(combobox) => json!({
                "items": combobox.items, "value": combobox.selected.map_or(-1, |selected| selected as i64),
            }),
            WidgetKind::Edit(edit) => {
                json!({"value": edit.value, "password": edit.password, "selected": edit.selected})
            }
            WidgetKind::Slider(slider) => json!({
                "value": slider.value, "minimum": slider.minimum, "maximum": slider.maximum,
                "vertical": slider.vertical, "tickInterval": slider.tick_interval,
                "tickPosition": slider.tick_position, "inverted": slider.inverted,
            }),
            WidgetKind::Spinbox(spinbox) => json!({
                "value": spinbox.value, "minimum": spinbox.minimum, "maximum": spinbox.maximum, "step": spinbox.step,
                "decimals": spinbox.decimals, "prefix": spinbox.prefix, "suffix": spinbox.suffix,
            }),
            WidgetKind::Label(label) => json!({"text": label.text, "wordWrap": label.word_wrap}),
            WidgetKind::ProgressBar(bar) => json!({
                "value": bar.value, "minimum": bar.minimum, "maximum": bar.maximum, "vertical": bar.vertical,
                "inverted": bar.inverted, "textVisible": bar.text_visible,
            }),
            WidgetKind::TextBrowser(browser) => json!({
                "text": browser.text, "type": browser.text_type.name(), "readOnly": browser.read_only,
                "wordWrap": browser.word_wrap, "url": browser.url,
            }),
            WidgetKind::Image(image) => image_json(image),
            WidgetKind::Canvas(canvas) => json!({
                "width": canvas.size[0], "height": canvas.size[1], "picture": base64(&canvas.picture),
            }),
            WidgetKind::Svg(svg) => json!({"text": svg.text}),
            WidgetKind::Table(table) => table_json(table),
            WidgetKind::Tree(tree) => tree_json(tree),
            WidgetKind::Plot(plot) => plot_json(plot),
            WidgetKind::Properties(properties) => {
                let rows = properties.rows.iter().map(|row| {
                    json!({
                        "name": row.name, "type": row.type_name, "value": row.value, "flags": row.flags,
                        "displayedName": row.displayed_name, "displayedValue": row.displayed_value,
                        "icon": row.icon, "description": row.description,
                    })
                });
                json!({
                    "rows": rows.collect::<Vec<_>>(), "selected": properties.selected, "menu": properties.menu,
                })
            }
            WidgetKind::Scene3d(scene) => scene_json(scene),
        }
    }
}

fn image_json(image: &Image) -> Value {
    json!({
        "width": image.width, "height": image.height, "pixels": base64(&image.pixels),
        "scaledContents": image.scaled_contents, "keepAspectRatio": image.keep_aspect_ratio,
    })
}

fn table_json(table: &Table) -> Value {
    let cells = table.cells.iter().map(|((row, column), cell)| {
        json!({
            "row": row, "column": column, "text": cell.text, "editable": cell.editable,
            "image": cell.image.as_ref().map(image_json),
        })
    });
    json!({
        "rowCount": table.row_count, "columnCount": table.column_count, "cells": cells.collect::<Vec<_>>(),
        "rowHeaders": table.row_headers, "columnHeaders": table.column_headers,
        "rowHeight": table.row_height, "columnWidth": table.column_width,
        "showHorizontalHeader": table.show_header[0], "showVerticalHeader": table.show_header[1],
        "autosizeHorizontalHeader": table.autosize_header[0], "autosizeVerticalHeader": table.autosize_header[1],
        "showGrid": table.show_grid, "editable": table.editable, "sortable": table.sortable,
        "selectionMode": table.selection_mode.name(), "selection": table.selection,
    })
}

fn tree_json(tree: &Tree) -> Value {
    let mut order: Vec<_> = tree.items.iter().collect();
    order.sort_by_key(|(_, item)| item.order);
    let items = order
        .into_iter()
        .map(|(id, item)| json!({"id": id, "parent": item.parent, "texts": item.texts, "expanded": item.expanded}));
    let last = tree.column_headers.keys().next_back().copied();
    let header = |column: i64| tree.column_headers.get(&column).map_or("", String::as_str);
    let headers: Vec<&str> = (0..=last.unwrap_or(-1).min(MAX_HEADERS))
        .map(header)
        .collect();
    json!({
        "items": items.collect::<Vec<_>>(), "columnCount": tree.column_count, "columnHeaders": headers,
        "showHeader": tree.show_header, "autosizeHeader": tree.autosize_header, "sortable": tree.sortable,
        "selected": tree.selected,
    })
}

fn plot_json(plot: &Plot) -> Value {
    let curves: Vec<Value> = plot.curves.iter().map(curve_json).collect();
    json!({
        "curves": curves, "xRange": plot.ranges[0], "yRange": plot.ranges[1],
        "xLabel": plot.labels[0], "yLabel": plot.labels[1],
        "xTicks": plot.ticks[0], "yTicks": plot.ticks[1],
        "xTickLabels": plot.tick_labels[0], "yTickLabels": plot.tick_labels[1],
        "legendVisible": plot.legend_visible, "square": plot.square, "colors": plot.colors,
        "panX": plot.mouse[0], "panY": plot.mouse[1], "zoomX": plot.mouse[2], "zoomY": plot.mouse[3],
        "replots": plot.replots,
    })
}

fn curve_json(curve: &Curve) -> Value {
    let coordinate = |axis: usize| {
        curve
            .points
            .iter()
            .map(|point| point[axis])
            .collect::<Vec<f64>>()
    };
    let options = &curve.options;
    json!({
        "name": curve.name, "type": curve.curve_type.name(), "color": curve.color, "style": curve.style,
        "scatterShape": options.scatter_shape, "scatterSize": options.scatter_size, "lineSize": options.line_size,
        "lineStyle": options.line_style, "inLegend": options.add_to_legend, "selectable": options.selectable,
        "track": options.track, "x": coordinate(1), "y": coordinate(2),
    })
}

fn scene_json(scene: &Scene3d) -> Value {
    let nodes = scene.nodes.iter().map(|(id, node)| {
        let params: Map<String, Value> =
            node.params.iter().map(|(name, value)| (name.clone(), data_json(value))).collect();
        json!({"id": id, "type": node.node_type, "parent": node.parent, "enabled": node.enabled, "params": params})
    });
    json!({"nodes": nodes.collect::<Vec<_>>(), "clearColor": scene.clear_color})
}

fn data_json(data: &Data) -> Value {
    match data {
        Data::Bool(value) => (*value).into(),
        Data::Int(value) => (*value).into(),
        Data::Float(value) => json!(value),
        Data::Text(bytes) | Data::Buffer(bytes) => String::from_utf8_lossy(bytes).into(),
        Data::Array(items) => items.iter().map(data_json).collect(),
        Data::Nil | Data::Map(_) => Value::Null,
    }
}
