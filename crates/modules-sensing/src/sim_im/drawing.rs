//! `simIM.*`: drawing. Places are columns and rows; with `shift` they have that many binary digits behind the point.

use api_macro::api;
use imaging::draw::{
    FontFace, LineType, Pen, PixelPosition, Stroke, Text, clip_line as clip, text_size as measure,
};
use imaging::matrix::{Matrix, MatrixError};

use super::arguments::Ints;
use super::images::refused;
use super::objects::images;
use crate::{ApiFn, Cx, Result, functions};
use script::{IntPair, Number};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    line,
    arrowed_line,
    polylines,
    rectangle,
    circle,
    ellipse,
    fill_poly,
    fill_convex_poly,
    text,
    text_size,
    clip_line,
];

/// `simIM.fontFace.simplex`.
const SIMPLEX: i64 = 10_400;
const WHITE: [i64; 3] = [255; 3];
const EIGHT_CONNECTED: i64 = 8;

/// A colour is passed as red, green, blue and stored in the opposite order.
fn pen(Ints([red, green, blue]): Ints<3>, line_type: Number) -> Result<Pen> {
    let line_type = match line_type.0 {
        4 => LineType::FourConnected,
        EIGHT_CONNECTED | 0 | 1 => LineType::EightConnected,
        16 => LineType::Antialiased,
        other => return Err(refused(&format!("invalid line type: {other}"))),
    };
    Ok(Pen {
        colour: [blue as f64, green as f64, red as f64, 0.0],
        line_type,
    })
}

/// Divisor of a fixed-point number with `shift` binary digits after the point.
fn divisor(shift: Number) -> Result<f64> {
    const MAX_SHIFT: i64 = 16;
    let is_possible = (0..=MAX_SHIFT).contains(&shift.0);
    if is_possible {
        Ok(f64::from(1u32 << shift.0))
    } else {
        Err(MatrixError::Range("the shift").into())
    }
}

fn place(Ints(numbers): Ints<2>, divisor: f64) -> PixelPosition {
    numbers.map(|number| number as f64 / divisor)
}

/// The thickness of a line, which has no inside.
fn thickness_of(thickness: Number) -> Result<u32> {
    match Stroke::from_thickness(thickness.0)? {
        Stroke::Outline(thickness) => Ok(thickness),
        Stroke::Fill => Err(MatrixError::Range("the thickness").into()),
    }
}

fn draw<T>(cx: &Cx, handle: &str, draw: impl FnOnce(&mut Matrix) -> T) -> Result<T> {
    images(cx).modify(handle, draw)
}

/// Draws a line.
///
/// @param handle the image
/// @param p1 first place
/// @param p2 last place
/// @param color red, green, blue
/// @param thickness pixels
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of places behind the point
#[api("simIM.line")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn line(
    cx: &Cx,
    handle: String,
    p1: Ints<2>,
    p2: Ints<2>,
    color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let (pen, thickness, divisor) = (
        pen(color, r#type)?,
        thickness_of(thickness)?,
        divisor(shift)?,
    );
    draw(cx, &handle, |image| {
        image.draw_line(place(p1, divisor), place(p2, divisor), &pen, thickness);
    })
}

/// Draws a line with a tip at its end.
///
/// @param handle the image
/// @param p1 first place
/// @param p2 last place
/// @param color red, green, blue
/// @param thickness pixels
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of places behind the point
/// @param tipLength part of the line's length
#[api("simIM.arrowedLine")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn arrowed_line(
    cx: &Cx,
    handle: String,
    p1: Ints<2>,
    p2: Ints<2>,
    color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
    #[default(0.1)] tip_length: f64,
) -> Result<()> {
    let (pen, thickness, divisor) = (
        pen(color, r#type)?,
        thickness_of(thickness)?,
        divisor(shift)?,
    );
    let (from, to) = (place(p1, divisor), place(p2, divisor));
    draw(cx, &handle, |image| {
        image.draw_arrow(from, to, &pen, thickness, tip_length);
    })
}

/// Places of several polygons, from lists of their coordinates and counts.
fn polygons(
    points: &[i64],
    counts: &[i64],
    divisor: f64,
    offset: [f64; 2],
) -> Result<Vec<Vec<PixelPosition>>> {
    let wrong = || refused("invalid number of points or invalid elements in numPoints");
    let (pairs, rest) = points.as_chunks::<2>();
    let mut left = if rest.is_empty() {
        pairs
    } else {
        return Err(wrong());
    };
    let mut polygons = Vec::new();
    for &count in counts {
        let count = usize::try_from(count)
            .ok()
            .filter(|count| *count > 0 && *count <= left.len())
            .ok_or_else(wrong)?;
        let (polygon, others) = left.split_at(count);
        let place = |[x, y]: &[i64; 2]| {
            [
                *x as f64 / divisor + offset[0],
                *y as f64 / divisor + offset[1],
            ]
        };
        polygons.push(polygon.iter().map(place).collect());
        left = others;
    }
    if left.is_empty() {
        Ok(polygons)
    } else {
        Err(wrong())
    }
}

/// Draws lines from place to place.
///
/// @param handle the image
/// @param points columns and rows of all places
/// @param numPoints how many places each line has
/// @param isClosed lines lead back to their first places
/// @param color red, green, blue
/// @param thickness pixels
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of places behind the point
#[api("simIM.polylines")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn polylines(
    cx: &Cx,
    handle: String,
    points: Vec<i64>,
    num_points: Vec<i64>,
    is_closed: bool,
    color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let (pen, thickness) = (pen(color, r#type)?, thickness_of(thickness)?);
    let lines = polygons(&points, &num_points, divisor(shift)?, [0.0; 2])?;
    draw(cx, &handle, |image| {
        lines
            .iter()
            .for_each(|line| image.draw_lines(line, is_closed, &pen, thickness));
    })
}

/// Draws a rectangle.
///
/// @param handle the image
/// @param p1 a corner
/// @param p2 the opposite corner
/// @param color red, green, blue
/// @param thickness pixels; -1 fills
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of places behind the point
#[api("simIM.rectangle")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn rectangle(
    cx: &Cx,
    handle: String,
    p1: Ints<2>,
    p2: Ints<2>,
    color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let (pen, stroke, divisor) = (
        pen(color, r#type)?,
        Stroke::from_thickness(thickness.0)?,
        divisor(shift)?,
    );
    draw(cx, &handle, |image| {
        image.draw_rectangle(place(p1, divisor), place(p2, divisor), &pen, stroke);
    })
}

/// Draws a circle.
///
/// @param handle the image
/// @param center its centre
/// @param radius pixels
/// @param color red, green, blue
/// @param thickness pixels; -1 fills
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of centre and radius behind the point
#[api("simIM.circle")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn circle(
    cx: &Cx,
    handle: String,
    center: Ints<2>,
    radius: Number,
    color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let (pen, stroke, divisor) = (
        pen(color, r#type)?,
        Stroke::from_thickness(thickness.0)?,
        divisor(shift)?,
    );
    let (centre, radius) = (place(center, divisor), radius.0 as f64 / divisor);
    Ok(draw(cx, &handle, |image| {
        image.draw_circle(centre, radius, &pen, stroke)
    })??)
}

/// Draws an ellipse or a part of it.
///
/// @param handle the image
/// @param center its centre
/// @param radius half of its axes
/// @param angle of its first axis, degrees, clockwise
/// @param startAngle where the part begins, degrees
/// @param endAngle where the part ends, degrees
/// @param color red, green, blue
/// @param thickness pixels; -1 fills
/// @param type 8 or 4: pixels touch at corners or at sides; 16: antialiased
/// @param shift binary digits of centre and radius behind the point
#[api("simIM.ellipse")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn ellipse(
    cx: &Cx,
    handle: String,
    center: Ints<2>,
    radius: Ints<2>,
    #[default(0.0)] angle: f64,
    #[default(0.0)] start_angle: f64,
    #[default(360.0)] end_angle: f64,
    #[default(WHITE)] color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let (pen, stroke, divisor) = (
        pen(color, r#type)?,
        Stroke::from_thickness(thickness.0)?,
        divisor(shift)?,
    );
    let (centre, radii) = (place(center, divisor), place(radius, divisor));
    if radius.0.iter().any(|radius| *radius < 0) {
        return Err(MatrixError::Range("the radius").into());
    }
    draw(cx, &handle, |image| {
        image.draw_ellipse(centre, radii, angle, [start_angle, end_angle], &pen, stroke);
    })
}

/// Fills what polygons enclose, but not where two overlap.
///
/// @param handle the image
/// @param points columns and rows of all places
/// @param numPoints how many places each polygon has
/// @param offset is added to all places
/// @param color red, green, blue
/// @param type 8 or 4; 16: antialiased
/// @param shift binary digits of places behind the point
#[api("simIM.fillPoly")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn fill_poly(
    cx: &Cx,
    handle: String,
    points: Vec<i64>,
    num_points: Vec<i64>,
    offset: Ints<2>,
    color: Ints<3>,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let pen = pen(color, r#type)?;
    let polygons = polygons(&points, &num_points, divisor(shift)?, offset.floats())?;
    draw(cx, &handle, |image| image.fill_polygons(&polygons, &pen))
}

/// Fills a polygon.
///
/// @param handle the image
/// @param points columns and rows of its places
/// @param color red, green, blue
/// @param type 8 or 4; 16: antialiased
/// @param shift binary digits of places behind the point
#[api("simIM.fillConvexPoly")]
fn fill_convex_poly(
    cx: &Cx,
    handle: String,
    points: Vec<i64>,
    color: Ints<3>,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(0)] shift: Number,
) -> Result<()> {
    let pen = pen(color, r#type)?;
    let polygons = polygons(
        &points,
        &[points.len() as i64 / 2],
        divisor(shift)?,
        [0.0; 2],
    )?;
    draw(cx, &handle, |image| image.fill_polygons(&polygons, &pen))
}

fn font_face(number: i64) -> Result<FontFace> {
    Ok(match number.wrapping_sub(SIMPLEX) {
        0 => FontFace::Simplex,
        1 => FontFace::Plain,
        2 => FontFace::Duplex,
        3 => FontFace::Complex,
        4 => FontFace::Triplex,
        5 => FontFace::ComplexSmall,
        6 => FontFace::ScriptSimplex,
        7 => FontFace::ScriptComplex,
        _ => return Err(refused(&format!("invalid font face: {number}"))),
    })
}

/// Draws a text. All fonts have the same glyphs here, in different sizes.
///
/// @param handle the image
/// @param str the text
/// @param pos left end of its baseline
/// @param fontFace simIM.fontFace.*
/// @param italic leans to the right
/// @param fontScale 1: capitals of simplex have 21 pixels
/// @param color red, green, blue
/// @param thickness pixels
/// @param type 8 or 4; 16: antialiased
/// @param bottomLeftOrigin letters stand upright when row 0 is the lowest one
#[api("simIM.text")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn text(
    cx: &Cx,
    handle: String,
    str: String,
    pos: Ints<2>,
    #[default(SIMPLEX, "simIM.fontFace.simplex")] font_face: Number,
    #[default(false)] italic: bool,
    #[default(1.0)] font_scale: f64,
    #[default(WHITE)] color: Ints<3>,
    #[default(1)] thickness: Number,
    #[default(EIGHT_CONNECTED)] r#type: Number,
    #[default(false)] bottom_left_origin: bool,
) -> Result<()> {
    let (pen, face) = (pen(color, r#type)?, self::font_face(font_face.0)?);
    let text = Text {
        text: &str,
        face,
        scale: font_scale,
        thickness: thickness_of(thickness)?,
        is_italic: italic,
        is_from_bottom: bottom_left_origin,
    };
    Ok(draw(cx, &handle, |image| {
        image.draw_text(pos.floats(), &text, &pen)
    })??)
}

/// The size of a text.
///
/// @param str the text
/// @param fontFace simIM.fontFace.*
/// @param italic leans to the right
/// @param fontScale 1: capitals of simplex have 21 pixels
/// @param thickness pixels
/// @return width
/// @return height above the baseline
/// @return baseline what is below it
#[api("simIM.textSize")]
fn text_size(
    _cx: &Cx,
    str: String,
    #[default(SIMPLEX, "simIM.fontFace.simplex")] font_face: Number,
    #[default(false)] italic: bool,
    #[default(1.0)] font_scale: f64,
    #[default(1)] thickness: Number,
) -> Result<(i64, i64, i64)> {
    let _ = italic;
    let size = measure(
        &str,
        self::font_face(font_face.0)?,
        font_scale,
        thickness_of(thickness)?,
    )?;
    Ok((size.width, size.height, size.baseline))
}

/// The part of a line that is inside of an image.
///
/// @param handle the image
/// @param p1 first place
/// @param p2 last place
/// @return valid there is such a part
/// @return p1 where it begins
/// @return p2 where it ends
#[api("simIM.clipLine")]
fn clip_line(
    cx: &Cx,
    handle: String,
    p1: Ints<2>,
    p2: Ints<2>,
) -> Result<(bool, IntPair, IntPair)> {
    let image = images(cx).get(&handle)?;
    let whole = |place: PixelPosition| IntPair(place.map(|at| at.round() as i64));
    Ok(match clip(image.size(), p1.floats(), p2.floats()) {
        Some([from, to]) => (true, whole(from), whole(to)),
        None => (false, IntPair(p1.0), IntPair(p2.0)),
    })
}
