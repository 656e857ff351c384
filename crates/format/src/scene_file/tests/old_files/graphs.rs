//! Graphs with their recordings.

use super::one;
use crate::ttt::chunks::{Curve, DataStream, Graph as GraphChunk, OldCurve, OldDataStream};
use crate::ttt::tree::Class;
use crate::ttt::{Counted, Rest};
use scene::graph::{Graph, GraphSample, TransformationKind};
use scene::{Kind, Object};

fn graph(chunk: GraphChunk) -> Graph {
    let object: Object = one(Class::Graph(Box::new(chunk)));
    let Kind::Graph(graph) = object.kind else {
        panic!("no graph")
    };
    *graph
}

#[test]
fn samples_of_single_precision() {
    let slot = |raw: f32, transformed: f32, valid: [u8; 2]| {
        [&raw.to_le_bytes()[..], &transformed.to_le_bytes(), &valid].concat()
    };
    let data = [slot(1.5, 2.5, [1, 0]), slot(3.5, 4.5, [0, 1])].concat();
    let samples = |data: Vec<u8>| {
        let stream = DataStream {
            data: Some(Rest(data)),
            ..DataStream::default()
        };
        let chunk = GraphChunk {
            times: Some(Rest(vec![0.0, 0.5])),
            streams: vec![stream],
            ..GraphChunk::default()
        };
        graph(chunk).streams()[0].samples.clone()
    };
    let sample = |raw, transformed| GraphSample { raw, transformed };
    assert_eq!(
        samples(data.clone()),
        [sample(Some(1.5), None), sample(None, Some(4.5))]
    );
    assert!(samples(data[1..].to_vec()).is_empty() && samples(vec![0; 24]).is_empty());
    let without_times = GraphChunk {
        streams: vec![DataStream {
            data: Some(Rest(data)),
            ..DataStream::default()
        }],
        ..GraphChunk::default()
    };
    assert!(graph(without_times).streams()[0].samples.is_empty());
}

#[test]
fn streams_and_curves_of_which_nothing_is_said() {
    let chunk = GraphChunk {
        streams: vec![DataStream::default()],
        curves: vec![
            Curve::default(),
            Curve {
                id_dim_width: Some([1, 3, 2]),
                ..Curve::default()
            },
        ],
        ..GraphChunk::default()
    };
    let graph = graph(chunk);
    let stream = &graph.streams()[0];
    assert!(stream.visible && stream.style.label && stream.style.linked && stream.fixed.is_none());
    assert_eq!(stream.transformation.kind, TransformationKind::Raw);
    let curve = &graph.curves[0];
    assert!(curve.relative && curve.style.label && curve.style.linked && !curve.old);
    assert_eq!(
        (curve.dimensions, curve.width, graph.curves[1].dimensions),
        (2, 1, 3)
    );
    assert!(graph.cyclic && !graph.explicit);
    let flags = |gps| {
        let graph = self::graph(GraphChunk {
            gps: Some(gps),
            ..GraphChunk::default()
        });
        (graph.cyclic, graph.explicit)
    };
    assert_eq!(
        [flags(0), flags(1), flags(0x10), flags(0xee)],
        [(false, false), (true, false), (false, true), (false, false)]
    );
}

#[test]
fn fixed_values_count_where_a_switch_says_so() {
    let with = |stream_flags, curve_flags| {
        let stream = DataStream {
            flags: Some(stream_flags),
            static_values: Some(Counted(vec![0.0, 1.0, 2.0, 3.0, 4.0])),
            ..DataStream::default()
        };
        let curve = Curve {
            flags: Some(curve_flags),
            id_dim_width: Some([0, 2, 1]),
            static_values: Some(Counted(vec![1.0, 2.0, 3.0, 4.0])),
            ..Curve::default()
        };
        let graph = graph(GraphChunk {
            streams: vec![stream],
            curves: vec![curve],
            ..GraphChunk::default()
        });
        let stream = &graph.streams()[0];
        let shown = [stream.visible, stream.style.label, stream.style.linked];
        (
            shown,
            stream.fixed.clone(),
            graph.curves[0].relative,
            graph.curves[0].fixed.clone(),
        )
    };
    let (shown, values, relative, points) = with(0x11, 0x8);
    assert_eq!(
        (shown, values),
        ([true, false, false], Some(vec![[0.0, 1.0], [2.0, 3.0]]))
    );
    assert_eq!(
        (relative, points),
        (false, Some(vec![[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]]))
    );
    assert_eq!(with(0xee, 0xf7), ([false, true, true], None, true, None));
}

#[test]
fn streams_and_curves_before_4_2() {
    let stream = OldDataStream {
        name: Some("height".into()),
        source: Some([3, 1, 8]),
        old_zoom_and_offset: Some([2.0, 9.0, 0.5]),
        ma_count: Some(4),
        transf: Some(1),
        flags: Some(2),
        data: Some(Rest(vec![1.0, 2.0])),
        tdata: Some(Rest(vec![3.0, 4.0])),
        valid: Some(Rest(vec![0, 1])),
        tvalid: Some(Rest(vec![1])),
        ..OldDataStream::default()
    };
    let curve = |flags| OldCurve {
        old_colours: Some([0.25, 0.5, 0.75, 1.0, 1.0, 1.0]),
        streams: Some([0, 1, 2]),
        width: Some(2.0),
        flags,
        ..OldCurve::default()
    };
    let chunk = GraphChunk {
        times: Some(Rest(vec![0.0, 0.5])),
        old_streams: vec![stream, OldDataStream::default()],
        old_curves_3d: vec![curve(Some(0x10))],
        old_curves_2d: vec![curve(None)],
        ..GraphChunk::default()
    };
    let graph = graph(chunk);
    let [stream, default] = graph.streams() else {
        panic!("two streams")
    };
    let made = &stream.transformation;
    assert_eq!((made.multiplier, made.offset, made.period), (2.0, 0.5, 4));
    assert_eq!(made.kind, TransformationKind::Derivative);
    let sample = |raw, transformed| GraphSample { raw, transformed };
    assert_eq!(
        stream.samples,
        [sample(None, Some(3.0)), sample(Some(2.0), None)]
    );
    assert!(!stream.visible && stream.style.label && !stream.style.linked);
    assert!(default.visible && default.style.label && default.style.linked);
    let [solid, flat] = &graph.curves[..] else {
        panic!("two curves")
    };
    assert!(!solid.relative && flat.relative && solid.old && flat.old && flat.style.linked);
    assert_eq!((solid.dimensions, flat.dimensions), (3, 2));
    assert_eq!((solid.style.colour, solid.width), ([0.25, 0.5, 0.75], 2));
}
