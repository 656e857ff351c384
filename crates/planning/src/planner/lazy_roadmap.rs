//! Roadmaps whose motions are checked only where a path needs them (R. Bohlin and L. E. Kavraki, *Path planning using lazy PRM*, 2000), until the
//! first path, or for the shortest one; and in batches of states that can still shorten it, as BIT* (J. D. Gammell and others, 2015).

use std::collections::BTreeSet;

use super::roadmap::{data_of, needed_neighbours};
use super::{Planner, PlannerData, keep_best};
use crate::graph::Graph;
use crate::{Problem, Refusal, Solution, State, path};

/// What distinguishes the roadmaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The first path suffices.
    First,
    /// The shortest path, with states everywhere.
    Optimal,
    /// The shortest path, with states where it can become shorter.
    Informed,
}

/// States of a batch.
const BATCH: usize = 100;

/// Neighbours of a state where the first path suffices.
const NEIGHBOURS: usize = 10;

/// A roadmap that takes motions for valid until they are needed.
pub(super) struct LazyRoadmap {
    kind: Kind,
    graph: Graph,
    /// Motions known to be valid, and states.
    checked: BTreeSet<(usize, usize)>,
    starts: Vec<usize>,
    goals: Vec<usize>,
    best: Option<Solution>,
}

impl LazyRoadmap {
    pub(super) fn new(kind: Kind) -> Self {
        let (starts, goals) = (Vec::new(), Vec::new());
        Self {
            kind,
            graph: Graph::default(),
            checked: BTreeSet::new(),
            starts,
            goals,
            best: None,
        }
    }

    fn add(&mut self, problem: &Problem<'_>, state: State) -> usize {
        let count = match self.kind {
            Kind::First => NEIGHBOURS,
            _ => needed_neighbours(problem.space.dimension(), self.graph.states.len()),
        };
        let near = self.graph.nearest(problem.space, &state, count);
        let place = self.graph.add(state);
        for other in near {
            self.graph.join(problem.space, place, other);
        }
        place
    }

    /// Whether a path through a state can be shorter than the best one.
    fn is_useful(&self, problem: &Problem<'_>, state: &State) -> bool {
        let (Kind::Informed, Some(best)) = (self.kind, &self.best) else {
            return true;
        };
        let least = |places: &[usize]| {
            let distances = places
                .iter()
                .map(|&place| problem.space.distance(&self.graph.states[place], state));
            distances.fold(f64::INFINITY, f64::min)
        };
        least(&self.starts) + least(&self.goals) < path::length(problem.space, &best.states)
    }

    /// Checks shortest paths until one is valid, or there is none. False if there are checks left when the world has enough.
    fn search(&mut self, problem: &mut Problem<'_>) {
        while let Some(path) = self
            .graph
            .shortest(problem.space, &self.starts, &self.goals)
        {
            let states: Vec<State> = path
                .iter()
                .map(|&place| self.graph.states[place].clone())
                .collect();
            let length = path::length(problem.space, &states);
            if self
                .best
                .as_ref()
                .is_some_and(|best| path::length(problem.space, &best.states) <= length)
            {
                return;
            }
            if self.check(problem, &path) {
                keep_best(&mut self.best, Solution::exact(states), problem);
                return;
            }
            if problem.world.is_over() {
                return;
            }
        }
    }

    /// Checks the motions of a path; the first invalid one is removed.
    fn check(&mut self, problem: &mut Problem<'_>, path: &[usize]) -> bool {
        for pair in path.windows(2) {
            let motion = (pair[0], pair[1]);
            if self.checked.contains(&motion) {
                continue;
            }
            let (from, to) = (
                self.graph.states[motion.0].clone(),
                self.graph.states[motion.1].clone(),
            );
            if !problem.is_motion_valid(&from, &to) {
                if !problem.world.is_over() {
                    self.graph.part(motion.0, motion.1);
                }
                return false;
            }
            self.checked.insert(motion);
            if problem.space.is_symmetric() {
                self.checked.insert((motion.1, motion.0));
            }
        }
        true
    }
}

impl Planner for LazyRoadmap {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if self.starts.is_empty() {
            let goals = problem.valid_goals();
            let starts = problem.valid_starts()?;
            self.starts = starts
                .into_iter()
                .map(|state| self.add(problem, state))
                .collect();
            self.goals = goals?
                .into_iter()
                .map(|state| self.add(problem, state))
                .collect();
            self.search(problem);
        }
        let batch = if self.kind == Kind::Informed {
            BATCH
        } else {
            BATCH / 5
        };
        for round in 0..iterations {
            if problem.world.is_over() || self.kind == Kind::First && self.best.is_some() {
                break;
            }
            if let Some(state) = problem.sample_valid()
                && self.is_useful(problem, &state)
            {
                self.add(problem, state);
            }
            if round % batch as u64 == batch as u64 - 1 {
                self.search(problem);
            }
        }
        if self.kind != Kind::First || self.best.is_none() {
            self.search(problem);
        }
        Ok(self.best.clone())
    }

    fn data(&self) -> PlannerData {
        data_of(&self.graph, &self.starts, &self.goals)
    }
}
