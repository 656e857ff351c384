//! What mechanisms may touch, found once for as long as none of their shapes has moved far. Where nothing else moves, the engine need not look for collisions
//! meanwhile.

#[cfg(test)]
mod tests;

use rapier3d_f64::math::Pose as EnginePose;
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d_f64::prelude::{Collider, ColliderHandle};

use crate::bodies::Tag;
use crate::contacts::{ContactResponse, Verdicts};
use crate::near::ordered;
use crate::world::{PREDICTION_DISTANCE, World};

/// How far shapes may move until their neighbours are searched again, metres.
const MARGIN: f64 = 0.2;
/// Largest number of colliders, and of pairs for each shape of a mechanism: with more, the engine's broad phase is faster.
const MAX_COLLIDERS: usize = 128;
const MAX_PAIRS: usize = 8;

/// The surroundings of all mechanisms.
#[derive(Default)]
pub(super) struct Surroundings {
    /// The shapes of mechanisms, where they were.
    shapes: Vec<Placed>,
    /// By mechanism: what its shapes may touch.
    pairs: Vec<Vec<NearPair>>,
    is_known: bool,
}

/// Where a collider was.
struct Placed {
    collider: ColliderHandle,
    pose: EnginePose,
    /// Largest distance of its points from its origin, metres.
    radius: f64,
}

/// Two colliders that may come to touch.
pub(super) struct NearPair {
    pub colliders: [ColliderHandle; 2],
    /// The bounds of the one that does not move, and the index of the one that does.
    obstacle: Option<(Aabb, usize)>,
}

impl NearPair {
    /// Whether the shapes are certainly farther apart than `reach`.
    pub(super) fn is_apart(&self, world: &World, reach: f64) -> bool {
        let colliders = self.colliders.map(|handle| world.colliders.get(handle));
        let [Some(first), Some(second)] = colliders else {
            return false;
        };
        let Some((bounds, moving)) = &self.obstacle else {
            let around = first.compute_aabb().loosened(reach);
            return !around.intersects(&second.compute_aabb());
        };
        let shape = [first, second][*moving];
        let sphere = shape.shape().compute_local_bounding_sphere();
        let center = *shape.position() * sphere.center;
        let nearest = center.clamp(bounds.mins, bounds.maxs);
        (center - nearest).length() > sphere.radius + reach
    }
}

impl Surroundings {
    /// Something else has moved, or may have.
    pub(super) fn forget(&mut self) {
        self.is_known = false;
    }

    pub(super) fn are_known(&self) -> bool {
        self.is_known
    }

    /// The pairs of a mechanism, if they are known.
    pub(super) fn of(&self, mechanism: usize) -> Option<&[NearPair]> {
        let pairs = self.pairs.get(mechanism).filter(|_| self.is_known)?;
        Some(pairs)
    }

    /// Whether they hold for where the shapes are now.
    pub(super) fn cover(&self, world: &World) -> bool {
        let has_stayed = |shape: &Placed| {
            let collider = world.colliders.get(shape.collider);
            collider.is_some_and(|collider| shape.way_to(collider.position()) < MARGIN)
        };
        self.shapes.iter().all(has_stayed)
    }

    /// Finds the neighbours of the colliders of each mechanism, unless there are too many.
    pub(super) fn find<'a>(
        &mut self,
        world: &World,
        mechanisms: impl Iterator<Item = &'a [ColliderHandle]>,
    ) {
        self.shapes.clear();
        self.pairs.clear();
        self.is_known = world.colliders.len() <= MAX_COLLIDERS;
        if !self.is_known {
            return;
        }
        let bounds = |(handle, collider): (_, &Collider)| (handle, collider.compute_aabb());
        let all: Vec<_> = world.colliders.iter().map(bounds).collect();
        for colliders in mechanisms {
            let mut pairs = Vec::new();
            for &handle in colliders {
                if let Some(collider) = world.colliders.get(handle) {
                    self.shapes.push(Placed::new(handle, collider));
                    add_pairs(world, handle, &all, &mut pairs);
                }
            }
            self.is_known &= pairs.len() <= MAX_PAIRS * colliders.len();
            self.pairs.push(pairs);
        }
    }
}

impl Placed {
    fn new(handle: ColliderHandle, collider: &Collider) -> Self {
        let sphere = collider.shape().compute_local_bounding_sphere();
        Self {
            collider: handle,
            pose: *collider.position(),
            radius: sphere.center.length() + sphere.radius,
        }
    }

    /// How far no point has moved, metres.
    fn way_to(&self, now: &EnginePose) -> f64 {
        let [before, after] = [self.pose.rotation, now.rotation];
        let turned = (before - after).length().min((before + after).length());
        (now.translation - self.pose.translation).length() + 2.0 * self.radius * turned
    }
}

/// Adds what a collider may touch before it, or both, have moved far; pairs of two that move are added once. `all`: the bounds of all colliders.
fn add_pairs(
    world: &World,
    handle: ColliderHandle,
    all: &[(ColliderHandle, Aabb)],
    pairs: &mut Vec<NearPair>,
) {
    let Some((_, bounds)) = all.iter().find(|(other, _)| *other == handle) else {
        return;
    };
    let around = bounds.loosened(2.0 * MARGIN + PREDICTION_DISTANCE);
    for (other, bounds) in all.iter().filter(|(_, bounds)| bounds.intersects(&around)) {
        let colliders = ordered([handle, *other]);
        let Some(known) = world.known.both([handle, *other]) else {
            continue;
        };
        let [a, b] = known.map(|known| Tag::unpack(known.tag));
        let may_touch = Verdicts::default().response(a, b) != ContactResponse::NoCollision;
        let moves = known[1].moves;
        let is_there = moves && pairs.iter().any(|pair| pair.colliders == colliders);
        if may_touch && !is_there && known[0].body != known[1].body {
            let moving = usize::from(colliders[0] != handle);
            pairs.push(NearPair {
                colliders,
                obstacle: (!moves).then_some((*bounds, moving)),
            });
        }
    }
}
