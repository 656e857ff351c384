//! Charts of curves as SVG.

use std::error::Error;
use std::ops::Range;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

/// Pixels.
const WIDTH: u32 = 900;
const HEIGHT: u32 = 360;

/// Curves over common axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    pub caption: String,
    pub x_label: String,
    pub background: [f32; 3],
    pub foreground: [f32; 3],
    pub curves: Vec<PlottedCurve>,
}

/// A curve, and how it looks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlottedCurve {
    /// None where the legend leaves it out.
    pub label: Option<String>,
    pub colour: [f32; 3],
    /// Whether lines join the points.
    pub linked: bool,
    pub points: Vec<(f64, f64)>,
}

/// The charts one below the other; None when there is none.
pub(crate) fn svg(charts: &[Chart]) -> Option<String> {
    let mut text = String::new();
    let height = HEIGHT
        * u32::try_from(charts.len())
            .ok()
            .filter(|count| (1..1000).contains(count))?;
    draw(
        SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area(),
        charts,
    )
    .ok()?;
    Some(text)
}

fn draw<B>(area: DrawingArea<B, Shift>, charts: &[Chart]) -> Result<(), Box<dyn Error>>
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    load_font();
    for (part, chart) in area.split_evenly((charts.len(), 1)).iter().zip(charts) {
        draw_chart(part, chart)?;
    }
    area.present()?;
    Ok(())
}

fn draw_chart<B>(area: &DrawingArea<B, Shift>, chart: &Chart) -> Result<(), Box<dyn Error>>
where
    B: DrawingBackend,
    B::ErrorType: 'static,
{
    let (paper, ink) = (rgb(chart.background), rgb(chart.foreground));
    area.fill(&paper)?;
    let curves: Vec<(&PlottedCurve, Vec<(f64, f64)>)> = chart
        .curves
        .iter()
        .map(|curve| (curve, thinned(drawable(&curve.points), WIDTH as usize)))
        .collect();
    let all = || curves.iter().flat_map(|(_, points)| points);
    let words = ("sans-serif", 13).into_font().color(&ink);
    let mut axes = ChartBuilder::on(area)
        .margin(10)
        .caption(&chart.caption, ("sans-serif", 16).into_font().color(&ink))
        .x_label_area_size(36)
        .y_label_area_size(70)
        .build_cartesian_2d(
            range(all().map(|point| point.0)),
            range(all().map(|point| point.1)),
        )?;
    axes.configure_mesh()
        .axis_style(ink)
        .bold_line_style(ink.mix(0.2))
        .light_line_style(paper)
        .label_style(words.clone())
        .x_desc(&chart.x_label)
        .x_labels(10)
        .y_labels(6)
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    for (curve, points) in &curves {
        let colour = rgb(curve.colour);
        let series = if curve.linked {
            axes.draw_series(LineSeries::new(
                points.iter().copied(),
                colour.stroke_width(2),
            ))?
        } else {
            axes.draw_series(
                points
                    .iter()
                    .map(|point| Circle::new(*point, 2, colour.filled())),
            )?
        };
        if let Some(name) = &curve.label {
            let sample =
                move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2));
            series.label(name).legend(sample);
        }
    }
    if curves.iter().any(|(curve, _)| curve.label.is_some()) {
        let legend = paper.mix(0.8);
        axes.configure_series_labels()
            .label_font(words)
            .background_style(legend)
            .border_style(ink.mix(0.5))
            .draw()?;
    }
    Ok(())
}

fn rgb(colour: [f32; 3]) -> RGBColor {
    let [red, green, blue] =
        colour.map(|part| numbers::level((part.clamp(0.0, 1.0) * 255.0).round().into()));
    RGBColor(red, green, blue)
}

/// Points that can be drawn: larger values leave no room between two lines of a grid.
pub fn drawable(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let is_fine = |value: f64| value.is_finite() && value.abs() < 1e100;
    points
        .iter()
        .copied()
        .filter(|(x, y)| is_fine(*x) && is_fine(*y))
        .collect()
}

/// Of many points over one pixel, only the lowest and the highest can be seen. Curves that turn back keep all.
pub fn thinned(points: Vec<(f64, f64)>, width: usize) -> Vec<(f64, f64)> {
    if points.len() <= 2 * width || !points.is_sorted_by(|a, b| a.0 <= b.0) {
        return points;
    }
    let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let extremes = |some: &[(f64, f64)]| {
        let mut ends: Vec<_> = some
            .iter()
            .min_by(by_value)
            .into_iter()
            .chain(some.iter().max_by(by_value))
            .copied()
            .collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        ends
    };
    points
        .chunks(points.len().div_ceil(width))
        .flat_map(extremes)
        .collect()
}

/// A number beside an axis.
pub fn label(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        format!("{value:.2e}")
    } else {
        format!("{value:.4}")
    }
}

/// The range of some numbers with a little room; never empty.
pub fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    if low > high {
        return 0.0..1.0;
    }
    let room = ((high - low) * 0.05)
        .max(high.abs().max(low.abs()) * 1e-9)
        .max(1e-12);
    low - room..high + room
}

/// plotters brings no font; it needs one also to measure the words of an SVG.
pub fn load_font() {
    static LOADED: Once = Once::new();
    // A font that cannot be loaded leaves a picture without words.
    LOADED.call_once(|| {
        heap::outside(|| {
            drop(register_font(
                "sans-serif",
                FontStyle::Normal,
                dejavu::sans::regular(),
            ));
        });
    });
}
