//! Rapidly exploring random trees (S. M. LaValle and J. J. Kuffner, *Randomized kinodynamic planning*, 2001), also without checks until a path
//! is there (R. Bohlin and L. E. Kavraki's idea, applied to trees), and with a transition test (L. Jaillet, J. Cortés and T. Siméon, *Sampling-based
//! path planning on configuration-space costmaps*, 2010).

use super::{
    COST_RANGE, FRONTIER, FRONTIER_RATIO, GOAL_BIAS, Planner, PlannerData, RANGE, keep_best,
};
use crate::tree::Tree;
use crate::{Problem, Refusal, Solution, State};

/// What distinguishes the trees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Plain,
    /// Motions are checked when they belong to a path.
    Lazy,
    /// States near others, which refine the tree only, are kept to a tenth of all.
    Transition,
}

/// A tree that grows from the starts.
pub(super) struct Rrt {
    kind: Kind,
    tree: Tree,
    explored: f64,
    refined: f64,
    best: Option<Solution>,
}

impl Rrt {
    pub(super) fn new(kind: Kind) -> Self {
        Self {
            kind,
            tree: Tree::default(),
            explored: 1.0,
            refined: 1.0,
            best: None,
        }
    }

    fn range(&self, problem: &Problem<'_>) -> f64 {
        let part = if self.kind == Kind::Transition {
            COST_RANGE
        } else {
            RANGE
        };
        part * problem.space.extent()
    }

    /// Grows by one motion; the place of the state it leads to.
    fn grow(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<usize> {
        let aim = if problem.random.next() < GOAL_BIAS {
            problem.sample_goal()
        } else {
            None
        };
        let sample: State = aim.unwrap_or_else(|| problem.sample());
        let nearest = self.tree.nearest(problem.space, &sample)?;
        let from = self.tree.state(nearest).clone();
        let to = problem.towards(&from, &sample, range);
        if self.kind == Kind::Transition && !self.is_welcome(problem, &from, &to) {
            return None;
        }
        if self.kind != Kind::Lazy && !problem.is_motion_valid(&from, &to) {
            return None;
        }
        let place = self.tree.add(problem.space, to, nearest);
        self.tree.vertices[place].is_checked = self.kind != Kind::Lazy;
        Some(place)
    }

    /// Counts states that explore and that refine; whether one more of its kind is welcome. Lengths of paths are no costs of states, so every
    /// transition passes the test itself.
    fn is_welcome(&mut self, problem: &Problem<'_>, from: &State, to: &State) -> bool {
        if problem.space.distance(from, to) >= FRONTIER * problem.space.extent() {
            self.explored += 1.0;
            return true;
        }
        if self.refined / self.explored > FRONTIER_RATIO && self.tree.len() > 10 {
            return false;
        }
        self.refined += 1.0;
        true
    }

    /// Checks the motions to a vertex from the root on. An invalid one is removed with all that follows.
    fn check(&mut self, problem: &mut Problem<'_>, place: usize) -> bool {
        for child in self.tree.unchecked(place) {
            let Some(parent) = self.tree.vertices[child].parent else {
                continue;
            };
            let (from, to) = (
                self.tree.state(parent).clone(),
                self.tree.state(child).clone(),
            );
            if !problem.is_motion_valid(&from, &to) {
                self.tree.remove_below(child);
                return false;
            }
            self.tree.vertices[child].is_checked = true;
        }
        true
    }

    /// Whether the path to a new vertex is better than what there is; true if it is exact.
    fn consider(&mut self, problem: &mut Problem<'_>, place: usize) -> bool {
        let nearness = problem.nearness(&self.tree.state(place).clone());
        let is_better = self
            .best
            .as_ref()
            .is_none_or(|best| nearness.distance < best.difference);
        if !(nearness.is_reached || is_better && self.kind != Kind::Lazy)
            || !self.check(problem, place)
        {
            return false;
        }
        let difference = if nearness.is_reached {
            0.0
        } else {
            nearness.distance
        };
        let solution = Solution {
            states: self.tree.path_to(place),
            is_exact: nearness.is_reached,
            difference,
        };
        keep_best(&mut self.best, solution, problem);
        nearness.is_reached
    }
}

impl Planner for Rrt {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if self.tree.is_empty() {
            self.tree = Tree::of_roots(&problem.valid_starts()?);
            for place in 0..self.tree.len() {
                if self.consider(problem, place) {
                    return Ok(self.best.clone());
                }
            }
        }
        let range = self.range(problem);
        for _ in 0..iterations {
            if problem.world.is_over() || self.best.as_ref().is_some_and(|best| best.is_exact) {
                break;
            }
            if let Some(place) = self.grow(problem, range)
                && self.consider(problem, place)
            {
                break;
            }
        }
        Ok(self.best.clone())
    }

    fn data(&self) -> PlannerData {
        data_of(&self.tree)
    }
}

/// A tree as planners report it.
pub(super) fn data_of(tree: &Tree) -> PlannerData {
    let vertices = || tree.vertices.iter().enumerate();
    PlannerData {
        states: tree
            .vertices
            .iter()
            .map(|vertex| vertex.state.clone())
            .collect(),
        tags: vec![0; tree.len()],
        edges: vertices()
            .filter_map(|(place, vertex)| Some((vertex.parent?, place)))
            .collect(),
        starts: vertices()
            .filter(|(_, vertex)| vertex.parent.is_none())
            .map(|(place, _)| place)
            .collect(),
        goals: Vec::new(),
    }
}

/// Two trees as planners report them: the second grows from the goal.
pub(super) fn data_of_both(start: &Tree, goal: &Tree) -> PlannerData {
    let (mut data, other) = (data_of(start), data_of(goal));
    let count = data.states.len();
    data.tags = [vec![1; count], vec![2; other.states.len()]].concat();
    data.states.extend(other.states);
    data.edges.extend(
        other
            .edges
            .into_iter()
            .map(|(from, to)| (to + count, from + count)),
    );
    data.goals = other
        .starts
        .into_iter()
        .map(|place| place + count)
        .collect();
    data
}
