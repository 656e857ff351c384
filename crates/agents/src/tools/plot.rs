//! Curves over time as a picture.

use std::error::Error;

use format::picture::{Layout, Picture};
use format::plot::{drawable, label, load_font, range, thinned};
use plotters::coord::Shift;
use plotters::prelude::*;

use super::samples::Curve;

/// Pixels.
const WIDTH: u32 = 800;
const HEIGHT: u32 = 180;
/// Curves in one picture; more would not be looked at.
const MAX_CURVES: usize = 6;

const INK: RGBColor = RGBColor(30, 80, 180);

/// The curves, one below the other, as PNG; None when there is none.
pub(super) fn png(curves: &[Curve<'_>]) -> Option<Vec<u8>> {
    let shown = &curves[..curves.len().min(MAX_CURVES)];
    if shown.is_empty() {
        return None;
    }
    let (width, height) = (WIDTH, HEIGHT * shown.len() as u32);
    let mut pixels = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
    draw(&area, shown).ok()?;
    drop(area);
    let picture = Picture::new(pixels, [i64::from(width), i64::from(height)], Layout::Rgb).ok()?;
    picture.encode("png", 100).ok()
}

fn draw(
    area: &DrawingArea<BitMapBackend<'_>, Shift>,
    curves: &[Curve<'_>],
) -> Result<(), Box<dyn Error>> {
    load_font();
    area.fill(&WHITE)?;
    for (part, curve) in area.split_evenly((curves.len(), 1)).iter().zip(curves) {
        draw_curve(part, curve)?;
    }
    area.present()?;
    Ok(())
}

fn draw_curve(
    area: &DrawingArea<BitMapBackend<'_>, Shift>,
    curve: &Curve<'_>,
) -> Result<(), Box<dyn Error>> {
    let points = thinned(drawable(&curve.points), WIDTH as usize);
    let mut axes = ChartBuilder::on(area)
        .margin(6)
        .caption(curve.name, ("sans-serif", 14))
        .x_label_area_size(22)
        .y_label_area_size(64)
        .build_cartesian_2d(
            range(points.iter().map(|point| point.0)),
            range(points.iter().map(|point| point.1)),
        )?;
    axes.configure_mesh()
        .light_line_style(WHITE)
        .x_labels(10)
        .y_labels(5)
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    axes.draw_series(LineSeries::new(points, INK.stroke_width(2)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_drawn_and_nothing_is_no_picture() {
        let flat = Curve {
            name: "flat",
            points: vec![(0.0, 1.0), (1.0, 1.0)],
        };
        let file = png(&[flat]).expect("a picture");
        assert!(file.starts_with(b"\x89PNG"));
        assert!(png(&[]).is_none());
    }
}
