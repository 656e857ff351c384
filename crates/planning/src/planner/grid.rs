//! Trees that explore the border of the cells they have reached: KPIECE1 (I. A. Şucan and L. E. Kavraki, *Kinodynamic motion planning by
//! interior-exterior cell exploration*, 2008), from one or both ends, and with checks at the end only as LBKPIECE1 and SBL (G. Sánchez and
//! J.-C. Latombe, *A single-query bi-directional probabilistic roadmap planner with lazy collision checking*, 2001).

use std::collections::BTreeMap;

use super::rrt::{data_of, data_of_both};
use super::{GOAL_BIAS, Planner, PlannerData, RANGE, keep_best};
use crate::tree::Tree;
use crate::{Problem, Refusal, Solution, State};

/// Part of the choices that prefer cells with fewer neighbours than they could have.
const BORDER: f64 = 0.9;
/// How much less a cell counts after a motion that failed.
const FAILED: f64 = 0.5;
/// Fraction of a motion that must be valid for it to be kept.
const MIN_VALID_FRACTION: f64 = 0.2;
/// The same for a planner with two trees.
const MIN_VALID_FRACTION_BIDIRECTIONAL: f64 = 0.5;

/// A tree with its cells.
#[derive(Default)]
struct Cells {
    tree: Tree,
    cells: BTreeMap<Vec<i64>, Cell>,
    added: u64,
}

struct Cell {
    vertices: Vec<usize>,
    /// Neighbours that were reached.
    neighbours: usize,
    chosen: f64,
    score: f64,
    /// When it was reached.
    iteration: u64,
}

fn coordinates(problem: &mut Problem<'_>, state: &[f64]) -> Vec<i64> {
    let Some(projection) = &mut problem.projection else {
        return Vec::new();
    };
    let cell = projection.cell;
    let projected = (projection.project)(state);
    projected
        .iter()
        .take(projection.size)
        .map(|value| (value / cell).floor() as i64)
        .collect()
}

/// The cells beside one, along each dimension.
fn beside(cell: &[i64]) -> impl Iterator<Item = Vec<i64>> + '_ {
    (0..cell.len()).flat_map(move |dimension| {
        [-1, 1].map(|step| {
            let mut other = cell.to_vec();
            other[dimension] = other[dimension].saturating_add(step);
            other
        })
    })
}

impl Cells {
    fn of_roots(problem: &mut Problem<'_>, roots: &[State]) -> Self {
        let mut cells = Self {
            tree: Tree::of_roots(roots),
            ..Self::default()
        };
        (0..roots.len()).for_each(|place| cells.enter(problem, place));
        cells
    }

    fn add(
        &mut self,
        problem: &mut Problem<'_>,
        state: State,
        parent: usize,
        is_checked: bool,
    ) -> usize {
        let place = self.tree.add(problem.space, state, parent);
        self.tree.vertices[place].is_checked = is_checked;
        self.enter(problem, place);
        place
    }

    /// Puts a vertex into its cell.
    fn enter(&mut self, problem: &mut Problem<'_>, place: usize) {
        let key = coordinates(problem, &self.tree.state(place).clone());
        self.added += 1;
        if let Some(cell) = self.cells.get_mut(&key) {
            cell.vertices.push(place);
            return;
        }
        let mut neighbours = 0;
        for other in beside(&key) {
            if let Some(other) = self.cells.get_mut(&other) {
                other.neighbours += 1;
                neighbours += 1;
            }
        }
        let cell = Cell {
            vertices: vec![place],
            neighbours,
            chosen: 1.0,
            score: 1.0,
            iteration: self.added,
        };
        self.cells.insert(key, cell);
    }

    /// The cell from which to grow: the most important one on the border, or inside.
    fn choose(&self, problem: &mut Problem<'_>) -> Option<Vec<i64>> {
        let on_border = problem.random.next() < BORDER;
        let importance = |cell: &Cell| {
            let neighbours = 1.0 + cell.neighbours as f64;
            cell.score * libm::log(cell.iteration as f64 + 1.0).max(0.1)
                / (cell.vertices.len() as f64 * cell.chosen * neighbours)
        };
        let is_candidate =
            |key: &Vec<i64>, cell: &Cell| (cell.neighbours < 2 * key.len().max(1)) == on_border;
        let best = |only_candidates: bool| {
            let cells = self
                .cells
                .iter()
                .filter(|(key, cell)| !only_candidates || is_candidate(key, cell));
            cells
                .max_by(|(_, a), (_, b)| importance(a).total_cmp(&importance(b)))
                .map(|(key, _)| key.clone())
        };
        best(true).or_else(|| best(false))
    }

    /// A cell of all with the same likelihood.
    fn choose_any(&self, problem: &mut Problem<'_>) -> Option<Vec<i64>> {
        if self.cells.is_empty() {
            return None;
        }
        let place = problem.random.index(self.cells.len());
        self.cells.keys().nth(place).cloned()
    }

    /// A vertex of a cell; the ones that came last are more likely.
    fn vertex(&mut self, problem: &mut Problem<'_>, key: &[i64]) -> Option<usize> {
        let cell = self.cells.get_mut(key)?;
        cell.chosen += 1.0;
        let count = cell.vertices.len();
        let from_end = (problem.random.normal().abs() * count as f64 / 3.0) as usize;
        Some(cell.vertices[count - 1 - from_end.min(count - 1)])
    }

    fn note_failure(&mut self, key: &[i64]) {
        if let Some(cell) = self.cells.get_mut(key) {
            cell.score *= FAILED;
        }
    }

    /// Removes a vertex and what follows.
    fn remove(&mut self, problem: &mut Problem<'_>, place: usize) {
        self.tree.remove_below(place);
        self.cells.clear();
        (0..self.tree.len()).for_each(|place| self.enter(problem, place));
    }
}

/// One tree from the starts.
#[derive(Default)]
pub(super) struct Single {
    cells: Cells,
    best: Option<Solution>,
}

impl Single {
    fn grow(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<usize> {
        let key = self.cells.choose(problem)?;
        let from_place = self.cells.vertex(problem, &key)?;
        let from = self.cells.tree.state(from_place).clone();
        let aim = if problem.random.next() < GOAL_BIAS {
            problem.sample_goal()
        } else {
            None
        };
        let aim = match aim {
            Some(aim) => problem.towards(&from, &aim, f64::INFINITY),
            None => {
                let near = problem.space.sample_near(problem.random, &from, range);
                problem.towards(&from, &near, range)
            }
        };
        let (state, part) = problem.last_valid(&from, &aim);
        if part < MIN_VALID_FRACTION {
            self.cells.note_failure(&key);
            return None;
        }
        Some(self.cells.add(problem, state, from_place, true))
    }

    fn consider(&mut self, problem: &mut Problem<'_>, place: usize) {
        let nearness = problem.nearness(&self.cells.tree.state(place).clone());
        let difference = if nearness.is_reached {
            0.0
        } else {
            nearness.distance
        };
        let is_better = self
            .best
            .as_ref()
            .is_none_or(|best| difference < best.difference);
        if is_better || nearness.is_reached {
            let states = self.cells.tree.path_to(place);
            keep_best(
                &mut self.best,
                Solution {
                    states,
                    is_exact: nearness.is_reached,
                    difference,
                },
                problem,
            );
        }
    }
}

impl Planner for Single {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if problem
            .projection
            .as_ref()
            .is_none_or(|projection| projection.size == 0)
        {
            return Err(Refusal::NoProjection);
        }
        if self.cells.tree.is_empty() {
            let starts = problem.valid_starts()?;
            self.cells = Cells::of_roots(problem, &starts);
            (0..starts.len()).for_each(|place| self.consider(problem, place));
        }
        let range = RANGE * problem.space.extent();
        for _ in 0..iterations {
            if problem.world.is_over() || self.best.as_ref().is_some_and(|best| best.is_exact) {
                break;
            }
            if let Some(place) = self.grow(problem, range) {
                self.consider(problem, place);
            }
        }
        Ok(self.best.clone())
    }

    fn data(&self) -> PlannerData {
        data_of(&self.cells.tree)
    }
}

/// What distinguishes planners with two trees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Motions are checked at once.
    Bkpiece,
    /// Motions are checked when the trees meet.
    Lbkpiece,
    /// The same, and all cells are equally likely.
    Sbl,
}

/// A tree from the starts and one from the goals.
pub(super) struct Double {
    kind: Kind,
    cells: [Cells; 2],
    turn: usize,
    solution: Option<Solution>,
}

impl Double {
    pub(super) fn new(kind: Kind) -> Self {
        Self {
            kind,
            cells: Default::default(),
            turn: 0,
            solution: None,
        }
    }

    /// A motion of a tree; the one of the goals grows against the direction of motion.
    fn is_motion_valid(problem: &mut Problem<'_>, side: usize, from: &State, to: &State) -> bool {
        match side {
            0 => problem.is_motion_valid(from, to),
            _ => problem.is_valid(to) && problem.is_motion_valid(to, from),
        }
    }

    fn grow(&mut self, problem: &mut Problem<'_>, side: usize, range: f64) -> Option<usize> {
        let cells = &mut self.cells[side];
        let key = if self.kind == Kind::Sbl {
            cells.choose_any(problem)
        } else {
            cells.choose(problem)
        }?;
        let from_place = cells.vertex(problem, &key)?;
        let from = cells.tree.state(from_place).clone();
        let near = problem.sample_valid_near(&from, range)?;
        let aim = problem.towards(&from, &near, range);
        let is_lazy = self.kind != Kind::Bkpiece;
        let state = match is_lazy {
            true => problem.is_valid(&aim).then_some(aim),
            false if problem.space.is_symmetric() => {
                let (state, part) = problem.last_valid(&from, &aim);
                (part >= MIN_VALID_FRACTION_BIDIRECTIONAL).then_some(state)
            }
            false => Self::is_motion_valid(problem, side, &from, &aim).then_some(aim),
        };
        match state {
            Some(state) => Some(self.cells[side].add(problem, state, from_place, !is_lazy)),
            None => {
                self.cells[side].note_failure(&key);
                None
            }
        }
    }

    /// Joins a new vertex to the other tree, in its cell or beside; the path if that is valid.
    fn join(&mut self, problem: &mut Problem<'_>, side: usize, place: usize) -> Option<Solution> {
        let state = self.cells[side].tree.state(place).clone();
        let key = coordinates(problem, &state);
        let other_cells = &self.cells[1 - side].cells;
        let candidates = std::iter::once(key.clone()).chain(beside(&key));
        let vertices: Vec<usize> = candidates
            .filter_map(|key| other_cells.get(&key))
            .flat_map(|cell| &cell.vertices)
            .copied()
            .collect();
        if vertices.is_empty() {
            return None;
        }
        let other = vertices[problem.random.index(vertices.len())];
        let aim = self.cells[1 - side].tree.state(other).clone();
        if !Self::is_motion_valid(problem, side, &state, &aim) {
            return None;
        }
        if !self.check(problem, side, place) || !self.check(problem, 1 - side, other) {
            return None;
        }
        let [start, goal] = if side == 0 {
            [place, other]
        } else {
            [other, place]
        };
        let mut states = self.cells[0].tree.path_to(start);
        states.extend(self.cells[1].tree.path_to(goal).into_iter().rev());
        Some(Solution::exact(states))
    }

    /// Checks the motions to a vertex; an invalid one is removed with what follows.
    fn check(&mut self, problem: &mut Problem<'_>, side: usize, place: usize) -> bool {
        for child in self.cells[side].tree.unchecked(place) {
            let tree = &self.cells[side].tree;
            let Some(parent) = tree.vertices[child].parent else {
                continue;
            };
            let (from, to) = (tree.state(parent).clone(), tree.state(child).clone());
            if !Self::is_motion_valid(problem, side, &from, &to) {
                self.cells[side].remove(problem, child);
                return false;
            }
            self.cells[side].tree.vertices[child].is_checked = true;
        }
        true
    }
}

impl Planner for Double {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if problem
            .projection
            .as_ref()
            .is_none_or(|projection| projection.size == 0)
        {
            return Err(Refusal::NoProjection);
        }
        if self.cells[0].tree.is_empty() {
            let goals = problem.valid_goals();
            let (starts, goals) = (problem.valid_starts()?, goals?);
            self.solution = problem.immediate(&starts);
            self.cells = [
                Cells::of_roots(problem, &starts),
                Cells::of_roots(problem, &goals),
            ];
        }
        let range = RANGE * problem.space.extent();
        for _ in 0..iterations {
            if problem.world.is_over() || self.solution.is_some() {
                break;
            }
            let side = self.turn;
            self.turn = 1 - side;
            if let Some(place) = self.grow(problem, side, range) {
                self.solution = self.join(problem, side, place);
            }
        }
        Ok(self.solution.clone())
    }

    fn data(&self) -> PlannerData {
        data_of_both(&self.cells[0].tree, &self.cells[1].tree)
    }
}
