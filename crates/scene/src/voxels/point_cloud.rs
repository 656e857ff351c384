//! Point clouds.

use geometry::BoundingBox;

use super::box_around;
use super::cloud_points::CloudPoints;

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
    pub points: CloudPoints,
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
        let finite = points.filter(|point| point.position.iter().all(|c| c.is_finite()));
        self.points.insert(finite, tolerance);
    }

    /// Removes the points that lie within `tolerance` metres of one of `places`.
    pub fn remove(&mut self, places: &[[f64; 3]], tolerance: f64) {
        self.points.keep(false, places, tolerance);
    }

    /// Keeps only the points that lie within `tolerance` metres of one of `places`.
    pub fn intersect(&mut self, places: &[[f64; 3]], tolerance: f64) {
        self.points.keep(true, places, tolerance);
    }

    /// The box around all points, in the frame of the object.
    pub fn bounding_box(&self) -> BoundingBox {
        box_around(self.points.iter().map(|point| point.position), 0.0)
    }

    /// Scales all lengths.
    pub fn scale(&mut self, factor: f64) {
        self.max_cell_size *= factor;
        self.points.scale(factor);
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
            points: CloudPoints::default(),
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
        cloud.remove(&[[0.001, 0.0, 0.0]], 0.015);
        assert_eq!(cloud.points.len(), 2);
        other.intersect(&[[0.001, 0.0, 0.0]], 0.015);
        assert_eq!(other.points.len(), 2);
    }
}
