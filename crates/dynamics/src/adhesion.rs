//! Adhesion: bodies that adhere to what they touch, as MuJoCo's actuators of that name.
//!
//! The force is shared by the points where the body is within a millimetre of something; it pulls both sides together there, and the contacts bear it.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher,
};
use rapier3d_f64::prelude::{Collider, ColliderHandle, RigidBodyHandle};

use super::bodies::{Bodies, Body, Tag};
use super::contacts::{ContactResponse, Verdicts};
use super::world::World;

/// How near a surface is that a body adheres to, metres.
const REACH: f64 = 1e-3;

/// A point where a body adheres to another one.
struct Place {
    other: Option<RigidBodyHandle>,
    point: Vector,
    /// From the body to the other one.
    towards: Vector,
}

/// Pulls bodies that adhere, and what they adhere to. Whether there are any.
pub(super) fn pull(bodies: &Bodies, world: &mut World, verdicts: &Verdicts) -> bool {
    if !bodies.are_adhering {
        return false;
    }
    let mut have_pulled = false;
    for (_, body) in bodies.iter().filter(|(_, body)| body.adhesion() > 0.0) {
        let places = places(body, world, verdicts);
        let share = body.adhesion() / places.len() as f64;
        for place in places {
            let force = place.towards * share;
            push(world, Some(body.rigid), force, place.point);
            push(world, place.other, -force, place.point);
            have_pulled = true;
        }
    }
    have_pulled
}

fn push(world: &mut World, body: Option<RigidBodyHandle>, force: Vector, point: Vector) {
    let rigid = body.and_then(|body| world.bodies.get_mut(body));
    if let Some(rigid) = rigid.filter(|rigid| rigid.is_dynamic()) {
        rigid.add_force_at_point(force, point, true);
    }
}

/// The points where a body is near others.
fn places(body: &Body, world: &World, verdicts: &Verdicts) -> Vec<Place> {
    let mut places = Vec::new();
    for &own in &body.colliders {
        for pair in world.near(own, 0.0) {
            let other = if pair[0] == own { pair[1] } else { pair[0] };
            add_places([own, other], world, verdicts, &mut places);
        }
    }
    places
}

fn add_places(
    pair: [ColliderHandle; 2],
    world: &World,
    verdicts: &Verdicts,
    places: &mut Vec<Place>,
) {
    let [Some(own), Some(other)] = pair.map(|collider| world.colliders.get(collider)) else {
        return;
    };
    let [tag, of_other] = [own, other].map(|collider| Tag::unpack(collider.user_data));
    if verdicts.response(tag, of_other) == ContactResponse::NoCollision {
        return;
    }
    for manifold in manifolds(own, other) {
        let placed =
            |pose: &EnginePose, part: Option<&EnginePose>| part.map_or(*pose, |part| *pose * *part);
        let frame = placed(own.position(), manifold.subshape_pos1());
        let near = manifold.points.iter().filter(|point| point.dist < REACH);
        places.extend(near.map(|point| Place {
            other: other.parent(),
            point: frame * point.local_p1,
            towards: frame.rotation * manifold.local_n1,
        }));
    }
}

/// Where two colliders are near each other.
fn manifolds(first: &Collider, second: &Collider) -> Vec<ContactManifold<(), ()>> {
    let dispatcher: &dyn PersistentQueryDispatcher<(), ()> = &DefaultQueryDispatcher;
    let apart = first.position().inv_mul(second.position());
    let mut manifolds = Vec::new();
    // What parry does not know touches nothing.
    let _ = dispatcher.contact_manifolds(
        &apart,
        first.shape(),
        second.shape(),
        REACH,
        &mut manifolds,
        &mut None,
    );
    manifolds
}
