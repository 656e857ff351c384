//! Trees that are rewired towards shorter paths: RRT* (S. Karaman and E. Frazzoli, *Sampling-based algorithms for optimal motion planning*,
//! 2011). With rejection of states that cannot shorten the path (J. D. Gammell and others, *Informed RRT\**, 2014).

use super::rrt::data_of;
use super::{GOAL_BIAS, Planner, PlannerData, RANGE, keep_best};
use crate::tree::Tree;
use crate::{Goal, Problem, Refusal, Solution, State};

/// How much larger the neighbourhood is than what suffices.
const REWIRE_FACTOR: f64 = 1.1;

/// A tree of short paths.
pub(super) struct RrtStar {
    tree: Tree,
    children: Vec<Vec<usize>>,
    /// Vertices in the goal.
    goals: Vec<usize>,
    is_informed: bool,
    best: Option<Solution>,
}

impl RrtStar {
    pub(super) fn new(is_informed: bool) -> Self {
        Self {
            tree: Tree::default(),
            children: Vec::new(),
            goals: Vec::new(),
            is_informed,
            best: None,
        }
    }

    /// Whether no path through a state can be shorter than the best one.
    fn is_useless(&self, problem: &Problem<'_>, state: &State) -> bool {
        let (true, Some(best), Goal::States(goals)) =
            (self.is_informed, self.exact_length(problem), &problem.goal)
        else {
            return false;
        };
        let from = problem
            .starts
            .iter()
            .map(|start| problem.space.distance(start, state));
        let to = goals.iter().map(|goal| problem.space.distance(state, goal));
        from.fold(f64::INFINITY, f64::min) + to.fold(f64::INFINITY, f64::min) >= best
    }

    fn exact_length(&self, problem: &Problem<'_>) -> Option<f64> {
        let best = self.best.as_ref().filter(|best| best.is_exact)?;
        Some(crate::path::length(problem.space, &best.states))
    }

    /// The neighbourhood of a new state: the k nearest vertices, as many as RRT* needs.
    fn neighbours(&self, problem: &Problem<'_>, state: &State) -> Vec<(usize, f64)> {
        let dimension = problem.space.dimension() as f64;
        let factor = REWIRE_FACTOR * std::f64::consts::E * (1.0 + 1.0 / dimension);
        let count = (factor * libm::log(self.tree.len() as f64 + 1.0)).ceil() as usize;
        self.tree.nearest_few(problem.space, state, count.max(1))
    }

    /// Grows by one state, with the shortest way to it.
    fn grow(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<usize> {
        let aim = if problem.random.next() < GOAL_BIAS {
            problem.sample_goal()
        } else {
            None
        };
        let sample = aim.unwrap_or_else(|| problem.sample());
        if self.is_useless(problem, &sample) {
            return None;
        }
        let nearest = self.tree.nearest(problem.space, &sample)?;
        let from = self.tree.state(nearest).clone();
        let state = problem.towards(&from, &sample, range);
        if self
            .goals
            .iter()
            .any(|&goal| *self.tree.state(goal) == state)
            || !problem.is_motion_valid(&from, &state)
        {
            return None;
        }
        let near = self.neighbours(problem, &state);
        let parent = self.best_parent(problem, &near, nearest, &state);
        let place = self.tree.add(problem.space, state, parent);
        self.children.push(Vec::new());
        self.children[parent].push(place);
        self.rewire(problem, place, &near);
        Some(place)
    }

    /// The neighbour by which the way to a state is shortest. Motions are checked from the shortest way on, until one is valid.
    fn best_parent(
        &self,
        problem: &mut Problem<'_>,
        near: &[(usize, f64)],
        nearest: usize,
        state: &State,
    ) -> usize {
        let mut ways: Vec<(f64, usize)> = near
            .iter()
            .map(|&(place, distance)| (self.tree.vertices[place].cost + distance, place))
            .collect();
        ways.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        for (_, place) in ways {
            if place == nearest || problem.is_motion_valid(&self.tree.state(place).clone(), state) {
                return place;
            }
        }
        nearest
    }

    /// Leads the ways to neighbours over a new state where they are shorter then.
    fn rewire(&mut self, problem: &mut Problem<'_>, place: usize, near: &[(usize, f64)]) {
        let state = self.tree.state(place).clone();
        for &(other, _) in near {
            let to = self.tree.state(other).clone();
            let cost = self.tree.vertices[place].cost + problem.space.distance(&state, &to);
            let Some(parent) = self.tree.vertices[other].parent else {
                continue;
            };
            if cost < self.tree.vertices[other].cost - 1e-12 && problem.is_motion_valid(&state, &to)
            {
                self.children[parent].retain(|&child| child != other);
                self.children[place].push(other);
                self.tree.vertices[other].parent = Some(place);
                self.update_costs(problem, other);
            }
        }
    }

    /// The costs of a vertex with a new parent and of all below it.
    fn update_costs(&mut self, problem: &Problem<'_>, top: usize) {
        let mut changed = vec![top];
        while let Some(place) = changed.pop() {
            if let Some(parent) = self.tree.vertices[place].parent {
                let piece = problem
                    .space
                    .distance(self.tree.state(parent), self.tree.state(place));
                self.tree.vertices[place].cost = self.tree.vertices[parent].cost + piece;
            }
            changed.extend(&self.children[place]);
        }
    }

    fn consider(&mut self, problem: &mut Problem<'_>, place: usize) {
        let nearness = problem.nearness(&self.tree.state(place).clone());
        if nearness.is_reached {
            self.goals.push(place);
        } else {
            let approximate = Solution {
                states: self.tree.path_to(place),
                is_exact: false,
                difference: nearness.distance,
            };
            if self
                .best
                .as_ref()
                .is_none_or(|best| approximate.is_better(best, problem.space))
            {
                self.best = Some(approximate);
            }
        }
    }

    /// The shortest path to the goal may have changed.
    fn update_best(&mut self, problem: &Problem<'_>) {
        let cost = |place: usize| self.tree.vertices[place].cost;
        if let Some(&goal) = self
            .goals
            .iter()
            .min_by(|&&a, &&b| cost(a).total_cmp(&cost(b)))
        {
            keep_best(
                &mut self.best,
                Solution::exact(self.tree.path_to(goal)),
                problem,
            );
        }
    }
}

impl Planner for RrtStar {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if self.tree.is_empty() {
            self.tree = Tree::of_roots(&problem.valid_starts()?);
            self.children = vec![Vec::new(); self.tree.len()];
            (0..self.tree.len()).for_each(|place| self.consider(problem, place));
        }
        let range = RANGE * problem.space.extent();
        for _ in 0..iterations {
            if problem.world.is_over() {
                break;
            }
            if let Some(place) = self.grow(problem, range) {
                self.consider(problem, place);
                self.update_best(problem);
            }
        }
        self.update_best(problem);
        Ok(self.best.clone())
    }

    fn data(&self) -> PlannerData {
        PlannerData {
            goals: self.goals.clone(),
            ..data_of(&self.tree)
        }
    }
}
