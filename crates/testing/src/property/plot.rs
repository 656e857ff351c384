//! Pictures of properties: robustness over time, and which part of the values fails.

use std::error::Error;

use plotters::prelude::*;

use super::values::Sample;
use format::plot::{drawable, label, load_font, range, thinned};
use script::test_cases::Signal;

/// Pixels.
const WIDTH: u32 = 900;
const HEIGHT: u32 = 180;
/// Pixels of the square of two choices.
const SIDE: u32 = 420;
/// With fewer cases there is nothing to see.
const MIN_SAMPLES: usize = 20;
/// Signals in one picture; more would not be looked at.
const MAX_SIGNALS: usize = 12;

const LINE: RGBColor = RGBColor(40, 90, 170);
const LIMIT: RGBColor = RGBColor(200, 60, 30);
const CLOSE: RGBColor = RGBColor(240, 160, 40);
const FAR: RGBColor = RGBColor(150, 190, 150);

type Drawn<T> = Result<T, Box<dyn Error>>;

/// How far conditions are from false over time, one below the other, as SVG. Booleans are drawn as 1 and -1.
pub(crate) fn of_signals(signals: &[Signal]) -> Option<String> {
    let shown: Vec<_> = signals
        .iter()
        .filter(|s| !s.samples.is_empty())
        .take(MAX_SIGNALS)
        .collect();
    let height = HEIGHT * u32::try_from(shown.len()).ok().filter(|count| *count > 0)?;
    let mut text = String::new();
    draw_signals(&mut text, (WIDTH, height), &shown).ok()?;
    Some(text)
}

fn draw_signals(text: &mut String, size: (u32, u32), signals: &[&Signal]) -> Drawn<()> {
    load_font();
    let area = SVGBackend::with_string(text, size).into_drawing_area();
    area.fill(&WHITE)?;
    for (part, signal) in area.split_evenly((signals.len(), 1)).iter().zip(signals) {
        let finite = |(time, value): &(f64, f64)| {
            let is_finite = value.is_finite();
            (*time, if is_finite { *value } else { value.signum() })
        };
        let points: Vec<_> = signal.samples.iter().map(finite).collect();
        let points = thinned(drawable(&points), WIDTH as usize);
        let times = range(points.iter().map(|point| point.0));
        let values = range(points.iter().map(|point| point.1).chain([0.0]));
        let zero = [(times.start, 0.0), (times.end, 0.0)];
        let mut chart = ChartBuilder::on(part)
            .margin(8)
            .caption(&signal.name, ("sans-serif", 15))
            .x_label_area_size(24)
            .y_label_area_size(70)
            .build_cartesian_2d(times, values)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_labels(10)
            .y_labels(4)
            .y_label_formatter(&|y| label(*y))
            .draw()?;
        chart.draw_series(LineSeries::new(zero, LIMIT.stroke_width(1)))?;
        chart.draw_series(LineSeries::new(points, LINE.stroke_width(2)))?;
    }
    area.present()?;
    Ok(())
}

/// The cases of a search over the two choices that matter most, as SVG: failed ones red, those close to it orange.
pub(crate) fn of_samples(samples: &[Sample]) -> Option<String> {
    let samples: Vec<_> = samples
        .iter()
        .filter(|sample| sample.passed.is_some())
        .collect();
    let (x, y) = axes(&samples)?;
    let mut text = String::new();
    draw_samples(&mut text, &samples, x, y).ok()?;
    Some(text)
}

/// The two choices with most influence on the robustness, of those that at least half of the cases have.
fn axes(samples: &[&Sample]) -> Option<(usize, usize)> {
    if samples.len() < MIN_SAMPLES {
        return None;
    }
    let mut counts: Vec<_> = samples.iter().map(|sample| sample.choices.len()).collect();
    counts.sort_unstable();
    let count = counts[counts.len() / 2];
    let mut numbers: Vec<_> = (0..count)
        .map(|choice| (influence(samples, choice), choice))
        .collect();
    numbers.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let (first, second) = (numbers.first()?.1, numbers.get(1)?.1);
    Some((first.min(second), first.max(second)))
}

/// The share of the spread of robustness that averages over ten parts of the choice explain (the correlation ratio).
fn influence(samples: &[&Sample], choice: usize) -> f64 {
    const PARTS: usize = 10;
    let measured = |sample: &&&Sample| sample.choices.len() > choice;
    let value = |sample: &Sample| match sample.robustness {
        r if r.is_finite() => r,
        _ => f64::from(u8::from(sample.passed == Some(true))),
    };
    let points: Vec<_> = samples
        .iter()
        .filter(measured)
        .map(|s| (s.choices[choice], value(s)))
        .collect();
    let bounds = range(points.iter().map(|point| point.0));
    let mean = points.iter().map(|p| p.1).sum::<f64>() / points.len() as f64;
    let (mut sums, mut counts) = ([0.0; PARTS], [0.0; PARTS]);
    for (x, robustness) in &points {
        let share = (x - bounds.start) / (bounds.end - bounds.start);
        let part = ((share * PARTS as f64) as usize).min(PARTS - 1);
        (sums[part], counts[part]) = (sums[part] + robustness - mean, counts[part] + 1.0);
    }
    let between: f64 = sums
        .iter()
        .zip(counts)
        .filter(|(_, n)| *n > 0.0)
        .map(|(s, n)| s * s / n)
        .sum();
    let all: f64 = points.iter().map(|p| (p.1 - mean) * (p.1 - mean)).sum();
    if all > 0.0 { between / all } else { 0.0 }
}

fn draw_samples(text: &mut String, samples: &[&Sample], x: usize, y: usize) -> Drawn<()> {
    load_font();
    let shown: Vec<_> = samples
        .iter()
        .filter(|s| s.choices.len() > x.max(y))
        .collect();
    let area = SVGBackend::with_string(text, (SIDE + 60, SIDE)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(8)
        .x_label_area_size(36)
        .y_label_area_size(60)
        .build_cartesian_2d(
            range(shown.iter().map(|s| s.choices[x])),
            range(shown.iter().map(|s| s.choices[y])),
        )?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_desc(format!("choice {}", x + 1))
        .y_desc(format!("choice {}", y + 1))
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    let close = quarter(samples);
    let dot = |sample: &&&Sample| {
        let (colour, size) = match sample.passed {
            Some(false) => (LIMIT, 4),
            _ if sample.robustness <= close => (CLOSE, 3),
            _ => (FAR, 2),
        };
        Circle::new(
            (sample.choices[x], sample.choices[y]),
            size,
            colour.filled(),
        )
    };
    chart.draw_series(shown.iter().map(dot))?;
    area.present()?;
    Ok(())
}

/// The robustness below which the closest quarter of the cases lies.
fn quarter(samples: &[&Sample]) -> f64 {
    let finite = samples
        .iter()
        .map(|s| s.robustness)
        .filter(|r| r.is_finite());
    let mut values: Vec<_> = finite.collect();
    values.sort_by(f64::total_cmp);
    values
        .get(values.len() / 4)
        .copied()
        .unwrap_or(f64::NEG_INFINITY)
}
