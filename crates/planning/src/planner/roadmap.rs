//! Probabilistic roadmaps (L. E. Kavraki and others, 1996), with as many neighbours as shortest paths need as PRM* (S. Karaman and E. Frazzoli,
//! 2011).

use super::{Planner, PlannerData, RANGE, keep_best};
use crate::graph::Graph;
use crate::{Problem, Refusal, Solution, State};

/// Neighbours that a state of a plain roadmap is joined to.
const NEIGHBOURS: usize = 10;

/// States between two searches for a path.
const BETWEEN_SEARCHES: usize = 10;

/// A roadmap whose motions are all valid.
pub(super) struct Roadmap {
    is_optimising: bool,
    graph: Graph,
    starts: Vec<usize>,
    goals: Vec<usize>,
    best: Option<Solution>,
}

/// The number of neighbours that shortest paths need.
pub(super) fn needed_neighbours(dimension: usize, count: usize) -> usize {
    let factor = std::f64::consts::E * (1.0 + 1.0 / dimension.max(1) as f64);
    ((factor * libm::log(count as f64 + 1.0)).ceil() as usize).max(1)
}

impl Roadmap {
    pub(super) fn new(is_optimising: bool) -> Self {
        Self {
            is_optimising,
            graph: Graph::default(),
            starts: Vec::new(),
            goals: Vec::new(),
            best: None,
        }
    }

    fn add(&mut self, problem: &mut Problem<'_>, state: State) -> usize {
        let count = match self.is_optimising {
            true => needed_neighbours(problem.space.dimension(), self.graph.states.len()),
            false => NEIGHBOURS,
        };
        let near = self.graph.nearest(problem.space, &state, count);
        let place = self.graph.add(state);
        for other in near {
            let (from, to) = (
                self.graph.states[place].clone(),
                self.graph.states[other].clone(),
            );
            // A motion of a roadmap is used in both directions.
            let back = problem.space.is_symmetric() || problem.is_motion_valid(&to, &from);
            if back && problem.is_motion_valid(&from, &to) {
                self.graph.join(problem.space, place, other);
            }
        }
        place
    }

    fn search(&mut self, problem: &Problem<'_>) {
        if let Some(path) = self
            .graph
            .shortest(problem.space, &self.starts, &self.goals)
        {
            let states = path
                .into_iter()
                .map(|place| self.graph.states[place].clone())
                .collect();
            keep_best(&mut self.best, Solution::exact(states), problem);
        }
    }

    /// A walk of random motions from a state that is hard to leave, whose states are all joined.
    fn bounce(&mut self, problem: &mut Problem<'_>) {
        const BOUNCES: usize = 5;
        let few = |place: &usize| self.graph.edges[*place].len();
        let Some(mut place) = (0..self.graph.states.len()).min_by_key(few) else {
            return;
        };
        for _ in 0..BOUNCES {
            let aim = problem.sample();
            let from = self.graph.states[place].clone();
            let aim = problem.towards(&from, &aim, RANGE * problem.space.extent());
            let (state, part) = problem.last_valid(&from, &aim);
            if part <= 0.0 {
                return;
            }
            place = self.add(problem, state);
        }
    }

    fn is_done(&self, problem: &mut Problem<'_>) -> bool {
        problem.world.is_over() || self.best.is_some() && !self.is_optimising
    }
}

impl Planner for Roadmap {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if self.starts.is_empty() {
            let goals = problem.valid_goals();
            for state in problem.valid_starts()? {
                let place = self.add(problem, state);
                self.starts.push(place);
            }
            for state in goals? {
                let place = self.add(problem, state);
                self.goals.push(place);
            }
            self.search(problem);
        }
        for round in 0..iterations {
            if self.is_done(problem) {
                break;
            }
            if let Some(state) = problem.sample_valid() {
                self.add(problem, state);
            }
            if round % BETWEEN_SEARCHES as u64 == 0 {
                self.bounce(problem);
                self.search(problem);
            }
        }
        self.search(problem);
        Ok(self.best.clone())
    }

    fn clear_query(&mut self) {
        self.starts.clear();
        self.goals.clear();
        self.best = None;
    }

    fn data(&self) -> PlannerData {
        data_of(&self.graph, &self.starts, &self.goals)
    }
}

/// A graph as planners report it.
pub(super) fn data_of(graph: &Graph, starts: &[usize], goals: &[usize]) -> PlannerData {
    let edges = graph.edges.iter().enumerate();
    PlannerData {
        states: graph.states.clone(),
        tags: vec![0; graph.states.len()],
        edges: edges
            .flat_map(|(from, to)| to.keys().map(move |&to| (from, to)))
            .filter(|(a, b)| a < b)
            .collect(),
        starts: starts.to_vec(),
        goals: goals.to_vec(),
    }
}
