//! Normals that parry gets wrong: of faces that touch to the last digit it finds none, or any direction, some of them deep inside of the bodies.
//!
//! A direction along which the shapes are farther apart than along the one that was found shows the mistake. Apart by a micrometre they have a normal.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::shape::{Shape, TypedShape};

use super::points::Manifold;

/// How far shapes are moved apart of which the normal is wrong, metres.
const NUDGE: f64 = 1e-6;
/// Distance up to which a normal that is found may be any direction, metres.
const TOUCHING: f64 = 1e-6;
/// Depth from which on it is looked for a better way out, metres.
const DEEP: f64 = 1e-4;

/// The way by which the second shape is to be moved before the normal of a manifold can be found, in the frame of the first; None where it is right.
pub(super) fn way_out(
    manifold: &Manifold,
    apart: &EnginePose,
    shapes: [&dyn Shape; 2],
) -> Option<Vector> {
    let distances = manifold.points.iter().map(|found| found.dist);
    let nearest = distances.min_by(f64::total_cmp)?;
    if manifold.local_n1.length_squared() < 0.5 {
        return Some(apart.translation.normalize_or_zero() * NUDGE);
    }
    if nearest >= -DEEP && nearest.abs() >= TOUCHING {
        return None;
    }
    let parts = Parts::of(manifold, apart, shapes)?;
    let found = parts.separation(manifold.local_n1);
    if nearest >= -DEEP && found >= nearest - TOUCHING {
        return None;
    }
    let (distance, axis) = parts.farthest()?;
    let way = axis * (NUDGE - distance.min(0.0));
    let turned = |pose: &EnginePose| pose.rotation * way;
    (found < distance - TOUCHING).then(|| manifold.subshape_pos1().map_or(way, turned))
}

/// Takes back from the distances of a manifold that the second shape was moved.
pub(super) fn move_back(manifold: &mut Manifold, way: Vector) {
    let way = match manifold.subshape_pos1() {
        Some(pose) => pose.rotation.inverse() * way,
        None => way,
    };
    let along = way.dot(manifold.local_n1);
    for found in &mut manifold.points {
        found.dist -= along;
    }
}

/// The convex parts of two shapes that a manifold is about, in the frame of the first.
struct Parts<'a> {
    shapes: [&'a dyn Shape; 2],
    second: EnginePose,
}

impl<'a> Parts<'a> {
    /// None where one of them is not convex.
    fn of(manifold: &Manifold, apart: &EnginePose, shapes: [&'a dyn Shape; 2]) -> Option<Self> {
        let placed = |part: Option<&EnginePose>| part.copied().unwrap_or(EnginePose::IDENTITY);
        let second = *apart * placed(manifold.subshape_pos2());
        let first = part_of(shapes[0], manifold.subshape1)?;
        Some(Self {
            shapes: [first, part_of(shapes[1], manifold.subshape2)?],
            second: placed(manifold.subshape_pos1()).inv_mul(&second),
        })
    }

    /// How far apart they are along a direction from the first to the second; negative where they overlap.
    fn separation(&self, axis: Vector) -> f64 {
        let [first, second] = self.shapes.map(Shape::as_support_map);
        let (Some(first), Some(second)) = (first, second) else {
            return f64::NEG_INFINITY;
        };
        let back = self.second.rotation.inverse() * -axis;
        let nearest = self.second * second.local_support_point(back);
        (nearest - first.local_support_point(axis)).dot(axis)
    }

    /// The normal of one of their faces along which they are farthest apart, and how far.
    fn farthest(&self) -> Option<(f64, Vector)> {
        let [first, second] = self.shapes.map(faces);
        let turned = second
            .into_iter()
            .map(|axis| -(self.second.rotation * axis));
        let axes = first.into_iter().chain(turned);
        let apart = axes.map(|axis| (self.separation(axis), axis));
        apart.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// A part of a group of shapes, or the shape itself, where it is convex.
fn part_of(shape: &dyn Shape, part: u32) -> Option<&dyn Shape> {
    let part = match shape.as_compound() {
        Some(group) => &*group.shapes().get(part as usize)?.1,
        None => shape,
    };
    part.as_support_map().map(|_| part)
}

/// Normals of the flat faces of a shape.
fn faces(shape: &dyn Shape) -> Vec<Vector> {
    let both = |axis: Vector| [axis, -axis];
    match shape.as_typed_shape() {
        TypedShape::Cuboid(_) => [Vector::X, Vector::Y, Vector::Z]
            .into_iter()
            .flat_map(both)
            .collect(),
        TypedShape::ConvexPolyhedron(hull) => hull.faces().iter().map(|face| face.normal).collect(),
        TypedShape::Cylinder(_) | TypedShape::Cone(_) => both(Vector::Y).into(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::parry::shape::{Ball, Cuboid, Cylinder};

    use super::*;

    #[test]
    fn a_cuboid_has_six_faces_and_a_cylinder_two() {
        let cuboid = faces(&Cuboid::new(Vector::ONE));
        for axis in [Vector::X, Vector::Y, Vector::Z] {
            assert!(cuboid.contains(&axis) && cuboid.contains(&-axis));
        }
        assert_eq!(cuboid.len(), 6);
        assert_eq!(faces(&Cylinder::new(1.0, 0.5)), [Vector::Y, -Vector::Y]);
        assert!(faces(&Ball::new(1.0)).is_empty());
    }

    #[test]
    fn shapes_are_farthest_apart_along_the_axis_of_their_gap() {
        let (cube, plate) = (
            Cuboid::new(Vector::splat(0.5)),
            Cuboid::new(Vector::new(1.0, 1.0, 0.1)),
        );
        // Beside each other with a gap of 0.25 m, at heights that overlap by 0.4 m.
        let mut apart = EnginePose::IDENTITY;
        apart.translation = Vector::new(-1.75, 0.0, 0.2);
        let parts = Parts {
            shapes: [&cube, &plate],
            second: apart,
        };
        for (axis, expected) in [
            (-Vector::X, 0.25),
            (Vector::X, -3.25),
            (Vector::Z, -0.4),
            (-Vector::Z, -0.8),
            (Vector::Y, -1.5),
        ] {
            let found = parts.separation(axis);
            assert!((found - expected).abs() < 1e-12, "{axis:?}: {found}");
        }
        let (distance, axis) = parts.farthest().expect("they have faces");
        assert!((distance - 0.25).abs() < 1e-12 && axis == -Vector::X);
    }
}
