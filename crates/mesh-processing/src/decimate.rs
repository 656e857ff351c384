//! Decimation: edges are collapsed, the cheapest first, by the quadric error metric (M. Garland, P. S. Heckbert: Surface Simplification Using
//! Quadric Error Metrics, 1997).

mod collapse;
mod quadric;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use collapse::Surface;

/// Vertices, and the indices of the corners of triangles.
pub type Triangles = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// When to stop collapsing edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// At most so many triangles remain, if the shape allows it.
    pub triangles: usize,
    /// At most so many vertices remain, if the shape allows it.
    pub vertices: usize,
    /// No vertex moves farther than about this from the planes of the triangles it stands for.
    pub largest_error: f64,
}

impl Default for Target {
    /// Nothing is collapsed.
    fn default() -> Self {
        Self {
            triangles: usize::MAX,
            vertices: usize::MAX,
            largest_error: f64::INFINITY,
        }
    }
}

/// An edge that may be collapsed, as both of its vertices were then.
struct Candidate {
    cost: f64,
    edge: [u32; 2],
    versions: [u32; 2],
    place: Vector3<f64>,
}

impl Ord for Candidate {
    /// The cheapest is the greatest; among equals the one with the smallest numbers.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .cost
            .total_cmp(&self.cost)
            .then(other.edge.cmp(&self.edge))
            .then(other.versions.cmp(&self.versions))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// A mesh with fewer triangles. Its topology stays: holes are not closed, parts do not vanish, edges of more than two triangles remain, and so do
/// borders, nearly. Vertices must be finite and shared by the triangles that meet there; indices must be in range.
///
/// Returns the vertices that are used, and the triangles.
pub fn decimate(vertices: &[[f64; 3]], triangles: &[[u32; 3]], target: Target) -> Triangles {
    let mut surface = Surface::new(vertices, triangles);
    let mut heap: BinaryHeap<Candidate> = surface
        .edges()
        .into_iter()
        .filter_map(|edge| candidate(&surface, edge, target))
        .collect();
    while surface.triangle_count() > target.triangles || surface.vertex_count() > target.vertices {
        let Some(next) = heap.pop() else { break };
        if next.edge.map(|vertex| surface.version(vertex)) != next.versions.map(Some)
            || !surface.allows(next.edge, &next.place)
        {
            continue;
        }
        surface.collapse(next.edge, next.place);
        let [kept, _] = next.edge;
        let around = surface.distinct_neighbours(kept);
        heap.extend(
            around.into_iter().filter_map(|other| {
                candidate(&surface, [kept.min(other), kept.max(other)], target)
            }),
        );
    }
    surface.into_triangles()
}

fn candidate(surface: &Surface, edge: [u32; 2], target: Target) -> Option<Candidate> {
    let (place, cost) = surface.best_place(edge);
    let versions = [surface.version(edge[0])?, surface.version(edge[1])?];
    (cost.sqrt() <= target.largest_error).then_some(Candidate {
        cost,
        edge,
        versions,
        place,
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A plane of `n` by `n` squares, waved by `height`.
    fn sheet(n: u32, height: f64) -> Triangles {
        let at = |i: u32, j: u32| {
            let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            [x, y, height * (7.0 * x).sin() * (5.0 * y).cos()]
        };
        let vertices = (0..=n)
            .flat_map(|j| (0..=n).map(move |i| at(i, j)))
            .collect();
        let corner = |i: u32, j: u32| j * (n + 1) + i;
        let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        let triangles = squares.flat_map(|(i, j)| {
            let [a, b, c, d] = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            [[a, b, c], [a, c, d]]
        });
        (vertices, triangles.collect())
    }

    /// A sphere of radius 1 from an octahedron whose faces are divided.
    fn sphere(times: u32) -> Triangles {
        let mut vertices = vec![
            [1., 0., 0.],
            [-1., 0., 0.],
            [0., 1., 0.],
            [0., -1., 0.],
            [0., 0., 1.],
            [0., 0., -1.],
        ];
        let mut triangles = vec![
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ];
        for _ in 0..times {
            let mut middles = std::collections::HashMap::new();
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let sum =
                        Vector3::from(vertices[a as usize]) + Vector3::from(vertices[b as usize]);
                    vertices.push(sum.normalize().into());
                    vertices.len() as u32 - 1
                })
            };
            let divided = triangles.iter().flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            });
            triangles = divided.collect();
        }
        (vertices, triangles)
    }

    fn is_closed(triangles: &[[u32; 3]]) -> bool {
        let edges: BTreeSet<(u32, u32)> = triangles
            .iter()
            .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
            .collect();
        edges.len() == 3 * triangles.len() && edges.iter().all(|(a, b)| edges.contains(&(*b, *a)))
    }

    fn volume((vertices, triangles): &Triangles) -> f64 {
        let corner = |i: u32| Vector3::from(vertices[i as usize]);
        triangles
            .iter()
            .map(|t| corner(t[0]).dot(&corner(t[1]).cross(&corner(t[2]))) / 6.0)
            .sum()
    }

    #[test]
    fn a_plane_needs_two_triangles() {
        let (vertices, triangles) = sheet(20, 0.0);
        let (vertices, triangles) = decimate(
            &vertices,
            &triangles,
            Target {
                triangles: 2,
                ..Target::default()
            },
        );
        assert_eq!((vertices.len(), triangles.len()), (4, 2));
        let corners = vertices
            .iter()
            .all(|v| v[0].min(1.0 - v[0]).abs() < 1e-9 && v[1].min(1.0 - v[1]).abs() < 1e-9);
        assert!(corners, "the border stays: {vertices:?}");
    }

    #[test]
    fn a_sphere_stays_closed_and_keeps_its_volume() {
        let (vertices, triangles) = sphere(5);
        assert_eq!(triangles.len(), 8192);
        let small = decimate(
            &vertices,
            &triangles,
            Target {
                triangles: 500,
                ..Target::default()
            },
        );
        assert!(small.1.len() <= 500 && small.1.len() > 490 && is_closed(&small.1));
        let ratio = volume(&small) / volume(&(vertices.clone(), triangles.clone()));
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
        let off = small
            .0
            .iter()
            .map(|v| (Vector3::from(*v).norm() - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(off < 0.02, "{off}");
        // A tetrahedron is the least that is closed.
        let least = decimate(
            &vertices,
            &triangles,
            Target {
                vertices: 1,
                ..Target::default()
            },
        );
        assert!(least.1.len() >= 4 && is_closed(&least.1));
    }

    #[test]
    fn the_error_is_limited() {
        let (vertices, triangles) = sheet(40, 0.05);
        let target = Target {
            triangles: 1,
            largest_error: 1e-3,
            ..Target::default()
        };
        let (few, small) = decimate(&vertices, &triangles, target);
        assert!(small.len() < triangles.len() / 3, "{}", small.len());
        let wave = |v: &[f64; 3]| (v[2] - 0.05 * (7.0 * v[0]).sin() * (5.0 * v[1]).cos()).abs();
        assert!(few.iter().all(|v| wave(v) < 5e-3));
        let nothing = decimate(&vertices, &triangles, Target::default());
        assert_eq!(nothing, (vertices, triangles));
    }

    #[test]
    fn odd_meshes_are_decimated_as_far_as_they_allow() {
        // Three triangles at one edge, a degenerate one, one twice, and vertices nobody uses.
        let vertices = [
            [0., 0., 0.],
            [1., 0., 0.],
            [0., 1., 0.],
            [0., -1., 0.],
            [0., 0., 1.],
            [9., 9., 9.],
        ];
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 4], [0, 0, 1], [0, 1, 2]];
        let (vertices, triangles) = decimate(
            &vertices,
            &triangles,
            Target {
                triangles: 1,
                ..Target::default()
            },
        );
        assert!(
            triangles
                .iter()
                .flatten()
                .all(|i| (*i as usize) < vertices.len())
                && !triangles.is_empty()
        );
        assert_eq!(
            decimate(
                &[],
                &[],
                Target {
                    triangles: 0,
                    ..Target::default()
                }
            ),
            (vec![], vec![])
        );
    }
}
