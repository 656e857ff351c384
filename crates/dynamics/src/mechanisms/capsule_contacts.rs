//! Contacts of a capsule with a face of a cuboid, such as a leg with the floor, without a search.
//!
//! Where the lower end of a capsule's segment lies above a face and within its edges, that end is nearest, along the normal of the face: points are below the ends.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::TrackedContact;
use rapier3d_f64::parry::shape::{Capsule, Cuboid, PackedFeatureId, Shape};

use super::points::Manifold;

/// How far inside of the edges of the face an end has to be, metres.
const MARGIN: f64 = 1e-4;
/// Least distance of the segment from the face, metres: below it the normal may be another one.
const MIN_HEIGHT: f64 = 1e-4;

/// Whether one of two shapes is a capsule and the other one a cuboid.
pub(super) fn are_capsule_and_cuboid(shapes: [&dyn Shape; 2]) -> bool {
    let is_capsule = |shape: &dyn Shape| shape.as_capsule().is_some();
    let is_cuboid = |shape: &dyn Shape| shape.as_cuboid().is_some();
    is_capsule(shapes[0]) && is_cuboid(shapes[1]) || is_cuboid(shapes[0]) && is_capsule(shapes[1])
}

/// Finds the points of a capsule and a cuboid that are near each other at a face; false for other shapes, and where they may be nearest elsewhere. `apart`: the pose of the
/// second in the frame of the first. Points keep the impulses of those that were at the same end.
pub(super) fn update_capsule_at_face(
    manifold: &mut Manifold,
    apart: &EnginePose,
    shapes: [&dyn Shape; 2],
    reach: f64,
) -> bool {
    let cuboids = shapes.map(|shape| shape.as_cuboid());
    let capsules = shapes.map(|shape| shape.as_capsule());
    let (ends, is_first) = match (cuboids, capsules) {
        ([Some(cuboid), _], [_, Some(capsule)]) => (Ends::of(cuboid, capsule, apart), false),
        ([_, Some(cuboid)], [Some(capsule), _]) => {
            (Ends::of(cuboid, capsule, &apart.inverse()), true)
        }
        _ => return false,
    };
    let Some(ends) = ends.filter(|ends| ends.are_inside(reach)) else {
        return false;
    };
    let old = std::mem::take(&mut manifold.points);
    let normals = [ends.face, -ends.face_at_capsule];
    [manifold.local_n1, manifold.local_n2] = if is_first {
        [normals[1], normals[0]]
    } else {
        normals
    };
    for end in (0..2).filter(|&end| ends.distance(end) <= reach) {
        let point = ends.point(end);
        let mut point = TrackedContact::flipped(
            point[0],
            point[1],
            PackedFeatureId::face(0),
            PackedFeatureId::vertex(end as u32),
            ends.distance(end),
            is_first,
        );
        point.data = ends.impulse_at(end, &old, is_first);
        manifold.points.push(point);
    }
    true
}

/// The ends of the segment of a capsule above the face of a cuboid.
struct Ends {
    half_extents: Vector,
    radius: f64,
    axis: usize,
    /// The normal of the face, in the frames of the cuboid and of the capsule.
    face: Vector,
    face_at_capsule: Vector,
    /// In the frames of the cuboid and of the capsule.
    ends: [[Vector; 2]; 2],
}

impl Ends {
    /// `pose`: of the capsule in the frame of the cuboid. None where the segment is not on one side of the cuboid.
    fn of(cuboid: &Cuboid, capsule: &Capsule, pose: &EnginePose) -> Option<Self> {
        let segment = [capsule.segment.a, capsule.segment.b];
        let placed = segment.map(|end| *pose * end);
        let axis = (0..3).find(|&axis| {
            let [first, second] = placed.map(|end| end[axis]);
            first * second > 0.0
                && first.abs().min(second.abs()) > cuboid.half_extents[axis] + MIN_HEIGHT
        })?;
        let mut face = Vector::ZERO;
        face[axis] = placed[0][axis].signum();
        Some(Self {
            half_extents: cuboid.half_extents,
            radius: capsule.radius,
            axis,
            face,
            face_at_capsule: pose.rotation.inverse() * face,
            ends: [placed, segment],
        })
    }

    fn height(&self, end: usize) -> f64 {
        self.ends[0][end].dot(self.face) - self.half_extents[self.axis]
    }

    fn distance(&self, end: usize) -> f64 {
        self.height(end) - self.radius
    }

    /// Whether the lower end is above the face, and so is the other one if it is near too.
    fn are_inside(&self, reach: f64) -> bool {
        let lower = usize::from(self.height(1) < self.height(0));
        let matters = |end: usize| end == lower || self.distance(end) <= reach;
        (0..2).filter(|&end| matters(end)).all(|end| {
            let beside = |side: usize| self.ends[0][end][side].abs() + MARGIN;
            (0..3).all(|side| side == self.axis || beside(side) < self.half_extents[side])
        })
    }

    /// The nearest points at an end: of the cuboid and of the capsule, each in its frame.
    fn point(&self, end: usize) -> [Vector; 2] {
        [
            self.ends[0][end] - self.face * self.height(end),
            self.ends[1][end] - self.face_at_capsule * self.radius,
        ]
    }

    /// The impulse of the points that were at an end of the capsule.
    fn impulse_at(&self, end: usize, old: &[TrackedContact<[f64; 3]>], is_first: bool) -> [f64; 3] {
        let along = self.ends[1][1 - end] - self.ends[1][end];
        let is_here = |point: &&TrackedContact<[f64; 3]>| {
            let place = if is_first {
                point.local_p1
            } else {
                point.local_p2
            };
            (place - self.ends[1][end]).dot(along) < 0.5 * along.length_squared()
        };
        let of_old = old.iter().filter(is_here).map(|point| point.data);
        of_old.fold([0.0; 3], |sum, impulse| {
            std::array::from_fn(|axis| sum[axis] + impulse[axis])
        })
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Rotation;
    use rapier3d_f64::prelude::{Collider, ColliderBuilder, ColliderHandle};
    use test_support::random::Random;

    use super::*;
    use crate::mechanisms::points::Pair;

    const REACH: f64 = 0.01;

    fn capsule(random: &mut Random, height: f64) -> Collider {
        let turn = Vector::new(random.signed(), random.signed(), random.signed());
        let mut pose = EnginePose::from_rotation(Rotation::from_scaled_axis(turn * 3.0));
        let tip = (pose.rotation * Vector::Z).z.abs() * 0.2;
        pose.translation = Vector::new(0.7 * random.signed(), 0.7 * random.signed(), height + tip);
        ColliderBuilder::capsule_z(0.2, 0.05).position(pose).build()
    }

    /// Places of the points, their distances and the normal.
    fn found(pair: &Pair, shapes: [&Collider; 2]) -> Vec<(Vector, f64, Vector)> {
        let points = pair.points([ColliderHandle::invalid(); 2], shapes[0], shapes[1], REACH);
        let points = points
            .iter()
            .map(|point| (point.place(), point.contact.distance, point.normal));
        let mut points: Vec<_> = points.collect();
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        points
    }

    #[test]
    fn what_is_found_at_a_face_is_what_a_search_finds() {
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.1)
            .translation(Vector::new(0.0, 0.0, -0.1))
            .build();
        let (mut random, mut near) = (Random::new(7), 0);
        for case in 0..400 {
            let height = 0.05 + 0.009 * random.signed();
            let leg = capsule(&mut random, height);
            for shapes in [[&floor, &leg], [&leg, &floor]] {
                let [mut searched, mut direct] = [Pair::default(), Pair::default()];
                let apart = shapes[0].position().inv_mul(shapes[1].position());
                searched.search(&apart, shapes[0], shapes[1], REACH);
                direct.update(shapes[0], shapes[1], REACH);
                let [a, b] = [&searched, &direct].map(|pair| found(pair, shapes));
                near += usize::from(!b.is_empty());
                let nearest = |all: &[(Vector, f64, Vector)]| all.first().copied();
                match (nearest(&a), nearest(&b)) {
                    (Some(a), Some(b)) => assert!(
                        (a.1 - b.1).abs() < 1e-7 && (a.2 - b.2).length() < 1e-5,
                        "{case}: {a:?} {b:?}"
                    ),
                    (a, b) => assert_eq!(a, b, "{case}"),
                }
            }
        }
        assert!(near > 500, "{near}");
    }

    #[test]
    fn a_lying_capsule_touches_at_both_ends_and_keeps_their_impulses() {
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.1)
            .translation(Vector::new(0.0, 0.0, -0.1))
            .build();
        let leg = ColliderBuilder::capsule_x(0.2, 0.05)
            .translation(Vector::new(0.1, 0.0, 0.05))
            .build();
        let mut pair = Pair::default();
        assert!(pair.update(&floor, &leg, REACH));
        let handles = [ColliderHandle::invalid(); 2];
        let points = pair.points(handles, &floor, &leg, REACH);
        let places: Vec<f64> = points.iter().map(|point| point.place().x).collect();
        assert_eq!(places.len(), 2);
        for mut point in points {
            point.impulse = Vector::new(0.0, 0.0, point.place().x);
            pair.store(&point);
        }
        assert!(pair.update(&floor, &leg, REACH));
        for point in pair.points(handles, &floor, &leg, REACH) {
            assert!((point.contact.impulse[2] - point.place().x).abs() < 1e-12);
        }
    }

    #[test]
    fn beyond_the_edge_of_a_face_it_is_searched() {
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.1).build();
        let beside =
            ColliderBuilder::capsule_z(0.2, 0.05).translation(Vector::new(1.03, 0.0, 0.31));
        let beside = beside.build();
        let mut pair = Pair::default();
        assert!(pair.update(&floor, &beside, REACH));
        let points = found(&pair, [&floor, &beside]);
        let (distance, normal) = (points[0].1, points[0].2);
        assert!(
            (distance - (0.03_f64.hypot(0.01) - 0.05)).abs() < 1e-6,
            "{distance}"
        );
        assert!(normal.x.abs() > 0.9, "{normal:?}");
    }

    /// What is found of an upright or lying capsule at a pose above a face at height 0 of 2 m by 2 m.
    fn above(pose: EnginePose, is_first: bool) -> Option<Manifold> {
        let (cuboid, leg) = (
            Cuboid::new(Vector::new(1.0, 1.0, 0.1)),
            Capsule::new_z(0.2, 0.05),
        );
        let floor = EnginePose::from_translation(Vector::Z * -0.1);
        let (apart, shapes): (_, [&dyn Shape; 2]) = if is_first {
            (pose.inv_mul(&floor), [&leg, &cuboid])
        } else {
            (floor.inv_mul(&pose), [&cuboid, &leg])
        };
        assert!(are_capsule_and_cuboid(shapes));
        let mut manifold = Manifold::new();
        update_capsule_at_face(&mut manifold, &apart, shapes, REACH).then_some(manifold)
    }

    fn upright(x: f64, height: f64) -> EnginePose {
        EnginePose::from_translation(Vector::new(x, 0.0, 0.25 + height))
    }

    #[test]
    fn the_lower_end_of_an_upright_capsule_is_over_the_point_that_is_nearest() {
        for is_first in [false, true] {
            let found = above(upright(0.3, 0.005), is_first).expect("it is above the face");
            assert_eq!(found.points.len(), 1);
            let point = &found.points[0];
            assert!((point.dist - 0.005).abs() < 1e-12, "{}", point.dist);
            let (mut own, mut other) = (point.local_p1, point.local_p2);
            let mut normals = [found.local_n1, found.local_n2];
            if is_first {
                std::mem::swap(&mut own, &mut other);
                normals.reverse();
            }
            let [floor, leg] = [Vector::new(0.3, 0.0, 0.1), Vector::Z * -0.25];
            assert!((own - floor).length() < 1e-12 && (other - leg).length() < 1e-12);
            assert_eq!(normals, [Vector::Z, -Vector::Z]);
        }
        let apart = above(upright(0.3, 0.02), false).expect("it is above the face");
        assert!(apart.points.is_empty());
    }

    #[test]
    fn ends_that_matter_have_to_be_over_the_face() {
        let is_found = |pose: EnginePose| above(pose, false).is_some();
        let edge = 1.0 - MARGIN;
        assert!(is_found(upright(edge - 1e-6, 0.0)) && !is_found(upright(edge + 1e-6, 0.0)));
        // The upper end of a slanted one is beyond the edge, and far away.
        let slanted = |angle: f64| {
            let mut pose = EnginePose::from_rotation(Rotation::from_rotation_y(angle));
            let up = 0.2 * angle.cos().abs();
            pose.translation = Vector::new(0.99, 0.0, 0.05 + up);
            pose
        };
        assert!(!is_found(slanted(1.57)));
        let mut beside = slanted(0.5);
        beside.translation.x = 0.95 + 0.2 * 0.5_f64.sin();
        assert!(is_found(beside));
    }

    #[test]
    fn only_a_capsule_and_a_cuboid_are_both() {
        let (cuboid, capsule) = (Cuboid::new(Vector::ONE), Capsule::new_z(0.2, 0.05));
        let shapes: [&dyn Shape; 2] = [&cuboid, &capsule];
        for (first, second) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let both = [shapes[first], shapes[second]];
            assert_eq!(are_capsule_and_cuboid(both), first != second);
        }
    }
}
