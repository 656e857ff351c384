//! Surfaces of points in scale space (J. Digne, J.-M. Morel, C. Lartigue, C. Mehdi-Souzani: Scale Space Meshing of Raw Data Point Sets, 2011): points are
//! moved onto the planes of their neighbours some times, the smooth points are meshed, and the triangles are those of the points as they were.

mod normals;
mod pivoting;

use std::collections::HashSet;

use nalgebra::{Point3, Vector3};

use crate::decimate::Triangles;
use crate::kd_tree::KdTree;
use normals::{oriented_normals, principal_plane};
use pivoting::Pivoting;

/// Points are looked at once in each cube of this part of the radius: a ball holds only so many.
const CELL: f64 = 0.125;

/// How a surface is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceOptions {
    /// How often points are moved onto the planes of their neighbours.
    pub iterations: usize,
    /// How many neighbours, at least 3.
    pub neighbors: usize,
    /// Of how many points the distance to the farthest of their neighbours is measured: its mean is the radius of the ball.
    pub samples: usize,
    /// The square of another radius of the ball that rolls over the points.
    pub squared_radius: Option<f64>,
}

impl Default for SurfaceOptions {
    fn default() -> Self {
        Self {
            iterations: 4,
            neighbors: 12,
            samples: 300,
            squared_radius: None,
        }
    }
}

/// The surface of points, with borders where the gaps between them are larger than the ball. Its vertices are points, in their order; points that are no
/// part of it are left out. It looks up at its highest point. Empty where there is none. Points must be finite.
pub fn surface(points: &[[f64; 3]], options: SurfaceOptions) -> Triangles {
    let tree = KdTree::new(points);
    let radius = options
        .squared_radius
        .map_or_else(|| mean_radius(points, &tree, options), f64::sqrt);
    if !(radius > 0.0 && radius.is_finite()) {
        return (Vec::new(), Vec::new());
    }
    let mut smooth = points.to_vec();
    for _ in 0..options.iterations {
        smooth = moved_onto_planes(&smooth, options.neighbors);
    }
    let kept = thinned(&smooth, CELL * radius);
    let smooth: Vec<[f64; 3]> = kept.iter().map(|number| smooth[*number]).collect();
    let normals = oriented_normals(&smooth, options.neighbors);
    let triangles = Pivoting::new(&smooth, &normals, radius).triangles();
    used(
        kept.iter().map(|number| points[*number]).collect(),
        triangles,
    )
}

/// The mean distance of the farthest of the nearest neighbours, of some points.
fn mean_radius(points: &[[f64; 3]], tree: &KdTree, options: SurfaceOptions) -> f64 {
    let stride = points.len().div_ceil(options.samples.max(1)).max(1);
    let farthest = points.iter().step_by(stride).filter_map(|point| {
        // The point itself is its own nearest neighbour.
        tree.k_nearest(*point, options.neighbors + 1)
            .last()
            .map(|far| far.distance_squared.sqrt())
    });
    let (sum, count) = farthest.fold((0.0, 0), |(sum, count), distance| {
        (sum + distance, count + 1)
    });
    sum / f64::from(count.max(1))
}

fn moved_onto_planes(points: &[[f64; 3]], neighbors: usize) -> Vec<[f64; 3]> {
    let tree = KdTree::new(points);
    let moved = |point: &[f64; 3]| {
        let near = tree.k_nearest(*point, neighbors + 1);
        let near: Vec<Vector3<f64>> = near
            .iter()
            .map(|found| Vector3::from(points[numbers::place(found.number)]))
            .collect();
        let (centre, normal) = principal_plane(&near);
        let point = Vector3::from(*point);
        (point - normal * normal.dot(&(point - centre))).into()
    };
    points.iter().map(moved).collect()
}

/// The numbers of points of which no other is in the same cube.
fn thinned(points: &[[f64; 3]], cell: f64) -> Vec<usize> {
    let mut seen = HashSet::new();
    let cube = |point: &[f64; 3]| point.map(|x| numbers::truncated((x / cell).floor()));
    (0..points.len())
        .filter(|number| seen.insert(cube(&points[*number])))
        .collect()
}

/// Only the vertices that triangles use.
fn used(points: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Triangles {
    let mut numbers = vec![None; points.len()];
    triangles
        .as_flattened()
        .iter()
        .for_each(|vertex| numbers[numbers::place(*vertex)] = Some(0));
    let mut vertices = Vec::new();
    for (number, point) in numbers
        .iter_mut()
        .zip(&points)
        .filter(|(number, _)| number.is_some())
    {
        *number = Some(numbers::count_u32(vertices.len()));
        vertices.push(*point);
    }
    let renumbered = triangles
        .iter()
        .map(|triangle| triangle.map(|vertex| numbers[numbers::place(vertex)].unwrap_or(0)));
    (vertices, renumbered.collect())
}

fn point(coordinates: &[f64; 3]) -> Point3<f64> {
    Point3::from(*coordinates)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points spread evenly over a ball of radius 1 (Fibonacci's spiral), moved by up to `noise`.
    fn ball(count: u32, noise: f64) -> Vec<[f64; 3]> {
        let at = |i: u32| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
            let (angle, ring) = (2.399_963_229_728_653 * f64::from(i), (1.0 - z * z).sqrt());
            let radius = 1.0 + noise * (12.9898 * f64::from(i)).sin();
            [
                radius * ring * angle.cos(),
                radius * ring * angle.sin(),
                radius * z,
            ]
        };
        (0..count).map(at).collect()
    }

    fn volume((vertices, triangles): &Triangles) -> f64 {
        let corner = |i: u32| Vector3::from(vertices[i as usize]);
        triangles
            .iter()
            .map(|t| corner(t[0]).dot(&corner(t[1]).cross(&corner(t[2]))) / 6.0)
            .sum()
    }

    fn open_edges(triangles: &[[u32; 3]]) -> usize {
        let directed = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
        let edges: HashSet<(u32, u32)> = triangles.iter().flat_map(directed).collect();
        assert_eq!(
            edges.len(),
            3 * triangles.len(),
            "an edge has two triangles at most"
        );
        edges
            .iter()
            .filter(|(a, b)| !edges.contains(&(*b, *a)))
            .count()
    }

    #[test]
    fn a_ball_is_closed_and_looks_outwards() {
        let found = surface(
            &ball(2000, 0.0),
            SurfaceOptions {
                iterations: 0,
                ..SurfaceOptions::default()
            },
        );
        assert_eq!((found.0.len(), open_edges(&found.1)), (2000, 0));
        assert_eq!(
            found.0.len() + found.1.len(),
            3 * found.1.len() / 2 + 2,
            "one piece without holes (Euler)"
        );
        let ratio = volume(&found) / (4.0 / 3.0 * std::f64::consts::PI);
        assert!((0.99..1.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn noise_is_no_obstacle() {
        let found = surface(&ball(4000, 0.01), SurfaceOptions::default());
        assert!(found.0.len() > 3900, "{}", found.0.len());
        assert!(open_edges(&found.1) < 60, "{}", open_edges(&found.1));
        let ratio = volume(&found) / (4.0 / 3.0 * std::f64::consts::PI);
        assert!((0.97..1.02).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_sheet_has_its_border_and_looks_up() {
        let points: Vec<[f64; 3]> = (0..400)
            .map(|i| {
                [
                    f64::from(i % 20) * 0.1,
                    f64::from(i / 20) * 0.1,
                    0.05 * f64::from(i % 20).sin(),
                ]
            })
            .collect();
        let (vertices, triangles) = surface(
            &points,
            SurfaceOptions {
                iterations: 0,
                ..SurfaceOptions::default()
            },
        );
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| Vector3::from(vertices[i as usize]));
            ((b - a).cross(&(c - a)) / 2.0).z
        };
        let total: f64 = triangles.iter().map(area).sum();
        assert!((total - 1.9 * 1.9).abs() < 0.05, "{total}");
    }

    #[test]
    fn few_or_equal_points_have_no_surface() {
        for points in [
            vec![],
            vec![[0.0; 3]; 50],
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
        ] {
            assert!(surface(&points, SurfaceOptions::default()).1.is_empty());
        }
        let options = SurfaceOptions {
            squared_radius: Some(100.0),
            ..SurfaceOptions::default()
        };
        assert!(surface(&[[1.0; 3]; 9], options).1.is_empty());
    }
}
