//! Boxes around meshes, the tightest one included. Lengths are in metres.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::Mesh;
use crate::Pose;

/// Largest number of face normals that the search for the tightest box tries.
const MAX_DIRECTIONS: usize = 200;
/// Largest number of points that the search visits, over all directions.
const MAX_VISITED_POINTS: usize = 60_000;

/// A box around a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox {
    /// Full extents along the axes of `pose` (m).
    pub size: [f64; 3],
    /// Centre and axes, in the frame of the mesh.
    pub pose: Pose,
}

impl Mesh {
    /// The box with the given axes (relative to the mesh frame); `None` without vertices.
    pub fn bounding_box(&self, orientation: &UnitQuaternion<f64>) -> Option<BoundingBox> {
        box_around(&self.points(), orientation)
    }

    /// The tightest box found, its size in the order x <= y <= z; `None` without vertices.
    ///
    /// Tries the axes of the frame, then boxes with one side flush with a face of the convex hull and
    /// another flush with an edge of the hull of its projection along it.
    pub fn oriented_box(&self) -> Option<BoundingBox> {
        let hull = Self::convex_hull(&self.vertices);
        let source = hull.as_ref().unwrap_or(self);
        let points = source.points();
        let identity = box_around(&points, &UnitQuaternion::identity())?;
        let frames = source
            .face_directions()
            .into_iter()
            .filter_map(|d| flush_frame(&points, &d));
        let boxes =
            frames.filter_map(|f| box_around(&points, &UnitQuaternion::from_rotation_matrix(&f)));
        let tightest = boxes.fold(
            identity,
            |best, b| if tighter(&b, &best) { b } else { best },
        );
        let ordered = sorted_axes(&tightest);
        self.bounding_box(&ordered)
    }

    /// Distinct face normals, those of large faces first.
    fn face_directions(&self) -> Vec<Vector3<f64>> {
        let mut areas: Vec<_> = self.triangles.iter().map(|t| self.area_vector(t)).collect();
        areas.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
        let most = (MAX_VISITED_POINTS / self.vertices.len().max(1)).clamp(10, MAX_DIRECTIONS);
        let mut found: Vec<Vector3<f64>> = Vec::new();
        for direction in areas.iter().filter_map(|a| a.try_normalize(0.0)) {
            if found.len() < most && found.iter().all(|f| f.dot(&direction).abs() < 1.0 - 1e-9) {
                found.push(direction);
            }
        }
        found
    }
}

fn box_around(points: &[Vector3<f64>], orientation: &UnitQuaternion<f64>) -> Option<BoundingBox> {
    let back = orientation.inverse().to_rotation_matrix();
    let turned = points.iter().map(|p| back * p);
    let (low, high) = turned.fold(None, |range: Option<(Vector3<f64>, Vector3<f64>)>, p| {
        Some(range.map_or((p, p), |(low, high)| (low.inf(&p), high.sup(&p))))
    })?;
    let centre = orientation * (low + (high - low) * 0.5);
    Some(BoundingBox {
        size: (high - low).into(),
        pose: Pose::from_parts(centre.into(), *orientation),
    })
}

/// Smaller volume by more than rounding; of solid boxes with the same volume the thinner one, of flat ones that with the smaller surface.
fn tighter(a: &BoundingBox, b: &BoundingBox) -> bool {
    let volume = |s: &[f64; 3]| s[0] * s[1] * s[2];
    let surface = |s: &[f64; 3]| s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
    let thickness = |s: &[f64; 3]| s[0].min(s[1]).min(s[2]);
    let largest = b.size.iter().fold(0.0_f64, |m, s| m.max(*s));
    let rounding = 1e-9 * largest.powi(3);
    let gain = volume(&b.size) - volume(&a.size);
    if gain.abs() > rounding {
        return gain > 0.0;
    }
    let measure = |s: &[f64; 3]| {
        if volume(&b.size) > rounding {
            thickness(s)
        } else {
            surface(s)
        }
    };
    measure(&a.size) < measure(&b.size) * (1.0 - 1e-9)
}

/// The orientation of a box with its axes reordered to size x <= y <= z.
fn sorted_axes(b: &BoundingBox) -> UnitQuaternion<f64> {
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| b.size[*i].total_cmp(&b.size[*j]));
    if order == [0, 1, 2] {
        return b.pose.rotation;
    }
    let axes = b.pose.rotation.to_rotation_matrix();
    let (x, y) = (
        axes.matrix().column(order[0]).into_owned(),
        axes.matrix().column(order[1]).into_owned(),
    );
    let sorted = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(sorted))
}

/// Axes of the tightest box with one axis along `direction`.
fn flush_frame(points: &[Vector3<f64>], direction: &Vector3<f64>) -> Option<Rotation3<f64>> {
    let u = direction
        .cross(&Vector3::ith(direction.iamin(), 1.0))
        .try_normalize(0.0)?;
    let v = direction.cross(&u);
    let hull = planar_hull(points.iter().map(|p| [p.dot(&u), p.dot(&v)]).collect());
    let area = |s: &[f64; 2]| {
        let extent = |x: f64, y: f64| {
            let along = hull.iter().map(|p| p[0] * x + p[1] * y);
            let (low, high) = along.fold((f64::MAX, f64::MIN), |(l, h), d| (l.min(d), h.max(d)));
            high - low
        };
        extent(s[0], s[1]) * extent(-s[1], s[0])
    };
    let side = |(a, b): (&[f64; 2], &[f64; 2])| {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = libm::hypot(x, y);
        (length > 0.0).then(|| [x / length, y / length])
    };
    let sides = hull
        .iter()
        .zip(hull.iter().cycle().skip(1))
        .filter_map(side);
    let best = sides
        .map(|s| (area(&s), s))
        .min_by(|a, b| a.0.total_cmp(&b.0))?
        .1;
    let x = u * best[0] + v * best[1];
    Some(Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[
        x,
        direction.cross(&x),
        *direction,
    ])))
}

/// Convex hull of points in a plane, counter-clockwise (A. M. Andrew's monotone chain).
fn planar_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    leave_out_inner(&mut points);
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && turn(&a, &b, &p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

/// Leaves out points inside of the octagon of the outermost ones (S. G. Akl, G. T. Toussaint 1978).
fn leave_out_inner(points: &mut Vec<[f64; 2]>) {
    let Some(first) = points.first() else { return };
    let along = |[x, y]: &[f64; 2]| [*x, x + y, *y, y - x];
    // The outermost points along four directions, and against them: a way around.
    let mut corners = [*first; 8];
    let (mut high, mut low) = (along(first), along(first));
    for point in points.iter() {
        for (k, x) in along(point).into_iter().enumerate() {
            if x > high[k] {
                (high[k], corners[k]) = (x, *point);
            } else if x < low[k] {
                (low[k], corners[k + 4]) = (x, *point);
            }
        }
    }
    let margin = 1e-12
        * high
            .iter()
            .chain(&low)
            .fold(0.0_f64, |size, x| size.max(x.abs()))
            .powi(2);
    let sides = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| (corners[k], corners[(k + 1) % 8]));
    let is_inner = |p: &[f64; 2]| {
        sides.iter().all(|(a, b)| {
            a == b || (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > margin
        })
    };
    points.retain(|p| !is_inner(p));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{block, close};

    #[test]
    fn tightest_box_is_ordered_and_found_when_rotated() {
        let frame = Pose::new(Vector3::new(2., 1.5, 3.), Vector3::new(0.3, -0.7, 1.1));
        let mut mesh = block([2., 1., 4.]);
        close(&mesh.oriented_box().expect("not empty").size, &[1., 2., 4.]);
        mesh.transform(&frame);
        let found = mesh.oriented_box().expect("not empty");
        close(&found.size, &[1., 2., 4.]);
        close(
            &<[f64; 3]>::from(found.pose.translation.vector),
            &[2., 1.5, 3.],
        );
        close(
            &mesh.bounding_box(&frame.rotation).expect("not empty").size,
            &[2., 1., 4.],
        );
    }

    #[test]
    fn flat_and_empty_meshes_have_boxes_too() {
        let corners = vec![[0., 0., 0.], [3., 0., 0.], [3., 1., 0.], [0., 1., 0.]];
        let mut flat = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("valid");
        flat.transform(&Pose::new(Vector3::zeros(), Vector3::new(1., 2., 3.)));
        close(&flat.oriented_box().expect("not empty").size, &[0., 1., 3.]);
        let point = Mesh::new(vec![[1., 2., 3.]], vec![[0, 0, 0]]).expect("valid");
        close(&point.oriented_box().expect("not empty").size, &[0.; 3]);
        assert_eq!(Mesh::default().oriented_box(), None);
    }
}
