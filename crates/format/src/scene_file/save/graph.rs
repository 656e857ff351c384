//! Graphs with their recorded data: always in double precision.

use super::Context;
use super::sensors::bits;
use crate::ttt::chunks as file;
use crate::ttt::{Counted, Rest};
use scene::graph::{CurveStyle, Graph, GraphCurve, GraphSample, GraphStream, OldSource};

/// Streams and curves that scripts made outlive them here.
const NO_SCRIPT: i32 = -1;

pub(super) fn graph(
    context: &Context<'_>,
    graph: &Graph,
    colour: Option<file::Colour>,
) -> file::Graph {
    let [r, g, b] = graph.background;
    let [x, y, z] = graph.foreground;
    let of_time = |old: bool| {
        graph
            .streams()
            .iter()
            .filter(move |stream| stream.source.is_some() == old)
    };
    let old_curves = |dimensions: usize| {
        let curves = graph
            .curves
            .iter()
            .filter(move |curve| curve.old && curve.dimensions == dimensions);
        curves.map(old_curve).collect()
    };
    file::Graph {
        size: Some(graph.size),
        colour,
        bgfg: Some([r, g, b, x, y, z]),
        buffer: Some([
            numbers::low_i32(graph.buffer_size),
            numbers::count_i32(graph.times().len()),
        ]),
        times: Some(Rest(graph.times().collect())),
        streams: of_time(false)
            .map(|of| stream(of, graph.times().len()))
            .collect(),
        curves: graph
            .curves
            .iter()
            .filter(|curve| !curve.old)
            .map(curve)
            .collect(),
        old_streams: of_time(true)
            .filter_map(|stream| {
                Some(old_stream(
                    context,
                    stream,
                    stream.source?,
                    graph.times().len(),
                ))
            })
            .collect(),
        old_curves_3d: old_curves(3),
        old_curves_2d: old_curves(2),
        gps: Some(bits(&[
            (graph.cyclic, 0),
            (true, 1),
            (true, 2),
            (true, 3),
            (graph.explicit, 4),
        ])),
        ..file::Graph::default()
    }
}

fn flags(first: bool, style: &CurveStyle, fixed: Option<u8>) -> u8 {
    bits(&[(first, 0), (style.label, 1), (style.linked, 2)]) | fixed.map_or(0, |bit| 1 << bit)
}

/// A stream of a graph with so many slots.
fn stream(stream: &GraphStream, slots: usize) -> file::DataStream {
    let (style, transformation) = (&stream.style, &stream.transformation);
    file::DataStream {
        name_and_unit: Some((style.name.as_str().into(), style.unit.as_str().into())),
        id: Some(numbers::low_i32(style.id)),
        script: Some(NO_SCRIPT),
        colour: Some(style.colour),
        transformation: Some((
            numbers::low_i32(transformation.kind.code()),
            [transformation.multiplier, transformation.offset],
            numbers::low_i32(transformation.period),
            transformation.cyclic_range,
        )),
        flags: Some(flags(
            stream.visible,
            style,
            stream.fixed.as_ref().map(|_| 4),
        )),
        data: (!stream.samples.is_empty()).then(|| {
            Rest(
                samples(stream, slots)
                    .flat_map(|sample| slot(&sample))
                    .collect(),
            )
        }),
        static_values: stream
            .fixed
            .as_ref()
            .map(|points| Counted(points.as_flattened().to_vec())),
    }
}

/// A sample for each slot; those from before the stream was there are gaps.
fn samples(stream: &GraphStream, slots: usize) -> impl Iterator<Item = GraphSample> {
    let before = slots.saturating_sub(stream.samples.len());
    std::iter::repeat_n(GraphSample::default(), before).chain(stream.samples.iter().copied())
}

/// A value, what became of it, and whether there are such.
fn slot(sample: &GraphSample) -> [u8; 18] {
    let mut bytes = [0; 18];
    for (i, value) in [sample.raw, sample.transformed].into_iter().enumerate() {
        bytes[8 * i..8 * i + 8].copy_from_slice(&value.unwrap_or(0.0).to_le_bytes());
        bytes[16 + i] = value.is_some().into();
    }
    bytes
}

fn curve(curve: &GraphCurve) -> file::Curve {
    let style = &curve.style;
    let fixed = |points: &Vec<[f64; 3]>| {
        Counted(
            points
                .iter()
                .flat_map(|point| point[..curve.dimensions].iter().copied())
                .collect(),
        )
    };
    file::Curve {
        name_and_unit: Some((style.name.as_str().into(), style.unit.as_str().into())),
        id_dim_width: Some([
            numbers::low_i32(style.id),
            numbers::count_i32(curve.dimensions),
            numbers::low_i32(curve.width),
        ]),
        script: Some(NO_SCRIPT),
        colour: Some(style.colour),
        offsets: Some(curve.defaults),
        streams: Some(curve.streams.map(numbers::low_i32)),
        flags: Some(flags(
            curve.relative,
            style,
            curve.fixed.as_ref().map(|_| 3),
        )),
        static_values: curve.fixed.as_ref().map(fixed),
    }
}

/// One of the two numbers of a sample.
type Half = fn(&GraphSample) -> Option<f64>;

fn old_stream(
    context: &Context<'_>,
    stream: &GraphStream,
    source: OldSource,
    slots: usize,
) -> file::OldDataStream {
    let (style, transformation) = (&stream.style, &stream.transformation);
    let all: Vec<GraphSample> = if stream.samples.is_empty() {
        Vec::new()
    } else {
        samples(stream, slots).collect()
    };
    let values = |of: Half| all.iter().map(|sample| of(sample).unwrap_or(0.0)).collect();
    let valid = |of: Half| {
        Rest(
            all.iter()
                .map(|sample| of(sample).is_some().into())
                .collect(),
        )
    };
    let (raw, transformed): (Half, Half) = (|s| s.raw, |s| s.transformed);
    file::OldDataStream {
        name: Some(style.name.as_str().into()),
        id: Some(numbers::low_i32(style.id)),
        source: Some([
            source.data_type,
            context.file_handle(source.object),
            source.auxiliary,
        ]),
        colour: Some(style.colour),
        zoom_and_offset: Some([transformation.multiplier, transformation.offset]),
        ma_count: Some(numbers::low_i32(transformation.period)),
        transf: Some(numbers::low_i32(transformation.kind.code())),
        flags: Some(flags(stream.visible, style, None)),
        data: Some(Rest(values(raw))),
        tdata: Some(Rest(values(transformed))),
        valid: Some(valid(raw)),
        tvalid: Some(valid(transformed)),
        ..file::OldDataStream::default()
    }
}

fn old_curve(curve: &GraphCurve) -> file::OldCurve {
    let mut colour = scene::appearance::colour::Colour::new(curve.style.colour);
    colour.specular = [0.0; 3];
    file::OldCurve {
        name: Some(curve.style.name.as_str().into()),
        id: Some(numbers::low_i32(curve.style.id)),
        colour: Some(super::colour::colour(&colour)),
        streams: Some(curve.streams.map(numbers::low_i32)),
        width: Some(numbers::real_of(curve.width)),
        flags: Some(flags(true, &curve.style, (!curve.relative).then_some(4))),
        ..file::OldCurve::default()
    }
}
