//! Expansive space trees (D. Hsu, J.-C. Latombe and R. Motwani, *Path planning in expansive configuration spaces*, 1999): they grow where they are
//! thin, which is measured by the number of neighbours in the space itself.

use super::rrt::data_of;
use super::{GOAL_BIAS, Planner, PlannerData, RANGE, keep_best};
use crate::tree::Tree;
use crate::{Problem, Refusal, Solution};

/// The neighbourhood, as a part of the range.
const NEIGHBOURHOOD: f64 = 0.25;

/// A tree that grows where it is thin.
#[derive(Default)]
pub(super) struct Expansive {
    tree: Tree,
    /// Neighbours of each vertex, itself included.
    neighbours: Vec<f64>,
    /// The sum of one by the number of neighbours, over all.
    weight: f64,
    best: Option<Solution>,
}

impl Expansive {
    /// Counts a new vertex, which is the last.
    fn count(&mut self, problem: &Problem<'_>, radius: f64) {
        let place = self.neighbours.len();
        let state = self.tree.state(place).clone();
        let mut count = 1.0;
        for (other, neighbours) in self.neighbours.iter_mut().enumerate() {
            if problem.space.distance(self.tree.state(other), &state) <= radius {
                *neighbours += 1.0;
                count += 1.0;
            }
        }
        self.neighbours.push(count);
        self.weight = self.neighbours.iter().map(|count| 1.0 / count).sum();
    }

    /// A vertex; those with few neighbours are more likely.
    fn choose(&self, problem: &mut Problem<'_>) -> usize {
        let mut left = problem.random.between(0.0, self.weight);
        for (place, count) in self.neighbours.iter().enumerate() {
            left -= 1.0 / count;
            if left <= 0.0 {
                return place;
            }
        }
        self.neighbours.len() - 1
    }

    fn grow(&mut self, problem: &mut Problem<'_>, range: f64) -> Option<usize> {
        let from_place = self.choose(problem);
        let from = self.tree.state(from_place).clone();
        let aim = if problem.random.next() < GOAL_BIAS {
            problem.sample_goal()
        } else {
            None
        };
        let aim = match aim {
            Some(aim) => aim,
            None => {
                let near = problem.sample_valid_near(&from, range)?;
                problem.towards(&from, &near, range)
            }
        };
        // States in dense places are welcome less often.
        let near = self
            .tree
            .count_within(problem.space, &aim, range * NEIGHBOURHOOD);
        if problem.random.next() > 1.0 / (near.max(1) as f64)
            || !problem.is_motion_valid(&from, &aim)
        {
            return None;
        }
        let place = self.tree.add(problem.space, aim, from_place);
        self.count(problem, range * NEIGHBOURHOOD);
        Some(place)
    }

    fn consider(&mut self, problem: &mut Problem<'_>, place: usize) {
        let nearness = problem.nearness(&self.tree.state(place).clone());
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
            let states = self.tree.path_to(place);
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

impl Planner for Expansive {
    fn solve(
        &mut self,
        problem: &mut Problem<'_>,
        iterations: u64,
    ) -> Result<Option<Solution>, Refusal> {
        let range = RANGE * problem.space.extent();
        if self.tree.is_empty() {
            self.tree = Tree::of_roots(&problem.valid_starts()?);
            for place in 0..self.tree.len() {
                self.count(problem, range * NEIGHBOURHOOD);
                self.consider(problem, place);
            }
        }
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
        data_of(&self.tree)
    }
}
