//! Path-directed subdivision trees: PDST (A. M. Ladd and L. E. Kavraki, *Motion planning in the presence of drift, underactuation and discrete
//! system changes*, 2005). Motions wait in a queue, those in large cells and those that waited longest first; the cell of a motion that grew is cut
//! in two, and so are the motions in it.

use super::{GOAL_BIAS, Planner, PlannerData, RANGE, keep_best};
use crate::{Problem, Refusal, Solution, State};

/// States that show how far projections reach.
const SURVEY: usize = 100;

/// Cells smaller than this fraction of the whole are not divided.
const MIN_VOLUME: f64 = 1e-12;

/// A motion, within one cell.
struct Motion {
    from: State,
    to: State,
    /// The motion that ends where this one begins.
    parent: Option<usize>,
    cell: usize,
    /// The higher, the later its turn.
    priority: f64,
}

/// A cell of the projection, or two halves of it.
struct Cell {
    low: Vec<f64>,
    high: Vec<f64>,
    /// Part of the whole.
    volume: f64,
    /// The dimension, where it is cut, and both halves.
    cut: Option<(usize, f64, [usize; 2])>,
}

/// Motions from the starts, and the cells they are in.
#[derive(Default)]
pub(super) struct Subdivision {
    motions: Vec<Motion>,
    cells: Vec<Cell>,
    starts: Vec<State>,
    iterations: u64,
    best: Option<Solution>,
}

fn project(problem: &mut Problem<'_>, state: &[f64]) -> Vec<f64> {
    problem
        .projection
        .as_mut()
        .map_or_else(Vec::new, |projection| {
            let mut projected = (projection.project)(state);
            projected.resize(projection.size, 0.0);
            projected
        })
}

impl Subdivision {
    fn begin(&mut self, problem: &mut Problem<'_>) -> Result<(), Refusal> {
        self.starts = problem.valid_starts()?;
        let first = project(problem, &self.starts[0].clone());
        let (mut low, mut high) = (first.clone(), first);
        for _ in 0..SURVEY {
            let state = problem.sample();
            for (dimension, value) in project(problem, &state).into_iter().enumerate() {
                low[dimension] = low[dimension].min(value);
                high[dimension] = high[dimension].max(value);
            }
        }
        self.cells = vec![Cell {
            low,
            high,
            volume: 1.0,
            cut: None,
        }];
        for start in self.starts.clone() {
            self.motions.push(Motion {
                from: start.clone(),
                to: start,
                parent: None,
                cell: 0,
                priority: 0.0,
            });
            self.consider(problem, self.motions.len() - 1);
        }
        Ok(())
    }

    /// The cell of a projected state.
    fn cell_of(&self, projected: &[f64]) -> usize {
        let mut at = 0;
        while let Some((dimension, value, halves)) = self.cells[at].cut {
            at = halves[usize::from(projected[dimension] >= value)];
        }
        at
    }

    /// The motion whose turn it is; the first of several.
    fn choose(&self) -> usize {
        let score = |place: usize| {
            self.motions[place].priority / self.cells[self.motions[place].cell].volume
        };
        (0..self.motions.len())
            .min_by(|&a, &b| score(a).total_cmp(&score(b)))
            .unwrap_or(0)
    }

    /// Cuts a motion in two at a state on it. The second half keeps the place; returns that of the first.
    fn cut_motion(&mut self, place: usize, middle: State) -> usize {
        let first = self.motions.len();
        let motion = &mut self.motions[place];
        let from = std::mem::replace(&mut motion.from, middle.clone());
        let parent = motion.parent.replace(first);
        let (cell, priority) = (motion.cell, motion.priority);
        self.motions.push(Motion {
            from,
            to: middle,
            parent,
            cell,
            priority,
        });
        first
    }

    /// Grows from a random state of the motion whose turn it is; the last of the new motions.
    fn grow(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<usize> {
        let chosen = self.choose();
        self.motions[chosen].priority = 2.0 * self.motions[chosen].priority + 1.0;
        let cell = self.motions[chosen].cell;
        let part = problem.random.next();
        let Motion { from, to, .. } = &self.motions[chosen];
        let parent = if from == to || part < f64::EPSILON {
            chosen
        } else {
            let middle = problem.space.interpolate(from, to, part);
            self.cut_motion(chosen, middle)
        };
        let from = self.motions[parent].to.clone();
        let aim = if problem.random.next() < GOAL_BIAS {
            problem.sample_goal()
        } else {
            None
        };
        let aim = aim.unwrap_or_else(|| {
            let sample = problem.sample();
            problem.towards(&from, &sample, range)
        });
        let (state, part) = problem.last_valid(&from, &aim);
        let last = (part > 0.0).then(|| self.add(problem, parent, &state));
        self.cut_cell(problem, cell);
        last
    }

    /// Adds the motions to a state, one for each cell on the way.
    fn add(&mut self, problem: &mut Problem<'_>, parent: usize, to: &State) -> usize {
        let from = self.motions[parent].to.clone();
        let parts = problem.space.parts(&from, to, problem.resolution);
        let mut parent = parent;
        let mut begin = from.clone();
        let mut cell = self.cell_at(problem, &from);
        for part in 1..=parts {
            let state = problem
                .space
                .interpolate(&from, to, part as f64 / parts as f64);
            let next = self.cell_at(problem, &state);
            if next != cell && part < parts {
                parent = self.push(
                    parent,
                    std::mem::replace(&mut begin, state.clone()),
                    state,
                    cell,
                );
                cell = next;
            }
        }
        self.push(parent, begin, to.clone(), cell)
    }

    fn cell_at(&self, problem: &mut Problem<'_>, state: &[f64]) -> usize {
        self.cell_of(&project(problem, state))
    }

    fn push(&mut self, parent: usize, from: State, to: State, cell: usize) -> usize {
        let priority = self.iterations as f64;
        self.motions.push(Motion {
            from,
            to,
            parent: Some(parent),
            cell,
            priority,
        });
        self.motions.len() - 1
    }

    /// Cuts a cell in two, across its longest side, and the motions that are in both halves.
    fn cut_cell(&mut self, problem: &mut Problem<'_>, at: usize) {
        let Cell {
            low,
            high,
            volume,
            cut,
        } = &self.cells[at];
        let sides = low.iter().zip(high).map(|(low, high)| high - low);
        let Some((dimension, side)) = sides.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b))
        else {
            return;
        };
        if cut.is_some() || side.is_nan() || side <= 0.0 || *volume < MIN_VOLUME {
            return;
        }
        let value = low[dimension] + 0.5 * side;
        let half = || Cell {
            low: low.clone(),
            high: high.clone(),
            volume: 0.5 * volume,
            cut: None,
        };
        let (mut lower, mut upper) = (half(), half());
        (lower.high[dimension], upper.low[dimension]) = (value, value);
        let halves = [self.cells.len(), self.cells.len() + 1];
        self.cells.extend([lower, upper]);
        self.cells[at].cut = Some((dimension, value, halves));
        for place in 0..self.motions.len() {
            if self.motions[place].cell == at {
                self.divide(problem, place);
            }
        }
    }

    /// Puts a motion into the halves of its cell: cut where it goes from one to the other.
    fn divide(&mut self, problem: &mut Problem<'_>, place: usize) {
        let (from, to) = (
            self.motions[place].from.clone(),
            self.motions[place].to.clone(),
        );
        let (first, last) = (self.cell_at(problem, &from), self.cell_at(problem, &to));
        self.motions[place].cell = last;
        if first == last {
            return;
        }
        let parts = problem.space.parts(&from, &to, problem.resolution);
        let states = (1..parts).map(|part| {
            problem
                .space
                .interpolate(&from, &to, part as f64 / parts as f64)
        });
        let states: Vec<State> = states.collect();
        if let Some(middle) = states
            .into_iter()
            .find(|state| self.cell_at(problem, state) != first)
        {
            let before = self.cut_motion(place, middle);
            self.motions[before].cell = first;
        }
    }

    /// The states from the start to the end of a motion.
    fn path_to(&self, place: usize) -> Vec<State> {
        let way = std::iter::successors(Some(place), |&at| self.motions[at].parent);
        let mut states: Vec<State> = way.map(|at| self.motions[at].to.clone()).collect();
        states.reverse();
        states.dedup();
        states
    }

    fn consider(&mut self, problem: &mut Problem<'_>, place: usize) {
        let nearness = problem.nearness(&self.motions[place].to.clone());
        let difference = if nearness.is_reached {
            0.0
        } else {
            nearness.distance
        };
        if nearness.is_reached
            || self
                .best
                .as_ref()
                .is_none_or(|best| difference < best.difference)
        {
            let states = self.path_to(place);
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

impl Planner for Subdivision {
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
        if self.motions.is_empty() {
            self.begin(problem)?;
        }
        let range = RANGE * problem.space.extent();
        for _ in 0..iterations {
            if problem.world.is_over() || self.best.as_ref().is_some_and(|best| best.is_exact) {
                break;
            }
            self.iterations += 1;
            if let Some(place) = self.grow(problem, range) {
                self.consider(problem, place);
            }
        }
        Ok(self.best.clone())
    }

    fn data(&self) -> PlannerData {
        let parents = self.motions.iter().enumerate();
        PlannerData {
            states: self
                .motions
                .iter()
                .map(|motion| motion.to.clone())
                .collect(),
            tags: vec![0; self.motions.len()],
            edges: parents
                .filter_map(|(place, motion)| Some((motion.parent?, place)))
                .collect(),
            starts: (0..self.motions.len())
                .filter(|&place| self.motions[place].parent.is_none())
                .collect(),
            goals: Vec::new(),
        }
    }
}
