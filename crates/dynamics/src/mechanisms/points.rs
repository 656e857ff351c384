//! Where two colliders are near each other, as the solver of mechanisms sees it.

use articulation::Contact;
use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::details::ContactManifoldsWorkspace;
use rapier3d_f64::parry::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, TrackedContact,
};
use rapier3d_f64::prelude::{Collider, ColliderHandle};

use super::capsule_contacts::{are_capsule_and_cuboid, update_capsule_at_face};
use super::face_contacts::update_at_face;
use super::needed_points::{remove_middles, spread};
use super::normals::{move_back, way_out};
use crate::contacts::{ColliderPair, ContactResponse, pair_of};
use crate::convert::{from_vector, to_vector};
use scene::Handle;

pub(super) type Manifold = ContactManifold<(), [f64; 3]>;

/// Two colliders that are near each other.
#[derive(Default)]
pub(super) struct Pair {
    pub mechanism: usize,
    manifolds: Vec<Manifold>,
    workspace: Option<ContactManifoldsWorkspace>,
    /// What scripts said about it.
    pub response: ContactResponse,
    /// Whether rapier leaves it out.
    pub is_solved: bool,
    pub touches: bool,
    /// In the sub-step before.
    pub touched: bool,
}

/// A point of a pair in the present sub-step.
#[derive(Clone)]
pub(crate) struct Point {
    pub colliders: [ColliderHandle; 2],
    /// The parts of the colliders that touch, by their index in a mesh or a group.
    pub parts: [u32; 2],
    /// Indices of the manifold and of the point there.
    pub(super) index: (usize, usize),
    pub(super) mechanism: usize,
    pub shapes: [Handle; 2],
    pub(super) contact: Contact,
    /// On the first shape.
    pub impulse: Vector,
    /// Points to the first shape.
    pub normal: Vector,
}

impl Point {
    fn new(
        colliders: [ColliderHandle; 2],
        index: (usize, usize),
        manifold: &Manifold,
        found: &TrackedContact<[f64; 3]>,
        (place, normal): (Vector, Vector),
    ) -> Self {
        let contact = Contact {
            bodies: [None; 2],
            base: None,
            point: from_vector(place),
            normal: from_vector(normal),
            distance: found.dist,
            friction: 0.0,
            restitution: 0.0,
            velocity: [0.0; 3],
            impulse: found.data,
        };
        Self {
            colliders,
            parts: [manifold.subshape1, manifold.subshape2],
            index,
            mechanism: 0,
            shapes: [Handle(0); 2],
            contact,
            impulse: Vector::ZERO,
            normal,
        }
    }

    /// Of two surfaces that are level.
    #[cfg(test)]
    pub(super) fn on_floor(place: Vector, distance: f64) -> Self {
        use rapier3d_f64::parry::shape::PackedFeatureId;

        let nowhere = PackedFeatureId::UNKNOWN;
        let found = TrackedContact::new(place, place, nowhere, nowhere, distance);
        let colliders = [ColliderHandle::invalid(); 2];
        Self::new(
            colliders,
            (0, 0),
            &Manifold::new(),
            &found,
            (place, Vector::Z),
        )
    }

    pub(crate) fn place(&self) -> Vector {
        to_vector(self.contact.point)
    }

    pub(super) fn pair(&self) -> ColliderPair {
        pair_of(self.colliders)
    }
}

impl Pair {
    /// Finds the points for where the shapes are, up to `reach` metres apart; whether there are any.
    pub(super) fn update(&mut self, first: &Collider, second: &Collider, reach: f64) -> bool {
        let apart = first.position().inv_mul(second.position());
        let shapes = [first.shape(), second.shape()];
        if self.manifolds.is_empty() && are_capsule_and_cuboid(shapes) {
            self.manifolds.push(Manifold::new());
        }
        if let [manifold] = &mut self.manifolds[..]
            && (update_capsule_at_face(manifold, &apart, shapes, reach)
                || update_at_face(manifold, &apart, shapes, reach))
        {
            return self.is_within(reach);
        }
        let mut found = self.search(&apart, first, second, reach);
        let mut mistakes = self.manifolds.iter();
        if let Some(way) = mistakes.find_map(|manifold| way_out(manifold, &apart, shapes)) {
            let mut moved = apart;
            moved.translation += way;
            // Nor is it to begin with what it found.
            self.manifolds
                .iter_mut()
                .for_each(|manifold| manifold.local_n1 = Vector::ZERO);
            found = self.search(&moved, first, second, reach);
            self.manifolds
                .iter_mut()
                .for_each(|manifold| move_back(manifold, way));
        }
        found && self.is_within(reach)
    }

    fn is_within(&self, reach: f64) -> bool {
        let mut points = self.manifolds.iter().flat_map(|manifold| &manifold.points);
        points.any(|found| found.dist < reach)
    }

    pub(super) fn search(
        &mut self,
        apart: &EnginePose,
        first: &Collider,
        second: &Collider,
        reach: f64,
    ) -> bool {
        // parry would keep points that moved by less than a millimetre: behind a wheel that begins to roll they drive it on.
        self.manifolds
            .iter_mut()
            .for_each(Manifold::mark_shapes_deformed);
        let dispatcher: &dyn PersistentQueryDispatcher<(), [f64; 3]> = &DefaultQueryDispatcher;
        let shapes = (first.shape(), second.shape());
        let found = dispatcher.contact_manifolds(
            apart,
            shapes.0,
            shapes.1,
            reach,
            &mut self.manifolds,
            &mut self.workspace,
        );
        found.is_ok()
    }

    pub(super) fn points(
        &self,
        colliders: [ColliderHandle; 2],
        first: &Collider,
        second: &Collider,
        reach: f64,
    ) -> Vec<Point> {
        let mut points = Vec::new();
        for (number, manifold) in self.manifolds.iter().enumerate() {
            let placed = |pose: &EnginePose, part: Option<&EnginePose>| {
                part.map_or(*pose, |part| *pose * *part)
            };
            let a = placed(first.position(), manifold.subshape_pos1());
            let b = placed(second.position(), manifold.subshape_pos2());
            // parry's normal points from the first to the second.
            let normal = -(a.rotation * manifold.local_n1);
            let near = manifold.points.iter().enumerate();
            let start = points.len();
            for (index, found) in near.filter(|(_, found)| found.dist < reach) {
                let place = (a * found.local_p1 + b * found.local_p2) * 0.5;
                let index = (number, index);
                points.push(Point::new(
                    colliders,
                    index,
                    manifold,
                    found,
                    (place, normal),
                ));
            }
            remove_middles(&mut points, start);
        }
        spread(points)
    }

    /// Keeps the impulse of a point for the next sub-step.
    pub(super) fn store(&mut self, point: &Point) {
        let (manifold, index) = point.index;
        self.manifolds[manifold].points[index].data = from_vector(point.impulse);
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Rotation;
    use rapier3d_f64::prelude::ColliderBuilder;

    use super::*;

    fn coin(height: f64) -> Collider {
        let mut pose =
            EnginePose::from_rotation(Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
        pose.translation = Vector::new(0.0, 0.3, height);
        ColliderBuilder::cylinder(0.001, 0.01)
            .position(pose)
            .build()
    }

    #[test]
    fn coins_that_touch_to_the_last_digit_have_a_normal() {
        for level in 0..40 {
            let height = 0.001 + 0.002 * f64::from(level);
            let (lower, upper) = (coin(height), coin(height + 0.002));
            let mut pair = Pair::default();
            assert!(pair.update(&lower, &upper, 0.01), "{level}");
            let points = pair.points([ColliderHandle::invalid(); 2], &lower, &upper, 0.01);
            assert_eq!(points.len(), 4, "{level}");
            assert!(
                points.iter().all(|point| point.normal.z < -0.999),
                "{level}"
            );
        }
    }

    fn points_on_floor(form: ColliderBuilder) -> Vec<Point> {
        let lying = Rotation::from_rotation_z(std::f64::consts::FRAC_PI_2 + 0.3);
        let mut pose = EnginePose::from_rotation(lying);
        pose.translation = Vector::new(0.02, 0.01, 0.1);
        let lying = form.position(pose).build();
        let floor = ColliderBuilder::cuboid(1.0, 1.0, 0.05)
            .translation(Vector::new(0.0, 0.0, -0.05))
            .build();
        let mut pair = Pair::default();
        assert!(pair.update(&floor, &lying, 0.01));
        pair.points([ColliderHandle::invalid(); 2], &floor, &lying, 0.01)
    }

    #[test]
    fn what_lies_along_a_line_touches_at_its_ends() {
        for form in [
            ColliderBuilder::cylinder(0.3, 0.1),
            ColliderBuilder::capsule_y(0.3, 0.1),
        ] {
            let points = points_on_floor(form);
            assert_eq!(points.len(), 2);
            let apart = (points[0].place() - points[1].place()).length();
            assert!((apart - 0.6).abs() < 1e-6, "{apart}");
        }
    }

    /// The corners of a box as a hull.
    fn hull(half: [f64; 3]) -> Collider {
        let corner = |i: usize| {
            let sign = |axis: usize| {
                if i >> axis & 1 == 1 {
                    half[axis]
                } else {
                    -half[axis]
                }
            };
            Vector::new(sign(0), sign(1), sign(2))
        };
        let corners: Vec<Vector> = (0..8).map(corner).collect();
        let builder = ColliderBuilder::convex_hull(&corners).expect("a box has a hull");
        builder.build()
    }

    /// Points of a pad beside a hull of half the `width`, with a normal from the hull to the pad.
    fn pad_at_hull(
        width: f64,
        [yaw, across]: [f64; 2],
        distance: f64,
        is_first: bool,
    ) -> Vec<Point> {
        let mut pose = EnginePose::from_rotation(Rotation::from_rotation_z(yaw));
        pose.translation = Vector::new(-width - 0.005 - distance, across, 0.0);
        let pad = ColliderBuilder::cuboid(0.005, 0.01, 0.01).position(pose);
        let (pad, held) = (pad.build(), hull([width, 0.025, 0.025]));
        let (first, second) = if is_first {
            (&pad, &held)
        } else {
            (&held, &pad)
        };
        let mut pair = Pair::default();
        assert!(pair.update(first, second, 0.01));
        let mut points = pair.points([ColliderHandle::invalid(); 2], first, second, 0.01);
        if !is_first {
            points.iter_mut().for_each(|point| point.normal *= -1.0);
        }
        points
    }

    #[test]
    fn a_pad_that_just_touches_a_hull_pushes_along_its_face() {
        let places = [
            [0.0, 0.0],
            [std::f64::consts::PI, 0.0],
            [0.0, 1e-3],
            [std::f64::consts::PI, 0.0115],
        ];
        let distances = (0..12).map(|power| 1e-17 * 10.0_f64.powi(power));
        let distances: Vec<f64> = distances
            .flat_map(|distance| [distance, -distance])
            .chain([0.0])
            .collect();
        let mut wrong = Vec::new();
        for place in places {
            for width in [0.001, 0.025, 0.03] {
                for &distance in &distances {
                    for is_first in [true, false] {
                        let points = pad_at_hull(width, place, distance, is_first);
                        let is_right = |point: &Point| {
                            point.normal.x < -0.999
                                && (point.contact.distance - distance).abs() < 1e-7
                        };
                        if points.len() != 4 || !points.iter().all(is_right) {
                            let found = points.first().map(|p| (p.normal, p.contact.distance));
                            wrong.push(format!(
                                "{width} {place:?} {distance:e} {is_first} {} {found:?}",
                                points.len()
                            ));
                        }
                    }
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}
