//! Convex hulls of points, by parry, checked. Lengths are in metres.

use nalgebra::Vector3;
use parry3d_f64::{math::Vector, transformation::try_convex_hull};

use super::Mesh;
use super::enclosure::Enclosure;
use super::fast_hash::{FastMap, FastSet};

/// Points whose thickness is less than this fraction of their length count as flat.
const MIN_RELATIVE_THICKNESS: f64 = 1e-7;

/// Of more points than this, those inside of the hull of a sample are left out first.
const MAX_POINTS_WITHOUT_SAMPLE: usize = 5000;
const SAMPLE: usize = 2000;

impl Mesh {
    /// Convex hull of points; `None` for fewer than 4 points, points in a plane or not finite ones.
    ///
    /// parry's hull sometimes cuts off points that crowd near a plane, so its answer is checked and asked for
    /// again with points merged more and more coarsely, up to 0.1 % of the size of the cloud.
    pub fn convex_hull(points: &[[f64; 3]]) -> Option<Mesh> {
        if !points.as_flattened().iter().all(|c| c.is_finite()) {
            return None;
        }
        let (cloud, numbers) = outer(spread(points)?, (0..points.len()).collect());
        let hulls = [0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3]
            .into_iter()
            .filter_map(|grid| {
                let (source, hull) = hull_of_cloud(&cloud, grid)?;
                let vertices = source.iter().map(|i| points[numbers[*i]]).collect();
                let mesh = Mesh::new(vertices, hull.triangles.clone()).ok()?;
                (hull.encloses(&cloud, 1e-9 + 4.0 * grid) && mesh.volume() > 0.0).then_some(mesh)
            });
        hulls.into_iter().next()
    }

    /// The hull of points with its faces moved outwards by `growth` (m), when that is positive.
    pub fn grown_hull(points: &[[f64; 3]], growth: f64) -> Option<Mesh> {
        let hull = Self::convex_hull(points)?;
        if growth <= 0.0 {
            return Some(hull);
        }
        let moved = |triangle: &[u32; 3]| {
            let shift = hull
                .area_vector(triangle)
                .try_normalize(0.0)
                .unwrap_or_default()
                * growth;
            hull.corners(triangle)
                .into_iter()
                .flat_map(move |corner| [corner + shift, corner - shift].map(<[f64; 3]>::from))
        };
        Self::convex_hull(&hull.triangles.iter().flat_map(moved).collect::<Vec<_>>())
    }

    /// Whether the mesh is closed and has the points inside, to within `tolerance` (m).
    fn encloses(&self, points: &[[f64; 3]], tolerance: f64) -> bool {
        let Some(mut enclosure) = Enclosure::new(self) else {
            return false;
        };
        points
            .iter()
            .all(|point| enclosure.outside(point) <= tolerance)
    }
}

/// Of many points, those that are not clearly inside of the hull of a few of them.
fn outer(cloud: Vec<[f64; 3]>, numbers: Vec<usize>) -> (Vec<[f64; 3]>, Vec<usize>) {
    if cloud.len() <= MAX_POINTS_WITHOUT_SAMPLE {
        return (cloud, numbers);
    }
    let stride = cloud.len().div_ceil(SAMPLE);
    let sample: Vec<[f64; 3]> = cloud.iter().step_by(stride).copied().collect();
    let Some(mut enclosure) =
        hull_of_cloud(&sample, 0.0).and_then(|(_, hull)| Enclosure::new(&hull))
    else {
        return (cloud, numbers);
    };
    let both = cloud.into_iter().zip(numbers);
    both.filter(|(point, _)| enclosure.outside(point) > -1e-9)
        .unzip()
}

/// The points in skewed axes in which the cloud is about as wide in all directions, which leaves hulls as
/// they are; `None` when they do not span space.
fn spread(points: &[[f64; 3]]) -> Option<Vec<[f64; 3]>> {
    let offset = |p: &[f64; 3]| Vector3::from(*p) - Vector3::from(points[0]);
    let farthest = |part: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        let parts = points.iter().map(|p| part(offset(p)));
        let widest = parts.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        Some((widest.try_normalize(0.0)?, widest.norm()))
    };
    let (x, length) = farthest(&|d| d)?;
    let (y, width) = farthest(&|d| d - x * x.dot(&d))?;
    let z = x.cross(&y);
    let thickness = points
        .iter()
        .map(|p| z.dot(&offset(p)).abs())
        .fold(0.0, f64::max);
    let spatial = length.is_finite() && width.min(thickness) > MIN_RELATIVE_THICKNESS * length;
    let scaled = |d: Vector3<f64>| [x.dot(&d) / length, y.dot(&d) / width, z.dot(&d) / thickness];
    spatial.then(|| points.iter().map(|p| scaled(offset(p))).collect())
}

/// Hull of the points of a cloud that differ on a grid, and which points its vertices are.
fn hull_of_cloud(cloud: &[[f64; 3]], grid: f64) -> Option<(Vec<usize>, Mesh)> {
    let mut seen = FastSet::default();
    let cells = cloud
        .iter()
        .map(|p| p.map(|c| (c / grid.max(1e-9)).round() as i64))
        .enumerate();
    let kept: Vec<usize> = cells
        .filter(|(_, cell)| seen.insert(*cell))
        .map(|(i, _)| i)
        .collect();
    let distinct: Vec<Vector> = kept.iter().map(|i| shaken(cloud[*i], grid)).collect();
    let (vertices, triangles) = try_convex_hull(&distinct).ok()?;
    let key = |v: &Vector| v.to_array().map(f64::to_bits);
    let index: FastMap<_, _> = distinct.iter().map(key).zip(kept).collect();
    let source = vertices
        .iter()
        .map(|v| index.get(&key(v)).copied())
        .collect::<Option<_>>()?;
    let mesh = Mesh::new(vertices.iter().map(Vector::to_array).collect(), triangles).ok()?;
    Some((source, mesh))
}

/// A point moved by up to `size`, always in the same way, so that few points share a plane.
fn shaken(p: [f64; 3], size: f64) -> Vector {
    let phase = 1e3 * (1.3 * p[0] + 1.7 * p[1] + 2.3 * p[2]);
    Vector::from_array([0, 1, 2].map(|i| p[i] + size * libm::sin(phase * (1.0 + i as f64))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::CORNER;

    #[test]
    fn hulls_need_volume() {
        let hull = Mesh::convex_hull(&[&CORNER[..], &[[0.1, 0.1, 0.1], [1., 0., 0.]]].concat())
            .expect("spans space");
        assert_eq!((hull.vertices.len(), hull.triangles.len()), (4, 4));
        let bad = [[f64::NAN, 0., 0.], [f64::INFINITY, 0., 0.], [0.5, 0.5, 0.0]];
        for fourth in bad {
            assert_eq!(
                Mesh::convex_hull(&[CORNER[0], CORNER[1], CORNER[2], fourth]),
                None
            );
        }
        assert_eq!(Mesh::convex_hull(&[]), None);
    }

    #[test]
    fn a_grown_cube_is_larger_by_its_growth() {
        let corners: Vec<_> = (0..8)
            .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
            .collect();
        let grown = Mesh::grown_hull(&corners, 0.5).expect("a cube");
        assert_eq!(grown.aabb(), Some(([-0.5; 3], [1.5; 3])));
        // The faces are moved, the edges are cut off: 1 + 6 / 2 + 12 / 8 + 8 / 48.
        assert!(
            (grown.volume() - (1.0 + 3.0 + 1.5 + 1.0 / 6.0)).abs() < 1e-6,
            "{}",
            grown.volume()
        );
        assert_eq!(
            Mesh::grown_hull(&corners, -1.0).map(|hull| hull.vertices.len()),
            Some(8)
        );
    }
}
