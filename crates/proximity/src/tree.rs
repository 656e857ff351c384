//! A tree of boxes around things that do not move against each other, built once.
//!
//! Built from the top by the surface area heuristic over 16 bins (I. Wald, *On fast construction of SAH-based bounding volume
//! hierarchies*, 2007). Children lie behind each other, things of a leaf too.

use crate::bounds::Bounds;

/// Largest number of items in a leaf.
const MAX_LEAF_SIZE: usize = 4;
/// Bins along an axis.
const BINS: usize = 16;
/// From here on nodes are halved, so that the depth is bounded whatever the input.
const DEPTH_OF_HALVES: usize = 40;
/// Room for a stack of nodes that waits during a descent: one per level is enough.
pub(crate) const STACK: usize = DEPTH_OF_HALVES + 40;

/// A node: a leaf of `count` things from `start`, or, with a count of 0, the children `start` and `start + 1`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    pub bounds: Bounds,
    pub start: u32,
    pub count: u32,
}

impl Node {
    #[inline]
    pub fn is_leaf(&self) -> bool {
        self.count > 0
    }

    /// The places of the things in a leaf.
    #[inline]
    pub fn items(&self) -> std::ops::Range<usize> {
        self.start as usize..(self.start + self.count) as usize
    }
}

/// The tree; its first node is the root.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    pub nodes: Vec<Node>,
}

impl Tree {
    /// The tree over things with the given boxes, and the order in which it has them. There must be at least one.
    pub fn build(boxes: &[Bounds]) -> (Self, Vec<u32>) {
        let mut order: Vec<Entry> = boxes
            .iter()
            .enumerate()
            .map(|(i, bounds)| Entry::new(i, bounds))
            .collect();
        let root = Node {
            bounds: merged(&order),
            start: 0,
            count: order.len() as u32,
        };
        let mut nodes = Vec::with_capacity(boxes.len());
        nodes.push(root);
        let mut open = vec![(0, 0)];
        while let Some((node, depth)) = open.pop() {
            let Node { start, .. } = nodes[node];
            let items = nodes[node].items();
            if let Some((left, middle, right)) = divide(&mut order[items], depth) {
                let [first, middle] = [nodes.len() as u32, middle as u32];
                let count = nodes[node].count;
                nodes.push(Node {
                    bounds: left,
                    start,
                    count: middle,
                });
                nodes.push(Node {
                    bounds: right,
                    start: start + middle,
                    count: count - middle,
                });
                (nodes[node].start, nodes[node].count) = (first, 0);
                open.push((first as usize + 1, depth + 1));
                open.push((first as usize, depth + 1));
            }
        }
        (
            Self { nodes },
            order.into_iter().map(|entry| entry.index).collect(),
        )
    }

    pub fn bounds(&self) -> Bounds {
        self.nodes[0].bounds
    }

    /// The children of a node that is no leaf.
    #[inline]
    pub fn children(&self, node: &Node) -> [u32; 2] {
        [node.start, node.start + 1]
    }
}

/// Entry that is sorted during the build.
#[derive(Clone, Copy)]
struct Entry {
    bounds: Bounds,
    index: u32,
}

impl Entry {
    fn new(index: usize, bounds: &Bounds) -> Self {
        Self {
            bounds: *bounds,
            index: index as u32,
        }
    }

    /// Twice the centre along an axis: halving would not change the order.
    #[inline]
    fn centre(&self, axis: usize) -> f64 {
        self.bounds.min[axis] + self.bounds.max[axis]
    }
}

fn merged(entries: &[Entry]) -> Bounds {
    entries
        .iter()
        .fold(Bounds::EMPTY, |bounds, entry| bounds.merged(&entry.bounds))
}

/// Divides the things of a node into two groups: their boxes and how many are in the first. `None` for a leaf.
fn divide(entries: &mut [Entry], depth: usize) -> Option<(Bounds, usize, Bounds)> {
    if entries.len() <= MAX_LEAF_SIZE {
        return None;
    }
    let centres = entries.iter().fold(Bounds::EMPTY, |bounds, entry| {
        let centre = [0, 1, 2].map(|axis| entry.centre(axis));
        bounds.merged(&Bounds {
            min: centre,
            max: centre,
        })
    });
    let extent = |axis: usize| centres.max[axis] - centres.min[axis];
    let axis = (0..3).fold(0, |widest, axis| {
        if extent(axis) > extent(widest) {
            axis
        } else {
            widest
        }
    });
    let binned = if depth < DEPTH_OF_HALVES {
        divide_by_area(entries, axis, &centres)
    } else {
        None
    };
    Some(binned.unwrap_or_else(|| halve(entries, axis)))
}

/// The halves along an axis.
fn halve(entries: &mut [Entry], axis: usize) -> (Bounds, usize, Bounds) {
    let middle = entries.len() / 2;
    let by_centre = |a: &Entry, b: &Entry| {
        a.centre(axis)
            .total_cmp(&b.centre(axis))
            .then(a.index.cmp(&b.index))
    };
    entries.select_nth_unstable_by(middle, by_centre);
    (
        merged(&entries[..middle]),
        middle,
        merged(&entries[middle..]),
    )
}

/// The cut between two bins with the smallest sum of areas times numbers; `None` if all centres are in one place.
fn divide_by_area(
    entries: &mut [Entry],
    axis: usize,
    centres: &Bounds,
) -> Option<(Bounds, usize, Bounds)> {
    let scale = BINS as f64 / (centres.max[axis] - centres.min[axis]);
    if !scale.is_finite() {
        return None;
    }
    let bin_of =
        |entry: &Entry| (((entry.centre(axis) - centres.min[axis]) * scale) as usize).min(BINS - 1);
    let mut bins = [(Bounds::EMPTY, 0_usize); BINS];
    for entry in entries.iter() {
        let (bounds, count) = &mut bins[bin_of(entry)];
        (*bounds, *count) = (bounds.merged(&entry.bounds), *count + 1);
    }
    let (cut, left, right) = cheapest_cut(&bins)?;
    let middle = partition(entries, |entry| bin_of(entry) < cut);
    (0 < middle && middle < entries.len()).then_some((left, middle, right))
}

/// The first bin behind the best cut, and the boxes on both sides.
fn cheapest_cut(bins: &[(Bounds, usize); BINS]) -> Option<(usize, Bounds, Bounds)> {
    let mut behind = [(Bounds::EMPTY, 0); BINS + 1];
    for cut in (1..BINS).rev() {
        behind[cut] = (
            behind[cut + 1].0.merged(&bins[cut].0),
            behind[cut + 1].1 + bins[cut].1,
        );
    }
    let (mut before, mut number) = (Bounds::EMPTY, 0);
    let mut best: Option<(usize, Bounds, Bounds)> = None;
    let mut least = f64::INFINITY;
    for cut in 1..BINS {
        (before, number) = (before.merged(&bins[cut - 1].0), number + bins[cut - 1].1);
        let (after, rest) = behind[cut];
        if number == 0 || rest == 0 {
            continue;
        }
        let cost = before.half_area() * number as f64 + after.half_area() * rest as f64;
        if cost < least || best.is_none() {
            (least, best) = (cost, Some((cut, before, after)));
        }
    }
    best
}

/// Brings those that belong to the left to the front; how many there are.
fn partition(entries: &mut [Entry], is_left: impl Fn(&Entry) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..entries.len() {
        if is_left(&entries[i]) {
            entries.swap(i, middle);
            middle += 1;
        }
    }
    middle
}
