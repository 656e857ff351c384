//! Point clouds.

use std::collections::HashMap;

use geometry::BoundingBox;

use super::box_around;

/// Points with colours, in the frame of the object.
#[derive(Debug, Clone, PartialEq)]
pub struct PointCloud {
    /// Largest edge of a cell of its octree, metres.
    pub max_cell_size: f64,
    /// Points in a cell beyond which it is divided.
    pub max_points_in_cell: i64,
    /// Displayed size of a point, pixels.
    pub point_size: i64,
    /// Points are kept in a tree of cells.
    pub uses_octree: bool,
    /// How many of the points are shown, 0 to 1.
    pub display_fraction: f64,
    /// Option of its creation, stored and read back; scripts choose the colours.
    pub random_colours: bool,
    /// The points in the order of insertion.
    pub points: Vec<CloudPoint>,
}

/// A point of a cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudPoint {
    /// Position in the frame of the object, metres.
    pub position: [f64; 3],
    /// Red, green, blue.
    pub colour: [u8; 3],
}

impl PointCloud {
    /// Adds points, except for those that have another within `tolerance` metres. Points that are nowhere are left out.
    pub fn insert(&mut self, points: impl Iterator<Item = CloudPoint>, tolerance: f64) {
        let mut near = NeighbourGrid::new(tolerance);
        self.points
            .iter()
            .for_each(|point| near.add(point.position));
        for point in points.filter(|point| point.position.iter().all(|c| c.is_finite())) {
            if !near.finds(point.position) {
                near.add(point.position);
                self.points.push(point);
            }
        }
    }

    /// Removes the points that lie within `tolerance` metres of one of `places`.
    pub fn remove(&mut self, places: impl Iterator<Item = [f64; 3]>, tolerance: f64) {
        let near = NeighbourGrid::of(places, tolerance);
        self.points.retain(|point| !near.finds(point.position));
    }

    /// Keeps only the points that lie within `tolerance` metres of one of `places`.
    pub fn intersect(&mut self, places: impl Iterator<Item = [f64; 3]>, tolerance: f64) {
        let near = NeighbourGrid::of(places, tolerance);
        self.points.retain(|point| near.finds(point.position));
    }

    /// The box around all points, in the frame of the object.
    pub fn bounding_box(&self) -> BoundingBox {
        box_around(self.points.iter().map(|point| point.position), 0.0)
    }

    /// Scales all lengths.
    pub fn scale(&mut self, factor: f64) {
        self.max_cell_size *= factor;
        self.points
            .iter_mut()
            .for_each(|point| point.position = point.position.map(|c| factor * c));
    }
}

/// Points in the cells of a grid as wide as the tolerance: neighbours are in the same cell or in one beside it.
struct NeighbourGrid {
    tolerance: f64,
    cells: HashMap<[i64; 3], Vec<[f64; 3]>>,
}

impl NeighbourGrid {
    fn new(tolerance: f64) -> Self {
        Self {
            tolerance: if tolerance > 0.0 { tolerance } else { 0.0 },
            cells: HashMap::new(),
        }
    }

    fn of(places: impl Iterator<Item = [f64; 3]>, tolerance: f64) -> Self {
        let mut near = Self::new(tolerance);
        places.for_each(|place| near.add(place));
        near
    }

    /// With a tolerance of zero no point is near.
    fn add(&mut self, place: [f64; 3]) {
        if self.tolerance > 0.0 {
            self.cells.entry(self.cell(place)).or_default().push(place);
        }
    }

    fn finds(&self, place: [f64; 3]) -> bool {
        let [x, y, z] = self.cell(place);
        let close = |other: &[f64; 3]| {
            (0..3).map(|i| (other[i] - place[i]).powi(2)).sum::<f64>() <= self.tolerance.powi(2)
        };
        let beside = |at: i64| at.saturating_sub(1)..=at.saturating_add(1);
        !self.cells.is_empty()
            && beside(x).any(|x| {
                beside(y).any(|y| {
                    beside(z).any(|z| {
                        self.cells
                            .get(&[x, y, z])
                            .is_some_and(|cell| cell.iter().any(close))
                    })
                })
            })
    }

    fn cell(&self, place: [f64; 3]) -> [i64; 3] {
        place.map(|c| (c / self.tolerance).floor() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> PointCloud {
        PointCloud {
            max_cell_size: 0.02,
            max_points_in_cell: 20,
            point_size: 2,
            uses_octree: true,
            display_fraction: 1.0,
            random_colours: false,
            points: Vec::new(),
        }
    }

    fn points(xs: &[f64]) -> impl Iterator<Item = CloudPoint> {
        xs.iter().map(|x| CloudPoint {
            position: [*x, 0.0, 0.0],
            colour: [0; 3],
        })
    }

    #[test]
    fn duplicates_are_left_out() {
        let mut cloud = cloud();
        cloud.insert(points(&[0.0, 0.0, 0.009, 0.011, f64::NAN]), 0.01);
        assert_eq!(cloud.points.len(), 2);
        cloud.insert(points(&[0.0, 0.0]), 0.0);
        assert_eq!(cloud.points.len(), 4);
    }

    #[test]
    fn what_is_near_is_removed_or_kept() {
        let mut cloud = cloud();
        cloud.insert(points(&[-0.015, 0.0, 0.015, 1.0]), 0.0);
        let mut other = cloud.clone();
        cloud.remove([[0.001, 0.0, 0.0]].into_iter(), 0.015);
        assert_eq!(cloud.points.len(), 2);
        other.intersect([[0.001, 0.0, 0.0]].into_iter(), 0.015);
        assert_eq!(other.points.len(), 2);
    }
}
