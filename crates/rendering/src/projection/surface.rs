//! From the triangles of a mesh to faces on the picture: transformed, culled, clipped.

use nalgebra::Vector3;

use crate::coverage::face::{Face, Plane, SMALL, UNIT};
use crate::mesh::{Cluster, Mesh};
use crate::projection::strokes::add_wire_frame;
use crate::projection::view::{ClipPlane, Transform, View};
use crate::three::three;

/// Drawn surface of a mesh.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    pub mesh: &'a Mesh,
    pub transform: Transform,
    /// Whether back faces are left out.
    pub culling: bool,
    /// Whether only the sides of triangles are drawn.
    pub wire_frame: bool,
    /// Which owner its faces have.
    pub owner: u32,
}

impl Surface<'_> {
    /// The corners of a triangle in view coordinates.
    pub fn corners(&self, triangle: usize) -> [Vector3<f64>; 3] {
        let vertices = &self.mesh.vertices[self.mesh.cluster_of(triangle).vertices.clone()];
        let corners = self.mesh.corners[triangle];
        three(|i| self.transform.apply(&vertices[usize::from(corners[i])]))
    }
}

/// Makes faces; its memory is used again.
#[derive(Debug, Default)]
pub struct Setup {
    pub faces: Vec<Face>,
    /// Those of a cluster.
    vertices: Vec<Vertex>,
    polygon: Vec<Vector3<f64>>,
    cut: Vec<Vector3<f64>>,
}

/// A vertex of a cluster.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    /// In view coordinates.
    point: Vector3<f64>,
    /// On the picture; `OFF_PICTURE` where it is too close or too far to the side, and must be clipped first.
    place: [i32; 2],
    closeness: f32,
}

const OFF_PICTURE: [i32; 2] = [i32::MIN; 2];

impl Vertex {
    #[inline(always)]
    fn new(view: &View, point: Vector3<f64>) -> Self {
        let place = view.project(&point);
        Self {
            point,
            place: place.unwrap_or(OFF_PICTURE),
            closeness: place.map_or(0.0, |_| numbers::single(view.closeness(point.z))),
        }
    }

    fn is_off_picture(&self) -> bool {
        self.place[0] == OFF_PICTURE[0]
    }
}

/// Values common to the faces of one triangle.
struct Origin<'a> {
    view: &'a View,
    surface: &'a Surface<'a>,
    points: [Vector3<f64>; 3],
    /// The least and the largest closeness of the points.
    range: [f32; 2],
    detail: u32,
}

impl Setup {
    /// Adds the faces of a cluster.
    pub fn add_cluster(&mut self, view: &View, surface: &Surface, cluster: &Cluster) {
        let ball = &cluster.ball;
        if !view.may_see(surface.transform.apply(&ball.centre), ball.radius) {
            return;
        }
        if surface.wire_frame {
            return cluster
                .triangles
                .clone()
                .for_each(|at| add_wire_frame(&mut self.faces, view, surface, at));
        }
        let vertices = &surface.mesh.vertices[cluster.vertices.clone()];
        let placed = vertices
            .iter()
            .map(|vertex| Vertex::new(view, surface.transform.apply(vertex)));
        self.vertices.clear();
        self.vertices.extend(placed);
        let corners = &surface.mesh.corners[cluster.triangles.clone()];
        for (at, corners) in cluster.triangles.clone().zip(corners) {
            let corners = three(|i| &self.vertices[usize::from(corners[i])]);
            if corners.iter().any(|corner| corner.is_off_picture()) {
                let points = three(|i| corners[i].point);
                self.add_clipped(&Origin::clipped(view, surface, points, at));
            } else if let Some(outline) =
                Outline::new(view, surface.culling, three(|i| corners[i].place))
            {
                let face = Origin::new(view, surface, corners, at).face(outline);
                self.faces.push(face);
            }
        }
    }

    /// Cuts a triangle by the near plane and by the guard band.
    fn add_clipped(&mut self, origin: &Origin) {
        if !origin
            .points
            .iter()
            .all(|point| point.iter().all(|number| number.is_finite()))
        {
            return;
        }
        self.polygon.clear();
        self.polygon.extend(origin.points);
        for plane in ClipPlane::ALL {
            cut(&self.polygon, &mut self.cut, |point| {
                origin.view.inside(plane, point)
            });
            std::mem::swap(&mut self.polygon, &mut self.cut);
        }
        let [first, rest @ ..] = self.polygon.as_slice() else {
            return;
        };
        let first = origin.view.project_clipped(first);
        for pair in rest.windows(2) {
            let [b, c] = [&pair[0], &pair[1]].map(|point| origin.view.project_clipped(point));
            let outline = Outline::new(origin.view, origin.surface.culling, [first, b, c]);
            self.faces
                .extend(outline.map(|outline| origin.face(outline)));
        }
    }
}

/// The part of a polygon where `inside` is not negative (I. Sutherland and G. Hodgman, *Reentrant polygon clipping*, 1974).
fn cut(
    polygon: &[Vector3<f64>],
    part: &mut Vec<Vector3<f64>>,
    inside: impl Fn(&Vector3<f64>) -> f64,
) {
    part.clear();
    let Some(mut previous) = polygon.last() else {
        return;
    };
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

/// Area covered by a triangle.
pub struct Outline {
    /// Counter-clockwise.
    pub corners: [[i32; 2]; 3],
    pub bounds: [[u16; 2]; 2],
    /// The longer side of the bounding box.
    pub extent: i32,
    doubled_area: i64,
    back: bool,
}

impl Outline {
    /// None where it covers no pixel or is culled.
    #[inline(always)]
    pub fn new(view: &View, culling: bool, [a, b, c]: [[i32; 2]; 3]) -> Option<Self> {
        let area = doubled_area(a, b, c);
        if area == 0 || (area < 0 && culling) {
            return None;
        }
        let low = [0, 1].map(|axis| a[axis].min(b[axis]).min(c[axis]));
        let high = [0, 1].map(|axis| a[axis].max(b[axis]).max(c[axis]));
        let bounds = view.pixels(low, high)?;
        let back = area < 0;
        let corners = if back { [a, c, b] } else { [a, b, c] };
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        Some(Self {
            corners,
            bounds,
            extent,
            doubled_area: area.abs(),
            back,
        })
    }

    /// Whether it is thinner than 1/8 pixel: the rounding of its corners is no longer small then.
    fn is_thin(&self) -> bool {
        self.doubled_area < i64::from(self.extent) * i64::from(UNIT / 8)
    }

    fn is_one_pixel(&self) -> bool {
        self.bounds[0][0] == self.bounds[0][1] && self.bounds[1][0] == self.bounds[1][1]
    }
}

impl<'a> Origin<'a> {
    #[inline(always)]
    fn new(view: &'a View, surface: &'a Surface, corners: [&Vertex; 3], at: usize) -> Self {
        let [a, b, c] = three(|i| corners[i].closeness);
        Self {
            view,
            surface,
            points: three(|i| corners[i].point),
            range: [a.min(b).min(c), a.max(b).max(c)],
            detail: numbers::count_u32(at),
        }
    }

    /// Of a triangle that may reach behind the near plane.
    fn clipped(view: &'a View, surface: &'a Surface, points: [Vector3<f64>; 3], at: usize) -> Self {
        let [a, b, c] = three(|i| points[i].z.max(view.near));
        Self {
            view,
            surface,
            points,
            range: [a.max(b).max(c), a.min(b).min(c)]
                .map(|depth| numbers::single(view.closeness(depth))),
            detail: numbers::count_u32(at),
        }
    }

    #[inline(always)]
    fn face(&self, outline: Outline) -> Face {
        Face {
            corners: outline.corners,
            bounds: outline.bounds,
            closeness: self.closeness(),
            range: self.range,
            owner: self.surface.owner,
            detail: self.detail,
            back: outline.back,
            is_small: outline.extent <= SMALL,
            is_uniform: outline.is_one_pixel() || outline.is_thin(),
        }
    }

    /// The closeness on the plane of the triangle; it is limited by that of the corners: on planes that are seen edge-on it would be
    /// exaggerated by their rounding.
    #[inline(always)]
    fn closeness(&self) -> Plane {
        let plane = self.view.closeness_on_plane(&self.points);
        let edge_on = Plane {
            a: 0.0,
            b: 0.0,
            c: f64::from(self.range[0]),
        };
        if plane.is_finite() { plane } else { edge_on }
    }
}

/// Positive where the corners are counter-clockwise.
fn doubled_area(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i64 {
    let (ab, ac) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    i64::from(ab[0]) * i64::from(ac[1]) - i64::from(ab[1]) * i64::from(ac[0])
}
