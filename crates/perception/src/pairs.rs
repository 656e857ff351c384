//! Which pairs of objects a query compares (spec: sensors 2).

use std::collections::BTreeSet;

use super::entity::{Entity, Group, Purpose};
use super::index::{Body, Index};
use scene::{Handle, Scene};

/// Objects of a collection that is compared with itself are not compared where their indicators differ by one of these.
const NEIGHBOURS: [u64; 6] = [1, 10, 100, 1000, 10_000, 100_000];

/// The pairs of two entities.
pub(super) struct Pairs {
    purpose: Purpose,
    /// The objects of the first entity, in the order of the scene.
    first: Vec<Handle>,
    second: Group,
    /// Objects that are in both entities.
    shared: BTreeSet<Handle>,
    /// A collection is compared with itself.
    is_self: bool,
}

impl Pairs {
    pub(super) fn of(scene: &Scene, purpose: Purpose, [first, second]: [Entity; 2]) -> Self {
        let objects = first.objects(scene, purpose);
        let group = first.opponents(scene, second, purpose);
        let shared = match &group {
            Group::List(list) => {
                let known: BTreeSet<_> = objects.iter().collect();
                list.iter()
                    .copied()
                    .filter(|object| known.contains(object))
                    .collect()
            }
            Group::All { .. } => BTreeSet::new(),
        };
        let is_self = first == second;
        Self {
            purpose,
            first: objects,
            second: group,
            shared,
            is_self,
        }
    }

    /// The bodies of the first entity.
    pub(super) fn first<'i>(&self, index: &'i Index) -> impl Iterator<Item = (Handle, &'i Body)> {
        self.first
            .iter()
            .filter_map(|&object| Some((object, index.body(object)?)))
    }

    /// The bodies that `object` is compared with, as far as their boxes overlap, in the order of the scene.
    pub(super) fn overlapping<'i>(
        &self,
        (scene, index): (&Scene, &'i Index),
        (object, body): (Handle, &Body),
    ) -> impl Iterator<Item = (Handle, &'i Body)> {
        let others = index.overlapping(&self.second, (scene, self.purpose), &body.bounds);
        others
            .into_iter()
            .filter(move |&(other, _)| self.is_compared(scene, object, other))
    }

    /// Visits the bodies that `object` is compared with by ascending distance of their boxes, as long as it is smaller than the limit.
    pub(super) fn nearest_first(
        &self,
        (scene, index): (&Scene, &Index),
        (object, body): (Handle, &Body),
        limit: f64,
        mut visit: impl FnMut(Handle, &Body, f64) -> f64,
    ) {
        let distance = |bounds: &proximity::Bounds| bounds.distance(&body.bounds);
        let purpose = (scene, self.purpose);
        index.nearest_first(
            &self.second,
            purpose,
            distance,
            limit,
            |other, body, limit| {
                if self.is_compared(scene, object, other) {
                    visit(other, body, limit)
                } else {
                    limit
                }
            },
        );
    }

    /// Whether a pair counts: not an object with itself, and no pair twice.
    fn is_compared(&self, scene: &Scene, object: Handle, other: Handle) -> bool {
        let both = self.shared.contains(&object) && self.shared.contains(&other);
        let created = |object| scene.object(object).ok().map(scene::Object::uid);
        let is_second_time = || created(other) < created(object);
        object != other
            && !(both && is_second_time())
            && !(self.is_self && are_neighbours(scene, object, other))
    }
}

fn are_neighbours(scene: &Scene, object: Handle, other: Handle) -> bool {
    let indicator = |object| {
        scene
            .object(object)
            .map_or(0, |object| object.self_collision_indicator)
    };
    NEIGHBOURS.contains(&indicator(object).abs_diff(indicator(other)))
}
