//! Surfaces that move along bodies which move themselves, as the belt of a conveyor that a robot carries. Those of static bodies are motions of the bodies (`bodies::sweeps`).
//!
//! What a surface does across itself does not count, so that it does not push away what it touches.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{Collider, ContactModificationContext, RigidBodyHandle, RigidBodySet};

use super::convert::to_vector;
use scene::shape::MovingSurface;

/// The surfaces by their bodies.
#[derive(Default)]
pub(super) struct MovingSurfaces(BTreeMap<(u32, u32), MovingSurface>);

impl MovingSurfaces {
    /// Those of bodies that move.
    pub(super) fn new(all: impl Iterator<Item = (RigidBodyHandle, MovingSurface)>) -> Self {
        Self(
            all.map(|(body, surface)| (body.into_raw_parts(), surface))
                .collect(),
        )
    }

    pub(super) fn are_none(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether one of two bodies has such a surface.
    pub(super) fn concern(&self, bodies: [Option<RigidBodyHandle>; 2]) -> bool {
        !self.are_none() && bodies.into_iter().any(|body| self.get(body).is_some())
    }

    fn get(&self, body: Option<RigidBodyHandle>) -> Option<&MovingSurface> {
        self.0.get(&body?.into_raw_parts())
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
        let surface = self.get(collider.parent());
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
        if !self.concern([first.parent(), second.parent()]) {
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
