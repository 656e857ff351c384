//! Bodies of octrees that grow: what comes is added in parts, so that not all voxels are prepared again for a few.

use proximity::VoxelGrid;
use scene::voxels::growth::Seen;
use scene::voxels::octree::OcTree;

use super::body::Part;

/// How the parts of the body of an octree came about.
#[derive(Debug)]
pub(super) struct Growth {
    seen: Seen,
    /// How many voxels each part has. Each has more than all behind it, so that there are few.
    sizes: Vec<usize>,
}

impl Growth {
    /// Of a body with all voxels in one part.
    pub(super) fn of(tree: &OcTree) -> Self {
        Self {
            seen: tree.seen(),
            sizes: vec![tree.len()],
        }
    }

    /// Brings parts up to date; false when all voxels have to be looked at.
    pub(super) fn follow(&mut self, tree: &OcTree, parts: &mut Vec<Part>) -> bool {
        let Some(mut count) = tree.grown_since(&self.seen) else {
            return false;
        };
        self.seen = tree.seen();
        if count == 0 {
            return true;
        }
        while let Some(size) = self.sizes.pop_if(|size| *size <= count) {
            count += size;
            parts.pop();
        }
        let grid = VoxelGrid::new(tree.voxel_size(), tree.last_added(count));
        let Some(grid) = grid.filter(|_| !self.sizes.is_empty()) else {
            return false;
        };
        self.sizes.push(count);
        parts.push(Part::of_voxels(grid));
        true
    }
}
