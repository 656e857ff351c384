//! `sim.*`: graphs: streams, curves. The viewer and `--graph` draw them.

use std::f64::consts::PI;

use api_macro::api;
use geometry::Finite;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::graph::{
    CurveStyle, Graph, GraphCurve, GraphOptions, GraphStream, Transformation, TransformationKind,
};
use scene::numbers;
use scene::{Data, Field, Handle, Kind, Object, SceneError, special};
use script::{Number, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    add_graph_stream,
    set_graph_stream_value,
    set_graph_stream_transformation,
    add_graph_curve,
    destroy_graph_curve,
    duplicate_graph_curve_to_static,
    get_graph_curve,
    get_graph_info,
    set_graph_user_data,
    handle_graph,
    reset_graph,
];

/// Changes a graph.
fn change<R>(
    cx: &mut Cx,
    handle: Handle,
    change: impl FnOnce(&mut Graph) -> std::result::Result<R, SceneError>,
) -> Result<R> {
    Ok(cx
        .scene_mut()
        .try_modify(handle, Field::Measured, |object| {
            change(object.graph_mut()?)
        })?)
}

fn style(name: String, unit: String, options: GraphOptions, colour: [f64; 3]) -> CurveStyle {
    CurveStyle {
        id: 0,
        name,
        unit,
        colour: colour.map(numbers::single),
        label: !options.contains(GraphOptions::NO_LABEL),
        linked: !options.contains(GraphOptions::NOT_LINKED),
    }
}

/// Adds a stream of values to a graph, or changes the one with that name.
///
/// @param graphHandle the graph
/// @param streamName its name
/// @param unit its unit
/// @param options 1: not shown, 2: without label, 4: points are not linked
/// @param color red, green, blue, 0 to 1
/// @param cyclicRange differences are the shortest modulo this; 0 for values that are not cyclic
/// @return streamId its number
#[api("sim.addGraphStream")]
fn add_graph_stream(
    cx: &mut Cx,
    graph_handle: Handle,
    stream_name: String,
    unit: String,
    #[default(0)] options: Number,
    #[default([1.0, 0.0, 0.0])] color: [f64; 3],
    #[default(PI, "math.pi")] cyclic_range: f64,
) -> Result<i64> {
    let transformation = Transformation {
        cyclic_range: cyclic_range.finite().ok_or(SceneError::InvalidArgument)?,
        ..Transformation::default()
    };
    let options = GraphOptions::from_bits_retain(options.0);
    let style = style(stream_name, unit, options, color);
    let stream = GraphStream {
        visible: !options.contains(GraphOptions::HIDDEN_STREAM),
        transformation,
        ..GraphStream::new(style)
    };
    change(cx, graph_handle, |graph| graph.add_stream(stream))
}

/// The value a stream records next.
///
/// @param graphHandle the graph
/// @param streamId from sim.addGraphStream
/// @param value number
#[api("sim.setGraphStreamValue")]
fn set_graph_stream_value(
    cx: &mut Cx,
    graph_handle: Handle,
    stream_id: Number,
    value: f64,
) -> Result<()> {
    change(cx, graph_handle, |graph| {
        graph.stream_mut(stream_id.0)?.next = Some(value).filter(geometry::Finite::is_finite);
        Ok(())
    })
}

/// Sets the transformation of a stream: raw, derivative, integral, cumulative.
///
/// @param graphHandle the graph
/// @param streamId from sim.addGraphStream
/// @param trType sim.stream_transf_*
/// @param mult factor of the result
/// @param off added to it
/// @param movAvgPeriod slots of the moving average
#[api("sim.setGraphStreamTransformation")]
fn set_graph_stream_transformation(
    cx: &mut Cx,
    graph_handle: Handle,
    stream_id: Number,
    tr_type: Number,
    #[default(1.0)] mult: f64,
    #[default(0.0)] off: f64,
    #[default(1)] mov_avg_period: Number,
) -> Result<()> {
    let kind = TransformationKind::from_code(tr_type.0).ok_or(SceneError::InvalidArgument)?;
    let [multiplier, offset] = [mult, off].finite().ok_or(SceneError::InvalidArgument)?;
    let period = mov_avg_period.0.max(1);
    change(cx, graph_handle, |graph| {
        let own = &mut graph.stream_mut(stream_id.0)?.transformation;
        *own = Transformation {
            kind,
            multiplier,
            offset,
            period,
            cyclic_range: own.cyclic_range,
        };
        Ok(())
    })
}

/// Adds a curve through the values of two or three streams, or changes the one with that name.
///
/// @param graphHandle the graph
/// @param curveName its name
/// @param dim 2 or 3
/// @param streamIds of x, y and z; -1 for a number
/// @param defaultValues the numbers where there is no stream
/// @param unitStr its unit
/// @param options 1: points of three dimensions are in the world, 2: without label, 4: points are not linked
/// @param color red, green, blue, 0 to 1
/// @param curveWidth pixels
/// @return curveId its number
#[api("sim.addGraphCurve")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn add_graph_curve(
    cx: &mut Cx,
    graph_handle: Handle,
    curve_name: String,
    dim: Number,
    stream_ids: Vec<i64>,
    default_values: Vec<f64>,
    unit_str: String,
    #[default(0)] options: Number,
    #[default([1.0, 1.0, 0.0])] color: [f64; 3],
    #[default(2)] curve_width: Number,
) -> Result<i64> {
    let dimensions = usize::try_from(dim.0)
        .ok()
        .filter(|dim| [2, 3].contains(dim));
    let dimensions = dimensions.ok_or(SceneError::InvalidArgument)?;
    if stream_ids.len() < dimensions || default_values.len() < dimensions {
        return Err(ApiError::TableSize);
    }
    default_values
        .as_slice()
        .finite()
        .ok_or(SceneError::InvalidArgument)?;
    let options = GraphOptions::from_bits_retain(options.0);
    let curve = GraphCurve {
        style: style(curve_name, unit_str, options, color),
        width: curve_width.0.clamp(1, 100),
        dimensions,
        streams: std::array::from_fn(|axis| stream_ids.get(axis).copied().unwrap_or(-1)),
        defaults: std::array::from_fn(|axis| default_values.get(axis).copied().unwrap_or(0.0)),
        relative: !options.contains(GraphOptions::CURVE_IN_WORLD),
        fixed: None,
        old: false,
    };
    change(cx, graph_handle, |graph| graph.add_curve(curve))
}

/// Removes a curve or a stream.
///
/// @param graphHandle the graph
/// @param curveId its number
#[api("sim.destroyGraphCurve")]
fn destroy_graph_curve(cx: &mut Cx, graph_handle: Handle, curve_id: Number) -> Result<()> {
    change(cx, graph_handle, |graph| graph.remove_curve(curve_id.0))
}

/// Copies a curve or a stream as it is now; recording does not change the copy.
///
/// @param graphHandle the graph
/// @param curveId its number
/// @param curveName name of the copy
/// @return curveId number of the copy
#[api("sim.duplicateGraphCurveToStatic")]
fn duplicate_graph_curve_to_static(
    cx: &mut Cx,
    graph_handle: Handle,
    curve_id: Number,
    #[default(String::new())] curve_name: String,
) -> Result<i64> {
    change(cx, graph_handle, |graph| {
        graph.fix_curve(curve_id.0, &curve_name)
    })
}

/// A curve with its points. Streams that are not shown, and slots with gaps, are left out.
///
/// @param graphHandle the graph
/// @param graphType 0: streams over time, 1: curves of two dimensions, 2: of three
/// @param curveIndex which one of them, from 0
/// @return label, curveType, curveColor, xData, yData, minMax, curveId, curveWidth nothing past the last one; a curve of three dimensions has
/// zData after yData. The type is 0: a line, 1: points that are not linked, plus 2: recording does not change it, 4: its label is not shown, 8: in
/// three dimensions, in the frame of the graph. minMax: the smallest and the
/// largest x, then of y and z
#[api("sim.getGraphCurve")]
fn get_graph_curve(
    cx: &Cx,
    graph_handle: Handle,
    graph_type: Number,
    curve_index: Number,
) -> Result<Results> {
    let scene = cx.scene();
    let graph = scene.object(graph_handle)?.graph()?;
    let Ok(index) = usize::try_from(curve_index.0) else {
        return Ok(Results(Vec::new()));
    };
    let dimensions = match graph_type.0 {
        0 => return Ok(Results(shown_stream(graph, index).unwrap_or_default())),
        1 => 2,
        2 => 3,
        _ => return Err(SceneError::InvalidArgument.into()),
    };
    let curve = graph
        .curves
        .iter()
        .filter(|curve| curve.dimensions == dimensions)
        .nth(index);
    Ok(Results(curve.map_or_else(Vec::new, |curve| {
        let points = graph.points(curve);
        let kind = CurveKind {
            fixed: curve.fixed.is_some(),
            relative: curve.relative && dimensions == 3,
        };
        described(&curve.style, kind, &points, dimensions, curve.width)
    })))
}

fn shown_stream(graph: &Graph, index: usize) -> Option<Vec<Data>> {
    let stream = graph
        .streams()
        .iter()
        .filter(|stream| stream.visible)
        .nth(index)?;
    let points: Vec<[f64; 3]> = graph
        .values(stream)
        .into_iter()
        .map(|[time, value]| [time, value, 0.0])
        .collect();
    let kind = CurveKind {
        fixed: stream.fixed.is_some(),
        relative: false,
    };
    Some(described(&stream.style, kind, &points, 2, 1))
}

/// What the type of a curve says besides its style.
struct CurveKind {
    fixed: bool,
    relative: bool,
}

fn described(
    style: &CurveStyle,
    kind: CurveKind,
    points: &[[f64; 3]],
    dimensions: usize,
    width: i64,
) -> Vec<Data> {
    let kind = i64::from(!style.linked)
        | i64::from(kind.fixed) << 1
        | i64::from(!style.label) << 2
        | i64::from(kind.relative) << 3;
    let axis = |axis: usize| points.iter().map(|point| point[axis]).collect::<Vec<f64>>();
    let extremes = |axis: usize| {
        let values = points.iter().map(|point| point[axis]);
        let span = values.fold(None, |span, v| {
            span.map_or(Some([v, v]), |[low, high]: [f64; 2]| {
                Some([low.min(v), high.max(v)])
            })
        });
        span.unwrap_or_default()
    };
    let mut all = vec![
        Data::text(&style.name),
        kind.into(),
        style.colour.map(f64::from).into(),
    ];
    all.extend((0..dimensions).map(|i| axis(i).into()));
    let min_max: Vec<f64> = (0..3).flat_map(extremes).collect();
    all.extend([min_max.into(), style.id.into(), width.into()]);
    all
}

/// Display settings of a graph.
///
/// @param graphHandle the graph
/// @return bitCoded 1: the oldest values are replaced, 16: handled explicitly; 2, 4 and 8, for its drawing, are always there
/// @return bgColor of the background
/// @return fgColor of lines and texts
#[api("sim.getGraphInfo")]
fn get_graph_info(cx: &Cx, graph_handle: Handle) -> Result<(i64, [f64; 3], [f64; 3])> {
    let scene = cx.scene();
    let graph = scene.object(graph_handle)?.graph()?;
    let bits = i64::from(graph.cyclic) | 0xe | i64::from(graph.explicit) << 4;
    Ok((
        bits,
        graph.background.map(f64::from),
        graph.foreground.map(f64::from),
    ))
}

/// The value a stream of an old graph records next.
///
/// @param graphHandle the graph
/// @param dataStreamName name of the stream
/// @param data number
#[api("sim.setGraphUserData")]
fn set_graph_user_data(
    cx: &mut Cx,
    graph_handle: Handle,
    data_stream_name: String,
    data: f64,
) -> Result<()> {
    change(cx, graph_handle, |graph| {
        let named = graph
            .streams()
            .iter()
            .find(|stream| stream.style.name == data_stream_name);
        let id = named.map_or(-1, |stream| stream.style.id);
        graph.stream_mut(id)?.next = Some(data).filter(geometry::Finite::is_finite);
        Ok(())
    })
}

/// Records a slot: the values set on the streams, and gaps for the others.
///
/// @param objectHandle the graph, sim.handle_all or sim.handle_all_except_explicit
/// @param simulationTime of the values
/// @return result 1
#[api("sim.handleGraph")]
fn handle_graph(cx: &mut Cx, object_handle: Number, simulation_time: f64) -> Result<i64> {
    let time = simulation_time
        .finite()
        .ok_or(SceneError::InvalidArgument)?;
    for handle in graphs(cx, object_handle)? {
        change(cx, handle, |graph| {
            graph.record(time);
            Ok(())
        })?;
    }
    Ok(1)
}

/// Clears the recorded data.
///
/// @param objectHandle the graph, sim.handle_all or sim.handle_all_except_explicit
/// @return result 1
#[api("sim.resetGraph")]
fn reset_graph(cx: &mut Cx, object_handle: Number) -> Result<i64> {
    for handle in graphs(cx, object_handle)? {
        change(cx, handle, |graph| {
            graph.reset();
            Ok(())
        })?;
    }
    Ok(1)
}

/// The graph, or all of them.
fn graphs(cx: &Cx, handle: Number) -> Result<Vec<Handle>> {
    let scene = cx.scene();
    let explicit_too = match handle.0 {
        special::ALL => true,
        special::ALL_EXCEPT_EXPLICIT => false,
        raw => {
            let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
            scene.object(handle)?.graph()?;
            return Ok(vec![handle]);
        }
    };
    let is_meant =
        |o: &&Object| matches!(&o.kind, Kind::Graph(graph) if explicit_too || !graph.explicit);
    Ok(scene
        .objects()
        .filter(is_meant)
        .map(Object::handle)
        .collect())
}
