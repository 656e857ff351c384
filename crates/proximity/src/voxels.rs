//! Voxel grids: solid cells of one size.

use geometry::MAX_COORDINATE;

use crate::bounds::Bounds;
use crate::primitive::{SolidBox, Vector};
use crate::tree::Tree;

/// Cubes of one size, each filled, with a tree over them.
#[derive(Debug, Clone)]
pub struct VoxelGrid {
    pub(crate) cells: Vec<Vector>,
    pub(crate) half: f64,
    pub(crate) tree: Tree,
}

impl VoxelGrid {
    /// Cubes with edges of length `cell` (m) around the centres, along the axes of the frame. Centres that are not finite or beyond 1e30
    /// are left out. `None` without any, and where `cell` is not positive and finite.
    pub fn new(cell: f64, cells: impl Iterator<Item = [f64; 3]>) -> Option<Self> {
        let is_possible = cell > 0.0 && cell <= MAX_COORDINATE;
        let within_range = |centre: &Vector| centre.iter().all(|x| x.abs() <= MAX_COORDINATE);
        let centres: Vec<Vector> = cells.map(Vector::from).filter(within_range).collect();
        if centres.is_empty() || !is_possible {
            return None;
        }
        let half = 0.5 * cell;
        let bounds = |centre: &Vector| Bounds {
            min: centre.map(|x| x - half).into(),
            max: centre.map(|x| x + half).into(),
        };
        let (tree, order) = Tree::build(&centres.iter().map(bounds).collect::<Vec<_>>());
        Some(Self {
            cells: order.into_iter().map(|i| centres[i as usize]).collect(),
            half,
            tree,
        })
    }

    /// The box around all cells.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    pub(crate) fn cell(&self, i: usize) -> SolidBox {
        SolidBox {
            centre: self.cells[i],
            half: Vector::repeat(self.half),
        }
    }
}
