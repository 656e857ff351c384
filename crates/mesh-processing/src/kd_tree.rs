//! A k-d tree of points: the nearest one, the k nearest, those within a distance (J. L. Bentley 1975).

use std::collections::BinaryHeap;

/// Largest number of points in a leaf.
const MAX_LEAF_SIZE: usize = 8;

/// Points, ordered so that those near each other are found fast.
#[derive(Debug, Clone)]
pub struct KdTree {
    /// The middle of each part divides it, along the axis of [`KdTree::axes`].
    points: Vec<[f64; 3]>,
    /// The number of each point in the list it comes from.
    numbers: Vec<u32>,
    /// Of the point in the middle of a part.
    axes: Vec<u8>,
}

/// A point that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour {
    /// Squared distance from what was asked for.
    pub distance_squared: f64,
    /// Its number in the list.
    pub number: u32,
}

impl Eq for Neighbour {}

impl Ord for Neighbour {
    /// By distance; among equals, by number.
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.distance_squared
            .total_cmp(&other.distance_squared)
            .then(self.number.cmp(&other.number))
    }
}

impl PartialOrd for Neighbour {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl KdTree {
    /// Points must be finite.
    pub fn new(points: &[[f64; 3]]) -> Self {
        let mut order: Vec<u32> = (0..numbers::count_u32(points.len())).collect();
        let mut axes = vec![0; points.len()];
        divide(points, &mut order, &mut axes);
        Self {
            points: order
                .iter()
                .map(|number| points[numbers::place(*number)])
                .collect(),
            numbers: order,
            axes,
        }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The nearest point; None without points.
    pub fn nearest(&self, to: [f64; 3]) -> Option<Neighbour> {
        let mut best: Option<Neighbour> = None;
        self.visit(0..self.points.len(), to, &mut |found| {
            best = Some(best.map_or(found, |best| best.min(found)));
            best.map_or(f64::INFINITY, |best| best.distance_squared)
        });
        best
    }

    /// The nearest points, `count` at most, the nearest first.
    pub fn k_nearest(&self, to: [f64; 3], count: usize) -> Vec<Neighbour> {
        let mut heap = BinaryHeap::new();
        if count == 0 {
            return Vec::new();
        }
        self.visit(0..self.points.len(), to, &mut |found| {
            heap.push(found);
            if heap.len() > count {
                heap.pop();
            }
            if heap.len() < count {
                f64::INFINITY
            } else {
                heap.peek()
                    .map_or(f64::INFINITY, |far: &Neighbour| far.distance_squared)
            }
        });
        heap.into_sorted_vec()
    }

    /// All points not farther away than `radius`, the nearest first.
    pub fn within(&self, to: [f64; 3], radius: f64) -> Vec<Neighbour> {
        let mut found = Vec::new();
        let limit = radius * radius;
        self.visit(0..self.points.len(), to, &mut |neighbour| {
            if neighbour.distance_squared <= limit {
                found.push(neighbour);
            }
            limit
        });
        found.sort_unstable();
        found
    }

    /// Shows the points of a part, the nearer side first; `found` answers how far away further ones may be, squared.
    fn visit(
        &self,
        part: std::ops::Range<usize>,
        to: [f64; 3],
        found: &mut impl FnMut(Neighbour) -> f64,
    ) -> f64 {
        let show = |index: usize, found: &mut dyn FnMut(Neighbour) -> f64| {
            let point = self.points[index];
            let distance_squared = (0..3)
                .map(|k| (point[k] - to[k]) * (point[k] - to[k]))
                .sum();
            found(Neighbour {
                distance_squared,
                number: self.numbers[index],
            })
        };
        if part.len() <= MAX_LEAF_SIZE {
            return part
                .map(|index| show(index, found))
                .fold(f64::INFINITY, |_, limit| limit);
        }
        let middle = part.start + part.len() / 2;
        let axis = usize::from(self.axes[middle]);
        let offset = to[axis] - self.points[middle][axis];
        let (near, far) = if offset < 0.0 {
            (part.start..middle, middle + 1..part.end)
        } else {
            (middle + 1..part.end, part.start..middle)
        };
        self.visit(near, to, found);
        let limit = show(middle, found);
        if offset * offset <= limit {
            self.visit(far, to, found)
        } else {
            limit
        }
    }
}

/// Puts the median of the widest axis into the middle, with smaller ones before and larger ones behind it.
#[expect(clippy::cast_possible_truncation, reason = "an axis is 0, 1 or 2")]
fn divide(points: &[[f64; 3]], order: &mut [u32], axes: &mut [u8]) {
    if order.len() <= MAX_LEAF_SIZE {
        return;
    }
    let extent = |axis: usize| {
        let bounds = order
            .iter()
            .map(|number| points[numbers::place(*number)][axis]);
        bounds.clone().fold(f64::MIN, f64::max) - bounds.fold(f64::MAX, f64::min)
    };
    let widths = [0, 1, 2].map(extent);
    let axis = (0..3).fold(0, |best, axis| {
        if widths[axis] > widths[best] {
            axis
        } else {
            best
        }
    });
    let middle = order.len() / 2;
    let along = |number: &u32| points[numbers::place(*number)][axis];
    order.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    axes[middle] = axis as u8;
    let (left, right) = order.split_at_mut(middle);
    let (left_axes, right_axes) = axes.split_at_mut(middle);
    divide(points, left, left_axes);
    divide(points, &mut right[1..], &mut right_axes[1..]);
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::*;

    #[test]
    fn finds_what_a_look_at_all_finds() {
        let mut random = Random::new(1);
        let mut next = || random.unit();
        // Some are equal, and some lie in a plane.
        let points: Vec<[f64; 3]> = (0..500)
            .map(|k| {
                [
                    next(),
                    (next() * 8.0).floor() / 8.0,
                    if k % 3 == 0 { 0.5 } else { next() },
                ]
            })
            .collect();
        let tree = KdTree::new(&points);
        for _ in 0..100 {
            let to = [next() * 1.5 - 0.25, next(), next()];
            let distance =
                |p: &[f64; 3]| (0..3).map(|k| (p[k] - to[k]) * (p[k] - to[k])).sum::<f64>();
            let mut all: Vec<Neighbour> = points
                .iter()
                .zip(0..)
                .map(|(p, number)| Neighbour {
                    distance_squared: distance(p),
                    number,
                })
                .collect();
            all.sort();
            assert_eq!(tree.nearest(to), Some(all[0]));
            assert_eq!(tree.k_nearest(to, 17), all[..17]);
            let near = all.iter().filter(|n| n.distance_squared <= 0.09).count();
            assert_eq!(tree.within(to, 0.3), all[..near]);
        }
        assert_eq!(tree.k_nearest([0.0; 3], 1000).len(), 500);
        assert_eq!(KdTree::new(&[]).nearest([0.0; 3]), None);
    }
}
