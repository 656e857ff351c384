//! A tree of boxes: whether a ray hits anything. Nothing else is asked, so that the first hit ends the search.

use std::sync::OnceLock;

use nalgebra::Vector3;

use crate::Mesh;

/// Items of a leaf, at most.
const MAX_LEAF_SIZE: usize = 4;

/// A part of a line: from the origin to the point where the direction is added `limit` times.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    pub origin: Vector3<f32>,
    pub direction: Vector3<f32>,
    pub limit: f32,
}

/// An axis-aligned box.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    pub low: Vector3<f32>,
    pub high: Vector3<f32>,
}

/// Boxes in a binary tree, split at the median.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    nodes: Vec<Node>,
    /// The numbers of the items, by leaves.
    items: Vec<u32>,
}

#[derive(Debug, Clone)]
struct Node {
    bounds: Bounds,
    /// The first item of a leaf; the second child of another node, whose first child is the next node.
    next: u32,
    /// Zero where it is no leaf.
    count: u32,
}

/// The triangles of a mesh in a tree.
#[derive(Debug, Clone, Default)]
pub struct MeshTree {
    tree: Tree,
    triangles: Vec<[Vector3<f32>; 3]>,
}

impl Bounds {
    fn around(points: impl Iterator<Item = Vector3<f32>>) -> Self {
        let empty = Self {
            low: Vector3::repeat(f32::INFINITY),
            high: Vector3::repeat(f32::NEG_INFINITY),
        };
        points.fold(empty, |all, point| Self {
            low: all.low.inf(&point),
            high: all.high.sup(&point),
        })
    }

    fn merged(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// By the slabs between its faces (T. Kay and J. Kajiya, *Ray tracing complex scenes*, 1986). Where a slab says nothing, since the
    /// ray lies in its border, `max` and `min` ignore it.
    fn is_hit(&self, ray: &Ray, inverse: &Vector3<f32>) -> bool {
        let (mut enter, mut leave) = (0.0f32, ray.limit);
        for axis in 0..3 {
            let a = (self.low[axis] - ray.origin[axis]) * inverse[axis];
            let b = (self.high[axis] - ray.origin[axis]) * inverse[axis];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        // A little longer, for the rounding of the lines above.
        enter <= leave * (1.0 + 1e-5)
    }
}

impl Tree {
    pub fn new(bounds: &[Bounds]) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            items: (0..numbers::count_u32(bounds.len())).collect(),
        };
        let mut items = std::mem::take(&mut tree.items);
        if !items.is_empty() {
            tree.add(bounds, &mut items, 0);
        }
        Self { items, ..tree }
    }

    /// Adds the node of some items, which begin at a place in the list, and those below it.
    fn add(&mut self, bounds: &[Bounds], items: &mut [u32], first: usize) {
        let whole = items
            .iter()
            .map(|item| bounds[numbers::place(*item)])
            .reduce(|a, b| a.merged(&b));
        let whole = whole.expect("a node has items");
        let at = self.nodes.len();
        self.nodes.push(Node {
            bounds: whole,
            next: numbers::count_u32(first),
            count: numbers::count_u32(items.len()),
        });
        if items.len() <= MAX_LEAF_SIZE {
            return;
        }
        let axis = (whole.high - whole.low).imax();
        let centre = |item: &u32| {
            bounds[numbers::place(*item)].low[axis] + bounds[numbers::place(*item)].high[axis]
        };
        let middle = items.len() / 2;
        items.select_nth_unstable_by(middle, |a, b| centre(a).total_cmp(&centre(b)));
        let (low, high) = items.split_at_mut(middle);
        self.add(bounds, low, first);
        (self.nodes[at].next, self.nodes[at].count) = (numbers::count_u32(self.nodes.len()), 0);
        self.add(bounds, high, first + middle);
    }

    /// Whether `hit` holds for any item whose box a ray hits.
    pub fn is_hit(&self, ray: &Ray, mut hit: impl FnMut(usize) -> bool) -> bool {
        let inverse = ray.direction.map(|part| 1.0 / part);
        // Splits at the median make at most 32 levels.
        let (mut pending, mut count) = ([0u32; 34], usize::from(!self.nodes.is_empty()));
        while count > 0 {
            count -= 1;
            let at = pending[count];
            let node = &self.nodes[numbers::place(at)];
            if !node.bounds.is_hit(ray, &inverse) {
                continue;
            }
            if node.count == 0 {
                (pending[count], pending[count + 1]) = (node.next, at + 1);
                count += 2;
            } else if self.items[numbers::place(node.next)..][..numbers::place(node.count)]
                .iter()
                .any(|item| hit(numbers::place(*item)))
            {
                return true;
            }
        }
        false
    }
}

impl MeshTree {
    fn new(mesh: &Mesh) -> Self {
        let corners = mesh.clusters.iter().flat_map(|cluster| {
            let vertices = &mesh.vertices[cluster.vertices.clone()];
            let corner = |at: u16| Vector3::from(vertices[usize::from(at)]).cast::<f32>();
            mesh.corners[cluster.triangles.clone()]
                .iter()
                .map(move |corners| corners.map(corner))
        });
        let triangles: Vec<[Vector3<f32>; 3]> = corners.collect();
        let bounds: Vec<Bounds> = triangles
            .iter()
            .map(|corners| Bounds::around(corners.iter().copied()))
            .collect();
        Self {
            tree: Tree::new(&bounds),
            triangles,
        }
    }

    pub fn is_hit(&self, ray: &Ray) -> bool {
        self.tree.is_hit(ray, |triangle| {
            is_triangle_hit(&self.triangles[triangle], ray)
        })
    }
}

impl Mesh {
    /// Built when it casts a shadow for the first time.
    pub(crate) fn tree(&self) -> &MeshTree {
        self.tree.get_or_init(|| MeshTree::new(self))
    }
}

/// Made when it is first needed.
pub type LazyTree = OnceLock<MeshTree>;

/// T. Möller and B. Trumbore, *Fast, minimum storage ray/triangle intersection* (1997), from both sides.
fn is_triangle_hit([a, b, c]: &[Vector3<f32>; 3], ray: &Ray) -> bool {
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(&ac);
    let over_determinant = 1.0 / ab.dot(&p);
    let from_a = ray.origin - a;
    let u = from_a.dot(&p) * over_determinant;
    let q = from_a.cross(&ab);
    let v = ray.direction.dot(&q) * over_determinant;
    let at = ac.dot(&q) * over_determinant;
    // False for everything that is not a number.
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 0.0 && at < ray.limit
}
