//! Rays against geometries.

use crate::bounds::{Bounds, larger, smaller};
use crate::mesh::TriangleMesh;
use crate::placed::{Geometry, Placed};
use crate::primitive::{Triangle, Vector};
use crate::tree::{STACK, Tree};
use crate::voxels::VoxelGrid;
use geometry::Pose;

/// Which surfaces a sensor detects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Triangles whose normal points to the side of the sensor's origin.
    pub front: bool,
    /// Triangles seen from behind.
    pub back: bool,
    /// The largest angle (rad) between the direction to the detected point and the normal or its opposite.
    pub max_angle: Option<f64>,
    /// Whether any detected point will do, not only the nearest one: faster.
    pub any: bool,
}

impl Default for Filter {
    /// The nearest point of any surface.
    fn default() -> Self {
        Self {
            front: true,
            back: true,
            max_angle: None,
            any: false,
        }
    }
}

/// A detected point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// In the sensor's frame (m).
    pub point: [f64; 3],
    /// Unit normal of the triangle by its winding, not turned towards the sensor, in the sensor's frame. For points of point sets the
    /// direction to the point; zero at the origin.
    pub normal: [f64; 3],
    /// From the sensor's origin (m).
    pub distance: f64,
}

/// The point where a ray through the sensor's origin first meets a surface, between the two distances of `range` (m).
///
/// `direction` is in the sensor's frame; its length does not matter. Rays see triangles and the faces of voxels, not points. A ray through
/// an edge that two triangles share meets at least one of them. `None` without a hit, and for poses, directions and ranges that are not numbers.
pub fn cast_ray(
    on: Placed,
    sensor: &Pose,
    direction: [f64; 3],
    range: [f64; 2],
    filter: &Filter,
) -> Option<Hit> {
    let direction = Vector::from(direction);
    let is_direction = direction.iter().all(|x| x.is_finite()) && direction.amax() > 0.0;
    let unit = is_direction.then(|| (direction / direction.amax()).normalize())?;
    let place = on.relative(sensor)?;
    let ray = Ray::new(place.translation, place.rotation * unit);
    let (distance, normal) = match on.geometry {
        Geometry::Mesh(mesh) => hit_mesh(mesh, &ray, range, filter)?,
        Geometry::Voxels(grid) => hit_voxels(grid, &ray, range, filter)?,
        Geometry::Points(_) | Geometry::Point => return None,
    };
    let normal = place.rotation.transpose() * normal;
    Some(Hit {
        point: (unit * distance).into(),
        normal: normal.into(),
        distance,
    })
}

/// A ray with what its tests need.
pub(crate) struct Ray {
    origin: Vector,
    direction: Vector,
    inverse: Vector,
    /// The origin for the planes where boxes are entered and left: moved by more than its rounding error, so that boxes are a bit larger.
    outside: [[f64; 3]; 2],
    /// The axis along which the ray goes most, and the two others.
    axes: [usize; 3],
    shear: [f64; 3],
}

impl Ray {
    pub fn new(origin: Vector, direction: Vector) -> Self {
        let along = direction.iamax();
        let (mut x, mut y) = ((along + 1) % 3, (along + 2) % 3);
        if direction[along] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let shear = [
            direction[x] / direction[along],
            direction[y] / direction[along],
            1.0 / direction[along],
        ];
        // A finite reciprocal of 0 saves the boxes from 0 times infinity.
        let inverse = direction.map(|d| {
            if d.abs() > 1e-300 {
                1.0 / d
            } else {
                1e300_f64.copysign(d)
            }
        });
        let margin =
            |i: usize| (origin[i].abs() * 4.0 * f64::EPSILON + 1e-290).copysign(inverse[i]);
        let outside = [
            [0, 1, 2].map(|i| origin[i] + margin(i)),
            [0, 1, 2].map(|i| origin[i] - margin(i)),
        ];
        Self {
            origin,
            direction,
            inverse,
            outside,
            axes: [x, y, along],
            shear,
        }
    }

    /// Where the ray enters a box, at the earliest at `from`; infinity if it does not before `to`.
    #[inline]
    pub fn entry(&self, bounds: &Bounds, from: f64, to: f64) -> f64 {
        let (mut enter, mut leave) = (from, to);
        for i in 0..3 {
            let (near, far) = (bounds.min[i], bounds.max[i]);
            let (near, far) = if self.inverse[i] > 0.0 {
                (near, far)
            } else {
                (far, near)
            };
            enter = larger((near - self.outside[0][i]) * self.inverse[i], enter);
            // More than the rounding errors of the two operations (T. Ize, *Robust BVH ray traversal*, 2013).
            leave = smaller(
                (far - self.outside[1][i]) * self.inverse[i] * (1.0 + 4.0 * f64::EPSILON),
                leave,
            );
        }
        if enter <= leave { enter } else { f64::INFINITY }
    }

    /// Where the line meets a triangle, edges included; whether it comes from the front. Both sides of an edge are computed from the same
    /// products, so that no ray passes between two triangles (S. Woop, *Watertight ray/triangle intersection*, 2013).
    #[inline]
    fn meet(&self, triangle: &Triangle) -> Option<(f64, bool)> {
        let [x, y, z] = self.axes;
        let [a, b, c] = triangle.map(|p| {
            let p = p - self.origin;
            [
                p[x] - self.shear[0] * p[z],
                p[y] - self.shear[1] * p[z],
                p[z],
            ]
        });
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let sum = u + v + w;
        let t = (u * a[2] + v * b[2] + w * c[2]) * self.shear[2] / sum;
        (sum != 0.0).then_some((t, sum > 0.0))
    }
}

/// A hit at a distance along the ray, with the normal there.
type Found = (f64, Vector);

fn hit_mesh(mesh: &TriangleMesh, ray: &Ray, range: [f64; 2], filter: &Filter) -> Option<Found> {
    let least = filter.max_angle.map_or(0.0, libm::cos);
    descend(&mesh.tree, ray, range, filter.any, |i, to| {
        let triangle = &mesh.triangles[i];
        let (t, front) = ray.meet(triangle)?;
        let wanted = if front { filter.front } else { filter.back };
        if !wanted || t < range[0] || t > to {
            return None;
        }
        let normal = (triangle[1] - triangle[0])
            .cross(&(triangle[2] - triangle[0]))
            .try_normalize(0.0)?;
        (least == 0.0 || normal.dot(&ray.direction).abs() >= least).then_some((t, normal))
    })
}

fn hit_voxels(grid: &VoxelGrid, ray: &Ray, range: [f64; 2], filter: &Filter) -> Option<Found> {
    let least = filter.max_angle.map_or(0.0, libm::cos);
    descend(&grid.tree, ray, range, filter.any, |i, to| {
        let sides = cell_sides(ray, &grid.cells[i], grid.half)?;
        let seen = |(t, normal): &Found, wanted: bool| {
            wanted && range[0] <= *t && *t <= to && normal.dot(&ray.direction).abs() >= least
        };
        let [entry, exit] = sides;
        seen(&entry, filter.front)
            .then_some(entry)
            .or(seen(&exit, filter.back).then_some(exit))
    })
}

/// Where the line enters and leaves a cell, with the outward normals there.
fn cell_sides(ray: &Ray, centre: &Vector, half: f64) -> Option<[Found; 2]> {
    let mut sides = [
        (f64::NEG_INFINITY, Vector::zeros()),
        (f64::INFINITY, Vector::zeros()),
    ];
    for axis in 0..3 {
        let outward = Vector::ith(axis, 1.0_f64.copysign(ray.inverse[axis]));
        let middle = (centre[axis] - ray.origin[axis]) * ray.inverse[axis];
        let reach = half * ray.inverse[axis].abs();
        if middle - reach > sides[0].0 {
            sides[0] = (middle - reach, -outward);
        }
        if middle + reach < sides[1].0 {
            sides[1] = (middle + reach, outward);
        }
    }
    (sides[0].0 <= sides[1].0).then_some(sides)
}

/// Visits the leaves along a ray, near ones first, and returns the nearest hit. `meet` looks at the thing at a place, no farther than a distance.
fn descend(
    tree: &Tree,
    ray: &Ray,
    [from, to]: [f64; 2],
    any: bool,
    mut meet: impl FnMut(usize, f64) -> Option<Found>,
) -> Option<Found> {
    let (mut best, mut limit) = (None, to);
    let mut waiting = [(0.0, 0); STACK];
    let mut depth = 1;
    waiting[0] = (ray.entry(&tree.nodes[0].bounds, from, limit), 0);
    while depth > 0 {
        depth -= 1;
        let (entry, node) = waiting[depth];
        if entry > limit || entry == f64::INFINITY {
            continue;
        }
        let node = &tree.nodes[node as usize];
        if node.is_leaf() {
            for i in node.items() {
                best = nearer(best, meet(i, limit));
                limit = best.map_or(limit, |(distance, _)| distance);
            }
            if any && best.is_some() {
                return best;
            }
            continue;
        }
        let [a, b] = tree.children(node).map(|child| {
            (
                ray.entry(&tree.nodes[child as usize].bounds, from, limit),
                child,
            )
        });
        // The nearer one is on top.
        (waiting[depth], waiting[depth + 1]) = if a.0 <= b.0 { (b, a) } else { (a, b) };
        depth += 2;
    }
    best
}

/// The nearer hit, the first one where both are equally near.
fn nearer(best: Option<Found>, other: Option<Found>) -> Option<Found> {
    match (best, other) {
        (Some(best), Some(other)) if other.0 < best.0 => Some(other),
        (Some(best), _) => Some(best),
        (None, other) => other,
    }
}
