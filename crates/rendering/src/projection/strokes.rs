//! Points, lines, edges and wire frames as faces on the picture: squares and parallelograms of a fixed width.

use std::ops::Range;

use nalgebra::Vector3;

use crate::coverage::band::COPLANAR;
use crate::coverage::face::{Face, Plane, SMALL, UNIT};
use crate::mesh::edges::MeshEdge;

use crate::projection::surface::{Outline, Surface};
use crate::projection::view::{ClipPlane, Transform, View};
use crate::{Edges, Lines, Mesh, Points};

/// How far behind a surface edges are still seen, in pixels.
const EDGE_DEPTH_TOLERANCE: f64 = 4.0;

/// Something at its place in view coordinates.
#[derive(Debug)]
pub struct Placed<'a, T> {
    pub content: &'a T,
    pub transform: Transform,
    /// Which owner its faces have.
    pub owner: u32,
}

/// How a stroke is drawn.
#[derive(Debug, Clone, Copy)]
struct Stroke {
    /// Pixels.
    width: f32,
    owner: u32,
    detail: u32,
    back: bool,
    /// Offset added to its closeness.
    lift: f64,
    /// The closeness on the surface it lies in.
    plane: Option<Plane>,
}

/// A colour as the detail of a face.
pub fn packed(colour: [f32; 3]) -> u32 {
    let [r, g, b] = colour.map(|part| numbers::level((part * 255.0 + 0.5).into()));
    u32::from_be_bytes([0, r, g, b])
}

/// The colour in the detail of a face.
pub fn unpacked(detail: u32) -> [f32; 3] {
    let [_, r, g, b] = detail.to_be_bytes();
    [r, g, b].map(|part| f32::from(part) / 255.0)
}

/// The colour of an element of a list: its own, or the one for all.
fn colour(colours: &[[f32; 3]], at: usize) -> [f32; 3] {
    colours
        .get(if colours.len() == 1 { 0 } else { at })
        .copied()
        .unwrap_or([1.0; 3])
}

/// Adds some of the points.
pub fn add_points(
    faces: &mut Vec<Face>,
    view: &View,
    placed: &Placed<Points>,
    range: Range<usize>,
) {
    let points = placed.content;
    let half = half_width(points.size);
    for (at, position) in points.positions[range.clone()].iter().enumerate() {
        let point = placed.transform.apply(position);
        let Some([x, y]) = view.project(&point) else {
            continue;
        };
        let closeness = Plane {
            a: 0.0,
            b: 0.0,
            c: view.closeness(point.z),
        };
        let detail = packed(colour(points.colours, range.start + at));
        let corners = [
            [x - half, y - half],
            [x + half, y - half],
            [x + half, y + half],
            [x - half, y + half],
        ];
        add_quad(
            faces,
            view,
            corners,
            (closeness, [closeness.c; 2]),
            &Stroke {
                owner: placed.owner,
                detail,
                ..Stroke::default()
            },
        );
    }
}

/// Adds some of the lines.
pub fn add_lines(faces: &mut Vec<Face>, view: &View, placed: &Placed<Lines>, range: Range<usize>) {
    let lines = placed.content;
    for (at, segment) in lines.segments[range.clone()].iter().enumerate() {
        let detail = packed(colour(lines.colours, range.start + at));
        let stroke = Stroke {
            owner: placed.owner,
            detail,
            width: lines.width,
            ..Stroke::default()
        };
        add_line(
            faces,
            view,
            segment.each_ref().map(|end| placed.transform.apply(end)),
            &stroke,
        );
    }
}

/// Adds those of some edges of a mesh that are sharp enough.
pub fn add_edges(
    faces: &mut Vec<Face>,
    view: &View,
    placed: &Placed<Mesh>,
    edges: &Edges,
    range: Range<usize>,
) {
    let detail = packed(edges.colour);
    let limit = numbers::single(libm::cos(edges.angle));
    let is_drawn = |edge: &&MeshEdge| edge.cosine <= limit && (edges.borders || !edge.is_border());
    for edge in placed.content.edges()[range].iter().filter(is_drawn) {
        let ends = edge.ends.each_ref().map(|end| placed.transform.apply(end));
        let lift =
            edge_lift(view, &placed.transform, edge, &ends) * f64::from(edges.width.max(1.0));
        let stroke = Stroke {
            owner: placed.owner,
            detail,
            width: edges.width,
            lift,
            ..Stroke::default()
        };
        add_line(faces, view, ends, &stroke);
    }
}

/// Adds the sides of a triangle.
pub fn add_wire_frame(faces: &mut Vec<Face>, view: &View, surface: &Surface, triangle: usize) {
    let corners = surface.corners(triangle);
    let [a, b, c] = corners.map(|corner| view.homogeneous(corner));
    // As of the surface, so that a frame in the plane of another surface is seen or hidden as a whole.
    let plane = Some(view.closeness_on_plane(&corners)).filter(Plane::is_finite);
    let (detail, back) = (numbers::count_u32(triangle), a.cross(&b).dot(&c) < 0.0);
    let stroke = Stroke {
        owner: surface.owner,
        detail,
        back,
        plane,
        ..Stroke::default()
    };
    for side in 0..3 {
        add_line(
            faces,
            view,
            [corners[side], corners[(side + 1) % 3]],
            &stroke,
        );
    }
}

/// How much closer than an edge its faces may be within a line of one pixel's width, from their slope.
fn edge_lift(
    view: &View,
    transform: &Transform,
    edge: &MeshEdge,
    [end, _]: &[Vector3<f64>; 2],
) -> f64 {
    let slope = |normal: &[f32; 3]| {
        let normal = view
            .in_metres(view.in_metres(transform.rotation * Vector3::from(*normal).cast::<f64>()));
        let plane = view.closeness_gradient(&normal, end);
        plane[0].abs() + plane[1].abs()
    };
    // Faces that are seen edge-on have no limit. What is hidden by more than a few pixels of depth stays hidden.
    let most = EDGE_DEPTH_TOLERANCE * view.closeness_of_pixel(end.z);
    let steepest = edge.normals.iter().flatten().map(slope).fold(0.0, f64::max);
    // Faces that are seen from the front have no slope: edges lie in their plane.
    let least = 4.0 * f64::from(COPLANAR) * view.closeness(end.z.max(view.near));
    (0.75 * steepest).min(most).max(least)
}

/// A line as two faces.
fn add_line(faces: &mut Vec<Face>, view: &View, ends: [Vector3<f64>; 2], stroke: &Stroke) {
    let Some(ends) = clipped(view, ends) else {
        return;
    };
    let [p, q] = ends.map(|end| view.project_clipped(&end));
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let main = usize::from(dx.abs() < dy.abs());
    if dx == 0 && dy == 0 {
        return;
    }
    let mut across = [half_width(stroke.width); 2];
    across[main] = 0;
    let range = ends.map(|end| view.closeness(end.z) + stroke.lift);
    let closeness = (
        stroke
            .plane
            .unwrap_or_else(|| closeness_along(view, main, [p, q], range)),
        range,
    );
    let [low, high] = [-1, 1]
        .map(|side| move |end: [i32; 2]| [end[0] + side * across[0], end[1] + side * across[1]]);
    add_quad(
        faces,
        view,
        [low(p), low(q), high(q), high(p)],
        closeness,
        stroke,
    );
}

/// The closeness of a line, which changes along one axis of the picture.
fn closeness_along(view: &View, axis: usize, [p, q]: [[i32; 2]; 2], [from, to]: [f64; 2]) -> Plane {
    let step = (to - from) / f64::from(q[axis] - p[axis]) * f64::from(UNIT);
    let start = from - step * (f64::from(p[axis]) / f64::from(UNIT) - view.centre[axis]);
    match axis {
        0 => Plane {
            a: step,
            b: 0.0,
            c: start,
        },
        _ => Plane {
            a: 0.0,
            b: step,
            c: start,
        },
    }
}

/// The part of a line between the near plane and the guard band.
fn clipped(view: &View, mut ends: [Vector3<f64>; 2]) -> Option<[Vector3<f64>; 2]> {
    for plane in ClipPlane::ALL {
        let inside = ends.map(|end| view.inside(plane, &end));
        // Nothing holds of numbers that are not finite.
        if !(inside[0] >= 0.0 || inside[1] >= 0.0) || !(inside[0] - inside[1]).is_finite() {
            return None;
        }
        for outer in (0..2).filter(|end| inside[*end] < 0.0) {
            let inner = 1 - outer;
            ends[outer] = ends[inner]
                + (ends[outer] - ends[inner]) * (inside[inner] / (inside[inner] - inside[outer]));
        }
    }
    Some(ends)
}

/// Two triangles between four corners.
fn add_quad(
    faces: &mut Vec<Face>,
    view: &View,
    [a, b, c, d]: [[i32; 2]; 4],
    (closeness, [from, to]): (Plane, [f64; 2]),
    stroke: &Stroke,
) {
    let range = [numbers::single(from.min(to)), numbers::single(from.max(to))];
    for triangle in [[a, b, c], [a, c, d]] {
        let Some(outline) = Outline::new(view, false, triangle) else {
            continue;
        };
        faces.push(Face {
            corners: outline.corners,
            bounds: outline.bounds,
            closeness,
            range,
            owner: stroke.owner,
            detail: stroke.detail,
            back: stroke.back,
            is_small: outline.extent <= SMALL,
            is_uniform: true,
        });
    }
}

/// Half of a width in pixels, in units of 1 / `UNIT` pixel; at least one pixel and at most 1024.
fn half_width(pixels: f32) -> i32 {
    numbers::truncated_i32((pixels.clamp(1.0, 1024.0) * UNIT as f32 / 2.0).into())
}

impl Default for Stroke {
    fn default() -> Self {
        Self {
            width: 1.0,
            owner: 0,
            detail: 0,
            back: false,
            lift: 0.0,
            plane: None,
        }
    }
}
