//! Graphs as files: tables of their streams (CSV), and charts (SVG).

#[cfg(feature = "plots")]
use super::plot::{self, Chart, PlottedCurve};
use scene::graph::{CurveStyle, Graph};

/// The kind of a file, from its extension; None for others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GraphFile {
    /// A table of the streams.
    Csv,
    /// A chart.
    #[cfg(feature = "plots")]
    Svg,
}

impl GraphFile {
    /// The kind of file of an extension in either case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            #[cfg(feature = "plots")]
            "svg" => Some(Self::Svg),
            _ => None,
        }
    }
}

/// What a graph has recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphData {
    /// The path of the graph.
    pub title: String,
    /// Colour behind the curves: red, green, blue, 0 to 1.
    pub background: [f32; 3],
    /// Colour of axes and texts: red, green, blue, 0 to 1.
    pub foreground: [f32; 3],
    /// Seconds.
    pub times: Vec<f64>,
    /// Values over time.
    pub streams: Vec<StreamData>,
    /// Curves of two or three streams.
    pub curves: Vec<CurveData>,
}

/// Values of a graph over time.
#[derive(Debug, Clone, PartialEq)]
pub struct StreamData {
    /// Label, colour and line of the stream.
    pub style: CurveStyle,
    /// Whether the graph shows it.
    pub visible: bool,
    /// Times and values.
    pub values: Vec<[f64; 2]>,
}

/// A curve of a graph in a plane or in space.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveData {
    /// Label, colour and line of the curve.
    pub style: CurveStyle,
    /// 2 or 3.
    pub dimensions: usize,
    /// No recording changes it.
    pub is_static: bool,
    /// Its points; curves in a plane have their default as third coordinate.
    pub points: Vec<[f64; 3]>,
}

impl GraphData {
    /// What a graph has recorded so far.
    pub fn new(graph: &Graph, title: &str) -> Self {
        let streams = graph.streams().iter().map(|stream| StreamData {
            style: stream.style.clone(),
            visible: stream.visible,
            values: graph.values(stream),
        });
        let curves = graph.curves.iter().map(|curve| CurveData {
            style: curve.style.clone(),
            dimensions: curve.dimensions,
            is_static: curve.fixed.is_some(),
            points: graph.points(curve),
        });
        Self {
            title: title.to_owned(),
            background: graph.background,
            foreground: graph.foreground,
            times: graph.times().collect(),
            streams: streams.collect(),
            curves: curves.collect(),
        }
    }

    /// The content of such a file.
    pub fn file(&self, kind: GraphFile) -> Vec<u8> {
        match kind {
            GraphFile::Csv => csv(self).into_bytes(),
            #[cfg(feature = "plots")]
            GraphFile::Svg => plot::svg(&charts(self)).unwrap_or_default().into_bytes(),
        }
    }
}

/// A chart over time of what is visible, and one of the curves through streams, if there are any. A curve of three dimensions is seen along z.
#[cfg(feature = "plots")]
fn charts(graph: &GraphData) -> Vec<Chart> {
    let visible = graph.streams.iter().filter(|stream| stream.visible);
    let streams = visible.map(|stream| {
        plotted(
            &stream.style,
            stream.values.iter().map(|[time, value]| (*time, *value)),
        )
    });
    let chart = |caption: &str, x_label: &str, curves| Chart {
        caption: caption.to_owned(),
        x_label: x_label.to_owned(),
        background: graph.background,
        foreground: graph.foreground,
        curves,
    };
    let mut charts = vec![chart(&graph.title, "time [s]", streams.collect())];
    if !graph.curves.is_empty() {
        let curves = graph.curves.iter();
        let curves = curves
            .map(|curve| plotted(&curve.style, curve.points.iter().map(|[x, y, _]| (*x, *y))));
        charts.push(chart(
            &format!("{}, curves", graph.title),
            "x",
            curves.collect(),
        ));
    }
    charts
}

#[cfg(feature = "plots")]
fn plotted(style: &CurveStyle, points: impl Iterator<Item = (f64, f64)>) -> PlottedCurve {
    let label = style.label.then(|| with_unit(style));
    PlottedCurve {
        label,
        colour: style.colour,
        linked: style.linked,
        points: points.collect(),
    }
}

fn with_unit(style: &CurveStyle) -> String {
    if style.unit.is_empty() {
        style.name.clone()
    } else {
        format!("{} [{}]", style.name, style.unit)
    }
}

/// A row for each time, a column for each stream, also those that are not shown; nothing in gaps. Then the points of curves that no recording
/// changes, which have no times: two or three columns each, from the first row on.
fn csv(graph: &GraphData) -> String {
    let of_streams = graph
        .streams
        .iter()
        .flat_map(|stream| &stream.values)
        .map(|[time, _]| *time);
    let mut times: Vec<f64> = graph.times.iter().copied().chain(of_streams).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut columns: Vec<(String, Vec<Option<f64>>)> =
        vec![("time [s]".into(), times.iter().copied().map(Some).collect())];
    for stream in &graph.streams {
        columns.push((with_unit(&stream.style), at_times(&times, &stream.values)));
    }
    for curve in graph.curves.iter().filter(|curve| curve.is_static) {
        for (axis, name) in ["x", "y", "z"]
            .into_iter()
            .enumerate()
            .take(curve.dimensions)
        {
            let column = curve.points.iter().map(|point| Some(point[axis])).collect();
            columns.push((format!("{} {name}", with_unit(&curve.style)), column));
        }
    }
    table(&columns)
}

/// Where there is none: nothing. Of several at one time the last counts.
fn at_times(times: &[f64], values: &[[f64; 2]]) -> Vec<Option<f64>> {
    let mut column = vec![None; times.len()];
    for [time, value] in values {
        if let Ok(row) = times.binary_search_by(|other| other.total_cmp(time)) {
            column[row] = Some(*value);
        }
    }
    column
}

fn table(columns: &[(String, Vec<Option<f64>>)]) -> String {
    let rows = columns
        .iter()
        .map(|(_, values)| values.len())
        .max()
        .unwrap_or(0);
    let mut text = columns
        .iter()
        .map(|(name, _)| quoted(name))
        .collect::<Vec<_>>()
        .join(",")
        + "\n";
    for row in 0..rows {
        let cell = |(_, values): &(String, Vec<Option<f64>>)| {
            values
                .get(row)
                .copied()
                .flatten()
                .map_or_else(String::new, |value| value.to_string())
        };
        text += &(columns.iter().map(cell).collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// RFC 4180: quotation marks around what contains separators.
fn quoted(text: &str) -> String {
    let is_plain = !text.contains([',', '"', '\n', '\r']);
    if is_plain {
        text.to_owned()
    } else {
        format!("\"{}\"", text.replace('"', "\"\""))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::graph::{GraphCurve, GraphStream};

    fn style(name: &str, unit: &str) -> CurveStyle {
        CurveStyle {
            id: 0,
            name: name.into(),
            unit: unit.into(),
            colour: [1.0, 0.0, 0.0],
            label: true,
            linked: true,
        }
    }

    fn graph() -> Graph {
        let mut graph = Graph::default();
        let ids = [("height", "m"), ("a, \"b\"", "")].map(|(name, unit)| {
            graph
                .add_stream(GraphStream::new(style(name, unit)))
                .expect("the name is new")
        });
        for slot in 0..3 {
            graph.stream_mut(ids[0]).expect("it was added").next = Some(0.5 * f64::from(slot));
            graph.stream_mut(ids[1]).expect("it was added").next = (slot != 1).then_some(-1.0);
            graph.record(0.25 * f64::from(slot));
        }
        let curve = GraphCurve {
            style: style("path", ""),
            width: 1,
            dimensions: 2,
            streams: [ids[0], ids[1], -1],
            defaults: [0.0; 3],
            relative: true,
            fixed: None,
            old: false,
        };
        let id = graph.add_curve(curve).expect("its streams are there");
        graph.fix_curve(id, "").expect("it was added");
        graph
    }

    #[test]
    fn a_table_has_all_streams() {
        let text = String::from_utf8(GraphData::new(&graph(), "g").file(GraphFile::Csv))
            .expect("it is text");
        let expected = "time [s],height [m],\"a, \"\"b\"\"\",path [static] x,path [static] y\n\
                        0,0,-1,0,-1\n0.25,0.5,,1,-1\n0.5,1,-1,,\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_picture_has_names_and_colours() {
        let text = String::from_utf8(GraphData::new(&graph(), "Heights <1>").file(GraphFile::Svg))
            .expect("it is text");
        for part in [
            "<svg",
            "height [m]",
            "Heights &lt;1&gt;",
            "#FF0000",
            "time [s]",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(
            text.contains("height=\"720\"")
                && text
                    == String::from_utf8_lossy(
                        &GraphData::new(&graph(), "Heights <1>").file(GraphFile::Svg)
                    )
        );
    }

    #[test]
    fn empty_graphs_and_odd_numbers_are_no_trouble() {
        let mut graph = Graph::default();
        assert_eq!(
            GraphData::new(&graph, "").file(GraphFile::Csv),
            b"time [s]\n"
        );
        assert!(
            GraphData::new(&graph, "")
                .file(GraphFile::Svg)
                .starts_with(b"<svg")
        );
        let id = graph
            .add_stream(GraphStream::new(style("s", "")))
            .expect("the name is new");
        for value in [f64::NAN, f64::INFINITY, 1e300, -1e300, 5e-324] {
            graph.stream_mut(id).expect("it was added").next = Some(value);
            graph.record(value);
        }
        assert!(
            GraphData::new(&graph, "")
                .file(GraphFile::Svg)
                .ends_with(b"</svg>\n")
        );
        GraphData::new(&graph, "").file(GraphFile::Csv);
    }
}
