//! What is near a body, and how far it goes in a sub-step.

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::bounding_volume::BoundingVolume;
use rapier3d_f64::prelude::{Collider, ColliderHandle, QueryFilter, RigidBody, RigidBodyHandle};

use super::bodies::Tag;
use super::contacts::{ColliderPair, ContactResponse, Verdicts};
use super::free_rotation;
use super::world::{PREDICTION_DISTANCE, World};

/// Way in a sub-step up to which rapier knows beforehand what a body may touch, metres.
const KNOWN_WAY: f64 = PREDICTION_DISTANCE / 2.0;

impl World {
    /// The pairs of a collider with what it may touch in a sub-step of `step` seconds: those that rapier knows, and what is in the way of a fast one.
    pub(super) fn near(&self, collider: ColliderHandle, step: f64) -> Vec<[ColliderHandle; 2]> {
        let known = self.narrow_phase.contact_pairs_with(collider);
        let mut pairs: Vec<_> = known.map(|pair| [pair.collider1, pair.collider2]).collect();
        pairs.extend(self.ahead(collider, step));
        pairs
    }

    /// The pairs of a fast collider with what is in its way.
    pub(super) fn ahead(&self, handle: ColliderHandle, step: f64) -> Vec<[ColliderHandle; 2]> {
        let Some(collider) = self.colliders.get(handle) else {
            return Vec::new();
        };
        let way = self.way(collider, step);
        if !(KNOWN_WAY..f64::MAX).contains(&way) {
            return Vec::new();
        }
        let here = collider.compute_aabb();
        let shift = self.way_of_point(collider, collider.position().translation, step);
        let there = here.translated(shift);
        let swept = here.merged(&there).loosened(PREDICTION_DISTANCE);
        let dispatcher = self.narrow_phase.query_dispatcher();
        let query = self.broad_phase.as_query_pipeline(
            dispatcher,
            &self.bodies,
            &self.colliders,
            QueryFilter::default().exclude_collider(handle),
        );
        let mut found: Vec<ColliderHandle> = query
            .intersect_aabb_conservative(swept)
            .map(|(other, _)| other)
            .collect();
        found.sort_unstable_by_key(|other| other.into_raw_parts());
        found
            .into_iter()
            .map(|other| ordered([handle, other]))
            .collect()
    }

    /// Whether a body may touch something in a sub-step.
    pub(super) fn is_near_anything(&self, rigid: &RigidBody, step: f64) -> bool {
        let has_pair = |&collider: &ColliderHandle| {
            let mut pairs = self.narrow_phase.contact_pairs_with(collider);
            pairs.next().is_some() || !self.ahead(collider, step).is_empty()
        };
        rigid.colliders().iter().any(has_pair)
    }

    /// How far no point of a collider goes in a sub-step, metres.
    pub(super) fn way(&self, collider: &Collider, step: f64) -> f64 {
        let Some(rigid) = collider.parent().and_then(|body| self.bodies.get(body)) else {
            return 0.0;
        };
        if rigid.is_fixed() {
            return 0.0;
        }
        let extent = rigid.mass_properties().max_extent();
        let fall = self.gravity().length() * step * rigid.gravity_scale();
        (rigid.linvel().length() + rigid.angvel().length() * extent + fall) * step
    }

    /// Where a point of a collider goes in a sub-step, metres.
    pub(super) fn way_of_point(&self, collider: &Collider, point: Vector, step: f64) -> Vector {
        let Some(rigid) = collider.parent().and_then(|body| self.bodies.get(body)) else {
            return Vector::ZERO;
        };
        let fall = if rigid.is_dynamic() {
            self.gravity() * step
        } else {
            Vector::ZERO
        };
        (rigid.velocity_at_point(point) + fall) * step
    }

    /// Whether the bodies of a pair of colliders sleep, and nothing that moves is near them.
    /// `is_disturbed`: whether a collider is near one that moves, by index.
    pub(super) fn sleeps(&self, pair: ColliderPair, is_disturbed: impl Fn(u32) -> bool) -> bool {
        let sides = [pair.0, pair.1].map(|index| {
            let (collider, _) = self.colliders.get_unknown_gen(index)?;
            let rigid = self.bodies.get(collider.parent()?)?;
            let rests = rigid.is_fixed() || rigid.is_sleeping() && !is_disturbed(index);
            rests.then(|| rigid.is_dynamic())
        });
        matches!(sides, [Some(a), Some(b)] if a || b)
    }

    /// What scripts say about a pair of colliders; None when one is gone.
    pub(super) fn verdict(
        &self,
        pair: ColliderPair,
        verdicts: &Verdicts,
    ) -> Option<ContactResponse> {
        let tag = |index: u32| {
            let (collider, _) = self.colliders.get_unknown_gen(index)?;
            Some(Tag::unpack(collider.user_data))
        };
        Some(verdicts.response(tag(pair.0)?, tag(pair.1)?))
    }

    /// Wakes what a pair of colliders belongs to.
    pub(super) fn wake_pair(&mut self, pair: ColliderPair) {
        for index in [pair.0, pair.1] {
            let parent = |(collider, _): (&Collider, _)| collider.parent();
            let body = self.colliders.get_unknown_gen(index).and_then(parent);
            let sleeps = |rigid: &RigidBody| rigid.is_dynamic() && rigid.is_sleeping();
            if let Some(body) = body
                && self.bodies.get(body).is_some_and(sleeps)
                && let Some(rigid) = self.bodies.get_mut(body)
            {
                rigid.wake_up(true);
            }
        }
    }

    /// The colliders that are near bodies that are awake, by index.
    pub(super) fn disturbed(&self) -> BTreeSet<u32> {
        let awake = self.awake().filter_map(|body| self.bodies.get(body));
        awake
            .flat_map(|rigid| rigid.colliders())
            .flat_map(|&collider| self.narrow_phase.contact_pairs_with(collider))
            .flat_map(|pair| [pair.collider1, pair.collider2])
            .map(|collider| collider.into_raw_parts().0)
            .collect()
    }
}

impl World {
    /// The bodies that touch nothing and tumble. rapier applies the gyroscopic torque to all others but those of mechanisms.
    pub(super) fn select_tumbling(&mut self) -> Vec<RigidBodyHandle> {
        let (mut tumbling, mut changes) = (Vec::new(), Vec::new());
        for handle in self.awake() {
            let Some(rigid) = self.bodies.get(handle) else {
                continue;
            };
            if !rigid.is_dynamic() || rigid.user_data == free_rotation::LINKED {
                continue;
            }
            let tumbles = free_rotation::tumbles(rigid) && self.is_alone(rigid);
            if tumbles {
                tumbling.push(handle);
            }
            if rigid.gyroscopic_forces_enabled() == tumbles {
                changes.push((handle, !tumbles));
            }
        }
        for (handle, is_on) in changes {
            if let Some(rigid) = self.bodies.get_mut(handle) {
                rigid.enable_gyroscopic_forces(is_on);
            }
        }
        tumbling
    }

    fn is_alone(&self, rigid: &RigidBody) -> bool {
        let has_pair = |&collider: &ColliderHandle| {
            let mut pairs = self.narrow_phase.contact_pairs_with(collider);
            pairs.next().is_some()
        };
        !rigid.colliders().iter().any(has_pair)
    }
}

/// A pair in the order in which it is asked about.
pub(super) fn ordered([first, second]: [ColliderHandle; 2]) -> [ColliderHandle; 2] {
    if first.into_raw_parts() < second.into_raw_parts() {
        [first, second]
    } else {
        [second, first]
    }
}
