//! Sets of points.

use heap::Lazy;

use geometry::MAX_COORDINATE;

use crate::bounds::Bounds;
use crate::primitive::Vector;
use crate::tree::Tree;

/// The single point of [`crate::Geometry::Point`].
pub(crate) static ORIGIN: Lazy<PointSet> =
    Lazy::new(|| PointSet::new(&[[0.0; 3]]).expect("the origin is a finite point"));

/// Points with a tree over them.
#[derive(Debug, Clone)]
pub struct PointSet {
    pub(crate) points: Vec<Vector>,
    pub(crate) tree: Tree,
}

impl PointSet {
    /// A set of points (m). Points that are not finite or beyond 1e30 are left out; `None` when none is left.
    pub fn new(points: &[[f64; 3]]) -> Option<Self> {
        let within_range = |p: &&[f64; 3]| p.iter().all(|x| x.abs() <= MAX_COORDINATE);
        let points: Vec<[f64; 3]> = points.iter().filter(within_range).copied().collect();
        if points.is_empty() {
            return None;
        }
        let boxes: Vec<Bounds> = points.iter().map(|p| Bounds { min: *p, max: *p }).collect();
        let (tree, order) = Tree::build(&boxes);
        Some(Self {
            points: order
                .into_iter()
                .map(|i| Vector::from(points[i as usize]))
                .collect(),
            tree,
        })
    }

    /// The box around all points.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
