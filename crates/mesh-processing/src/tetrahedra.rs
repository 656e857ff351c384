//! Tetrahedra within a closed mesh.
//!
//! Cells of a regular grid whose middle is inside are divided into six tetrahedra each, mirrored from cell to cell, and the points of the boundary are moved onto the
//! mesh, as far as no element gets too flat. Edges sharper than the grid are rounded off; boxes along the axes are met exactly.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

type V3 = Vector3<f64>;

/// Largest number of cells.
const MAX_CELLS: usize = 40_000;
/// Part of its volume in the grid that an element keeps at least.
const LEAST_VOLUME: f64 = 0.1;
/// How often points within go to the middle of their neighbours.
const SMOOTHINGS: usize = 3;
/// How often points that make elements too flat go half of their way back.
const ROUNDS: usize = 8;
/// The tetrahedra of a cell, by the axes along which the corners are on the far side; all contain the first and the last corner.
const PATHS: [[usize; 2]; 6] = [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]];

/// Points, and tetrahedra in positive order.
pub type Tetrahedra = (Vec<[f64; 3]>, Vec<[u32; 4]>);

/// Tetrahedra within a mesh, of cells not larger than `cell` (metres).
///
/// # Errors
/// A sentence that says why there are none: the mesh is not closed, an index is out of range, or the cells are too large or too small for it.
pub fn tetrahedra(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    cell: f64,
) -> Result<Tetrahedra, String> {
    let mesh = Closed::new(vertices, triangles)?;
    let grid = Grid::around(&mesh, cell)?;
    let inside = grid.inside(&mesh);
    if inside.is_empty() {
        return Err("no cell of the grid is within the mesh: smaller cells are needed.".into());
    }
    let mut lattice = grid.lattice(&inside);
    lattice.fit(&mesh);
    let points = lattice.points.iter().map(|point| (*point).into());
    Ok((points.collect(), lattice.elements))
}

/// Points and tetrahedra of a box of cells from a corner on.
pub fn grid(corner: [f64; 3], cell: [f64; 3], counts: [usize; 3]) -> Tetrahedra {
    let grid = Grid {
        low: corner.into(),
        cell: cell.into(),
        counts,
    };
    let [x, y, _] = counts;
    let cells = (0..counts.iter().product()).map(|n: usize| [n % x, n / x % y, n / x / y]);
    let lattice = grid.lattice(&cells.collect::<Vec<_>>());
    let points = lattice.points.into_iter().map(Into::into);
    (points.collect(), lattice.elements)
}

/// The faces of tetrahedra in positive order that belong to one of them only, facing outwards.
pub fn faces(tetrahedra: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let mut faces: BTreeMap<[u32; 3], ([u32; 3], usize)> = BTreeMap::new();
    for [a, b, c, d] in tetrahedra {
        for face in [[*a, *c, *b], [*a, *b, *d], [*a, *d, *c], [*b, *c, *d]] {
            let mut name = face;
            name.sort_unstable();
            faces.entry(name).or_insert((face, 0)).1 += 1;
        }
    }
    let own = faces.into_values().filter(|(_, count)| *count == 1);
    own.map(|(face, _)| face).collect()
}

/// A mesh whose edges belong to two triangles each.
struct Closed {
    triangles: Vec<[V3; 3]>,
    low: V3,
    high: V3,
}

impl Closed {
    fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, String> {
        let point = |index: u32| vertices.get(index as usize).map(|point| V3::from(*point));
        let corners = |[a, b, c]: &[u32; 3]| Some([point(*a)?, point(*b)?, point(*c)?]);
        let corners: Option<Vec<[V3; 3]>> = triangles.iter().map(corners).collect();
        let corners = corners.ok_or("a triangle has a vertex that is not there.")?;
        let all = || corners.iter().flatten();
        if !all().all(|point| point.iter().all(|x| x.is_finite())) {
            return Err("a vertex has no place.".into());
        }
        if corners.is_empty() || !is_closed(&corners) {
            return Err("the mesh is not closed.".into());
        }
        let [low, high] = [V3::inf as fn(&V3, &V3) -> V3, V3::sup]
            .map(|extreme| all().fold(corners[0][0], |sum, point| extreme(&sum, point)));
        Ok(Self {
            triangles: corners,
            low,
            high,
        })
    }

    /// Where a line along x crosses the mesh.
    fn crossings(&self, y: f64, z: f64) -> Vec<f64> {
        let crossing = |[a, b, c]: &[V3; 3]| {
            let area = |p: &V3, q: &V3| (p.y - y) * (q.z - z) - (p.z - z) * (q.y - y);
            let weights = [area(b, c), area(c, a), area(a, b)];
            let sum: f64 = weights.iter().sum();
            let is_within = weights.iter().all(|weight| weight * sum > 0.0);
            is_within.then(|| (a.x * weights[0] + b.x * weights[1] + c.x * weights[2]) / sum)
        };
        self.triangles.iter().filter_map(crossing).collect()
    }

    fn nearest(&self, point: &V3) -> V3 {
        let mut best = (f64::MAX, *point);
        for [a, b, c] in &self.triangles {
            let (low, high) = (a.inf(b).inf(c), a.sup(b).sup(c));
            let outside = (low - point).sup(&(point - high)).sup(&V3::zeros());
            if outside.norm_squared() < best.0 {
                let near = nearest_on(point, [a, b, c]);
                let distance = (near - point).norm_squared();
                if distance < best.0 {
                    best = (distance, near);
                }
            }
        }
        best.1
    }
}

/// Whether each edge is there once in each direction; corners are the same where their places are.
fn is_closed(triangles: &[[V3; 3]]) -> bool {
    let name = |point: &V3| [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits());
    let mut edges: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = (name(from), name(to));
            let sign = if from < to { 1 } else { -1 };
            *edges.entry([from.min(to), from.max(to)]).or_default() += sign;
        }
    }
    edges.values().all(|sum| *sum == 0)
}

fn nearest_on(point: &V3, [a, b, c]: [&V3; 3]) -> V3 {
    let normal = (b - a).cross(&(c - a));
    let area = normal.norm_squared();
    if area > 0.0 {
        let beside = |p: &V3, q: &V3| (p - point).cross(&(q - point)).dot(&normal);
        let weights = [beside(b, c), beside(c, a), beside(a, b)];
        if weights.iter().all(|weight| *weight >= 0.0) {
            return (a * weights[0] + b * weights[1] + c * weights[2]) / area;
        }
    }
    let on_edges = [(a, b), (b, c), (c, a)].map(|(p, q)| {
        let along = q - p;
        let part = (point - p).dot(&along) / along.norm_squared();
        p + along
            * if part.is_nan() {
                0.0
            } else {
                part.clamp(0.0, 1.0)
            }
    });
    let distance = |place: &V3| (place - point).norm_squared();
    let nearer = |a: V3, b: V3| if distance(&b) < distance(&a) { b } else { a };
    on_edges.into_iter().reduce(nearer).unwrap_or(*a)
}

/// A regular grid around a mesh.
struct Grid {
    low: V3,
    /// Size of a cell.
    cell: V3,
    counts: [usize; 3],
}

impl Grid {
    fn around(mesh: &Closed, cell: f64) -> Result<Self, String> {
        let size = mesh.high - mesh.low;
        if !(cell.is_finite() && cell > 0.0 && size.iter().all(|x| *x > 0.0)) {
            return Err(
                "the size of cells has to be positive, and the mesh has to have a volume.".into(),
            );
        }
        let parts = size.map(|extent| (extent / cell * (1.0 - 1e-9)).ceil().max(1.0));
        if parts.product() > MAX_CELLS as f64 {
            return Err(format!(
                "cells of {cell} m are too small: there would be more than {MAX_CELLS}."
            ));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not more than the number of cells"
        )]
        let counts = [parts.x as usize, parts.y as usize, parts.z as usize];
        Ok(Self {
            low: mesh.low,
            cell: size.component_div(&parts),
            counts,
        })
    }

    /// The cells whose middle is within the mesh.
    fn inside(&self, mesh: &Closed) -> Vec<[usize; 3]> {
        let mut cells = Vec::new();
        for k in 0..self.counts[2] {
            for j in 0..self.counts[1] {
                // Beside the middle, so that the line meets no edge of a regular mesh.
                let middle = self.point([0, j, k])
                    + self.cell.component_mul(&V3::new(0.5, 0.500_137, 0.500_071));
                let crossings = mesh.crossings(middle.y, middle.z);
                for i in 0..self.counts[0] {
                    let x = middle.x + self.cell.x * i as f64;
                    let before = crossings.iter().filter(|crossing| **crossing < x).count();
                    if before % 2 == 1 {
                        cells.push([i, j, k]);
                    }
                }
            }
        }
        cells
    }

    fn point(&self, place: [usize; 3]) -> V3 {
        let [i, j, k] = place.map(|n| n as f64);
        self.low + self.cell.component_mul(&V3::new(i, j, k))
    }

    fn lattice(&self, cells: &[[usize; 3]]) -> Lattice {
        let mut lattice = Lattice::default();
        let mut known = BTreeMap::new();
        for place in cells {
            // Cells are mirrored, so that faces of neighbours have the same diagonal.
            let mirror = (0..3).fold(0, |bits, axis| bits | (place[axis] & 1) << axis);
            let is_turned = mirror.count_ones() % 2 == 1;
            let corners: [u32; 8] = std::array::from_fn(|corner| {
                let bits = corner ^ mirror;
                let at = std::array::from_fn(|axis| place[axis] + (bits >> axis & 1));
                *known
                    .entry(at)
                    .or_insert_with(|| lattice.add(self.point(at)))
            });
            for [first, second] in PATHS {
                let mut element = [0, first, second, 7].map(|corner| corners[corner]);
                if is_turned {
                    element.swap(1, 2);
                }
                lattice.elements.push(element);
            }
        }
        lattice
    }
}

/// Points and elements of a grid.
#[derive(Default)]
struct Lattice {
    points: Vec<V3>,
    elements: Vec<[u32; 4]>,
}

impl Lattice {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "eight for each cell at most"
    )]
    fn add(&mut self, point: V3) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// Moves the points of the boundary onto the mesh, as far as no element gets too flat.
    fn fit(&mut self, mesh: &Closed) {
        let boundary = self.boundary();
        let start = self.points.clone();
        for node in &boundary {
            let point = &mut self.points[*node as usize];
            *point = mesh.nearest(point);
        }
        self.smooth(&boundary);
        // What got flat between points of the boundary is not needed.
        let is_needed = |nodes: &[u32; 4]| {
            let is_flat = volume(&self.points, *nodes) < LEAST_VOLUME * volume(&start, *nodes);
            !(is_flat && nodes.iter().all(|node| boundary.contains(node)))
        };
        self.elements.retain(is_needed);
        let volumes: Vec<f64> = (0..self.elements.len())
            .map(|i| volume(&start, self.elements[i]))
            .collect();
        for round in 0..=ROUNDS {
            let flat = self.elements.iter().zip(&volumes);
            let flat =
                flat.filter(|(nodes, rest)| volume(&self.points, **nodes) < LEAST_VOLUME * **rest);
            let back: BTreeSet<u32> = flat.flat_map(|(nodes, _)| *nodes).collect();
            if back.is_empty() {
                break;
            }
            // In the last round, all of the way.
            let part = if round == ROUNDS { 1.0 } else { 0.5 };
            for node in back {
                let node = node as usize;
                self.points[node] = self.points[node].lerp(&start[node], part);
            }
        }
        self.drop_unused();
    }

    /// Leaves out the points that belong to no element.
    fn drop_unused(&mut self) {
        let used: BTreeSet<u32> = self.elements.iter().flatten().copied().collect();
        let numbers: BTreeMap<u32, u32> = used.iter().copied().zip(0..).collect();
        self.points = used
            .iter()
            .map(|node| self.points[*node as usize])
            .collect();
        for node in self.elements.iter_mut().flatten() {
            *node = numbers[node];
        }
    }

    /// Moves the points within to the middle of their neighbours.
    fn smooth(&mut self, boundary: &BTreeSet<u32>) {
        for _ in 0..SMOOTHINGS {
            let mut sums = vec![(V3::zeros(), 0.0); self.points.len()];
            for nodes in &self.elements {
                let sum: V3 = nodes.iter().map(|node| self.points[*node as usize]).sum();
                for node in nodes.iter().map(|node| *node as usize) {
                    sums[node].0 += sum - self.points[node];
                    sums[node].1 += 3.0;
                }
            }
            for (node, point) in (0..)
                .zip(&mut self.points)
                .filter(|(node, _)| !boundary.contains(node))
            {
                let node = node as usize;
                *point = sums[node].0 / sums[node].1;
            }
        }
    }

    /// The points of faces that belong to one element only.
    fn boundary(&self) -> BTreeSet<u32> {
        faces(&self.elements).into_iter().flatten().collect()
    }
}

fn volume(points: &[V3], nodes: [u32; 4]) -> f64 {
    let [a, b, c, d] = nodes.map(|node| points[node as usize]);
    (b - a).dot(&(c - a).cross(&(d - a))) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(size: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let corner = |i: usize| std::array::from_fn(|axis| size * (i >> axis & 1) as f64);
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = quads
            .iter()
            .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        ((0..8).map(corner).collect(), triangles.collect())
    }

    /// A sphere by parallels and meridians.
    fn sphere(radius: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let (rows, columns) = (16_u32, 24_u32);
        let mut points = vec![[0.0, 0.0, radius], [0.0, 0.0, -radius]];
        for row in 1..rows {
            let (sine, cosine) =
                libm::sincos(std::f64::consts::PI * f64::from(row) / f64::from(rows));
            for column in 0..columns {
                let (s, c) =
                    libm::sincos(std::f64::consts::TAU * f64::from(column) / f64::from(columns));
                points.push([radius * sine * c, radius * sine * s, radius * cosine]);
            }
        }
        let at = |row: u32, column: u32| 2 + (row - 1) * columns + column % columns;
        let mut triangles = Vec::new();
        for column in 0..columns {
            triangles.push([0, at(1, column), at(1, column + 1)]);
            triangles.push([1, at(rows - 1, column + 1), at(rows - 1, column)]);
            for row in 1..rows - 1 {
                let [a, b] = [at(row, column), at(row, column + 1)];
                let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
                triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        (points, triangles)
    }

    fn total((points, elements): &Tetrahedra) -> f64 {
        let points: Vec<V3> = points.iter().map(|point| V3::from(*point)).collect();
        let volumes = elements.iter().map(|nodes| volume(&points, *nodes));
        volumes.inspect(|volume| assert!(*volume > 0.0)).sum()
    }

    #[test]
    fn a_box_is_filled_exactly() {
        let (vertices, triangles) = cube(0.3);
        let filled = tetrahedra(&vertices, &triangles, 0.1).unwrap();
        assert_eq!((filled.0.len(), filled.1.len()), (64, 162));
        assert!((total(&filled) - 0.027).abs() < 1e-12);
    }

    #[test]
    fn a_grid_has_a_closed_surface() {
        let (points, elements) = grid([1.0, 0.0, 0.0], [0.1, 0.2, 0.3], [3, 2, 1]);
        assert_eq!((points.len(), elements.len()), (24, 36));
        assert!((total(&(points.clone(), elements.clone())) - 0.3 * 0.4 * 0.3).abs() < 1e-12);
        let faces = faces(&elements);
        assert_eq!(faces.len(), 2 * 2 * (6 + 3 + 2));
        assert!(Closed::new(&points, &faces).is_ok());
    }

    #[test]
    fn a_ball_is_filled_up_to_its_surface() {
        let (vertices, triangles) = sphere(0.1);
        let filled = tetrahedra(&vertices, &triangles, 0.025).unwrap();
        let exact = 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
        assert!(
            (total(&filled) / exact - 1.0).abs() < 0.06,
            "{}",
            total(&filled) / exact
        );
        let size = |point: &[f64; 3]| V3::from(*point).norm();
        assert!(filled.0.iter().all(|point| size(point) < 0.1005));
        let on_surface = filled.0.iter().filter(|point| size(point) > 0.097).count();
        assert!(
            on_surface > filled.0.len() / 3,
            "{on_surface} of {}",
            filled.0.len()
        );
    }

    #[test]
    fn what_cannot_be_filled_is_refused() {
        let (vertices, triangles) = cube(0.3);
        let refused = |vertices: &[[f64; 3]], triangles: &[[u32; 3]], cell: f64| {
            tetrahedra(vertices, triangles, cell).unwrap_err()
        };
        assert!(refused(&vertices, &triangles[1..], 0.1).contains("not closed"));
        assert!(refused(&vertices, &[[0, 1, 9]], 0.1).contains("not there"));
        assert!(refused(&vertices, &triangles, 1e-3).contains("too small"));
        assert!(refused(&vertices, &triangles, f64::NAN).contains("positive"));
        assert!(refused(&[], &[], 0.1).contains("not closed"));
        let mut unplaced = vertices.clone();
        unplaced[3][1] = f64::INFINITY;
        assert!(refused(&unplaced, &triangles, 0.1).contains("no place"));
    }
}
