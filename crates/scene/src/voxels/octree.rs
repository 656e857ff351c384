//! Octrees: the cells of a grid that are occupied.

use std::collections::BTreeMap;

use geometry::BoundingBox;

use super::box_around;
use super::growth::Growth;

/// A grid of cubic cells along the axes of the object, with a boundary at its origin; some cells are voxels.
#[derive(Debug, Clone, PartialEq)]
pub struct OcTree {
    voxel_size: f64,
    /// Displayed size of a point, pixels.
    pub point_size: f64,
    /// Shown as points, not as cubes.
    pub shows_points: bool,
    /// Option of its creation, stored and read back; scripts choose the colours.
    pub random_colours: bool,
    voxels: BTreeMap<Cell, Voxel>,
    pub(super) growth: Growth,
}

/// How many cells from the origin: z, y, x, so that layers follow each other.
pub(super) type Cell = [i32; 3];

/// The content of an occupied cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Voxel {
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// A number of the script that put it there.
    pub tag: u32,
}

impl OcTree {
    /// An octree without voxels. The edge of a cell is within 1 mm and 1 m.
    pub fn new(voxel_size: f64, point_size: f64) -> Self {
        let voxels = BTreeMap::new();
        Self {
            voxel_size: cell_size(voxel_size),
            point_size,
            shows_points: false,
            random_colours: false,
            voxels,
            growth: Growth::default(),
        }
    }

    /// The edge of a cell, metres.
    pub fn voxel_size(&self) -> f64 {
        self.voxel_size
    }

    /// Changes the edge of the cells; voxels go to the cells that hold their centres now.
    pub fn set_voxel_size(&mut self, size: f64) {
        let old: Vec<_> = self.voxels().collect();
        self.voxel_size = cell_size(size);
        self.clear();
        old.into_iter()
            .for_each(|(centre, voxel)| self.insert(centre, voxel));
    }

    /// Scales all lengths.
    pub fn scale(&mut self, factor: f64) {
        self.voxel_size *= factor;
        self.growth = Growth::default();
    }

    /// Occupies the cell a point is in. Points too far away for the grid are left out.
    pub fn insert(&mut self, point: [f64; 3], voxel: Voxel) {
        if let Some(cell) = self.cell(point)
            && self.voxels.insert(cell, voxel).is_none()
        {
            self.growth.add(cell);
        }
    }

    /// Empties the cell a point is in.
    pub fn remove(&mut self, point: [f64; 3]) {
        if let Some(cell) = self.cell(point)
            && self.voxels.remove(&cell).is_some()
        {
            self.growth = Growth::default();
        }
    }

    /// Empties all cells.
    pub fn clear(&mut self) {
        self.voxels.clear();
        self.growth = Growth::default();
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.voxels.len()
    }

    /// Whether there is no voxel.
    pub fn is_empty(&self) -> bool {
        self.voxels.is_empty()
    }

    /// Voxel of the cell that contains the point.
    pub fn voxel_at(&self, point: [f64; 3]) -> Option<&Voxel> {
        self.voxels.get(&self.cell(point)?)
    }

    /// Centres in the frame of the object, and what is there.
    pub fn voxels(&self) -> impl Iterator<Item = ([f64; 3], Voxel)> {
        self.voxels
            .iter()
            .map(|(cell, voxel)| (self.centre(*cell), *voxel))
    }

    pub(super) fn centre(&self, [z, y, x]: Cell) -> [f64; 3] {
        [x, y, z].map(|at| (f64::from(at) + 0.5) * self.voxel_size)
    }

    /// The box around all voxels, in the frame of the object.
    pub fn bounding_box(&self) -> BoundingBox {
        box_around(self.voxels().map(|(centre, _)| centre), self.voxel_size)
    }

    /// The centres of the voxels in the layers between two heights.
    pub(crate) fn layers(&self, low: f64, high: f64) -> impl Iterator<Item = [f64; 3]> {
        let layer = |height: f64| (height / self.voxel_size).floor() as i32;
        let (first, last) = (layer(low), layer(high));
        let cells = [first, i32::MIN, i32::MIN]..=[last.max(first), i32::MAX, i32::MAX];
        self.voxels.range(cells).map(|(cell, _)| self.centre(*cell))
    }

    fn cell(&self, [x, y, z]: [f64; 3]) -> Option<Cell> {
        let at = |c: f64| {
            let cell = (c / self.voxel_size).floor();
            (cell.abs() < f64::from(1 << 30)).then_some(cell as i32)
        };
        Some([at(z)?, at(y)?, at(x)?])
    }
}

/// The edge of a cell, within what is sensible, metres.
pub fn cell_size(wanted: f64) -> f64 {
    if wanted.is_finite() {
        wanted.clamp(0.001, 1.0)
    } else {
        0.001
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VOXEL: Voxel = Voxel {
        colour: [1, 2, 3],
        tag: 4,
    };

    #[test]
    fn points_of_a_cell_are_one_voxel() {
        let mut tree = OcTree::new(0.05, 1.0);
        tree.insert([0.12, 0.07, -0.03], VOXEL);
        tree.insert([0.10001, 0.0501, -0.049], VOXEL);
        let (centre, voxel) = tree.voxels().next().unwrap();
        assert!(
            centre
                .iter()
                .zip([0.125, 0.075, -0.025])
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert_eq!((tree.len(), voxel), (1, VOXEL));
        assert_eq!(tree.voxel_at([0.11, 0.06, -0.01]), Some(&VOXEL));
        tree.remove([0.11, 0.06, -0.01]);
        assert!(tree.is_empty());
    }

    #[test]
    fn what_is_nowhere_is_left_out() {
        let mut tree = OcTree::new(f64::NAN, 1.0);
        [f64::NAN, f64::INFINITY, 1e300]
            .into_iter()
            .for_each(|far| tree.insert([far, 0.0, 0.0], VOXEL));
        assert!(tree.is_empty());
    }
}
