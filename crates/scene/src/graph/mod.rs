//! Graphs: streams of values over time, and curves made of them (spec: sensors 7). Nothing is drawn.

pub(crate) mod record;

use std::collections::VecDeque;

use bitflags::bitflags;

use super::{Handle, SceneError, SceneResult};

/// A graph: its streams have a slot for each time that was recorded since they are there.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// Recorded only when a script handles the graph, not with all graphs at the end of a step.
    pub explicit: bool,
    /// Capacity in slots.
    pub buffer_size: i64,
    /// New slots replace the oldest.
    pub cyclic: bool,
    /// Edge of its symbol in the scene, metres.
    pub size: f64,
    /// Colour of the plot area: red, green, blue, 0 to 1.
    pub background: [f32; 3],
    /// Colour of axes and labels.
    pub foreground: [f32; 3],
    /// When the slots were recorded, seconds, the oldest first.
    pub(super) times: VecDeque<f64>,
    pub(super) streams: Vec<GraphStream>,
    /// Curves through the values of its streams.
    pub curves: Vec<GraphCurve>,
}

bitflags! {
    /// Options of `sim.addGraphStream` and `sim.addGraphCurve`, where the first bit has a meaning of its own.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct GraphOptions: i64 {
        /// The stream is recorded, but not shown.
        const HIDDEN_STREAM = 0x1;
        /// The points of a curve of three dimensions do not move with the graph.
        const CURVE_IN_WORLD = 0x1;
        /// The name is not shown.
        const NO_LABEL = 0x2;
        /// Points are not linked by lines.
        const NOT_LINKED = 0x4;
        const _ = !0;
    }
}

/// Name and appearance of a stream or curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveStyle {
    /// Number, unique among the streams and curves of the graph.
    pub id: i64,
    /// Name, unique among the streams, or the curves, of the graph.
    pub name: String,
    /// Unit of the values, for labels.
    pub unit: String,
    /// Red, green, blue, 0 to 1.
    pub colour: [f32; 3],
    /// The name is shown.
    pub label: bool,
    /// Points are linked by lines.
    pub linked: bool,
}

/// A stream: values over time.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphStream {
    /// Name and appearance.
    pub style: CurveStyle,
    /// Shown in plots over time.
    pub visible: bool,
    /// What is done to recorded values.
    pub transformation: Transformation,
    /// Value for the next slot.
    pub next: Option<f64>,
    /// Of the last slots; those before them are gaps. None where the values are fixed.
    pub samples: VecDeque<GraphSample>,
    /// Times and values that no recording changes.
    pub fixed: Option<Vec<[f64; 2]>>,
    /// Of a stream from before 4.2.
    pub source: Option<OldSource>,
}

/// Source of a stream from before 4.2, stored for files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OldSource {
    /// Number of the quantity, as old files have it.
    pub data_type: i32,
    /// The object that is measured.
    pub object: Option<Handle>,
    /// A further number that some quantities need.
    pub auxiliary: i32,
}

/// The content of one slot; empty in a gap.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GraphSample {
    /// The recorded value.
    pub raw: Option<f64>,
    /// After the transformation, before it is multiplied and averaged.
    pub transformed: Option<f64>,
}

/// Transformation of the values of a stream.
#[derive(Debug, Clone, PartialEq)]
pub struct Transformation {
    /// The operation on successive values.
    pub kind: TransformationKind,
    /// Factor of transformed values.
    pub multiplier: f64,
    /// Added to the product.
    pub offset: f64,
    /// Slots in the moving average.
    pub period: i64,
    /// Differences are the shortest modulo this; 0 where values are not cyclic.
    pub cyclic_range: f64,
}

/// What a stream computes from the values it records (`sim.stream_transf_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransformationKind {
    /// The values themselves.
    Raw,
    /// Change per second.
    Derivative,
    /// Sum over time by the trapezoidal rule.
    Integral,
    /// Running sum of the values.
    Cumulative,
}

/// A curve through the values of two or three streams.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphCurve {
    /// Name and appearance.
    pub style: CurveStyle,
    /// Width of the line, pixels.
    pub width: i64,
    /// 2 or 3.
    pub dimensions: usize,
    /// The streams of x, y, z; -1 for a number.
    pub streams: [i64; 3],
    /// The numbers where there is no stream.
    pub defaults: [f64; 3],
    /// Points are in the frame of the graph.
    pub relative: bool,
    /// Points that no recording changes.
    pub fixed: Option<Vec<[f64; 3]>>,
    /// It is from before 4.2.
    pub old: bool,
}

impl TransformationKind {
    /// From `sim.stream_transf_*`.
    pub fn from_code(code: i64) -> Option<Self> {
        [
            Self::Raw,
            Self::Derivative,
            Self::Integral,
            Self::Cumulative,
        ]
        .into_iter()
        .find(|kind| kind.code() == code)
    }

    /// The number of `sim.stream_transf_*`.
    pub fn code(self) -> i64 {
        self as i64
    }
}

impl Default for Transformation {
    fn default() -> Self {
        Self {
            kind: TransformationKind::Raw,
            multiplier: 1.0,
            offset: 0.0,
            period: 1,
            cyclic_range: 0.0,
        }
    }
}

impl GraphStream {
    /// A visible stream without samples.
    pub fn new(style: CurveStyle) -> Self {
        let (samples, transformation) = Default::default();
        Self {
            style,
            visible: true,
            transformation,
            next: None,
            samples,
            fixed: None,
            source: None,
        }
    }
}

impl Default for Graph {
    fn default() -> Self {
        Self {
            explicit: false,
            buffer_size: 1000,
            cyclic: true,
            size: 0.1,
            background: [0.1; 3],
            foreground: [0.8; 3],
            times: VecDeque::new(),
            streams: Vec::new(),
            curves: Vec::new(),
        }
    }
}

impl Graph {
    /// Largest number of slots kept.
    pub const MAX_BUFFER_SIZE: i64 = 1_000_000;

    /// The streams in the order of their creation.
    pub fn streams(&self) -> &[GraphStream] {
        &self.streams
    }

    /// The streams, to change their samples and settings.
    pub fn streams_mut(&mut self) -> &mut [GraphStream] {
        &mut self.streams
    }

    /// When the slots were recorded, seconds of simulation time, the oldest first.
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> + DoubleEndedIterator {
        self.times.iter().copied()
    }

    /// The stream with that number.
    ///
    /// # Errors
    /// When there is no such stream.
    pub fn stream_mut(&mut self, id: i64) -> SceneResult<&mut GraphStream> {
        self.streams
            .iter_mut()
            .find(|stream| stream.style.id == id)
            .ok_or_else(no_curve)
    }

    /// A number no stream or curve has.
    fn free_id(&self) -> i64 {
        let ids = self
            .streams
            .iter()
            .map(|stream| stream.style.id)
            .chain(self.curves.iter().map(|c| c.style.id));
        ids.max().map_or(0, |id| id.saturating_add(1))
    }

    /// Adds a stream, or changes the appearance of the one with that name. Returns its number.
    ///
    /// # Errors
    /// When there is no name, or the one with that name is fixed.
    pub fn add_stream(&mut self, mut stream: GraphStream) -> SceneResult<i64> {
        let known = self
            .streams
            .iter_mut()
            .find(|known| known.style.name == stream.style.name);
        check_name(
            &stream.style.name,
            known.as_ref().is_some_and(|known| known.fixed.is_some()),
        )?;
        if let Some(known) = known {
            stream.style.id = known.style.id;
            (known.style, known.visible) = (stream.style, stream.visible);
            known.transformation.cyclic_range = stream.transformation.cyclic_range;
            return Ok(known.style.id);
        }
        stream.style.id = self.free_id();
        let id = stream.style.id;
        self.streams.push(stream);
        Ok(id)
    }

    /// Adds a curve, or replaces the one with that name. Returns its number.
    ///
    /// # Errors
    /// As [`add_stream`](Self::add_stream); and when a stream of it does not exist.
    pub fn add_curve(&mut self, mut curve: GraphCurve) -> SceneResult<i64> {
        let known = self
            .curves
            .iter()
            .position(|known| known.style.name == curve.style.name);
        check_name(
            &curve.style.name,
            known.is_some_and(|at| self.curves[at].fixed.is_some()),
        )?;
        let exists =
            |id: &i64| *id == -1 || self.streams.iter().any(|stream| stream.style.id == *id);
        if !curve.streams[..curve.dimensions].iter().all(exists) {
            return Err(no_curve());
        }
        curve.style.id = known.map_or_else(|| self.free_id(), |at| self.curves[at].style.id);
        let id = curve.style.id;
        match known {
            Some(at) => self.curves[at] = curve,
            None => self.curves.push(curve),
        }
        Ok(id)
    }

    /// Removes a curve or a stream.
    ///
    /// # Errors
    /// When there is none with that number.
    pub fn remove_curve(&mut self, id: i64) -> SceneResult<()> {
        let before = (self.curves.len(), self.streams.len());
        self.curves.retain(|curve| curve.style.id != id);
        if self.curves.len() == before.0 {
            self.streams.retain(|stream| stream.style.id != id);
        }
        if before == (self.curves.len(), self.streams.len()) {
            Err(no_curve())
        } else {
            Ok(())
        }
    }

    /// A copy of a stream or curve that no recording changes. Its number.
    ///
    /// # Errors
    /// When there is none with that number.
    pub fn fix_curve(&mut self, id: i64, name: &str) -> SceneResult<i64> {
        let free = self.free_id();
        let style = |style: &CurveStyle| {
            let name = if name.is_empty() {
                format!("{} [static]", style.name)
            } else {
                name.to_owned()
            };
            CurveStyle {
                id: free,
                name,
                ..style.clone()
            }
        };
        if let Some(curve) = self.curves.iter().find(|curve| curve.style.id == id) {
            let fixed = Some(self.points(curve));
            self.curves.push(GraphCurve {
                style: style(&curve.style),
                fixed,
                ..curve.clone()
            });
        } else {
            let stream = self
                .streams
                .iter()
                .find(|stream| stream.style.id == id)
                .ok_or_else(no_curve)?;
            let (style, fixed) = (style(&stream.style), Some(self.values(stream)));
            self.streams.push(GraphStream {
                fixed,
                visible: stream.visible,
                ..GraphStream::new(style)
            });
        }
        Ok(free)
    }

    /// Takes what a file holds. Samples that are not as many as the times are left out.
    pub fn restore(
        &mut self,
        times: VecDeque<f64>,
        mut streams: Vec<GraphStream>,
        curves: Vec<GraphCurve>,
    ) {
        let slots = times.len();
        for stream in &mut streams {
            if stream.fixed.is_some() || stream.samples.len() != slots {
                stream.samples.clear();
            }
        }
        (self.times, self.streams, self.curves) = (times, streams, curves);
    }
}

fn check_name(name: &str, is_fixed: bool) -> SceneResult<()> {
    match (name, is_fixed) {
        ("", _) => Err(SceneError::Refused("empty string is not allowed.".into())),
        (_, true) => Err(SceneError::Refused("cannot overwrite static curve.".into())),
        _ => Ok(()),
    }
}

fn no_curve() -> SceneError {
    SceneError::Refused("invalid curve id.".into())
}
