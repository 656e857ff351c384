//! Contacts that are none: where surfaces meet that lie in one plane, and where bodies pass each other closely.
//!
//! What is found before bodies touch is a half-space each, which reaches farther than the body it stands for. A box that slides over two tiles would stop at
//! the side face of the second one, since that is what separates them until it lies on both; a peg would stop above the rim of a hole into which it falls.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::{ShapeCastOptions, cast_shapes};
use rapier3d_f64::parry::shape::Shape;
use rapier3d_f64::prelude::{Collider, ColliderSet};

use super::points::Point;

/// Cosine of the largest angle between directions that count as one: less than a degree, as facets of meshes are found.
const MIN_NORMAL_COSINE: f64 = 0.9999;
/// Distance from which surfaces do not touch yet, metres.
pub(super) const CLEARANCE: f64 = 1e-4;
/// A body lies on what is nearer than this, metres.
const SUPPORT_DISTANCE: f64 = 5e-4;
/// How far a part that lies on a plane may reach below it, metres.
const MAX_SINKING: f64 = 1e-3;
/// Height up to which what stands out of the plane on which a body lies is no step, metres.
const MAX_STEP: f64 = 2e-4;

/// How exactly points are on the surfaces, metres.
const TOLERANCE: f64 = 1e-6;

/// Removes the points of bodies with what does not reach above a plane on which they lie.
pub(super) fn remove_seams(points: &mut Vec<Point>, colliders: &ColliderSet) {
    let Some(first) = points.first() else { return };
    let is_aligned = |point: &Point| point.normal.dot(first.normal).abs() > MIN_NORMAL_COSINE;
    if points.iter().all(is_aligned) {
        return;
    }
    let ghosts: Vec<bool> = points
        .iter()
        .map(|point| (0..2).any(|side| is_below(points, point, side, colliders)))
        .collect();
    let mut ghosts = ghosts.into_iter();
    points.retain(|_| !ghosts.next().unwrap_or(false));
}

/// Whether what is at the other side of a point lies below a plane on which the body at this side lies with the part that would touch it: other parts of the body
/// may reach below that plane.
fn is_below(points: &[Point], point: &Point, side: usize, colliders: &ColliderSet) -> bool {
    let reach = |side: usize, direction: Vector| {
        let collider = colliders.get(point.colliders[side])?;
        top(collider, point.parts[side], direction)
    };
    supports(points, point, side).any(|(support, up)| {
        let plane = plane(support, up);
        is_level(point, side, plane, up)
            && reach(1 - side, up).is_some_and(|top| top < plane + MAX_STEP)
            && reach(side, -up).is_some_and(|depth| -depth > plane - MAX_SINKING)
    })
}

/// Whether the surfaces at a point are where they are if what is at the other side lies below a plane: parts reach at least as far as their points, which need no
/// search for how far they reach.
fn is_level(point: &Point, side: usize, plane: f64, up: Vector) -> bool {
    let middle = point.place().dot(up);
    let half = upward(point, side).dot(up) * point.contact.distance / 2.0;
    middle - half < plane + MAX_STEP + TOLERANCE && middle + half > plane - MAX_SINKING - TOLERANCE
}

/// What the body at one side of a point lies on otherwise, and in which direction that pushes.
fn supports<'a>(
    points: &'a [Point],
    point: &'a Point,
    side: usize,
) -> impl Iterator<Item = (&'a Point, Vector)> {
    let body = point.contact.bodies[side];
    let own = upward(point, side);
    points
        .iter()
        .filter(move |support| body.is_some() && support.contact.distance < SUPPORT_DISTANCE)
        .filter_map(move |support| {
            let side = support.contact.bodies.iter().position(|&at| at == body)?;
            Some((support, upward(support, side)))
        })
        .filter(move |(_, up)| up.dot(own) < MIN_NORMAL_COSINE)
}

/// How high the surface reaches on which a body lies, which may have sunk in.
fn plane(support: &Point, up: Vector) -> f64 {
    support.place().dot(up) - support.contact.distance / 2.0
}

/// The normal of a point, to the body at that side.
fn upward(point: &Point, side: usize) -> Vector {
    if side == 0 {
        point.normal
    } else {
        -point.normal
    }
}

/// How far a part of a collider reaches in a direction (world axes); None for shapes that are not convex.
fn top(collider: &Collider, part: u32, direction: Vector) -> Option<f64> {
    let of = |pose: &EnginePose, shape: &dyn Shape| {
        let point = shape
            .as_support_map()?
            .local_support_point(pose.rotation.inverse() * direction);
        Some((*pose * point).dot(direction))
    };
    let Some(parts) = collider.shape().as_composite_shape() else {
        return of(collider.position(), collider.shape());
    };
    let mut found = None;
    parts.map_part_at(part, &mut |pose: Option<&EnginePose>,
                                  shape: &dyn Shape,
                                  _| {
        let pose = pose.map_or(*collider.position(), |pose| *collider.position() * *pose);
        found = of(&pose, shape);
    });
    found
}

/// Whether the first of two colliders touches the second one on its way (m), seen from there; true where that cannot be found out.
pub(super) fn meet([first, second]: [&Collider; 2], way: Vector) -> bool {
    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
    let hit = cast_shapes(
        first.position(),
        way,
        first.shape(),
        second.position(),
        Vector::ZERO,
        second.shape(),
        options,
    );
    hit.map_or(true, |hit| hit.is_some())
}
