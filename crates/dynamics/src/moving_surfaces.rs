//! Surfaces that move along bodies which move themselves, as the belt of a conveyor that a robot carries. Those of static bodies are motions of the bodies (`bodies::sweeps`).
//!
//! What a surface does across itself does not count, so that it does not push away what it touches.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{Collider, ContactModificationContext, RigidBodySet};

use super::bodies::{Bodies, Tag};
use super::convert::to_vector;
use scene::Handle;
use scene::shape::MovingSurface;

/// The surfaces by their shapes.
#[derive(Default)]
pub(super) struct MovingSurfaces(BTreeMap<Handle, MovingSurface>);

impl MovingSurfaces {
    pub(super) fn of(bodies: &Bodies) -> Self {
        let moving = bodies.iter().filter(|(_, body)| body.build.dynamic);
        let surfaces = moving.filter_map(|(shape, body)| Some((shape, body.surface_motion()?)));
        Self(surfaces.collect())
    }

    pub(super) fn are_none(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether one of two colliders has such a surface.
    pub(super) fn concern(&self, tags: [u128; 2]) -> bool {
        let has = |tag: u128| self.0.contains_key(&Tag::unpack(tag).shape);
        !self.are_none() && tags.into_iter().any(has)
    }

    /// The velocity of the second surface against the first one at a point, along the plane with that normal, m/s, as far as it is not that of the bodies.
    pub(super) fn velocity(
        &self,
        colliders: [&Collider; 2],
        bodies: &RigidBodySet,
        place: Vector,
        normal: Vector,
    ) -> Vector {
        if self.are_none() {
            return Vector::ZERO;
        }
        let [first, second] = colliders.map(|collider| self.of_collider(collider, bodies, place));
        let between = second - first;
        between - normal * between.dot(normal)
    }

    fn of_collider(&self, collider: &Collider, bodies: &RigidBodySet, place: Vector) -> Vector {
        let surface = self.0.get(&Tag::unpack(collider.user_data).shape);
        let rigid = collider.parent().and_then(|body| bodies.get(body));
        let (Some(surface), Some(rigid)) = (surface, rigid) else {
            return Vector::ZERO;
        };
        let local = rigid.position().inverse_transform_point(place);
        let turning =
            Vector3::from(surface.angular).cross(&Vector3::new(local.x, local.y, local.z));
        let velocity = Vector3::from(surface.linear) + turning;
        rigid.rotation() * to_vector(velocity.into())
    }

    /// Lets rapier's contacts carry along.
    pub(super) fn carry(&self, context: &mut ContactModificationContext) {
        let colliders = [context.collider1, context.collider2];
        let [Some(first), Some(second)] = colliders.map(|handle| context.colliders.get(handle))
        else {
            return;
        };
        if !self.concern([first.user_data, second.user_data]) {
            return;
        }
        let bodies = context.bodies;
        let Some(contact) = context.rigid_mut() else {
            return;
        };
        let normal = *contact.normal;
        for point in contact.solver_contacts.iter_mut() {
            let (place, _) = contact
                .manifold
                .data
                .solver_contact_world_points(point, bodies);
            let velocity = self.velocity([first, second], bodies, place, normal);
            // rapier's is that of the first against the second one, with the opposite sign.
            point.tangent_velocity = -velocity;
        }
    }
}
