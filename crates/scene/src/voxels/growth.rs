//! What came to an octree since someone has looked.

use std::rc::Rc;

use super::octree::{Cell, OcTree};

/// The cells that became voxels, in that order, since one was last emptied.
#[derive(Debug, Default)]
pub(super) struct Growth {
    /// Another one after each time that a cell was emptied, and in each copy.
    beginning: Rc<()>,
    pub(super) added: Vec<Cell>,
}

impl Growth {
    /// A cell became a voxel.
    pub(super) fn add(&mut self, cell: Cell) {
        self.added.push(cell);
    }
}

impl Clone for Growth {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Growth {
    /// Octrees are equal that have the same voxels, however they came about.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What a reader knows of the voxels of an octree.
#[derive(Debug, Clone)]
pub struct Seen {
    beginning: Rc<()>,
    count: usize,
}

impl OcTree {
    /// What is known to an index of all voxels now.
    pub fn seen(&self) -> Seen {
        Seen {
            beginning: Rc::clone(&self.growth.beginning),
            count: self.growth.added.len(),
        }
    }

    /// How many voxels came since; None when voxels went, or the octree is another one.
    pub fn grown_since(&self, seen: &Seen) -> Option<usize> {
        let Growth { beginning, added } = &self.growth;
        Rc::ptr_eq(beginning, &seen.beginning).then(|| added.len() - seen.count)
    }

    /// The centres of the voxels that came last, in the frame of the object, layer by layer.
    pub fn last_added(&self, count: usize) -> impl Iterator<Item = [f64; 3]> {
        let added = &self.growth.added;
        let mut cells = added[added.len().saturating_sub(count)..].to_vec();
        cells.sort_unstable();
        cells.into_iter().map(|cell| self.centre(cell))
    }
}

#[cfg(test)]
mod tests {
    use crate::voxels::octree::{OcTree, Voxel};

    const VOXEL: Voxel = Voxel {
        colour: [1, 2, 3],
        tag: 4,
    };

    #[test]
    fn what_came_is_known_until_something_goes() {
        let mut tree = OcTree::new(0.1, 1.0);
        tree.insert([0.05, 0.0, 0.0], VOXEL);
        let seen = tree.seen();
        for x in [0.35, 0.25, 0.01] {
            tree.insert([x, 0.0, 0.0], VOXEL);
        }
        assert_eq!(tree.grown_since(&seen), Some(2));
        let last: Vec<f64> = tree.last_added(2).map(|[x, ..]| x).collect();
        assert!((last[0] - 0.25).abs() < 1e-12 && (last[1] - 0.35).abs() < 1e-12);
        assert_eq!(tree.clone().grown_since(&seen), None);
        tree.remove([5.0; 3]);
        assert_eq!(tree.grown_since(&seen), Some(2));
        let mut scaled = [tree.clone(), tree.clone(), tree];
        let seen = scaled.each_ref().map(OcTree::seen);
        scaled[0].scale(2.0);
        scaled[1].remove([0.05, 0.0, 0.0]);
        scaled[2].clear();
        let grown = scaled.iter().zip(&seen);
        assert!(
            grown
                .into_iter()
                .all(|(tree, seen)| tree.grown_since(seen).is_none())
        );
    }
}
