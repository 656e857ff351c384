//! Boxes whose axes fit the surface in them: flat where the surface is, so that lower bounds of distances are tight.

use std::ops::Range;

use nalgebra::Matrix3;

use crate::bounds::Bounds;
use crate::primitive::{Triangle, Vector};
use crate::tree::{Node, Tree};

/// The length of the sum of a surface's normals as a fraction of the sum of their lengths: below it the box has the axes of the frame.
const MIN_NORMAL_COHERENCE: f64 = 0.5;

/// A box with axes of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OrientedBox {
    pub centre: Vector,
    /// Unit vectors as columns.
    pub axes: Matrix3<f64>,
    pub half: Vector,
}

impl OrientedBox {
    #[inline]
    pub fn upright(bounds: &Bounds) -> Self {
        Self {
            centre: bounds.centre().into(),
            axes: Matrix3::identity(),
            half: bounds.half_size().into(),
        }
    }

    /// Square of the distance of a point (m²); 0 inside.
    #[inline]
    pub fn distance_squared_to_point(&self, p: &Vector) -> f64 {
        let apart = self.axes.tr_mul(&(p - self.centre)).abs() - self.half;
        apart
            .iter()
            .map(|x| if *x > 0.0 { x * x } else { 0.0 })
            .sum()
    }

    /// How far it reaches from its centre along a direction.
    #[inline]
    fn reach(&self, direction: &Vector) -> f64 {
        self.axes.tr_mul(direction).abs().dot(&self.half)
    }

    fn half_area(&self) -> f64 {
        let [x, y, z] = self.half.into();
        4.0 * (x * y + y * z + z * x)
    }

    /// The box with the given axes around intervals along them, each the lowest and the highest place.
    fn around(axes: &Matrix3<f64>, intervals: [[f64; 2]; 3]) -> Self {
        let middle = Vector::from(intervals.map(|[low, high]| 0.5 * (low + high)));
        let half = Vector::from(intervals.map(|[low, high]| 0.5 * (high - low)));
        Self {
            centre: axes * middle,
            axes: *axes,
            half,
        }
    }
}

/// Nodes with up to so many triangles get the smallest box with its axes; boxes of larger nodes are around those of their children.
const MAX_TRIANGLES_FOR_OWN_BOX: usize = 128;

/// The triangles below a node.
#[derive(Clone, Default)]
struct Surface {
    items: Range<usize>,
    /// Sum of their normals, weighted by area.
    normal: Vector,
    /// Sum of the lengths of these.
    length: f64,
}

/// A box for each node of a tree over triangles.
pub(crate) fn boxes_of(tree: &Tree, triangles: &[Triangle]) -> Vec<OrientedBox> {
    let surfaces = surfaces_of(tree, triangles);
    let mut boxes: Vec<OrientedBox> = tree
        .nodes
        .iter()
        .map(|node| OrientedBox::upright(&node.bounds))
        .collect();
    // Children lie behind their parents.
    for (i, node) in tree.nodes.iter().enumerate().rev() {
        let Some(axes) = axes(node, &surfaces[i]) else {
            continue;
        };
        let items = surfaces[i].items.clone();
        let fitted = if items.len() <= MAX_TRIANGLES_FOR_OWN_BOX {
            around_corners(&axes, &triangles[items])
        } else {
            around_boxes(
                &axes,
                tree.children(node).map(|child| boxes[child as usize]),
            )
        };
        if fitted.half_area() < boxes[i].half_area() {
            boxes[i] = fitted;
        }
    }
    boxes
}

fn surfaces_of(tree: &Tree, triangles: &[Triangle]) -> Vec<Surface> {
    let mut surfaces = vec![Surface::default(); tree.nodes.len()];
    for (i, node) in tree.nodes.iter().enumerate().rev() {
        surfaces[i] = if node.is_leaf() {
            Surface::of_leaf(node.items(), triangles)
        } else {
            let [first, last] = tree.children(node).map(|child| &surfaces[child as usize]);
            Surface {
                items: first.items.start..last.items.end,
                normal: first.normal + last.normal,
                length: first.length + last.length,
            }
        };
    }
    surfaces
}

impl Surface {
    fn of_leaf(items: Range<usize>, triangles: &[Triangle]) -> Self {
        let normals = triangles[items.clone()]
            .iter()
            .map(|[a, b, c]| (b - a).cross(&(c - a)));
        let (normal, length) = normals.fold((Vector::zeros(), 0.0), |sum, normal| {
            (sum.0 + normal, sum.1 + normal.norm())
        });
        Self {
            items,
            normal,
            length,
        }
    }
}

/// Axes along the mean normal, and along the longest side of the upright box as far as it is across the normal. `None` for what is curved too
/// much for it.
fn axes(node: &Node, Surface { normal, length, .. }: &Surface) -> Option<Matrix3<f64>> {
    if normal.norm() <= MIN_NORMAL_COHERENCE * length {
        return None;
    }
    let normal = normal.normalize();
    let extents = Vector::from(node.bounds.half_size());
    let across = |axis: usize| extents[axis] * (1.0 - normal[axis] * normal[axis]);
    let longest = (1..3).fold(0, |best, axis| {
        if across(axis) > across(best) {
            axis
        } else {
            best
        }
    });
    let side = Vector::ith(longest, 1.0);
    let first = (side - normal * normal[longest]).try_normalize(1e-6)?;
    Some(Matrix3::from_columns(&[
        normal,
        first,
        normal.cross(&first),
    ]))
}

fn around_corners(axes: &Matrix3<f64>, triangles: &[Triangle]) -> OrientedBox {
    let mut intervals = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for corner in triangles.iter().flatten() {
        let places = axes.tr_mul(corner);
        for (interval, place) in intervals.iter_mut().zip(places.iter()) {
            *interval = [interval[0].min(*place), interval[1].max(*place)];
        }
    }
    OrientedBox::around(axes, intervals)
}

fn around_boxes(axes: &Matrix3<f64>, boxes: [OrientedBox; 2]) -> OrientedBox {
    let interval = |axis: usize| {
        let direction = axes.column(axis).into_owned();
        let [a, b] = boxes.map(|own| (own.centre.dot(&direction), own.reach(&direction)));
        [(a.0 - a.1).min(b.0 - b.1), (a.0 + a.1).max(b.0 + b.1)]
    };
    OrientedBox::around(axes, [0, 1, 2].map(interval))
}
