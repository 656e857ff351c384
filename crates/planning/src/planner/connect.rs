//! Two trees that grow towards each other (J. J. Kuffner and S. M. LaValle, *RRT-Connect*, 2000); with a control of refinement as BiTRRT.

use super::rrt::data_of_both;
use super::{COST_RANGE, FRONTIER, FRONTIER_RATIO, Planner, PlannerData, RANGE};
use crate::tree::Tree;
use crate::{Problem, Refusal, Solution};

/// A tree from the starts and one from the goals.
#[derive(Default)]
pub(super) struct Connect {
    trees: [Tree; 2],
    controls_refinement: bool,
    /// States that explored and that refined.
    counts: [f64; 2],
    /// Which tree grows next.
    turn: usize,
    solution: Option<Solution>,
}

/// Where a growth has ended.
enum Growth {
    Trapped,
    Advanced(usize),
    Reached(usize),
}

impl Connect {
    pub(super) fn new(controls_refinement: bool) -> Self {
        Self {
            controls_refinement,
            counts: [1.0; 2],
            ..Self::default()
        }
    }

    /// One step of a tree towards a state.
    fn extend(
        &mut self,
        problem: &mut Problem<'_>,
        tree: usize,
        aim: &[f64],
        range: f64,
    ) -> Growth {
        let Some(nearest) = self.trees[tree].nearest(problem.space, aim) else {
            return Growth::Trapped;
        };
        let from = self.trees[tree].state(nearest).clone();
        let to = problem.towards(&from, aim, range);
        // The tree of the goals grows against the direction of motion.
        let is_valid = match tree {
            0 => problem.is_motion_valid(&from, &to),
            _ => problem.is_valid(&to) && problem.is_motion_valid(&to, &from),
        };
        if !is_valid {
            return Growth::Trapped;
        }
        let reaches = to == aim;
        let place = self.trees[tree].add(problem.space, to, nearest);
        if reaches {
            Growth::Reached(place)
        } else {
            Growth::Advanced(place)
        }
    }

    /// Counts states that explore and that refine; whether one more of its kind is welcome.
    fn is_welcome(&mut self, problem: &Problem<'_>, tree: usize, aim: &[f64]) -> bool {
        if !self.controls_refinement {
            return true;
        }
        let nearest = self.trees[tree].nearest(problem.space, aim);
        let distance = nearest.map_or(0.0, |place| {
            problem.space.distance(self.trees[tree].state(place), aim)
        });
        let kind = usize::from(distance < FRONTIER * problem.space.extent());
        if kind == 1
            && self.counts[1] / self.counts[0] > FRONTIER_RATIO
            && self.trees[tree].len() > 10
        {
            return false;
        }
        self.counts[kind] += 1.0;
        true
    }

    /// One step of one tree, and the other one as far as it gets; the path if they meet.
    fn iterate(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<Solution> {
        let tree = self.turn;
        self.turn = 1 - tree;
        let aim = problem.sample();
        if !self.is_welcome(problem, tree, &aim) {
            return None;
        }
        let place = match self.extend(problem, tree, &aim, range) {
            Growth::Trapped => return None,
            Growth::Advanced(place) | Growth::Reached(place) => place,
        };
        let aim = self.trees[tree].state(place).clone();
        loop {
            match self.extend(problem, 1 - tree, &aim, range) {
                Growth::Advanced(_) => {}
                Growth::Trapped => return None,
                Growth::Reached(other) => {
                    let [start, goal] = if tree == 0 {
                        [place, other]
                    } else {
                        [other, place]
                    };
                    return Some(self.join(start, goal));
                }
            }
        }
    }

    /// The path through a state that both trees have.
    fn join(&self, start: usize, goal: usize) -> Solution {
        let mut states = self.trees[0].path_to(start);
        states.extend(self.trees[1].path_to(goal).into_iter().rev().skip(1));
        Solution::exact(states)
    }
}

impl Planner for Connect {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        if self.trees[0].is_empty() {
            let goals = problem.valid_goals();
            let starts = problem.valid_starts()?;
            self.trees = [Tree::of_roots(&starts), Tree::of_roots(&goals?)];
            self.solution = problem.immediate(&starts);
        }
        let part = if self.controls_refinement {
            COST_RANGE
        } else {
            RANGE
        };
        let range = part * problem.space.extent();
        for _ in 0..iterations {
            if problem.world.is_over() || self.solution.is_some() {
                break;
            }
            self.solution = self.iterate(problem, range);
        }
        Ok(self.solution.clone())
    }

    fn data(&self) -> PlannerData {
        data_of_both(&self.trees[0], &self.trees[1])
    }
}
