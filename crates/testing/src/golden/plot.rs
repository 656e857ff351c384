//! Plots of expected and actual traces.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::compare::Difference;
use super::{Comparison, ComparisonResult, Recordings};
use format::picture::{Layout, Picture};
use format::plot::{drawable, label, load_font, range, thinned};
use script::test_bench::Trace;

/// Pixels.
const WIDTH: u32 = 900;
const HEIGHT: u32 = 220;
/// Quantities in one picture; more would not be looked at.
const MAX_CURVES: usize = 8;

const EXPECTED: RGBColor = RGBColor(120, 120, 120);
const ACTUAL: RGBColor = RGBColor(200, 60, 30);

type Drawn<T> = Result<T, Box<dyn Error>>;

/// The picture as SVG; None when there is nothing to compare.
pub(super) fn svg(comparison: &Comparison) -> Option<String> {
    let shown = shown(comparison)?;
    let mut text = String::new();
    let size = (WIDTH, HEIGHT * shown.columns.len() as u32);
    let drawn = draw(
        SVGBackend::with_string(&mut text, size).into_drawing_area(),
        &shown,
    );
    drawn.is_ok().then_some(text)
}

/// The picture as PNG; None when there is nothing to compare.
pub(super) fn png(comparison: &Comparison) -> Option<Vec<u8>> {
    let shown = shown(comparison)?;
    let (width, height) = (WIDTH, HEIGHT * shown.columns.len() as u32);
    let mut pixels = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
    draw(area, &shown).ok()?;
    let picture = Picture::new(pixels, [i64::from(width), i64::from(height)], Layout::Rgb).ok()?;
    picture.encode("png", 100).ok()
}

/// Content of a plot: two traces, and the columns of both that belong together.
struct Shown<'a> {
    expected: &'a Trace,
    actual: &'a Trace,
    columns: Vec<(usize, usize)>,
}

/// The quantities that differ, as columns of both traces; all when they differ in length only.
fn shown(comparison: &Comparison) -> Option<Shown<'_>> {
    let Recordings::Traces {
        actual,
        expected: Some(expected),
    } = &comparison.recordings
    else {
        return None;
    };
    let differs = |name: &String| match &comparison.result {
        ComparisonResult::Different(Difference::Values { columns, .. }) => columns.contains(name),
        _ => true,
    };
    let place = |name: &String| actual.columns.iter().position(|other| other == name);
    let columns = expected
        .columns
        .iter()
        .enumerate()
        .filter(|(_, name)| differs(name));
    let columns: Vec<_> = columns
        .filter_map(|(i, name)| Some((i, place(name)?)))
        .take(MAX_CURVES)
        .collect();
    (!columns.is_empty()).then_some(Shown {
        expected,
        actual,
        columns,
    })
}

fn draw<B>(
    area: DrawingArea<B, Shift>,
    Shown {
        expected,
        actual,
        columns,
    }: &Shown<'_>,
) -> Drawn<()>
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    load_font();
    area.fill(&WHITE)?;
    for (part, &(i, j)) in area.split_evenly((columns.len(), 1)).iter().zip(columns) {
        let (was, is) = (points(expected, i), points(actual, j));
        draw_quantity(part, &expected.columns[i], &was, &is)?;
    }
    area.present()?;
    Ok(())
}

/// The points of a column that can be drawn: time and value.
fn points(trace: &Trace, column: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = trace
        .rows
        .iter()
        .map(|row| (row[0], row[column + 1]))
        .collect();
    thinned(drawable(&points), WIDTH as usize)
}

fn draw_quantity<B>(
    area: &DrawingArea<B, Shift>,
    name: &str,
    was: &[(f64, f64)],
    is: &[(f64, f64)],
) -> Drawn<()>
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    let all = || was.iter().chain(is);
    let (times, values) = (
        range(all().map(|point| point.0)),
        range(all().map(|point| point.1)),
    );
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .caption(name, ("sans-serif", 15))
        .x_label_area_size(24)
        .y_label_area_size(70)
        .build_cartesian_2d(times, values)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_labels(10)
        .y_labels(5)
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    let lines = [("expected", EXPECTED, was), ("this run", ACTUAL, is)];
    for (label, colour, points) in lines {
        let series = LineSeries::new(points.iter().copied(), colour.stroke_width(2));
        chart
            .draw_series(series)?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .background_style(WHITE.mix(0.8))
        .border_style(EXPECTED)
        .draw()?;
    Ok(())
}
