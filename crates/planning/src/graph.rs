//! Graphs of states, and shortest paths in them.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use crate::tree::lowest;
use crate::{State, StateSpace};

/// States and the motions between them, with their lengths.
#[derive(Debug, Clone, Default)]
pub(crate) struct Graph {
    pub states: Vec<State>,
    pub edges: Vec<BTreeMap<usize, f64>>,
}

/// A vertex on the way to the goal; the one with the shortest estimate comes first, and the first of equal ones.
struct Open {
    estimate: f64,
    place: usize,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .estimate
            .total_cmp(&self.estimate)
            .then(other.place.cmp(&self.place))
    }
}

impl Graph {
    pub(crate) fn add(&mut self, state: State) -> usize {
        self.states.push(state);
        self.edges.push(BTreeMap::new());
        self.states.len() - 1
    }

    pub(crate) fn join(&mut self, space: &dyn StateSpace, from: usize, to: usize) {
        let length = space.distance(&self.states[from], &self.states[to]);
        self.edges[from].insert(to, length);
        self.edges[to].insert(from, length);
    }

    pub(crate) fn part(&mut self, from: usize, to: usize) {
        self.edges[from].remove(&to);
        self.edges[to].remove(&from);
    }

    /// The `count` vertices nearest to a state.
    pub(crate) fn nearest(
        &self,
        space: &dyn StateSpace,
        state: &[f64],
        count: usize,
    ) -> Vec<usize> {
        let distances = self.states.iter().map(|other| space.distance(other, state));
        lowest(distances.enumerate().collect(), count)
            .into_iter()
            .map(|(place, _)| place)
            .collect()
    }

    /// The shortest path from one of `starts` to one of `goals` (A*, with the distance as the estimate).
    pub(crate) fn shortest(
        &self,
        space: &dyn StateSpace,
        starts: &[usize],
        goals: &[usize],
    ) -> Option<Vec<usize>> {
        let estimate = |place: usize| {
            let distances = goals
                .iter()
                .map(|&goal| space.distance(&self.states[place], &self.states[goal]));
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut costs = vec![f64::INFINITY; self.states.len()];
        let mut parents = vec![usize::MAX; self.states.len()];
        let mut is_closed = vec![false; self.states.len()];
        let mut open = BinaryHeap::new();
        for &start in starts {
            costs[start] = 0.0;
            open.push(Open {
                estimate: estimate(start),
                place: start,
            });
        }
        while let Some(Open { place, .. }) = open.pop() {
            if std::mem::replace(&mut is_closed[place], true) {
                continue;
            }
            if goals.contains(&place) {
                return Some(path_to(&parents, place));
            }
            for (&next, length) in &self.edges[place] {
                let cost = costs[place] + length;
                if cost < costs[next] {
                    (costs[next], parents[next], is_closed[next]) = (cost, place, false);
                    open.push(Open {
                        estimate: cost + estimate(next),
                        place: next,
                    });
                }
            }
        }
        None
    }
}

fn path_to(parents: &[usize], place: usize) -> Vec<usize> {
    let mut path = vec![place];
    let mut at = place;
    while parents[at] != usize::MAX {
        at = parents[at];
        path.push(at);
    }
    path.reverse();
    path
}
