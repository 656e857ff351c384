//! Graphs with their recorded data (spec: scene-files 7.4).

use std::collections::VecDeque;

use super::sensors::groups;
use crate::ttt::chunks as file;
use crate::ttt::{Counted, Rest, Text};
use scene::Handle;
use scene::graph::{
    CurveStyle, Graph, GraphCurve, GraphSample, GraphStream, OldSource, Transformation,
    TransformationKind,
};

/// Bits of a stream; of a curve the first says that it moves with the graph.
const VISIBLE: u8 = 0x1;
const RELATIVE: u8 = 0x1;
const LABEL: u8 = 0x2;
const LINKED: u8 = 0x4;
/// Static values count.
const STREAM_IS_STATIC: u8 = 0x10;
const CURVE_IS_STATIC: u8 = 0x8;
/// Of a curve from before 4.2.
const OLD_IN_WORLD: u8 = 0x10;

pub(super) fn graph(chunk: &file::Graph) -> Graph {
    let mut graph = Graph::default();
    graph.size = chunk.size.unwrap_or(graph.size);
    if let Some([buffer, _]) = chunk.buffer {
        graph.buffer_size = i64::from(buffer).clamp(1, Graph::MAX_BUFFER_SIZE);
    }
    if let Some(values) = chunk.bgfg {
        [graph.background, graph.foreground] = groups(values);
    }
    let switches = chunk.gps.unwrap_or(1);
    (graph.cyclic, graph.explicit) = (switches & 1 != 0, switches & 0x10 != 0);
    let times: VecDeque<f64> = chunk
        .times
        .iter()
        .flat_map(|Rest(times)| times.iter().copied())
        .collect();
    let new = chunk.streams.iter().map(|chunk| stream(chunk, times.len()));
    let streams = new
        .chain(chunk.old_streams.iter().map(old_stream))
        .collect();
    let spatial = chunk.old_curves_3d.iter().map(|chunk| old_curve(chunk, 3));
    let flat = chunk.old_curves_2d.iter().map(|chunk| old_curve(chunk, 2));
    graph.restore(
        times,
        streams,
        chunk
            .curves
            .iter()
            .map(curve)
            .chain(spatial)
            .chain(flat)
            .collect(),
    );
    graph
}

fn style(
    names: Option<&(Text, Text)>,
    id: Option<i32>,
    colour: Option<[f32; 3]>,
    flags: u8,
) -> CurveStyle {
    let (name, unit) = names
        .map(|(name, unit)| (name.decode(), unit.decode()))
        .unwrap_or_default();
    CurveStyle {
        id: id.unwrap_or(0).into(),
        name,
        unit,
        colour: colour.unwrap_or([1.0, 0.0, 0.0]),
        label: flags & LABEL != 0,
        linked: flags & LINKED != 0,
    }
}

fn stream(chunk: &file::DataStream, slots: usize) -> GraphStream {
    let flags = chunk.flags.unwrap_or(VISIBLE | LABEL | LINKED);
    let style = style(chunk.name_and_unit.as_ref(), chunk.id, chunk.colour, flags);
    let mut stream = GraphStream {
        visible: flags & VISIBLE != 0,
        ..GraphStream::new(style)
    };
    if let Some((kind, [multiplier, offset], period, cyclic_range)) = chunk.transformation {
        let kind = TransformationKind::from_code(kind.into()).unwrap_or(TransformationKind::Raw);
        stream.transformation = Transformation {
            kind,
            multiplier,
            offset,
            period: period.into(),
            cyclic_range,
        };
    }
    stream.samples = chunk
        .data
        .iter()
        .flat_map(|Rest(bytes)| samples(bytes, slots))
        .collect();
    stream.fixed = chunk
        .static_values
        .as_ref()
        .filter(|_| flags & STREAM_IS_STATIC != 0)
        .map(|Counted(values)| values.as_chunks().0.to_vec());
    stream
}

/// Per slot a value, what became of it, and whether there are such; in single precision up to serialization 24.
fn samples(bytes: &[u8], slots: usize) -> Vec<GraphSample> {
    let numbers: fn(&[u8]) -> [f64; 2] = match bytes.len().checked_div(slots) {
        Some(18) => {
            |slot| [0, 8].map(|at| f64::from_le_bytes(std::array::from_fn(|i| slot[at + i])))
        }
        Some(10) => {
            |slot| [0, 4].map(|at| f32::from_le_bytes(std::array::from_fn(|i| slot[at + i])).into())
        }
        _ => return Vec::new(),
    };
    let size = bytes.len() / slots;
    let sample = |slot: &[u8]| {
        let [raw, transformed] = numbers(slot);
        let [has_raw, has_transformed] = [slot[size - 2], slot[size - 1]].map(|valid| valid != 0);
        GraphSample {
            raw: has_raw.then_some(raw),
            transformed: has_transformed.then_some(transformed),
        }
    };
    bytes.chunks_exact(size).map(sample).collect()
}

fn curve(chunk: &file::Curve) -> GraphCurve {
    let flags = chunk.flags.unwrap_or(RELATIVE | LABEL | LINKED);
    let [id, dimensions, width] = chunk.id_dim_width.unwrap_or([0, 2, 1]);
    let dimensions = if dimensions > 2 { 3 } else { 2 };
    let point = |point: &[f64]| std::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0));
    let fixed = chunk
        .static_values
        .as_ref()
        .filter(|_| flags & CURVE_IS_STATIC != 0)
        .map(|Counted(values)| values.chunks_exact(dimensions).map(point).collect());
    GraphCurve {
        style: style(chunk.name_and_unit.as_ref(), Some(id), chunk.colour, flags),
        width: width.into(),
        dimensions,
        streams: chunk.streams.unwrap_or([-1; 3]).map(i64::from),
        defaults: chunk.offsets.unwrap_or_default(),
        relative: flags & RELATIVE != 0,
        fixed,
        old: false,
    }
}

fn old_stream(chunk: &file::OldDataStream) -> GraphStream {
    let flags = chunk.flags.unwrap_or(VISIBLE | LABEL | LINKED);
    let name = chunk.name.clone().map(|name| (name, Text::default()));
    let style = style(name.as_ref(), chunk.id, chunk.colour, flags);
    let mut stream = GraphStream {
        visible: flags & VISIBLE != 0,
        ..GraphStream::new(style)
    };
    let old = chunk
        .old_zoom_and_offset
        .map(|[zoom, _, offset]| [zoom.into(), offset.into()]);
    let [multiplier, offset] = chunk.zoom_and_offset.or(old).unwrap_or([1.0, 0.0]);
    let kind = TransformationKind::from_code(chunk.transf.unwrap_or(0).into())
        .unwrap_or(TransformationKind::Raw);
    let period = chunk.ma_count.unwrap_or(1).into();
    stream.transformation = Transformation {
        kind,
        multiplier,
        offset,
        period,
        cyclic_range: 0.0,
    };
    let [data_type, object, auxiliary] = chunk.source.unwrap_or([0, -1, -1]);
    stream.source = Some(OldSource {
        data_type,
        object: Handle::from_raw(object.into()),
        auxiliary,
    });
    let values = |values: &Option<Rest<f64>>| {
        values
            .as_ref()
            .map_or(Vec::new(), |Rest(values)| values.clone())
    };
    let (raw, transformed) = (values(&chunk.data), values(&chunk.tdata));
    let is_valid = |valid: &Option<Rest<u8>>, slot: usize| {
        valid
            .as_ref()
            .is_some_and(|Rest(valid)| valid.get(slot).is_some_and(|valid| *valid != 0))
    };
    let sample = |(slot, (raw, transformed)): (usize, (&f64, &f64))| GraphSample {
        raw: is_valid(&chunk.valid, slot).then_some(*raw),
        transformed: is_valid(&chunk.tvalid, slot).then_some(*transformed),
    };
    stream.samples = raw
        .iter()
        .zip(&transformed)
        .enumerate()
        .map(sample)
        .collect();
    stream
}

fn old_curve(chunk: &file::OldCurve, dimensions: usize) -> GraphCurve {
    let flags = chunk.flags.unwrap_or(VISIBLE | LABEL | LINKED);
    let first = |values: &[f32]| [values[0], values[1], values[2]];
    let new = chunk
        .colour
        .as_ref()
        .and_then(|colour| colour.values.as_ref())
        .map(|values| first(values));
    let colour = new.or(chunk.old_colours.as_ref().map(|values| first(values)));
    let name = chunk.name.clone().map(|name| (name, Text::default()));
    GraphCurve {
        style: style(name.as_ref(), chunk.id, colour, flags),
        width: numbers::truncated(chunk.width.unwrap_or(1.0)),
        dimensions,
        streams: chunk.streams.unwrap_or([-1; 3]).map(i64::from),
        defaults: [0.0; 3],
        relative: flags & OLD_IN_WORLD == 0,
        fixed: None,
        old: true,
    }
}
