//! Contacts: collision filters, callbacks of scripts, and the contact impulses that the links need.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    ActiveHooks, Collider, ColliderSet, ContactManifold, ContactModificationContext, ContactPair, PairFilterContext,
    PhysicsHooks, SolverFlags,
};

use super::bodies::Tag;
use super::convert::from_vector;
use super::world::World;
use crate::scene::Handle;

/// The answer of scripts for a pair of shapes that may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ContactResponse {
    /// The shapes' own materials decide.
    Default,
    NoCollision,
    Collide {
        friction: f64,
        restitution: f64,
    },
}

/// Called once per pair of shapes and sub-step.
pub(crate) type ContactCallback<'a> = &'a dyn Fn(Handle, Handle) -> ContactResponse;

/// The rules of one sub-step.
pub(super) struct Rules<'a> {
    callback: Option<ContactCallback<'a>>,
    responses: RefCell<BTreeMap<(Handle, Handle), ContactResponse>>,
}

impl<'a> Rules<'a> {
    pub(super) fn new(callback: Option<ContactCallback<'a>>) -> Self {
        Self { callback, responses: RefCell::default() }
    }

    fn response(&self, a: Tag, b: Tag) -> ContactResponse {
        if !masks_overlap(a, b) {
            return ContactResponse::NoCollision;
        }
        let Some(callback) = self.callback else { return ContactResponse::Default };
        let known = self.responses.borrow().get(&(a.shape, b.shape)).copied();
        known.unwrap_or_else(|| {
            let response = callback(a.shape, b.shape);
            self.responses.borrow_mut().insert((a.shape, b.shape), response);
            response
        })
    }
}

/// The collision response rule: local masks within a tree, global masks between trees.
fn masks_overlap(a: Tag, b: Tag) -> bool {
    let bits = if a.root == b.root { 0x00ff } else { 0xff00 };
    a.mask & b.mask & bits != 0
}

impl PhysicsHooks for Rules<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let [a, b] = tags(context.colliders, context.collider1, context.collider2)?;
        (self.response(a, b) != ContactResponse::NoCollision).then(SolverFlags::default)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let Some([a, b]) = tags(context.colliders, context.collider1, context.collider2) else { return };
        let response = self.response(a, b);
        if let (ContactResponse::Collide { friction, restitution }, Some(contact)) = (response, context.rigid_mut()) {
            *contact.friction = friction;
            *contact.restitution = restitution;
        }
    }
}

/// The tags of two colliders.
pub(super) fn tags(
    colliders: &ColliderSet,
    first: rapier3d_f64::prelude::ColliderHandle,
    second: rapier3d_f64::prelude::ColliderHandle,
) -> Option<[Tag; 2]> {
    Some([Tag::unpack(colliders.get(first)?.user_data), Tag::unpack(colliders.get(second)?.user_data)])
}

/// Filters all pairs, or only those with masks of their own. With filters, rapier recomputes resting contacts in every sub-step.
pub(super) fn filter_all_pairs(world: &mut World, all: bool) {
    let hooks = |collider: &Collider| match (all, Tag::unpack(collider.user_data).mask != u16::MAX) {
        (true, _) => ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS,
        (false, true) => ActiveHooks::FILTER_CONTACT_PAIRS,
        (false, false) => ActiveHooks::empty(),
    };
    let others = world.colliders.iter().filter(|(_, collider)| collider.active_hooks() != hooks(collider));
    for handle in others.map(|(handle, _)| handle).collect::<Vec<_>>() {
        if let Some(collider) = world.colliders.get_mut(handle) {
            let hooks = hooks(collider);
            collider.set_active_hooks(hooks);
        }
    }
}

/// The shapes that touch something, or nearly do.
pub(super) fn shapes_near(world: &World) -> BTreeSet<Handle> {
    let close =
        |pair: &&ContactPair| pair.solver_manifolds().iter().any(|manifold| !manifold.data.solver_contacts.is_empty());
    let pairs = world.narrow_phase.contact_pairs().filter(close);
    pairs
        .filter_map(|pair| tags(&world.colliders, pair.collider1, pair.collider2))
        .flatten()
        .map(|tag| tag.shape)
        .collect()
}

/// An impulse between two shapes, world axes: what the second does to the first.
pub(super) struct Push {
    pub shapes: [Handle; 2],
    pub point: [f64; 3],
    pub impulse: [f64; 3],
}

/// Warm-start impulses of the next sub-step: those of the contacts of the previous one, for shapes that matter.
pub(super) fn expected(world: &World, matters: impl Fn(Handle) -> bool) -> Vec<Push> {
    let mut pushes = Vec::new();
    for pair in world.narrow_phase.contact_pairs() {
        let Some([a, b]) = tags(&world.colliders, pair.collider1, pair.collider2) else { continue };
        if matters(a.shape) || matters(b.shape) {
            pair.solver_manifolds()
                .iter()
                .for_each(|manifold| expect(world, manifold, [a.shape, b.shape], &mut pushes));
        }
    }
    pushes
}

/// One push per point along the normal; friction acts at the middle of the points, as one.
fn expect(world: &World, manifold: &ContactManifold, shapes: [Handle; 2], pushes: &mut Vec<Push>) {
    let (mut middle, mut friction) = (Vector::ZERO, Vector::ZERO);
    let count = manifold.data.solver_contacts.len() as f64;
    for contact in &manifold.data.solver_contacts {
        let Some(point) = manifold.points.get(contact.contact_indices()[0] as usize) else { continue };
        let (a, b) = manifold.data.solver_contact_world_points(contact, &world.bodies);
        let place = (a + b) * 0.5;
        let impulse = manifold.data.normal * -point.data.warmstart_impulse;
        pushes.push(Push { shapes, point: from_vector(place), impulse: from_vector(impulse) });
        middle += place / count;
        friction += point.data.warmstart_tangent_world / count;
    }
    pushes.push(Push { shapes, point: from_vector(middle), impulse: from_vector(friction) });
}
