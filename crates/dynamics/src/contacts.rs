//! Contacts: collision filters, callbacks of scripts, and the contact impulses that the links need.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    ActiveHooks, CoefficientCombineRule, Collider, ColliderHandle, ColliderSet, ContactManifold,
    ContactModificationContext, PairFilterContext, PhysicsHooks, RigidBody, SolverFlags,
};

use super::bodies::Tag;
use super::convert::from_vector;
use super::flat_faces;
use super::moving_surfaces::MovingSurfaces;
use super::plan::PairRule;
use super::world::{ALL_HOOKS, Known, World, parts_of_impulse};
use scene::Handle;

/// Speed from which a body may touch what the previous sub-step did not find near it, m/s.
const MIN_FAST_SPEED: f64 = 1.0;

/// The answer of scripts for a pair of shapes that may touch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ContactResponse {
    /// The shapes' own materials decide.
    #[default]
    Default,
    /// The shapes do not touch.
    NoCollision,
    /// The shapes touch, with the friction and restitution given here.
    Collide {
        /// Coefficient of friction.
        friction: f64,
        /// Coefficient of restitution.
        restitution: f64,
    },
}

impl ContactResponse {
    fn of(rule: &PairRule) -> Self {
        match rule.friction {
            _ if !rule.touches => Self::NoCollision,
            Some(friction) => Self::Collide {
                friction,
                restitution: 0.0,
            },
            None => Self::Default,
        }
    }
}

/// Called once per pair of shapes and sub-step.
pub type ContactCallback<'a> = &'a dyn Fn(Handle, Handle) -> ContactResponse;

/// Two colliders by their indices.
pub(super) type ColliderPair = (u32, u32);

/// The key of a pair of colliders.
pub(super) fn pair_of(colliders: [ColliderHandle; 2]) -> ColliderPair {
    let [first, second] = colliders.map(|collider| collider.into_raw_parts().0);
    (first.min(second), first.max(second))
}

/// What scripts have decided about pairs of shapes for a sub-step.
#[derive(Default)]
pub struct Verdicts {
    /// The pairs they were asked about, which all differ.
    asked: Vec<(Handle, Handle)>,
    /// Whether the pairs rise: few sub-steps look one up.
    is_sorted: bool,
    /// The pairs for which scripts change something.
    special: BTreeMap<(Handle, Handle), ContactResponse>,
}

impl Verdicts {
    /// What scripts have answered about pairs of shapes, which all differ.
    pub fn new(asked: Vec<(Handle, Handle)>, responses: Vec<ContactResponse>) -> Self {
        let all = asked.iter().copied().zip(responses);
        let special = all
            .filter(|(_, response)| *response != ContactResponse::Default)
            .collect();
        Self {
            asked,
            is_sorted: false,
            special,
        }
    }

    /// Adds what shapes say of pairs, which counts whatever masks and scripts say.
    pub(super) fn add_rules(&mut self, rules: &[PairRule]) {
        for rule in rules {
            let ([a, b], response) = (rule.shapes, ContactResponse::of(rule));
            self.special.insert((a, b), response);
            self.special.insert((b, a), response);
        }
    }

    /// The verdict about a pair; None when scripts were not asked.
    fn find(&mut self, pair: (Handle, Handle)) -> Option<ContactResponse> {
        if let Some(response) = self.special.get(&pair) {
            return Some(*response);
        }
        if !self.is_sorted {
            self.asked.sort_unstable_by_key(rank);
            self.is_sorted = true;
        }
        self.asked
            .binary_search_by_key(&rank(&pair), rank)
            .is_ok()
            .then(|| self.special_or_default(pair))
    }

    /// Adds the verdict about a pair that was looked for.
    fn insert(&mut self, pair: (Handle, Handle), response: ContactResponse) {
        let place = self
            .asked
            .partition_point(|known| rank(known) < rank(&pair));
        self.asked.insert(place, pair);
        if response != ContactResponse::Default {
            self.special.insert(pair, response);
        }
    }

    fn special_or_default(&self, pair: (Handle, Handle)) -> ContactResponse {
        self.special
            .get(&pair)
            .copied()
            .unwrap_or(ContactResponse::Default)
    }

    /// How a pair responds: as shapes or scripts say of it, else by the masks.
    pub(super) fn response(&self, a: Tag, b: Tag) -> ContactResponse {
        match self.special.get(&(a.shape, b.shape)) {
            Some(response) => *response,
            None if masks_overlap(a, b) => ContactResponse::Default,
            None => ContactResponse::NoCollision,
        }
    }
}

/// The place of a pair in the order of handles, as one number: hundreds are sorted.
fn rank(&(first, second): &(Handle, Handle)) -> u64 {
    u64::from(first.0) << 32 | u64::from(second.0)
}

/// The rules of one sub-step.
pub(super) struct Rules<'a> {
    callback: Option<ContactCallback<'a>>,
    verdicts: RefCell<Verdicts>,
    /// Pairs that mechanisms solve, rising.
    apart: &'a [ColliderPair],
    surfaces: Arc<MovingSurfaces>,
}

impl<'a> Rules<'a> {
    pub(super) fn new(
        callback: Option<ContactCallback<'a>>,
        verdicts: Verdicts,
        apart: &'a [ColliderPair],
        surfaces: Arc<MovingSurfaces>,
    ) -> Self {
        Self {
            callback,
            verdicts: RefCell::new(verdicts),
            apart,
            surfaces,
        }
    }

    /// Scripts are asked about pairs that were not known before the sub-step.
    fn response(&self, a: Tag, b: Tag) -> ContactResponse {
        let Some(callback) = self.callback.filter(|_| masks_overlap(a, b)) else {
            return self.verdicts.borrow().response(a, b);
        };
        let pair = (a.shape, b.shape);
        let known = self.verdicts.borrow_mut().find(pair);
        known.unwrap_or_else(|| {
            let response = callback(a.shape, b.shape);
            self.verdicts.borrow_mut().insert(pair, response);
            response
        })
    }
}

/// The collision response rule: local masks within a tree, global masks between trees.
pub(super) fn masks_overlap(a: Tag, b: Tag) -> bool {
    let is_within = a.root == b.root;
    let bits = if is_within { 0x00ff } else { 0xff00 };
    a.mask & b.mask & bits != 0 || is_within && a.further_bits & b.further_bits != 0
}

impl PhysicsHooks for Rules<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        if self
            .apart
            .binary_search(&pair_of([context.collider1, context.collider2]))
            .is_ok()
        {
            return None;
        }
        let [a, b] = tags(context.colliders, context.collider1, context.collider2)?;
        (self.response(a, b) != ContactResponse::NoCollision).then(SolverFlags::default)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let Some([a, b]) = tags(context.colliders, context.collider1, context.collider2) else {
            return;
        };
        let response = self.response(a, b);
        let Some(contact) = context.rigid_mut() else {
            return;
        };
        if let ContactResponse::Collide {
            friction,
            restitution,
        } = response
        {
            *contact.friction = friction;
            *contact.restitution = restitution;
        }
        if *contact.friction == 0.0 {
            flat_faces::level(context);
        } else {
            self.surfaces.carry(context);
        }
    }
}

/// The pairs of shapes that may touch in a sub-step of `step` seconds, each once, without those whose masks do not allow it.
pub(super) fn pairs_near(world: &World, step: f64) -> Vec<(Handle, Handle)> {
    let known = &world.known;
    let near = |colliders: [ColliderHandle; 2]| {
        let [first, second] = known.both(colliders)?;
        let [a, b] = [Tag::unpack(first.tag), Tag::unpack(second.tag)];
        let may_touch = (first.moves || second.moves) && a.shape != b.shape && masks_overlap(a, b);
        may_touch.then_some((a.shape, b.shape))
    };
    let mut pairs: Vec<_> = world
        .narrow_phase
        .contact_pairs()
        .filter_map(|pair| near([pair.collider1, pair.collider2]))
        .collect();
    let ahead = pairs_ahead(world, step);
    if known.is_composite || !ahead.is_empty() {
        pairs.extend(ahead.into_iter().filter_map(near));
        let mut seen = BTreeSet::new();
        pairs.retain(|&pair| seen.insert(pair));
    }
    pairs
}

/// The pairs of fast bodies with what is in their way.
fn pairs_ahead(world: &World, step: f64) -> Vec<[ColliderHandle; 2]> {
    let awake = world.awake().filter_map(|body| world.bodies.get(body));
    let moving = awake.filter(|rigid| rigid.is_dynamic());
    moving
        .flat_map(|rigid| rigid.colliders())
        .flat_map(|&collider| world.ahead(collider, step))
        .collect()
}

/// The tags of two colliders.
pub(super) fn tags(
    colliders: &ColliderSet,
    first: rapier3d_f64::prelude::ColliderHandle,
    second: rapier3d_f64::prelude::ColliderHandle,
) -> Option<[Tag; 2]> {
    Some([
        Tag::unpack(colliders.get(first)?.user_data),
        Tag::unpack(colliders.get(second)?.user_data),
    ])
}

/// Sets for which colliders rapier asks the rules: those in pairs that mechanisms solve or that do not just collide with friction, and those so fast that
/// they may touch within the sub-step in which a pair is found. rapier computes resting contacts anew where it has to ask, so that it
/// shall not for others; whether scripts look on changes nothing.
pub(super) fn set_hooks(world: &mut World, verdicts: &Verdicts, apart: &[ColliderPair]) {
    let asked = asked_about(world, verdicts, apart);
    let is_asked = |handle: ColliderHandle| {
        asked
            .get(handle.into_raw_parts().0 as usize)
            .is_some_and(|&asked| asked)
    };
    let awake = world
        .awake()
        .filter_map(|body| world.bodies.get(body))
        .flat_map(|rigid| rigid.colliders());
    let others = (0..).zip(&asked).filter(|(_, asked)| **asked);
    let others = others.filter_map(|(index, _)| Some(world.colliders.get_unknown_gen(index)?.1));
    let hooks = |handle: ColliderHandle| {
        let collider = world.colliders.get(handle)?;
        let rigid = world
            .bodies
            .get(collider.parent()?)
            .filter(|rigid| rigid.is_dynamic())?;
        let hooks = if is_asked(handle) || is_fast(rigid) {
            ALL_HOOKS
        } else {
            ActiveHooks::empty()
        };
        (collider.active_hooks() != hooks).then_some((handle, hooks))
    };
    let changes: Vec<_> = awake.copied().chain(others).filter_map(hooks).collect();
    for (handle, hooks) in changes {
        let Some(collider) = world.colliders.get_mut(handle) else {
            continue;
        };
        collider.set_active_hooks(hooks);
        // A sleeper may lose what it lies on.
        if let Some(rigid) = collider
            .parent()
            .and_then(|body| world.bodies.get_mut(body))
        {
            rigid.wake_up(true);
        }
    }
}

/// Whether colliders are in pairs that do not just collide, by index.
fn asked_about(world: &World, verdicts: &Verdicts, apart: &[ColliderPair]) -> Vec<bool> {
    let mut asked = Vec::new();
    let mut ask = |pair: ColliderPair| {
        for index in [pair.0 as usize, pair.1 as usize] {
            asked.resize(asked.len().max(index + 1), false);
            asked[index] = true;
        }
    };
    apart.iter().copied().for_each(&mut ask);
    let surfaces = &world.surfaces;
    if !world.known.is_special && verdicts.special.is_empty() && surfaces.are_none() {
        return asked;
    }
    for pair in world.narrow_phase.contact_pairs() {
        let Some([first, second]) = world.known.pair(pair) else {
            continue;
        };
        let response = verdicts.response(Tag::unpack(first.tag), Tag::unpack(second.tag));
        let is_carried = surfaces.concern([first.body, second.body]);
        if response != ContactResponse::Default || first.friction(second) == 0.0 || is_carried {
            ask(pair_of([pair.collider1, pair.collider2]));
        }
    }
    asked
}

/// Notes what the rules need to know of the colliders, which came, went or changed.
pub(super) fn note_colliders(world: &mut World) {
    let mut known = Known::default();
    let mut shapes = BTreeSet::new();
    for (handle, collider) in world.colliders.iter() {
        known.add(handle, collider, &world.bodies);
        let tag = Tag::unpack(collider.user_data);
        known.is_special |= tag.mask != u16::MAX || collider.friction() == 0.0;
        known.is_composite |= !shapes.insert(tag.shape);
    }
    world.known = known;
}

/// Friction between two colliders.
pub(super) fn friction(first: &Collider, second: &Collider) -> f64 {
    let rules = (
        first.friction_combine_rule(),
        second.friction_combine_rule(),
    );
    CoefficientCombineRule::combine(first.friction(), second.friction(), rules.0, rules.1)
}

/// Whether a body may reach something that is farther away than contacts are prepared.
fn is_fast(rigid: &RigidBody) -> bool {
    let reach = rigid.mass_properties().max_extent();
    rigid.linvel().length() + rigid.angvel().length() * reach > MIN_FAST_SPEED
}

/// An impulse between two shapes, world axes: what the second does to the first.
pub(super) struct Push {
    pub shapes: [Handle; 2],
    pub point: [f64; 3],
    pub impulse: [f64; 3],
}

/// The impulses of the contacts of the previous sub-step, for shapes that matter: those expected in the next one.
pub(super) fn expected(world: &World, matters: impl Fn(Handle) -> bool) -> Vec<Push> {
    let mut pushes = Vec::new();
    for pair in world.narrow_phase.contact_pairs() {
        let Some([a, b]) = tags(&world.colliders, pair.collider1, pair.collider2) else {
            continue;
        };
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
    let share = 1.0 / manifold.data.solver_contacts.len() as f64;
    for contact in &manifold.data.solver_contacts {
        let Some(point) = manifold.points.get(contact.contact_indices()[0] as usize) else {
            continue;
        };
        let (a, b) = manifold
            .data
            .solver_contact_world_points(contact, &world.bodies);
        let place = (a + b) * 0.5;
        let impulse = manifold.data.normal * -point.data.impulse;
        pushes.push(Push {
            shapes,
            point: from_vector(place),
            impulse: from_vector(impulse),
        });
        middle += place * share;
        friction += point.data.warmstart_tangent_world * share;
    }
    let friction = friction * parts_of_impulse(manifold);
    pushes.push(Push {
        shapes,
        point: from_vector(middle),
        impulse: from_vector(friction),
    });
}
