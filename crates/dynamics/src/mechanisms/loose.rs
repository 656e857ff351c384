//! Free bodies that touch something, solved as the guests of robots are: stiff contacts, one friction for sliding and turning, rebounds that neither gain nor
//! lose energy. Groups of some bodies only: those of larger ones, such as piles, rapier solves, which takes less.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};

use super::exact_contacts::ExactContacts;
use super::linked::Linked;
use super::search::{Conditions, Touching};
use crate::bodies::{Bodies, Tag};
use crate::contacts::{Verdicts, pair_of};
use crate::links::Links;
use crate::world::{World, index_of};
use scene::Handle;

/// Largest number of free bodies that are solved together.
const MAX_BODIES: usize = 16;
/// With more free bodies than the second number that touch something, rapier solves all of them, and does so until there are fewer than the first one.
const CROWD: (usize, usize) = (48, 96);
/// Distance up to which surfaces count as near though their bodies hardly move, metres.
const SLACK: f64 = 1e-3;

/// The groups of the present sub-step.
#[derive(Default)]
pub(super) struct Loose {
    /// The first `count` are in use.
    groups: Vec<Linked>,
    count: usize,
    /// Whether there are too many to be solved one by one.
    is_crowded: bool,
}

/// What a sub-step starts from.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub links: &'a Links,
    pub bodies: &'a Bodies,
    pub world: &'a World,
    pub gravity: [f64; 3],
    pub step: f64,
    pub verdicts: &'a Verdicts,
    pub places: &'a BTreeMap<Handle, (usize, usize)>,
}

impl Loose {
    /// Finds the groups and solves them. `taken`: the guests of robots, to which those of the groups are added; `first`: number of the first group.
    pub(super) fn solve(
        &mut self,
        start: Start<'_>,
        contacts: &mut ExactContacts,
        taken: &mut BTreeSet<Handle>,
        first: usize,
    ) {
        self.count = 0;
        let world = start.world;
        let candidates = candidates(start);
        self.is_crowded = candidates.len() > if self.is_crowded { CROWD.0 } else { CROWD.1 };
        if self.is_crowded || candidates.is_empty() {
            return;
        }
        let sizes = Sizes::new(world, contacts);
        let (robots, bases) = (taken.clone(), BTreeMap::new());
        let is_refused = |body: RigidBodyHandle, shape: Handle| {
            sizes.of(body) > MAX_BODIES || robots.contains(&shape)
        };
        let conditions = Conditions {
            places: start.places,
            verdicts: start.verdicts,
            step: start.step,
            max_guests: MAX_BODIES,
            slack: SLACK,
            is_refused: &is_refused,
        };
        for (handle, rigid, shape) in candidates {
            if taken.contains(&shape) || is_refused(handle, shape) {
                continue;
            }
            let number = first + self.count;
            let touching = Touching {
                mechanism: number,
                linked: 0,
                colliders: rigid.colliders(),
                bases: &bases,
            };
            if let Some(guests) = contacts.find(world, conditions, touching, None) {
                self.add(guests, start, contacts, number);
                taken.extend(self.groups[self.count - 1].guests());
            }
        }
    }

    fn add(
        &mut self,
        guests: Vec<Handle>,
        start: Start<'_>,
        contacts: &mut ExactContacts,
        number: usize,
    ) {
        if self.groups.len() == self.count {
            self.groups.push(Linked::without_links());
        }
        let group = &mut self.groups[self.count];
        self.count += 1;
        group.receive(guests, start.bodies);
        group.read(
            start.links,
            start.world,
            start.gravity,
            start.step,
            contacts.of(number),
        );
        group.solve();
        if group.is_solved {
            contacts.store(number, group.contact_impulses());
        } else {
            contacts.leave(number);
            group.receive(Vec::new(), start.bodies);
        }
    }

    /// The same, to be asked.
    pub(super) fn groups_mut(&mut self) -> impl Iterator<Item = &mut Linked> {
        self.groups[..self.count].iter_mut()
    }

    /// The groups that were solved.
    pub(super) fn groups(&self) -> impl Iterator<Item = &Linked> {
        self.groups[..self.count].iter()
    }
}

/// The bodies that may touch something, and belong to no mechanism.
fn candidates(start: Start<'_>) -> Vec<(RigidBodyHandle, &RigidBody, Handle)> {
    let world = start.world;
    let candidate = |handle| {
        let rigid = world.bodies.get(handle)?;
        let shape = shape_of(rigid, world)?;
        let is_free = !start.places.contains_key(&shape) && !world.has_joints(handle);
        (is_free && world.is_near_anything(rigid, start.step)).then_some((handle, rigid, shape))
    };
    world.awake().filter_map(candidate).collect()
}

/// The shape of a dynamic body that collides.
fn shape_of(rigid: &RigidBody, world: &World) -> Option<Handle> {
    let collider = world.colliders.get(*rigid.colliders().first()?)?;
    rigid
        .is_dynamic()
        .then(|| Tag::unpack(collider.user_data).shape)
}

/// How many free bodies hang together by their contacts of the sub-step before.
struct Sizes {
    /// By index of the body: one of the same group, itself for one that stands for its group.
    parents: Vec<usize>,
    /// Of the group, for those that stand for it.
    sizes: Vec<usize>,
}

impl Sizes {
    fn new(world: &World, contacts: &ExactContacts) -> Self {
        let mut sizes = Self {
            parents: (0..world.bodies.len()).collect(),
            sizes: vec![1; world.bodies.len()],
        };
        for pair in world.narrow_phase.contact_pairs() {
            let key = pair_of([pair.collider1, pair.collider2]);
            if !pair.has_any_active_contact() && !contacts.touched(key) {
                continue;
            }
            let Some([first, second]) = world.known.pair(pair) else {
                continue;
            };
            if let (true, true, Some(a), Some(b)) =
                (first.moves, second.moves, first.body, second.body)
            {
                sizes.join(index_of(a), index_of(b));
            }
        }
        sizes
    }

    fn root(&self, mut index: usize) -> usize {
        while let Some(&parent) = self.parents.get(index).filter(|&&parent| parent != index) {
            index = parent;
        }
        index
    }

    fn join(&mut self, a: usize, b: usize) {
        for index in self.parents.len()..=a.max(b) {
            self.parents.push(index);
            self.sizes.push(1);
        }
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            let (smaller, larger) = if self.sizes[a] < self.sizes[b] {
                (a, b)
            } else {
                (b, a)
            };
            self.parents[smaller] = larger;
            self.sizes[larger] += self.sizes[smaller];
        }
    }

    fn of(&self, body: RigidBodyHandle) -> usize {
        self.sizes
            .get(self.root(index_of(body)))
            .copied()
            .unwrap_or(1)
    }
}
