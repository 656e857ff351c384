//! The curves of a graph.

use serde_json::{Value, json};

use scene::graph::{CurveStyle, Graph};
use scene::{Handle, SceneError};
use simulator::Simulator;

/// Streams over time, and curves of two streams, as a page draws them.
///
/// # Errors
/// When there is no graph with that handle.
pub(super) fn curves(sim: &Simulator, handle: i64) -> Result<Value, String> {
    let scene = sim.scene();
    let object = Handle::from_raw(handle)
        .ok_or(SceneError::NoSuchObject)
        .and_then(|handle| scene.object(handle));
    let object = object.map_err(|error| error.to_string())?;
    let graph = object.graph().map_err(|error| error.to_string())?;
    let over_time: Vec<Value> = of_streams(graph);
    let flat = graph.curves.iter().filter(|curve| curve.dimensions == 2);
    let flat: Vec<Value> = flat
        .map(|curve| {
            let points = graph.points(curve);
            curve_of(
                &curve.style,
                points.iter().map(|point| [point[0], point[1]]).collect(),
            )
        })
        .collect();
    Ok(json!({ "title": object.alias(), "curves": over_time, "xyCurves": flat }))
}

fn of_streams(graph: &Graph) -> Vec<Value> {
    let visible = graph.streams().iter().filter(|stream| stream.visible);
    visible
        .map(|stream| curve_of(&stream.style, graph.values(stream)))
        .collect()
}

fn curve_of(style: &CurveStyle, points: Vec<[f64; 2]>) -> Value {
    let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().map(|[x, y]| (x, y)).unzip();
    json!({ "name": style.name, "unit": style.unit, "color": style.colour, "x": x, "y": y })
}
