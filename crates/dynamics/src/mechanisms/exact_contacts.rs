//! Contacts that mechanisms solve exactly, together with their joints (`articulation::Contact`): with what no force moves, with free bodies
//! that touch the mechanism (guests) and what those touch in turn, and of links with each other. So a light foot is as hard as all that stands
//! on it. rapier leaves these pairs out.
//!
//! A mechanism that touches another one, or too much, is left to rapier, with its joints as impulse joints.

use std::cell::LazyCell;
use std::collections::BTreeMap;
use std::ops::Range;

use articulation::Contact;

use super::points::{Pair, Point};
use super::search::{Conditions, Search, Touching};
use super::surroundings::NearPair;
use crate::contacts::{ColliderPair, Verdicts};
use crate::convert::to_vector;
use crate::world::World;
use scene::Handle;

/// The contacts that mechanisms solve.
#[derive(Default)]
pub(crate) struct ExactContacts {
    pairs: BTreeMap<ColliderPair, Pair>,
    points: Vec<Point>,
    /// Mechanisms that are near each other or touch the same free body.
    meetings: Vec<[usize; 2]>,
}

impl ExactContacts {
    /// Forgets the points of the sub-step before.
    pub(super) fn clear(&mut self) {
        self.points.clear();
        for pair in self.pairs.values_mut() {
            pair.is_solved = false;
            pair.touched = std::mem::take(&mut pair.touches);
        }
    }

    /// Forgets what was found in this sub-step.
    pub(super) fn restart(&mut self) {
        self.points.clear();
        for pair in self.pairs.values_mut() {
            (pair.is_solved, pair.touches) = (false, false);
        }
    }

    /// The mechanisms that were found near each other, or near a guest of each other, since this was last asked.
    pub(super) fn meetings(&mut self) -> Vec<[usize; 2]> {
        std::mem::take(&mut self.meetings)
    }

    /// Whether two colliders were near each other in the sub-step before, and solved here.
    pub(super) fn touched(&self, pair: ColliderPair) -> bool {
        self.pairs.get(&pair).is_some_and(|pair| pair.touched)
    }

    /// Finds what a mechanism touches; returns its guests, or None when it is left to rapier. `near`: what it may touch, if that is known.
    pub(super) fn find(
        &mut self,
        world: &World,
        conditions: Conditions<'_>,
        touching: Touching<'_>,
        near: Option<&[NearPair]>,
    ) -> Option<Vec<Handle>> {
        let mechanism = touching.mechanism;
        let mut search = Search::new(world, conditions, touching);
        let found = match near {
            Some(near) => search.look_at_known(near, &mut self.pairs),
            None => search.run(&mut self.pairs),
        };
        self.meetings
            .extend(search.meeting.map(|other| [mechanism, other]));
        if found.is_none() {
            self.pairs.retain(|_, pair| pair.mechanism != mechanism);
            return None;
        }
        self.points.append(&mut search.points);
        Some(search.guests)
    }

    /// The contacts of a mechanism.
    pub(super) fn of(&self, mechanism: usize) -> impl Iterator<Item = Contact> {
        self.points[self.range(mechanism)]
            .iter()
            .map(|point| point.contact)
    }

    /// Where the points of a mechanism are: they are found in the order of mechanisms.
    fn range(&self, mechanism: usize) -> Range<usize> {
        let first = self
            .points
            .partition_point(|point| point.mechanism < mechanism);
        let count = self.points[first..].partition_point(|point| point.mechanism == mechanism);
        first..first + count
    }

    /// Stores what the contacts of a mechanism exert.
    pub(super) fn store(&mut self, mechanism: usize, impulses: impl Iterator<Item = [f64; 3]>) {
        let range = self.range(mechanism);
        let points = &mut self.points[range];
        for (point, impulse) in points.iter_mut().zip(impulses) {
            point.impulse = to_vector(impulse);
        }
        for of_pair in points.chunk_by(|a, b| a.colliders == b.colliders) {
            if let Some(pair) = self.pairs.get_mut(&of_pair[0].pair()) {
                of_pair.iter().for_each(|point| pair.store(point));
            }
        }
    }

    /// Leaves the contacts of a mechanism to rapier.
    pub(super) fn leave(&mut self, mechanism: usize) {
        self.points.retain(|point| point.mechanism != mechanism);
        self.pairs.retain(|_, pair| pair.mechanism != mechanism);
    }

    /// The pairs that mechanisms solve, rising; pairs that are no longer near are forgotten, but for those of sleepers. Sleepers of which scripts decide
    /// anew, or that something comes near to, wake up.
    pub(crate) fn pairs(&mut self, world: &mut World, verdicts: &Verdicts) -> Vec<ColliderPair> {
        if self.pairs.values().any(|pair| !pair.is_solved) {
            let disturbed = LazyCell::new(|| world.disturbed());
            let stays = |key: ColliderPair, pair: &Pair| {
                let is_as_before = || {
                    world
                        .verdict(key, verdicts)
                        .is_some_and(|now| now == pair.response)
                };
                pair.is_solved
                    || world.sleeps(key, |index| disturbed.contains(&index)) && is_as_before()
            };
            let mut left = Vec::new();
            self.pairs.retain(|&key, pair| {
                let stays = stays(key, pair);
                if !stays {
                    left.push(key);
                }
                stays
            });
            left.into_iter().for_each(|key| world.wake_pair(key));
        }
        self.pairs.keys().copied().collect()
    }

    /// The points of the present sub-step.
    pub(crate) fn points(&self) -> &[Point] {
        &self.points
    }
}
