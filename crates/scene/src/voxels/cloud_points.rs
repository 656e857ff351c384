//! The points of a cloud, and which of them are near a place.

use std::collections::HashMap;
use std::ops::Deref;

use super::point_cloud::CloudPoint;

/// The points in the order of insertion.
#[derive(Default)]
pub struct CloudPoints {
    list: Vec<CloudPoint>,
    /// Of all points, as the last insertion left it: a cloud that is filled in pieces is not looked through for each of them.
    near: Option<NeighbourGrid>,
}

impl CloudPoints {
    /// Adds a point.
    pub fn push(&mut self, point: CloudPoint) {
        if let Some(near) = &mut self.near {
            near.add(point.position);
        }
        self.list.push(point);
    }

    /// Removes all points.
    pub fn clear(&mut self) {
        (self.near, self.list) = (None, Vec::new());
    }

    /// Adds points, except for those that have another within `tolerance` metres.
    pub(super) fn insert(&mut self, points: impl Iterator<Item = CloudPoint>, tolerance: f64) {
        let tolerance = if tolerance > 0.0 { tolerance } else { 0.0 };
        let known = self.near.take();
        let mut near = known
            .filter(|near| near.tolerance == tolerance)
            .unwrap_or_else(|| NeighbourGrid::of(self.positions(), tolerance));
        for point in points {
            if !near.finds(point.position, |number| self.list[number].position) {
                near.add(point.position);
                self.list.push(point);
            }
        }
        self.near = Some(near);
    }

    /// Keeps only the points that lie within `tolerance` metres of one of `places`, or (with `near` false) only the others.
    pub(super) fn keep(&mut self, near: bool, places: &[[f64; 3]], tolerance: f64) {
        let grid = NeighbourGrid::of(places.iter().copied(), tolerance);
        self.retain(|point| grid.finds(point.position, |number| places[number]) == near);
    }

    /// Keeps only some points.
    pub(super) fn retain(&mut self, stays: impl FnMut(&CloudPoint) -> bool) {
        self.near = None;
        self.list.retain(stays);
    }

    /// Scales all lengths.
    pub(super) fn scale(&mut self, factor: f64) {
        self.near = None;
        for point in &mut self.list {
            point.position = point.position.map(|c| factor * c);
        }
    }

    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        self.list.iter().map(|point| point.position)
    }
}

impl Deref for CloudPoints {
    type Target = [CloudPoint];

    fn deref(&self) -> &[CloudPoint] {
        &self.list
    }
}

impl Clone for CloudPoints {
    /// Without what only makes insertions faster.
    fn clone(&self) -> Self {
        let (list, near) = (self.list.clone(), None);
        Self { list, near }
    }
}

impl std::fmt::Debug for CloudPoints {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.list.fmt(f)
    }
}

impl PartialEq for CloudPoints {
    fn eq(&self, other: &Self) -> bool {
        self.list == other.list
    }
}

/// Places in the cells of a grid as wide as the tolerance: neighbours are in the same cell or in one beside it. Places are known by their
/// number, in the order they came.
struct NeighbourGrid {
    tolerance: f64,
    /// The last place of each cell.
    cells: HashMap<[i64; 3], u32>,
    /// For each place the one before it in its cell, or itself.
    previous: Vec<u32>,
}

impl NeighbourGrid {
    fn of(places: impl Iterator<Item = [f64; 3]>, tolerance: f64) -> Self {
        let mut near = Self {
            tolerance: if tolerance > 0.0 { tolerance } else { 0.0 },
            cells: HashMap::new(),
            previous: Vec::new(),
        };
        places.for_each(|place| near.add(place));
        near
    }

    /// With a tolerance of zero no point is near.
    fn add(&mut self, place: [f64; 3]) {
        if self.tolerance > 0.0 {
            let number = self.previous.len() as u32;
            let before = self.cells.insert(self.cell(place), number);
            self.previous.push(before.unwrap_or(number));
        }
    }

    /// Whether one of the places is near. `at`: the position of each of them.
    fn finds(&self, place: [f64; 3], at: impl Fn(usize) -> [f64; 3]) -> bool {
        let [x, y, z] = self.cell(place);
        let close = |number: u32| {
            let other = at(number as usize);
            (0..3).map(|i| (other[i] - place[i]).powi(2)).sum::<f64>() <= self.tolerance.powi(2)
        };
        let beside = |at: i64| at.saturating_sub(1)..=at.saturating_add(1);
        !self.cells.is_empty()
            && beside(x)
                .any(|x| beside(y).any(|y| beside(z).any(|z| self.in_cell([x, y, z]).any(close))))
    }

    /// The places in a cell, the last one first.
    fn in_cell(&self, cell: [i64; 3]) -> impl Iterator<Item = u32> {
        let last = self.cells.get(&cell).copied();
        std::iter::successors(last, |&number| {
            let before = self.previous[number as usize];
            (before != number).then_some(before)
        })
    }

    fn cell(&self, place: [f64; 3]) -> [i64; 3] {
        place.map(|c| (c / self.tolerance).floor() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use test_support::random::Random;

    fn points(random: &mut Random, count: usize) -> Vec<CloudPoint> {
        let point = |_| CloudPoint {
            position: random.vector(),
            colour: [0; 3],
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn a_cloud_filled_in_pieces_is_that_filled_at_once() {
        let mut random = Random::new(3);
        let all = points(&mut random, 400);
        let (mut pieces, mut whole) = (CloudPoints::default(), CloudPoints::default());
        all.chunks(7)
            .for_each(|piece| pieces.insert(piece.iter().copied(), 0.2));
        whole.insert(all.into_iter(), 0.2);
        assert!(pieces == whole && whole.len() < 300);
        // What is between insertions counts.
        let more = points(&mut random, 100);
        for cloud in [&mut pieces, &mut whole] {
            cloud.keep(false, &[[0.3; 3]], 0.5);
            cloud.push(more[0]);
            cloud.scale(1.1);
        }
        pieces.insert(more.iter().copied(), 0.1);
        let mut copy = whole.clone();
        copy.insert(more.into_iter(), 0.1);
        assert!(pieces == copy && copy.len() > whole.len());
    }

    #[test]
    fn points_are_looked_at_once_however_many_pieces_there_are() {
        let mut cloud = CloudPoints::default();
        let point = |x: u32| CloudPoint {
            position: [f64::from(x), 0.0, 0.0],
            colour: [0; 3],
        };
        (0..10).for_each(|x| cloud.insert([point(x)].into_iter(), 0.1));
        let near = cloud.near.as_ref().expect("it was filled");
        assert_eq!(near.previous.len(), 10);
    }
}
