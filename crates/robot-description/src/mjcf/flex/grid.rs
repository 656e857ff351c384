//! Regular grids of nodes, and what is between them.

use std::collections::BTreeMap;

/// A grid around the origin. Nodes are counted along the last axis first, as MuJoCo does.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    pub count: [usize; 3],
    pub spacing: [f64; 3],
}

impl Grid {
    /// How many axes have more than one node.
    pub fn dimension(&self) -> usize {
        self.axes().count()
    }

    /// The axes with more than one node.
    pub fn axes(&self) -> impl Iterator<Item = usize> {
        let count = self.count;
        (0..3).filter(move |axis| count[*axis] > 1)
    }

    /// The mean distance of neighbours along these axes; 0 for a single node.
    pub fn mean_spacing(&self) -> f64 {
        let sum: f64 = self.axes().map(|axis| self.spacing[axis]).sum();
        sum / self.dimension().max(1) as f64
    }

    pub fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.count[1] + j) * self.count[2] + k
    }

    /// The places of all nodes, in their order.
    pub fn places(&self) -> impl Iterator<Item = [usize; 3]> {
        let [nx, ny, nz] = self.count;
        (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])))
    }

    pub fn points(&self) -> Vec<[f64; 3]> {
        let along = |axis: usize, i: usize| {
            self.spacing[axis] * (i as f64 - 0.5 * (self.count[axis] as f64 - 1.0))
        };
        let point = |place: [usize; 3]| [0, 1, 2].map(|axis| along(axis, place[axis]));
        self.places().map(point).collect()
    }

    /// Whether a node has no neighbour on one side along an axis with several nodes.
    pub fn is_outside(&self, place: [usize; 3]) -> bool {
        self.axes()
            .any(|axis| place[axis] == 0 || place[axis] + 1 == self.count[axis])
    }

    /// Triangles of a grid of two dimensions; diagonals alternate.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let axes: Vec<usize> = self.axes().collect();
        let [first, second] = axes[..] else {
            return Vec::new();
        };
        let step = |place: [usize; 3], along: &[usize]| {
            let mut place = place;
            along.iter().for_each(|axis| place[*axis] += 1);
            self.number(place) as u32
        };
        let cells = self.places().filter(|place| {
            place[first] + 1 < self.count[first] && place[second] + 1 < self.count[second]
        });
        let split = |place: [usize; 3]| {
            let corners = [&[][..], &[first], &[first, second], &[second]];
            let [a, b, c, d] = corners.map(|along| step(place, along));
            if (place[first] + place[second]).is_multiple_of(2) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            }
        };
        cells.flat_map(split).collect()
    }

    /// Tetrahedra of a grid of three dimensions: six in each cell, along its diagonal.
    pub fn tetrahedra(&self) -> Vec<[u32; 4]> {
        const PATHS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [0, 2, 1],
            [2, 1, 0],
            [1, 0, 2],
        ];
        let is_cell = |place: &[usize; 3]| (0..3).all(|axis| place[axis] + 1 < self.count[axis]);
        let within = |place: [usize; 3]| {
            PATHS.into_iter().enumerate().map(move |(number, path)| {
                let mut at = place;
                let mut corners = [self.number(at) as u32; 4];
                for (corner, axis) in corners[1..].iter_mut().zip(path) {
                    at[axis] += 1;
                    *corner = self.number(at) as u32;
                }
                // The last three go round the other way.
                if number >= 3 {
                    corners.swap(2, 3);
                }
                corners
            })
        };
        self.places().filter(is_cell).flat_map(within).collect()
    }
}

/// The triangles around tetrahedra in positive order, facing outwards.
pub fn surface(tetrahedra: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let mut faces: BTreeMap<[u32; 3], ([u32; 3], usize)> = BTreeMap::new();
    for [a, b, c, d] in tetrahedra {
        for face in [[*a, *c, *b], [*a, *b, *d], [*a, *d, *c], [*b, *c, *d]] {
            let mut name = face;
            name.sort_unstable();
            faces.entry(name).or_insert((face, 0)).1 += 1;
        }
    }
    let alone = faces.into_values().filter(|(_, count)| *count == 1);
    alone.map(|(face, _)| face).collect()
}
