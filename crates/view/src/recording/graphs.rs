//! Graphs in recordings: what they have recorded, as a message at the end.

use serde_json::{Value, json};

use format::graph_file::{CurveData, GraphData, StreamData};
use scene::graph::CurveStyle;
use scene::{Kind, Scene};

/// The message; None for a scene without graphs.
pub(super) fn message(scene: &Scene) -> Option<String> {
    let graphs = scene.objects().filter_map(|object| {
        let Kind::Graph(graph) = &object.kind else {
            return None;
        };
        let path = scene.short_path(object.handle()).unwrap_or_default();
        Some(graph_json(
            &GraphData::new(graph, &path),
            object.handle().raw(),
        ))
    });
    let graphs: Vec<Value> = graphs.collect();
    (!graphs.is_empty()).then(|| json!({ "type": "graphs", "graphs": graphs }).to_string())
}

fn graph_json(graph: &GraphData, handle: i64) -> Value {
    let stream = |stream: &StreamData| {
        let mut value = style_json(&stream.style);
        value["visible"] = stream.visible.into();
        value["values"] = json!(stream.values);
        value
    };
    let curve = |curve: &CurveData| {
        let mut value = style_json(&curve.style);
        value["dimensions"] = curve.dimensions.into();
        value["static"] = curve.is_static.into();
        value["points"] = json!(curve.points);
        value
    };
    json!({
        "handle": handle, "path": graph.title, "background": graph.background, "foreground": graph.foreground,
        "times": graph.times,
        "streams": graph.streams.iter().map(stream).collect::<Vec<_>>(),
        "curves": graph.curves.iter().map(curve).collect::<Vec<_>>(),
    })
}

fn style_json(style: &CurveStyle) -> Value {
    json!({
        "id": style.id, "name": style.name, "unit": style.unit, "color": style.colour, "label": style.label,
        "linked": style.linked,
    })
}

/// The graphs of such a message, with their handles; None if it is another one.
pub fn read(message: &Value) -> Option<Vec<(i64, GraphData)>> {
    (message["type"] == "graphs").then_some(())?;
    message["graphs"]
        .as_array()?
        .iter()
        .map(|graph| Some((graph["handle"].as_i64()?, graph_data(graph)?)))
        .collect()
}

fn graph_data(value: &Value) -> Option<GraphData> {
    let stream = |value: &Value| {
        let values = rows(&value["values"])?;
        Some(StreamData {
            style: style(value)?,
            visible: value["visible"].as_bool()?,
            values,
        })
    };
    let curve = |value: &Value| {
        Some(CurveData {
            style: style(value)?,
            dimensions: usize::try_from(value["dimensions"].as_u64()?).ok()?,
            is_static: value["static"].as_bool()?,
            points: rows(&value["points"])?,
        })
    };
    Some(GraphData {
        title: value["path"].as_str()?.to_owned(),
        background: colour(&value["background"])?,
        foreground: colour(&value["foreground"])?,
        times: value["times"]
            .as_array()?
            .iter()
            .map(Value::as_f64)
            .collect::<Option<_>>()?,
        streams: value["streams"]
            .as_array()?
            .iter()
            .map(stream)
            .collect::<Option<_>>()?,
        curves: value["curves"]
            .as_array()?
            .iter()
            .map(curve)
            .collect::<Option<_>>()?,
    })
}

fn rows<const N: usize>(value: &Value) -> Option<Vec<[f64; N]>> {
    value.as_array()?.iter().map(numbers).collect()
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let numbers: Vec<f64> = value
        .as_array()?
        .iter()
        .map(Value::as_f64)
        .collect::<Option<_>>()?;
    numbers.try_into().ok()
}

fn colour(value: &Value) -> Option<[f32; 3]> {
    numbers(value).map(|colour| colour.map(|part| part as f32))
}

fn style(value: &Value) -> Option<CurveStyle> {
    Some(CurveStyle {
        id: value["id"].as_i64()?,
        name: value["name"].as_str()?.to_owned(),
        unit: value["unit"].as_str()?.to_owned(),
        colour: colour(&value["color"])?,
        label: value["label"].as_bool()?,
        linked: value["linked"].as_bool()?,
    })
}
