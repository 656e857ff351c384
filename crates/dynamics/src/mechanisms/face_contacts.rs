//! Contacts with a face of a cuboid, such as the floor, without a search: most of what touches does so as in the sub-step before.
//!
//! Where the nearest point of a convex shape along the normal of a face lies above the face, that normal is the one by which they touch. It takes a tenth of the
//! time that parry needs to find it for shapes that overlap.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::TrackedContact;
use rapier3d_f64::parry::shape::{
    Cuboid, PackedFeatureId, PolygonalFeature, PolygonalFeatureMap, Shape,
};

use super::points::Manifold;

/// A normal with a component of at least this is that of a face.
const MIN_FACE_COSINE: f64 = 1.0 - 1e-9;
/// How far inside of the edges of the face the nearest point has to be, beyond what the shapes overlap; metres.
const MARGIN: f64 = 1e-4;
/// Largest overlap, metres.
const MAX_OVERLAP: f64 = 1e-3;

/// Finds the points of two convex shapes that touch at a face of one, as they did before; false where they may touch elsewhere. `apart`: the pose of the second in the
/// frame of the first.
pub(super) fn update_at_face(
    manifold: &mut Manifold,
    apart: &EnginePose,
    shapes: [&dyn Shape; 2],
    reach: f64,
) -> bool {
    let [Some(first), Some(second)] = shapes.map(sharp) else {
        return false;
    };
    if manifold.points.is_empty() || shapes.iter().all(|shape| shape.as_cuboid().is_some()) {
        return false;
    }
    let back = apart.inverse();
    let normals = [manifold.local_n1, manifold.local_n2];
    let found = match shapes.map(|shape| shape.as_cuboid()) {
        [Some(cuboid), _] => Touch::of(cuboid, normals[0], apart, second),
        [_, Some(cuboid)] => Touch::of(cuboid, normals[1], &back, first).map(|it| it.turned(apart)),
        _ => None,
    };
    let Some(touch) = found else {
        return false;
    };
    let old = std::mem::take(&mut manifold.points);
    manifold.local_n1 = touch.normal;
    manifold.local_n2 = -(back.rotation * touch.normal);
    if touch.distance() <= reach {
        touch.add_points(manifold, [first, second], [apart, &back]);
        manifold.match_contacts(&old);
    }
    true
}

/// A shape with flat features and without a rounded border.
fn sharp(shape: &dyn Shape) -> Option<&dyn PolygonalFeatureMap> {
    let (map, border) = shape.as_polygonal_feature_map()?;
    (border == 0.0).then_some(map)
}

/// The points at which two shapes are nearest, and the normal from the first to the second.
struct Touch {
    points: [Vector; 2],
    normal: Vector,
}

impl Touch {
    /// Of a cuboid and a convex shape, in the frame of the cuboid; None where they may be nearer elsewhere.
    fn of(
        cuboid: &Cuboid,
        normal: Vector,
        apart: &EnginePose,
        other: &dyn PolygonalFeatureMap,
    ) -> Option<Self> {
        let axis = (0..3).find(|&axis| normal[axis].abs() >= MIN_FACE_COSINE)?;
        let mut face = Vector::ZERO;
        face[axis] = normal[axis].signum();
        let nearest = *apart * other.local_support_point(apart.rotation.inverse() * -face);
        let distance = nearest.dot(face) - cuboid.half_extents[axis];
        let margin = MARGIN - distance.min(0.0);
        let is_inside =
            |side: usize| side == axis || nearest[side].abs() + margin < cuboid.half_extents[side];
        let is_shallow = -distance < MAX_OVERLAP.min(cuboid.half_extents[axis]);
        ((0..3).all(is_inside) && is_shallow).then(|| Self {
            points: [nearest - face * distance, nearest],
            normal: face,
        })
    }

    /// The same seen from the other shape, in whose frame the cuboid is at `pose`.
    fn turned(self, pose: &EnginePose) -> Self {
        let [at_cuboid, at_other] = self.points.map(|point| *pose * point);
        Self {
            points: [at_other, at_cuboid],
            normal: -(pose.rotation * self.normal),
        }
    }

    fn distance(&self) -> f64 {
        (self.points[1] - self.points[0]).dot(self.normal)
    }

    /// Where the features of the shapes overlap, and the nearest points; `poses`: of the second shape in the frame of the first, and the other way round.
    fn add_points(
        &self,
        manifold: &mut Manifold,
        shapes: [&dyn PolygonalFeatureMap; 2],
        poses: [&EnginePose; 2],
    ) {
        let at_second = *poses[1] * self.points[1];
        let [mut first, mut second] = [PolygonalFeature::default(), PolygonalFeature::default()];
        let (normal, opposite) = (manifold.local_n1, manifold.local_n2);
        shapes[0].local_support_feature_toward(normal, self.points[0], &mut first);
        shapes[1].local_support_feature_toward(opposite, at_second, &mut second);
        PolygonalFeature::contacts(
            poses[0], poses[1], normal, opposite, &first, &second, manifold, false,
        );
        manifold.points.push(TrackedContact::new(
            self.points[0],
            at_second,
            PackedFeatureId::UNKNOWN,
            PackedFeatureId::UNKNOWN,
            self.distance(),
        ));
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Rotation;
    use rapier3d_f64::prelude::{Collider, ColliderBuilder, ColliderHandle};
    use test_support::random::Random;

    use super::*;
    use crate::mechanisms::points::{Pair, Point};

    const REACH: f64 = 0.01;

    fn floor() -> Collider {
        ColliderBuilder::cuboid(1.0, 1.0, 0.1)
            .translation(Vector::new(0.0, 0.0, -0.1))
            .build()
    }

    fn wheel(pose: EnginePose) -> Collider {
        ColliderBuilder::cylinder(0.02, 0.08).position(pose).build()
    }

    fn at(x: f64, z: f64, turn: Vector) -> EnginePose {
        let mut pose = EnginePose::from_rotation(Rotation::from_scaled_axis(turn));
        pose.translation = Vector::new(x, 0.0, z);
        pose
    }

    fn points(pair: &Pair, shapes: [&Collider; 2]) -> Vec<Point> {
        pair.points([ColliderHandle::invalid(); 2], shapes[0], shapes[1], REACH)
    }

    /// The nearest distance and the normal.
    fn summary(points: &[Point]) -> Option<(f64, Vector)> {
        let distances = points.iter().map(|point| point.contact.distance);
        let nearest = distances.min_by(f64::total_cmp)?;
        Some((nearest, points[0].normal))
    }

    #[test]
    fn what_is_found_at_a_face_is_what_a_search_finds() {
        let mut random = Random::new(11);
        for case in 0..300 {
            let tilt = Vector::new(random.signed(), random.signed(), random.signed()) * 0.02;
            let pose = |z: f64| at(0.5 * f64::from(case) / 300.0, z, tilt);
            let ground = floor();
            let (before, now) = (
                wheel(pose(0.08)),
                wheel(pose(0.08 + 2e-3 * random.signed())),
            );
            for is_first in [true, false] {
                let ordered = |wheel| {
                    if is_first {
                        [wheel, &ground]
                    } else {
                        [&ground, wheel]
                    }
                };
                let [mut warm, mut cold] = [Pair::default(), Pair::default()];
                let [first, second] = ordered(&before);
                warm.update(first, second, REACH);
                let [first, second] = ordered(&now);
                assert_eq!(
                    warm.update(first, second, REACH),
                    cold.update(first, second, REACH)
                );
                let [a, b] = [&warm, &cold].map(|pair| summary(&points(pair, [first, second])));
                let (Some(a), Some(b)) = (a, b) else {
                    panic!("{case}: {a:?} {b:?}");
                };
                assert!(
                    (a.0 - b.0).abs() < 1e-8 && (a.1 - b.1).length() < 1e-6,
                    "{case}: {a:?} {b:?}"
                );
            }
        }
    }

    #[test]
    fn beyond_the_edge_of_a_face_it_is_searched() {
        let ground = floor();
        let lying = Vector::X * std::f64::consts::FRAC_PI_2;
        let mut pair = Pair::default();
        let inside = wheel(at(0.98, 0.02 - 1e-4, lying));
        assert!(pair.update(&inside, &ground, REACH));
        // The wheel hangs over the edge: its lowest point is beside the floor.
        let over = wheel(at(1.05, 0.05, Vector::X * 0.1));
        pair.update(&over, &ground, REACH);
        let mut cold = Pair::default();
        cold.update(&over, &ground, REACH);
        let [a, b] = [&pair, &cold].map(|pair| summary(&points(pair, [&over, &ground])));
        let (Some(a), Some(b)) = (a, b) else {
            panic!("{a:?} {b:?}");
        };
        assert!(a.1.z < 0.9 && (a.1 - b.1).length() < 1e-3, "{a:?} {b:?}");
    }

    /// Whether a wheel that lies on the floor is found at its face without a search, as it stood there before.
    fn is_at_face(x: f64, overlap: f64) -> bool {
        let lying = at(x, 0.02 - overlap, Vector::X * std::f64::consts::FRAC_PI_2);
        let (ground, wheel) = (floor(), wheel(lying));
        let shapes = [ground.shape(), wheel.shape()];
        let apart = ground.position().inv_mul(wheel.position());
        let mut manifold = Manifold::new();
        (manifold.local_n1, manifold.local_n2) = (Vector::Z, -Vector::Y);
        manifold.points.push(TrackedContact::new(
            Vector::ZERO,
            Vector::ZERO,
            PackedFeatureId::UNKNOWN,
            PackedFeatureId::UNKNOWN,
            0.0,
        ));
        let found = update_at_face(&mut manifold, &apart, shapes, REACH);
        if found {
            let nearest = manifold.points.iter().map(|point| point.dist);
            let nearest = nearest.min_by(f64::total_cmp).expect("they touch");
            assert!((nearest + overlap).abs() < 1e-12, "{nearest}");
            assert!((manifold.local_n1 - Vector::Z).length() < 1e-12);
        }
        found
    }

    #[test]
    fn a_wheel_that_lies_on_a_face_needs_no_search() {
        for overlap in [-5e-3, 0.0, 5e-4] {
            assert!(is_at_face(0.5, overlap), "{overlap}");
        }
        // Too deep, and where its lowest point may be nearer to the side: what they overlap counts for that.
        assert!(!is_at_face(0.5, 2e-3));
        assert!(!is_at_face(1.1, 0.0));
    }

    #[test]
    fn what_overlaps_has_to_be_as_far_from_the_edge() {
        // A ball of facets has one lowest point, below its middle.
        let is_found = |to_edge: f64, overlap: f64| {
            let form = ColliderBuilder::cone(0.1, 0.05);
            let mut pose =
                EnginePose::from_rotation(Rotation::from_rotation_x(-std::f64::consts::FRAC_PI_2));
            pose.translation = Vector::new(1.0 - to_edge, 0.0, 0.1 - overlap);
            let (ground, cone) = (floor(), form.position(pose).build());
            let apart = ground.position().inv_mul(cone.position());
            let mut manifold = Manifold::new();
            manifold.local_n1 = Vector::Z;
            manifold.points.push(TrackedContact::new(
                Vector::ZERO,
                Vector::ZERO,
                PackedFeatureId::UNKNOWN,
                PackedFeatureId::UNKNOWN,
                0.0,
            ));
            update_at_face(&mut manifold, &apart, [ground.shape(), cone.shape()], REACH)
        };
        assert!(is_found(2e-4, 0.0) && !is_found(0.5e-4, 0.0));
        assert!(is_found(7e-4, 5e-4) && !is_found(5e-4, 5e-4));
    }
}
