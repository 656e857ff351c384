//! Fast marching trees (L. Janson and others, *Fast marching tree*, 2015): a set of states, and one pass over it in the order of the lengths of the
//! ways to them.

use super::rrt::data_of;
use super::{Planner, PlannerData};
use crate::tree::{Tree, lowest};
use crate::{Problem, Refusal, Solution, State};

/// States of the first pass; a pass that finds nothing is followed by one with twice as many.
const SAMPLES: usize = 1000;
/// How much larger the neighbourhood is than what suffices.
const RADIUS_FACTOR: f64 = 1.1;

/// The tree of the last pass.
#[derive(Default)]
pub(super) struct FastMarching {
    tree: Tree,
    solution: Option<Solution>,
    passes: u32,
}

/// States that are not in the tree yet.
struct Unvisited {
    states: Vec<State>,
    is_left: Vec<bool>,
}

impl Unvisited {
    /// The goals and so many other valid states.
    fn sampled(problem: &mut Problem<'_>, goals: &[State], samples: usize) -> Self {
        let mut states: Vec<State> = goals.to_vec();
        while states.len() < samples + goals.len() && !problem.world.is_over() {
            let Some(state) = problem.sample_valid() else {
                break;
            };
            states.push(state);
        }
        Self {
            is_left: vec![true; states.len()],
            states,
        }
    }

    fn near(&self, problem: &Problem<'_>, state: &State, count: usize) -> Vec<usize> {
        let left = (0..self.states.len()).filter(|&place| self.is_left[place]);
        let distances =
            left.map(|place| (place, problem.space.distance(state, &self.states[place])));
        lowest(distances.collect(), count)
            .into_iter()
            .map(|(place, _)| place)
            .collect()
    }
}

impl FastMarching {
    /// One pass over so many states.
    fn pass(
        &mut self,
        problem: &mut Problem<'_>,
        starts: &[State],
        goals: &[State],
        samples: usize,
    ) {
        let mut unvisited = Unvisited::sampled(problem, goals, samples);
        self.tree = Tree::of_roots(starts);
        let mut open: Vec<usize> = (0..starts.len()).collect();
        let neighbours = neighbours(problem, samples);
        while let Some(at) = self.take_lowest(&mut open) {
            let state = self.tree.state(at).clone();
            if goals.contains(&state) {
                self.solution = Some(Solution::exact(self.tree.path_to(at)));
                return;
            }
            if problem.world.is_over() {
                return;
            }
            let mut added = Vec::new();
            let candidates: Vec<usize> = open.iter().copied().chain([at]).collect();
            for place in unvisited.near(problem, &state, neighbours) {
                added.extend(self.visit(problem, &candidates, &mut unvisited, place));
            }
            open.extend(added);
        }
    }

    fn take_lowest(&self, open: &mut Vec<usize>) -> Option<usize> {
        let cost = |place: &usize| self.tree.vertices[*place].cost;
        let lowest = (0..open.len()).min_by(|&a, &b| cost(&open[a]).total_cmp(&cost(&open[b])))?;
        Some(open.swap_remove(lowest))
    }

    /// Joins a state to the open vertex by which the way to it is shortest, if that motion is valid.
    fn visit(
        &mut self,
        problem: &mut Problem<'_>,
        open: &[usize],
        unvisited: &mut Unvisited,
        place: usize,
    ) -> Option<usize> {
        let state = unvisited.states[place].clone();
        let cost = |vertex: usize| {
            self.tree.vertices[vertex].cost
                + problem.space.distance(self.tree.state(vertex), &state)
        };
        let best = open
            .iter()
            .copied()
            .map(|vertex| (cost(vertex), vertex))
            .min_by(|(a, _), (b, _)| a.total_cmp(b));
        let (_, parent) = best?;
        let from = self.tree.state(parent).clone();
        if !problem.is_motion_valid(&from, &state) {
            return None;
        }
        unvisited.is_left[place] = false;
        Some(self.tree.add(problem.space, state, parent))
    }
}

/// The number of neighbours that a pass over so many states needs.
fn neighbours(problem: &Problem<'_>, samples: usize) -> usize {
    let dimension = problem.space.dimension().max(1) as f64;
    let factor = RADIUS_FACTOR * std::f64::consts::E * 2.0 * (1.0 + 1.0 / dimension);
    (factor * libm::log(samples as f64 + 1.0)).ceil() as usize
}

impl Planner for FastMarching {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        let goals = problem.valid_goals();
        let (starts, goals) = (problem.valid_starts()?, goals?);
        let mut left = iterations;
        while self.solution.is_none() && left > 0 && !problem.world.is_over() {
            let samples =
                (SAMPLES << self.passes.min(10)).min(usize::try_from(left).unwrap_or(usize::MAX));
            self.pass(problem, &starts, &goals, samples);
            self.passes += 1;
            left -= samples as u64;
        }
        Ok(self.solution.clone())
    }

    fn data(&self) -> PlannerData {
        data_of(&self.tree)
    }
}
