//! What is asked of a planner: where to begin, what is allowed, and where to end.

use crate::{Random, State, StateSpace};

/// What the caller knows of states, and when it has enough.
pub trait World {
    /// Whether the robot can be in a state.
    fn is_valid(&mut self, state: &[f64]) -> bool;

    /// Whether planning is to end: asked in each iteration and before each check of a state. An end means that nothing else is asked.
    fn is_over(&mut self) -> bool {
        false
    }

    /// A valid state of the caller's choice; None for one that planners find themselves.
    fn sample(&mut self) -> Option<State> {
        None
    }

    /// The same within a distance of another.
    fn sample_near(&mut self, near: &[f64], distance: f64) -> Option<State> {
        let _ = (near, distance);
        None
    }
}

/// How near a state is to the goal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearness {
    /// Whether the state lies in the goal.
    pub is_reached: bool,
    /// 0 in the goal; an estimate of any unit elsewhere.
    pub distance: f64,
}

/// Says how near a state is to the goal.
pub type Judge<'a> = Box<dyn FnMut(&[f64]) -> Nearness + 'a>;

/// Maps a state to a few numbers.
pub type Project<'a> = Box<dyn FnMut(&[f64]) -> Vec<f64> + 'a>;

/// Where a path may end.
pub enum Goal<'a> {
    /// In one of these states.
    States(Vec<State>),
    /// Where a function says so. Planners that grow from both ends refuse it, since it has no states to begin with.
    Region(Judge<'a>),
}

/// A map of states to a few numbers, in which planners see how well they have spread.
pub struct Projection<'a> {
    /// Numbers of a projected state.
    pub size: usize,
    /// Length of a cell in each dimension.
    pub cell: f64,
    /// Maps a state to [`size`](Self::size) numbers.
    pub project: Project<'a>,
}

/// How often a valid state is tried for.
const ATTEMPTS: usize = 100;

/// A task for planners.
pub struct Problem<'a> {
    /// The states of the robot.
    pub space: &'a dyn StateSpace,
    /// What the caller knows of them.
    pub world: &'a mut dyn World,
    /// The source of all random numbers.
    pub random: &'a mut dyn Random,
    /// States where a path may begin.
    pub starts: Vec<State>,
    /// Where a path may end.
    pub goal: Goal<'a>,
    /// Needed by planners with cells.
    pub projection: Option<Projection<'a>>,
    /// Motions are checked at parts that are at most as long as this fraction of the extent.
    pub resolution: f64,
}

/// Why there is no planning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// No start is valid and within the bounds.
    #[error("There are no valid initial states!")]
    NoValidStart,
    /// No state of the goal is valid and within the bounds.
    #[error("There are no valid goal states!")]
    NoValidGoal,
    /// A state has not as many numbers as the space has dimensions.
    #[error("State is of incorrect size.")]
    StateSize,
    /// The planner needs states of the goal.
    #[error("Unknown type of goal")]
    GoalWithoutStates,
    /// The planner needs cells.
    #[error("Dimension of projection needs to be larger than 0")]
    NoProjection,
}

impl Problem<'_> {
    /// Whether a state is valid. Bounds are for samples, starts and goals: curves between states may leave them.
    pub fn is_valid(&mut self, state: &[f64]) -> bool {
        !self.world.is_over() && self.world.is_valid(state)
    }

    /// Whether all states between two are valid, and the last one. The first is taken for valid. The end comes first, then halves of halves.
    pub fn is_motion_valid(&mut self, from: &[f64], to: &[f64]) -> bool {
        if !self.is_valid(to) {
            return false;
        }
        let parts = self.space.parts(from, to, self.resolution);
        let mut stretches = std::collections::VecDeque::from([(1, parts - 1)]);
        while let Some((first, last)) = stretches.pop_front() {
            if first > last {
                continue;
            }
            let middle = first + (last - first) / 2;
            let state = self
                .space
                .interpolate(from, to, middle as f64 / parts as f64);
            if !self.is_valid(&state) {
                return false;
            }
            stretches.push_back((first, middle - 1));
            stretches.push_back((middle + 1, last));
        }
        true
    }

    /// How far one can go towards a state: the last valid state, and the part of the way up to it.
    pub fn last_valid(&mut self, from: &[f64], to: &[f64]) -> (State, f64) {
        let parts = self.space.parts(from, to, self.resolution);
        let mut last = (from.to_vec(), 0.0);
        for part in 1..=parts {
            let is_end = part == parts;
            let part = part as f64 / parts as f64;
            let state = if is_end {
                to.to_vec()
            } else {
                self.space.interpolate(from, to, part)
            };
            if !self.is_valid(&state) {
                break;
            }
            last = (state, part);
        }
        last
    }

    /// The state at most `range` away on the way to another.
    pub fn towards(&self, from: &[f64], to: &[f64], range: f64) -> State {
        let distance = self.space.distance(from, to);
        if distance <= range {
            to.to_vec()
        } else {
            self.space.interpolate(from, to, range / distance)
        }
    }

    /// A state within the bounds.
    pub fn sample(&mut self) -> State {
        self.space.sample(self.random)
    }

    /// A valid state; None where none was found.
    pub fn sample_valid(&mut self) -> Option<State> {
        if let Some(state) = self.world.sample() {
            return Some(state);
        }
        (0..ATTEMPTS).find_map(|_| {
            let state = self.sample();
            self.is_valid(&state).then_some(state)
        })
    }

    /// A valid state near another; None where none was found.
    pub fn sample_valid_near(&mut self, near: &[f64], distance: f64) -> Option<State> {
        if let Some(state) = self.world.sample_near(near, distance) {
            return Some(state);
        }
        (0..ATTEMPTS).find_map(|_| {
            let state = self.space.sample_near(self.random, near, distance);
            self.is_valid(&state).then_some(state)
        })
    }

    /// How near a state is to the goal.
    pub fn nearness(&mut self, state: &[f64]) -> Nearness {
        match &mut self.goal {
            Goal::Region(nearness) => nearness(state),
            Goal::States(states) => {
                let distances = states.iter().map(|goal| self.space.distance(state, goal));
                let distance = distances.fold(f64::INFINITY, f64::min);
                Nearness {
                    is_reached: distance <= f64::EPSILON,
                    distance,
                }
            }
        }
    }

    /// A state of the goal; None where it has none.
    pub fn sample_goal(&mut self) -> Option<State> {
        match &self.goal {
            Goal::States(states) if !states.is_empty() => {
                Some(states[self.random.index(states.len())].clone())
            }
            _ => None,
        }
    }

    /// Those of some states that are within the bounds and valid.
    fn admissible(&mut self, states: Vec<State>) -> Result<Vec<State>, Refusal> {
        if states
            .iter()
            .any(|state| state.len() != self.space.dimension())
        {
            return Err(Refusal::StateSize);
        }
        Ok(states
            .into_iter()
            .filter(|state| self.space.is_within_bounds(state) && self.is_valid(state))
            .collect())
    }

    /// The starts that are within the bounds and valid.
    ///
    /// # Errors
    /// When none is.
    pub fn valid_starts(&mut self) -> Result<Vec<State>, Refusal> {
        let valid = self.admissible(self.starts.clone())?;
        if valid.is_empty() {
            Err(Refusal::NoValidStart)
        } else {
            Ok(valid)
        }
    }

    /// The path of a start that is in the goal already.
    pub fn immediate(&mut self, starts: &[State]) -> Option<Solution> {
        let start = starts
            .iter()
            .find(|start| self.nearness(start).is_reached)?;
        Some(Solution::exact(vec![start.clone()]))
    }

    /// The states of the goal that are within the bounds and valid.
    ///
    /// # Errors
    /// When none is, or the goal has no states.
    pub fn valid_goals(&mut self) -> Result<Vec<State>, Refusal> {
        let Goal::States(states) = &self.goal else {
            return Err(Refusal::GoalWithoutStates);
        };
        let valid = self.admissible(states.clone())?;
        if valid.is_empty() {
            Err(Refusal::NoValidGoal)
        } else {
            Ok(valid)
        }
    }
}

/// A path from a start to the goal, or near it.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The corners of the path, from the start.
    pub states: Vec<State>,
    /// Whether it ends in the goal.
    pub is_exact: bool,
    /// How far its end is from the goal.
    pub difference: f64,
}

impl Solution {
    /// A path that ends in the goal.
    pub fn exact(states: Vec<State>) -> Self {
        Self {
            states,
            is_exact: true,
            difference: 0.0,
        }
    }

    /// Whether it is better than another: exact, or nearer to the goal; of two exact ones the shorter.
    pub fn is_better(&self, other: &Self, space: &dyn StateSpace) -> bool {
        match (self.is_exact, other.is_exact) {
            (true, true) => {
                crate::path::length(space, &self.states) < crate::path::length(space, &other.states)
            }
            (false, false) => self.difference < other.difference,
            (exact, _) => exact,
        }
    }
}
