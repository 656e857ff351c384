//! Normals of points: those of the planes of their neighbours, all to the same side (H. Hoppe and others: Surface Reconstruction from Unorganized
//! Points, 1992).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::{Matrix3, Vector3};

use crate::kd_tree::KdTree;

/// Of so many neighbours at most one takes the side of its normal.
const WAYS: usize = 16;

/// The centre of points, and the direction in which they are thinnest.
pub(super) fn principal_plane(points: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let centre = points.iter().sum::<Vector3<f64>>() / numbers::real(points.len().max(1));
    let covariance: Matrix3<f64> = points
        .iter()
        .map(|point| (point - centre) * (point - centre).transpose())
        .sum();
    let eigen = covariance.symmetric_eigen();
    (
        centre,
        eigen
            .eigenvectors
            .column(eigen.eigenvalues.imin())
            .into_owned(),
    )
}

/// A point that is next to one whose normal is known.
struct Step {
    /// How much the planes differ: those that differ least come first.
    difference: f64,
    from: u32,
    to: u32,
}

impl Ord for Step {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .difference
            .total_cmp(&self.difference)
            .then((other.from, other.to).cmp(&(self.from, self.to)))
    }
}

impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Step {}

/// A normal for each point: upwards at the highest point of each piece, and from neighbour to neighbour along the tree of the smallest differences.
pub(super) fn oriented_normals(points: &[[f64; 3]], neighbors: usize) -> Vec<Vector3<f64>> {
    let tree = KdTree::new(points);
    // They are looked for twice: the lists of all points would take much memory.
    let near = |of: usize, count: usize| {
        tree.k_nearest(points[of], count + 1)
            .into_iter()
            .map(|found| found.number)
    };
    let plane = |of: usize| {
        let near: Vec<_> = near(of, neighbors)
            .map(|number| Vector3::from(points[numbers::place(number)]))
            .collect();
        principal_plane(&near).1
    };
    let mut normals: Vec<Vector3<f64>> = (0..points.len()).map(plane).collect();
    let mut is_known = vec![false; points.len()];
    let mut from_top: Vec<usize> = (0..points.len()).collect();
    from_top.sort_by(|a, b| points[*b][2].total_cmp(&points[*a][2]).then(a.cmp(b)));
    for start in from_top {
        if !is_known[start] {
            if normals[start].z < 0.0 {
                normals[start] = -normals[start];
            }
            spread(
                numbers::count_u32(start),
                |of| near(numbers::place(of), neighbors.min(WAYS)),
                &mut normals,
                &mut is_known,
            );
        }
    }
    normals
}

/// From a point to all that are reached through neighbours.
fn spread<I: Iterator<Item = u32>>(
    start: u32,
    near: impl Fn(u32) -> I,
    normals: &mut [Vector3<f64>],
    is_known: &mut [bool],
) {
    let mut heap = BinaryHeap::from([Step {
        difference: 0.0,
        from: start,
        to: start,
    }]);
    while let Some(Step { from, to, .. }) = heap.pop() {
        if std::mem::replace(&mut is_known[numbers::place(to)], true) {
            continue;
        }
        if normals[numbers::place(from)].dot(&normals[numbers::place(to)]) < 0.0 {
            normals[numbers::place(to)] = -normals[numbers::place(to)];
        }
        for next in near(to).filter(|next| !is_known[numbers::place(*next)]) {
            let difference = 1.0
                - normals[numbers::place(to)]
                    .dot(&normals[numbers::place(next)])
                    .abs();
            heap.push(Step {
                difference,
                from: to,
                to: next,
            });
        }
    }
}
