//! States that were reached, and how.

use crate::{State, StateSpace};

/// The `count` lowest of numbered values, the lowest first, of equal ones the first.
pub(crate) fn lowest(mut values: Vec<(usize, f64)>, count: usize) -> Vec<(usize, f64)> {
    let order = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0));
    if count < values.len() {
        values.select_nth_unstable_by(count, order);
        values.truncate(count);
    }
    values.sort_unstable_by(order);
    values
}

/// A state of a tree.
#[derive(Debug, Clone)]
pub(crate) struct Vertex {
    pub state: State,
    /// None for a root.
    pub parent: Option<usize>,
    /// Length of the way from the root.
    pub cost: f64,
    /// Whether the motion from the parent is known to be valid.
    pub is_checked: bool,
}

/// A tree, or several. Vertices keep their places.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tree {
    pub vertices: Vec<Vertex>,
}

impl Tree {
    pub(crate) fn of_roots(roots: &[State]) -> Self {
        let vertex = |state: &State| Vertex {
            state: state.clone(),
            parent: None,
            cost: 0.0,
            is_checked: true,
        };
        Self {
            vertices: roots.iter().map(vertex).collect(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.vertices.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    pub(crate) fn state(&self, place: usize) -> &State {
        &self.vertices[place].state
    }

    /// Adds a state that was reached by a valid motion; returns its place.
    pub(crate) fn add(&mut self, space: &dyn StateSpace, state: State, parent: usize) -> usize {
        let cost = self.vertices[parent].cost + space.distance(self.state(parent), &state);
        self.vertices.push(Vertex {
            state,
            parent: Some(parent),
            cost,
            is_checked: true,
        });
        self.vertices.len() - 1
    }

    /// The vertex from which the way to a state is shortest; the first of several.
    pub(crate) fn nearest(&self, space: &dyn StateSpace, state: &[f64]) -> Option<usize> {
        let distances = self
            .vertices
            .iter()
            .map(|vertex| space.distance(&vertex.state, state));
        distances
            .enumerate()
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(place, _)| place)
    }

    /// How many vertices are at most `radius` away from a state.
    pub(crate) fn count_within(&self, space: &dyn StateSpace, state: &[f64], radius: f64) -> usize {
        self.vertices
            .iter()
            .filter(|vertex| space.distance(&vertex.state, state) <= radius)
            .count()
    }

    /// The `count` vertices from which the ways to a state are shortest, with the lengths, the nearest first.
    pub(crate) fn nearest_few(
        &self,
        space: &dyn StateSpace,
        state: &[f64],
        count: usize,
    ) -> Vec<(usize, f64)> {
        let distances = self
            .vertices
            .iter()
            .map(|vertex| space.distance(&vertex.state, state));
        lowest(distances.enumerate().collect(), count)
    }

    /// The states from the root to a vertex.
    pub(crate) fn path_to(&self, place: usize) -> Vec<State> {
        let mut path = vec![self.state(place).clone()];
        let mut at = place;
        while let Some(parent) = self.vertices[at].parent {
            path.push(self.state(parent).clone());
            at = parent;
        }
        path.reverse();
        path
    }

    /// The motions to a vertex that were not checked, from the root on: the places they lead to.
    pub(crate) fn unchecked(&self, place: usize) -> Vec<usize> {
        let way = std::iter::successors(Some(place), |&at| self.vertices[at].parent);
        let mut unchecked: Vec<usize> = way.filter(|&at| !self.vertices[at].is_checked).collect();
        unchecked.reverse();
        unchecked
    }

    /// Removes a vertex and all that were reached by it. Parents come before their children here.
    pub(crate) fn remove_below(&mut self, top: usize) {
        // The new place of each vertex that stays.
        let mut places: Vec<Option<usize>> = Vec::with_capacity(self.len());
        let mut kept = Vec::with_capacity(self.len());
        for (place, mut vertex) in std::mem::take(&mut self.vertices).into_iter().enumerate() {
            let parent = vertex.parent.map(|parent| places[parent]);
            if place == top || parent == Some(None) {
                places.push(None);
                continue;
            }
            vertex.parent = parent.flatten();
            places.push(Some(kept.len()));
            kept.push(vertex);
        }
        self.vertices = kept;
    }
}
