//! Spaces of several components.

use super::{Component, State, StateSpace};
use crate::Random;

/// Largest number of segments at which a motion is checked: more would take too long.
const MAX_SEGMENTS: f64 = 1e5;

/// Components one after the other, each with a weight: distances are the weighted sums of theirs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CompoundSpace {
    components: Vec<(Component, f64)>,
}

impl CompoundSpace {
    /// A space of components with their weights.
    pub fn new(components: Vec<(Component, f64)>) -> Self {
        Self { components }
    }

    /// The components and their weights.
    pub fn components(&self) -> &[(Component, f64)] {
        &self.components
    }

    /// The components with the numbers of two states.
    fn each<'a>(
        &'a self,
        from: &'a [f64],
        to: &'a [f64],
    ) -> impl Iterator<Item = (&'a Component, f64, &'a [f64], &'a [f64])> {
        let mut start = 0;
        self.components.iter().map(move |(component, weight)| {
            let range = start..start + component.dimension();
            start = range.end;
            (component, *weight, &from[range.clone()], &to[range])
        })
    }
}

impl StateSpace for CompoundSpace {
    fn dimension(&self) -> usize {
        self.components
            .iter()
            .map(|(component, _)| component.dimension())
            .sum()
    }

    fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        self.each(from, to)
            .map(|(component, weight, from, to)| weight * component.distance(from, to))
            .sum()
    }

    fn interpolate(&self, from: &[f64], to: &[f64], part: f64) -> State {
        let mut out = Vec::with_capacity(from.len());
        self.each(from, to)
            .for_each(|(component, _, from, to)| component.interpolate(from, to, part, &mut out));
        out
    }

    fn extent(&self) -> f64 {
        self.components
            .iter()
            .map(|(component, weight)| weight * component.extent())
            .sum()
    }

    fn sample(&self, random: &mut dyn Random) -> State {
        let mut out = Vec::new();
        self.components
            .iter()
            .for_each(|(component, _)| component.sample(random, &mut out));
        out
    }

    fn sample_near(&self, random: &mut dyn Random, near: &[f64], distance: f64) -> State {
        let mut out = Vec::with_capacity(near.len());
        for (component, weight, near, _) in self.each(near, near) {
            component.sample_near(random, near, distance / weight, &mut out);
        }
        out
    }

    fn is_within_bounds(&self, state: &[f64]) -> bool {
        self.each(state, state)
            .all(|(component, _, state, _)| component.is_within_bounds(state))
    }

    fn enforce_bounds(&self, state: &mut [f64]) {
        let mut start = 0;
        for (component, _) in &self.components {
            let end = start + component.dimension();
            component.enforce_bounds(&mut state[start..end]);
            start = end;
        }
    }

    fn parts(&self, from: &[f64], to: &[f64], fraction: f64) -> usize {
        let parts = self.each(from, to).map(|(component, _, from, to)| {
            let longest = fraction * component.extent();
            if longest > 0.0 {
                (component.distance(from, to) / longest)
                    .ceil()
                    .min(MAX_SEGMENTS) as usize
            } else {
                1
            }
        });
        parts.max().unwrap_or(1).max(1)
    }

    fn is_symmetric(&self) -> bool {
        self.components
            .iter()
            .all(|(component, _)| !matches!(component, Component::Dubins { .. }))
    }
}
