//! How a cloth resists bending: as a thin plate.
//!
//! The curvature of a triangle is that of its slopes at the edges, which are the means of its own slope and that of the neighbour there: the rotation-free element
//! of E. Onate and F. Zarate (*Rotation-free triangular plate and shell elements*, 2000). Jumps of the slope are linear in the places, as in M. Bergou, M. Wardetzky,
//! D. Harmon, D. Zorin and E. Grinspun, *A quadratic bending model for inextensible surfaces* (2006), so that the energy is quadratic, and its stiffness constant.
//! A curvature at rest is kept along the normals at the beginning of the step.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::sparse::Sparse;
use crate::V3;

/// The bending stiffness of a cloth.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bending {
    hinges: Vec<Hinge>,
    plates: Vec<Plate>,
    /// The stiffness between nodes, the same for all directions, N/m.
    pub matrix: Sparse,
    /// The jumps at rest, as the triangles are turned, and the forces that come of them.
    targets: Vec<V3>,
    at_rest: Vec<V3>,
}

/// An edge between two triangles.
#[derive(Debug, Clone)]
struct Hinge {
    /// Start and end of the edge, and the corners opposite to it.
    nodes: [usize; 4],
    triangles: [usize; 2],
    /// The jump of the slope across the edge times its length is the sum of these times the places.
    weights: [f64; 4],
    /// Along the normal, metres.
    rest: f64,
}

/// A triangle.
#[derive(Debug, Clone)]
struct Plate {
    /// At its edges; None where there is no neighbour.
    hinges: [Option<usize>; 3],
    /// Energy by the jumps of two hinges.
    stiffness: Matrix3<f64>,
}

impl Bending {
    /// Of triangles that are at rest where `places` say. `is_flat`: in planes at rest. `bend`: moment per curvature of a unit of width, N m. None where a triangle has
    /// no area.
    pub(crate) fn new(
        triangles: &[[usize; 3]],
        places: &[V3],
        is_flat: bool,
        bend: f64,
        poisson: f64,
    ) -> Option<Self> {
        let (hinges, of_triangles) = hinges(triangles, places, is_flat)?;
        let plate = |(nodes, hinges): (&[usize; 3], [Option<usize>; 3])| {
            let corners = nodes.map(|node| places[node]);
            Plate {
                hinges,
                stiffness: plate_stiffness(corners, poisson) * bend,
            }
        };
        let mut bending = Self {
            hinges,
            plates: triangles.iter().zip(of_triangles).map(plate).collect(),
            ..Self::default()
        };
        bending.find_matrix(places.len());
        Some(bending)
    }

    fn find_matrix(&mut self, nodes: usize) {
        let mut entries = BTreeMap::new();
        for plate in &self.plates {
            for (first, second, stiffness) in plate.pairs() {
                let [first, second] = [first, second].map(|hinge| &self.hinges[hinge]);
                for (node, weight) in first.nodes.iter().zip(first.weights) {
                    for (other, other_weight) in second.nodes.iter().zip(second.weights) {
                        let value = stiffness * weight * other_weight;
                        *entries.entry([*node, *other]).or_insert(0.0) += value;
                    }
                }
            }
        }
        self.matrix = Sparse::new(nodes, entries);
    }

    /// A triangle is gone.
    pub(crate) fn remove(&mut self, triangle: usize) {
        let hinges = &self.hinges;
        let is_gone = |hinge: usize| hinges[hinge].triangles.contains(&triangle);
        for plate in &mut self.plates {
            for hinge in &mut plate.hinges {
                *hinge = hinge.filter(|hinge| !is_gone(*hinge));
            }
        }
        self.find_matrix(self.matrix.len());
    }

    /// Begins a step at these places.
    pub(crate) fn begin(&mut self, places: &[V3]) {
        if self.hinges.iter().all(|hinge| hinge.rest == 0.0) {
            return;
        }
        self.targets = self
            .hinges
            .iter()
            .map(|hinge| hinge.target(places))
            .collect();
        self.at_rest = vec![V3::zeros(); places.len()];
        for plate in &self.plates {
            for (first, second, stiffness) in plate.pairs() {
                let force = self.targets[second] * stiffness;
                let hinge = &self.hinges[first];
                for (node, weight) in hinge.nodes.iter().zip(hinge.weights) {
                    self.at_rest[*node] += force * weight;
                }
            }
        }
    }

    /// Elastic energy.
    pub(crate) fn potential(&self, places: &[V3]) -> f64 {
        let targets = self
            .targets
            .iter()
            .copied()
            .chain(std::iter::repeat(V3::zeros()));
        let beyond = self.hinges.iter().zip(targets);
        let beyond: Vec<V3> = beyond
            .map(|(hinge, target)| hinge.jump(places) - target)
            .collect();
        let pairs = self.plates.iter().flat_map(Plate::pairs);
        pairs
            .map(|(first, second, stiffness)| 0.5 * stiffness * beyond[first].dot(&beyond[second]))
            .sum()
    }

    /// Adds the gradient of the potential.
    pub(crate) fn add(&self, places: &[V3], gradient: &mut [V3]) {
        for (node, sum) in gradient.iter_mut().enumerate().take(self.matrix.len()) {
            *sum += self.matrix.row_times(node, places);
        }
        for (sum, at_rest) in gradient.iter_mut().zip(&self.at_rest) {
            *sum -= at_rest;
        }
    }
}

impl Plate {
    /// Pairs of its hinges, with the stiffness between them.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let all = (0..9).map(|i| (i / 3, i % 3));
        all.filter_map(|(i, j)| Some((self.hinges[i]?, self.hinges[j]?, self.stiffness[(i, j)])))
    }
}

/// Energy of a plate by the jumps at its edges, for a bending stiffness of one. The edge at a corner is the one that begins there.
fn plate_stiffness(corners: [V3; 3], poisson: f64) -> Matrix3<f64> {
    let [a, b, c] = corners;
    let edges = [b - a, c - b, a - c].map(|edge| edge.normalize());
    let area = 0.5 * (b - a).cross(&(c - a)).norm();
    Matrix3::from_fn(|i, j| {
        // The directions across two edges have the same angle as the edges.
        let along = edges[i].dot(&edges[j]);
        ((1.0 - poisson) * along * along + poisson) / (4.0 * area)
    })
}

impl Hinge {
    fn new(nodes: [usize; 4], triangles: [usize; 2], places: &[V3], is_flat: bool) -> Option<Self> {
        let [start, end, first, second] = nodes.map(|node| places[node]);
        let edge = end - start;
        let length = edge.norm();
        let side = |corner: V3| {
            let along = (corner - start).dot(&edge) / (length * length);
            let height = (corner - start - edge * along).norm();
            (height > 0.0 && length > 0.0).then_some((along, length / height))
        };
        let [(a, up), (b, down)] = [side(first)?, side(second)?];
        let ends = Vector3::new(-(1.0 - a) * up - (1.0 - b) * down, -a * up - b * down, 0.0);
        let mut hinge = Self {
            nodes,
            triangles,
            weights: [ends.x, ends.y, up, down],
            rest: 0.0,
        };
        if !is_flat {
            hinge.rest = hinge.jump(places).dot(&hinge.normal(places));
        }
        Some(hinge)
    }

    fn jump(&self, places: &[V3]) -> V3 {
        let parts = self.nodes.iter().zip(&self.weights);
        parts.fold(V3::zeros(), |sum, (node, weight)| {
            sum + places[*node] * *weight
        })
    }

    /// The mean normal of the two triangles.
    fn normal(&self, places: &[V3]) -> V3 {
        let [start, end, first, second] = self.nodes.map(|node| places[node]);
        let edge = end - start;
        let unit = |normal: V3| normal.try_normalize(0.0).unwrap_or_default();
        let sum = unit(edge.cross(&(first - start))) - unit(edge.cross(&(second - start)));
        sum.try_normalize(1e-9).unwrap_or_default()
    }

    /// The jump at rest, as the triangles are turned.
    fn target(&self, places: &[V3]) -> V3 {
        self.normal(places) * self.rest
    }
}

/// The edges of two triangles, and those of each triangle.
type Hinges = (Vec<Hinge>, Vec<[Option<usize>; 3]>);

fn hinges(triangles: &[[usize; 3]], places: &[V3], is_flat: bool) -> Option<Hinges> {
    let mut edges: BTreeMap<[usize; 2], Vec<(usize, usize)>> = BTreeMap::new();
    for (triangle, nodes) in triangles.iter().enumerate() {
        for corner in 0..3 {
            let [a, b] = [nodes[corner], nodes[(corner + 1) % 3]];
            edges
                .entry([a.min(b), a.max(b)])
                .or_default()
                .push((triangle, corner));
        }
    }
    let mut hinges = Vec::new();
    let mut of_triangles = vec![[None; 3]; triangles.len()];
    for ([start, end], sides) in edges {
        // Where more than two meet, nothing says which of them bend.
        let [(first, a), (second, b)] = sides[..] else {
            continue;
        };
        let opposite = |triangle: usize, corner: usize| triangles[triangle][(corner + 2) % 3];
        let nodes = [start, end, opposite(first, a), opposite(second, b)];
        for (triangle, corner) in sides {
            of_triangles[triangle][corner] = Some(hinges.len());
        }
        hinges.push(Hinge::new(nodes, [first, second], places, is_flat)?);
    }
    Some((hinges, of_triangles))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of cells of a size, with the height of its points.
    fn grid(size: f64, height: impl Fn(f64, f64) -> f64) -> (Vec<[usize; 3]>, Vec<V3>) {
        let point = |i: usize, j: usize| {
            let [x, y] = [i, j].map(|n| n as f64 * size);
            V3::new(x, y, height(x, y))
        };
        let points = (0..36).map(|n| point(n % 6, n / 6)).collect();
        let cells = (0..25).map(|n| n / 5 * 6 + n % 5);
        let triangles = cells.flat_map(|a| [[a, a + 1, a + 7], [a, a + 7, a + 6]]);
        (triangles.collect(), points)
    }

    #[test]
    fn curvatures_have_the_energy_of_a_plate() {
        let (bend, poisson, size) = (3.0, 0.3, 0.1);
        let shapes = [[0.01, 0.0, 0.0], [0.0, 0.0, 0.02], [0.01, -0.02, 0.005]];
        for [xx, yy, xy] in shapes {
            let (triangles, flat) = grid(size, |_, _| 0.0);
            let (_, bent) = grid(size, |x, y| 0.5 * (xx * x * x + yy * y * y) + xy * x * y);
            let bending = Bending::new(&triangles, &flat, true, bend, poisson).unwrap();
            // Of a triangle within, since those at the rim have no slope beyond it.
            let mut all = bending.clone();
            all.plates = vec![bending.plates[24].clone()];
            all.find_matrix(36);
            let trace: f64 = xx + yy;
            let square = xx * xx + yy * yy + 2.0 * xy * xy;
            let expected = 0.5
                * bend
                * ((1.0 - poisson) * square + poisson * trace * trace)
                * 0.5
                * size
                * size;
            assert!((all.potential(&bent) / expected - 1.0).abs() < 1e-6);
            assert!(bending.potential(&flat).abs() < 1e-12);
        }
    }

    #[test]
    fn what_is_bent_at_rest_is_so_however_it_is_turned() {
        let (triangles, bent) = grid(0.1, |x, _| 0.3 * x * x);
        let mut bending = Bending::new(&triangles, &bent, false, 2.0, 0.0).unwrap();
        let turned: Vec<V3> = bent
            .iter()
            .map(|p| V3::new(p.z, p.x, p.y) + V3::x())
            .collect();
        bending.begin(&turned);
        assert!(bending.potential(&turned).abs() < 1e-9);
        let mut gradient = vec![V3::zeros(); 36];
        bending.add(&turned, &mut gradient);
        assert!(gradient.iter().all(|force| force.norm() < 1e-9));
        let (_, flat) = grid(0.1, |_, _| 0.0);
        bending.begin(&flat);
        assert!(bending.potential(&flat) > 0.01);
    }

    #[test]
    fn a_triangle_that_is_gone_bends_nothing() {
        let (triangles, bent) = grid(0.1, |x, _| 0.3 * x * x);
        let mut bending = Bending::new(&triangles[..2], &bent, true, 2.0, 0.0).unwrap();
        let (_, folded) = grid(0.1, |x, y| x * y);
        assert!(bending.potential(&folded) > 0.01);
        bending.remove(1);
        assert!(bending.potential(&folded).abs() < 1e-12);
    }
}
