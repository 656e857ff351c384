//! A tree of boxes that come, go and move: an index over the objects of a scene.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use crate::bounds::Bounds;
use crate::ray::Ray;

/// No node.
const NONE: u32 = u32::MAX;

/// Boxes with a number each, in a tree. Queries take the logarithm of how many there are, and so do changes.
///
/// A new box goes where it makes the boxes above it grow least; on the way back to the root, neighbours change places where that makes a box
/// smaller (A. Kensler, *Tree rotations for improving bounding volume hierarchies*, 2008). The same calls make the same tree.
///
/// ```
/// use proximity::{Bounds, BoundsTree};
///
/// let mut tree = BoundsTree::default();
/// for key in 0..10 {
///     let x = f64::from(key);
///     tree.insert(key, &Bounds { min: [x, 0.0, 0.0], max: [x + 0.5, 1.0, 1.0] });
/// }
/// tree.remove(3);
/// let mut met = Vec::new();
/// tree.along_ray([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0], [0.0, 6.0], |key, limit| {
///     met.push(key);
///     limit
/// });
/// assert_eq!(met, [0, 1, 2, 4, 5]);
/// ```
#[derive(Debug, Clone)]
pub struct BoundsTree {
    nodes: Vec<Node>,
    /// Places in `nodes` that are unused.
    free: Vec<u32>,
    root: u32,
    leaves: BTreeMap<u32, u32>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    parent: u32,
    /// Both `NONE` for a leaf.
    children: [u32; 2],
    key: u32,
    /// Leaves below, itself included.
    count: u32,
}

impl Default for BoundsTree {
    /// A tree without boxes.
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            free: Vec::new(),
            root: NONE,
            leaves: BTreeMap::new(),
        }
    }
}

impl BoundsTree {
    /// Inserts a box, or moves the one that has the number. A box with a coordinate that is not
    /// finite is not stored.
    pub fn insert(&mut self, key: u32, bounds: &Bounds) {
        if self.bounds_of(key) == Some(*bounds) {
            return;
        }
        self.remove(key);
        if bounds.min.iter().chain(&bounds.max).any(|x| !x.is_finite()) {
            return;
        }
        let leaf = self.add(Node {
            bounds: *bounds,
            parent: NONE,
            children: [NONE; 2],
            key,
            count: 1,
        });
        self.leaves.insert(key, leaf);
        if self.root == NONE {
            self.root = leaf;
        } else {
            self.join(leaf, self.sibling_for(bounds));
        }
    }

    /// Removes the box with a number; whether there was one.
    pub fn remove(&mut self, key: u32) -> bool {
        let Some(leaf) = self.leaves.remove(&key) else {
            return false;
        };
        let parent = self.at(leaf).parent;
        self.free.push(leaf);
        if parent == NONE {
            self.root = NONE;
            return true;
        }
        let Node {
            children,
            parent: above,
            ..
        } = *self.at(parent);
        let sibling = if children[0] == leaf {
            children[1]
        } else {
            children[0]
        };
        self.free.push(parent);
        self.replace_child(above, parent, sibling);
        self.refit(above);
        true
    }

    /// The box with a number.
    pub fn bounds_of(&self, key: u32) -> Option<Bounds> {
        self.leaves.get(&key).map(|leaf| self.at(*leaf).bounds)
    }

    /// The box around all boxes; [`Bounds::EMPTY`] without any.
    pub fn bounds(&self) -> Bounds {
        if self.root == NONE {
            Bounds::EMPTY
        } else {
            self.at(self.root).bounds
        }
    }

    /// How many boxes there are.
    pub fn len(&self) -> usize {
        self.leaves.len()
    }

    /// Whether there is no box.
    pub fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    /// Visits the boxes that have a point in common with `bounds`, in no particular but always the same order.
    pub fn overlapping(&self, bounds: &Bounds, mut visit: impl FnMut(u32)) {
        let mut open = Vec::with_capacity(64);
        open.extend((self.root != NONE).then_some(self.root));
        while let Some(node) = open.pop() {
            let node = self.at(node);
            if !node.bounds.overlaps(bounds) {
                continue;
            }
            if node.children[0] == NONE {
                visit(node.key);
            } else {
                open.extend(node.children);
            }
        }
    }

    /// Visits boxes by ascending `lower_bound`, as long as it is smaller than the limit; equal ones by their numbers. `visit` gets the number, its
    /// bound and the limit, and returns the new limit.
    ///
    /// `lower_bound` of a box must not be larger than that of a box inside of it: a distance, for example. Infinity leaves a box out.
    pub fn nearest_first(
        &self,
        lower_bound: impl Fn(&Bounds) -> f64,
        mut limit: f64,
        mut visit: impl FnMut(u32, f64, f64) -> f64,
    ) {
        let mut open = BinaryHeap::with_capacity(64);
        let put = |open: &mut BinaryHeap<Next>, node: u32, limit| {
            let bound = lower_bound(&self.at(node).bounds);
            if bound < limit {
                open.push(Next {
                    bound,
                    is_leaf: self.at(node).children[0] == NONE,
                    key: self.at(node).key,
                    node,
                });
            }
        };
        if self.root != NONE {
            put(&mut open, self.root, limit);
        }
        while let Some(Next {
            bound,
            is_leaf,
            key,
            node,
        }) = open.pop()
        {
            if bound >= limit {
                return;
            }
            if is_leaf {
                limit = visit(key, bound, limit);
            } else {
                self.at(node)
                    .children
                    .into_iter()
                    .for_each(|child| put(&mut open, child, limit));
            }
        }
    }

    /// Visits the boxes that a ray meets between the two distances of `range`, mostly near ones first. `visit` gets the number and the distance up to
    /// which the ray counts, and returns a new one. Distances are multiples of the length of `direction`.
    pub fn along_ray(
        &self,
        origin: [f64; 3],
        direction: [f64; 3],
        [from, mut to]: [f64; 2],
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        let is_ray =
            origin.iter().chain(&direction).all(|x| x.is_finite()) && direction != [0.0; 3];
        if self.root == NONE || !is_ray {
            return;
        }
        let ray = Ray::new(origin.into(), direction.into());
        let entry = |node: u32, to| ray.entry(&self.at(node).bounds, from, to);
        let mut open = Vec::with_capacity(64);
        open.push((entry(self.root, to), self.root));
        while let Some((enter, node)) = open.pop() {
            if !(enter <= to && enter < f64::INFINITY) {
                continue;
            }
            let node = self.at(node);
            if node.children[0] == NONE {
                to = visit(node.key, to);
                continue;
            }
            let [a, b] = node.children.map(|child| (entry(child, to), child));
            open.extend(if a.0 <= b.0 { [b, a] } else { [a, b] });
        }
    }

    #[inline]
    fn at(&self, node: u32) -> &Node {
        &self.nodes[node as usize]
    }

    fn at_mut(&mut self, node: u32) -> &mut Node {
        &mut self.nodes[node as usize]
    }

    fn add(&mut self, node: Node) -> u32 {
        if let Some(place) = self.free.pop() {
            *self.at_mut(place) = node;
            return place;
        }
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// The node beside which a box makes the boxes above grow least, found by descending where the growth is smaller.
    fn sibling_for(&self, bounds: &Bounds) -> u32 {
        let growth = |node: u32| {
            let Node {
                bounds: own,
                children,
                count,
                ..
            } = self.at(node);
            let joined = own.merged(bounds).half_area();
            (
                if children[0] == NONE {
                    joined
                } else {
                    joined - own.half_area()
                },
                *count,
            )
        };
        let mut node = self.root;
        loop {
            let Node {
                bounds: own,
                children: [left, right],
                ..
            } = *self.at(node);
            if left == NONE {
                return node;
            }
            let joined = own.merged(bounds).half_area();
            let (a, b) = (growth(left), growth(right));
            let is_left = a.0 < b.0 || (a.0 == b.0 && a.1 <= b.1);
            let (least, child) = if is_left { (a.0, left) } else { (b.0, right) };
            if joined < joined - own.half_area() + least {
                return node;
            }
            node = child;
        }
    }

    /// Puts a leaf beside a node, below a new parent of both.
    fn join(&mut self, leaf: u32, sibling: u32) {
        let above = self.at(sibling).parent;
        let bounds = self.at(sibling).bounds;
        let parent = self.add(Node {
            bounds,
            parent: above,
            children: [sibling, leaf],
            key: 0,
            count: 0,
        });
        self.replace_child(above, sibling, parent);
        self.at_mut(sibling).parent = parent;
        self.at_mut(leaf).parent = parent;
        self.refit(parent);
    }

    fn replace_child(&mut self, above: u32, old: u32, new: u32) {
        self.at_mut(new).parent = above;
        if above == NONE {
            self.root = new;
        } else {
            let slot = usize::from(self.at(above).children[1] == old);
            self.at_mut(above).children[slot] = new;
        }
    }

    /// Renews the boxes from a node to the root.
    fn refit(&mut self, mut node: u32) {
        while node != NONE {
            self.renew(node);
            self.rotate(node);
            node = self.at(node).parent;
        }
    }

    fn renew(&mut self, node: u32) {
        let [a, b] = self.at(node).children;
        let (bounds, count) = (
            self.at(a).bounds.merged(&self.at(b).bounds),
            self.at(a).count + self.at(b).count,
        );
        (self.at_mut(node).bounds, self.at_mut(node).count) = (bounds, count);
    }

    /// Lets a child and a grandchild on the other side change places where that makes the other child's box smaller, or no larger and the tree
    /// more even.
    fn rotate(&mut self, node: u32) {
        let children = self.at(node).children;
        let mut best = ((0.0, 0), None);
        for side in [0, 1] {
            let (lone, parent) = (children[side], children[1 - side]);
            let grandchildren = self.at(parent).children;
            if grandchildren[0] == NONE {
                continue;
            }
            for slot in [0, 1] {
                let kept = self.at(grandchildren[1 - slot]).bounds;
                let gain = self.at(parent).bounds.half_area()
                    - kept.merged(&self.at(lone).bounds).half_area();
                let evenness =
                    i64::from(self.at(grandchildren[slot]).count) - i64::from(self.at(lone).count);
                if (gain, evenness) > best.0 {
                    best = ((gain, evenness), Some((side, slot)));
                }
            }
        }
        let Some((side, slot)) = best.1 else { return };
        let (lone, parent) = (children[side], children[1 - side]);
        let grandchild = self.at(parent).children[slot];
        self.at_mut(node).children[side] = grandchild;
        self.at_mut(grandchild).parent = node;
        self.at_mut(parent).children[slot] = lone;
        self.at_mut(lone).parent = parent;
        self.renew(parent);
    }
}

/// A node that waits: the smallest bound first, then nodes before leaves, so that equal leaves meet in the heap.
struct Next {
    bound: f64,
    is_leaf: bool,
    key: u32,
    node: u32,
}

impl Ord for Next {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = |next: &Self| (next.is_leaf, next.key, next.node);
        other
            .bound
            .total_cmp(&self.bound)
            .then_with(|| order(other).cmp(&order(self)))
    }
}

impl PartialOrd for Next {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Next {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Next {}
