//! From the triangles of a mesh to faces on the picture: transformed, culled, clipped.

use nalgebra::Vector3;

use crate::mesh::{Cluster, Mesh};
use crate::raster::{Face, Plane};
use crate::view::{ClipPlane, Transform, View};

/// What is drawn of a mesh.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    pub mesh: &'a Mesh,
    pub transform: Transform,
    /// Whether back faces are left out.
    pub culling: bool,
    /// Which owner its faces have.
    pub owner: u32,
}

/// A vertex in view coordinates.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    point: Vector3<f64>,
    /// On the picture; None where it must be clipped first.
    on_picture: Option<[i32; 2]>,
}

/// Makes faces; its memory is used again.
#[derive(Debug, Default)]
pub struct Setup {
    pub faces: Vec<Face>,
    vertices: Vec<Vertex>,
    polygon: Vec<Vector3<f64>>,
    cut: Vec<Vector3<f64>>,
}

/// What the faces of one triangle have in common.
struct Origin<'a> {
    view: &'a View,
    surface: &'a Surface<'a>,
    points: [Vector3<f64>; 3],
    detail: u32,
}

impl Setup {
    /// Adds the faces of a cluster.
    pub fn add_cluster(&mut self, view: &View, surface: &Surface, cluster: &Cluster) {
        let ball = &cluster.ball;
        if !view.may_see(surface.transform.apply(&ball.centre), ball.radius) {
            return;
        }
        self.vertices.clear();
        self.vertices.extend(surface.mesh.vertices[cluster.vertices.clone()].iter().map(|vertex| {
            let point = surface.transform.apply(vertex);
            Vertex { point, on_picture: view.project(&point) }
        }));
        for at in cluster.triangles.clone() {
            let corners = surface.mesh.triangles[at].corners.map(|corner| self.vertices[usize::from(corner)]);
            let origin = Origin { view, surface, points: corners.map(|corner| corner.point), detail: at as u32 };
            match corners.map(|corner| corner.on_picture) {
                [Some(a), Some(b), Some(c)] => self.faces.extend(origin.face([a, b, c])),
                _ => self.add_clipped(&origin),
            }
        }
    }

    /// Cuts a triangle by the near plane and by the guard band.
    fn add_clipped(&mut self, origin: &Origin) {
        if !origin.points.iter().all(|point| point.iter().all(|number| number.is_finite())) {
            return;
        }
        self.polygon.clear();
        self.polygon.extend(origin.points);
        for plane in ClipPlane::ALL {
            cut(&self.polygon, &mut self.cut, |point| origin.view.inside(plane, point));
            std::mem::swap(&mut self.polygon, &mut self.cut);
        }
        let [first, rest @ ..] = self.polygon.as_slice() else { return };
        let first = origin.view.project_clipped(first);
        for pair in rest.windows(2) {
            let [b, c] = [&pair[0], &pair[1]].map(|point| origin.view.project_clipped(point));
            self.faces.extend(origin.face([first, b, c]));
        }
    }
}

/// The part of a polygon where `inside` is not negative (I. Sutherland and G. Hodgman, *Reentrant polygon clipping*, 1974).
fn cut(polygon: &[Vector3<f64>], part: &mut Vec<Vector3<f64>>, inside: impl Fn(&Vector3<f64>) -> f64) {
    part.clear();
    let Some(mut previous) = polygon.last() else { return };
    for point in polygon {
        match [inside(previous), inside(point)] {
            [a, b] if a >= 0.0 && b < 0.0 => part.push(between(previous, a, point, b)),
            // From the inner side, so that neighbours compute the same point of a common edge.
            [a, b] if a < 0.0 && b >= 0.0 => part.extend([between(point, b, previous, a), *point]),
            [_, b] if b >= 0.0 => part.push(*point),
            _ => (),
        }
        previous = point;
    }
}

fn between(inner: &Vector3<f64>, a: f64, outer: &Vector3<f64>, b: f64) -> Vector3<f64> {
    inner + (outer - inner) * (a / (a - b))
}

impl Origin<'_> {
    /// The face of a triangle or a part of it; None where it covers no pixel or is culled.
    fn face(&self, mut corners: [[i32; 2]; 3]) -> Option<Face> {
        let bounds = self.view.pixels(&corners)?;
        let area = doubled_area(&corners);
        if area == 0 || (area < 0 && self.surface.culling) {
            return None;
        }
        if area < 0 {
            corners.swap(1, 2);
        }
        let (closeness, range) = self.closeness();
        let (owner, detail) = (self.surface.owner, self.detail);
        Some(Face { corners, bounds, closeness, range, owner, detail, back: area < 0 })
    }

    /// The closeness on the plane of the triangle, and its limits on the triangle itself: on planes that are seen edge-on it would be
    /// exaggerated by the rounding of corners.
    fn closeness(&self) -> (Plane, [f32; 2]) {
        let depths = self.points.map(|point| point.z.max(self.view.near));
        let [least, most] =
            [depths.into_iter().fold(depths[0], f64::max), depths.into_iter().fold(depths[0], f64::min)];
        let range = [least, most].map(|depth| self.view.closeness(depth) as f32);
        let plane = self.view.closeness_on_plane(&self.points);
        let edge_on = Plane { a: 0.0, b: 0.0, c: f64::from(range[0]) };
        (if plane.is_finite() { plane } else { edge_on }, range)
    }
}

/// Positive where the corners are counter-clockwise.
fn doubled_area([a, b, c]: &[[i32; 2]; 3]) -> i64 {
    let [ab, ac] = [b, c].map(|end| [0, 1].map(|axis| i64::from(end[axis]) - i64::from(a[axis])));
    ab[0] * ac[1] - ab[1] * ac[0]
}
