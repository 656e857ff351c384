//! Motion planning by sampling: paths of states from a start to a goal, through states that the caller calls valid.
//!
//! This crate does not depend on a robot or a scene: a [`StateSpace`] says what states are, a [`World`] which of them are valid.
//!
//! | to | look at |
//! |---|---|
//! | describe states: points, angles, rotations, places, cars, and compounds of them | [`space`] |
//! | say what is asked for | [`Problem`], [`Goal`], [`Projection`] |
//! | plan | [`Algorithm::planner`], [`Planner::solve`] |
//! | measure, divide and shorten a path | [`path`] |
//!
//! # Methods
//!
//! Planners have OMPL's names and defaults: steps of a fifth of the extent, a goal bias of 0.05, ten neighbours in plain roadmaps. Some names share an
//! implementation with the same guarantee: [`Algorithm::planner`] says which. The nearest states are found by looking at all, which suffices for some
//! ten thousand states; a check of validity usually takes longer.
//!
//! # Determinism
//!
//! Random numbers come from the caller's generator ([`Random`]), no clock is read, and nothing is iterated in the order of a hash: the same seed has
//! the same path. A time limit is the caller's: [`World::is_over`] is asked again and again.
//!
//! ```
//! use planning::space::{Bounds, Component, CompoundSpace};
//! use planning::{Algorithm, Goal, Problem, Random, World};
//!
//! struct Numbers(u64);
//! impl Random for Numbers {
//!     fn next(&mut self) -> f64 {
//!         self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
//!         (self.0 >> 11) as f64 / (1_u64 << 53) as f64
//!     }
//! }
//!
//! /// A wall with a gap at its lower end.
//! struct Wall;
//! impl World for Wall {
//!     fn is_valid(&mut self, state: &[f64]) -> bool {
//!         !(0.4..0.6).contains(&state[0]) || state[1] < 0.2
//!     }
//! }
//!
//! let square = Component::Real(Bounds::new(vec![0.0; 2], vec![1.0; 2]));
//! let mut problem = Problem {
//!     space: &CompoundSpace::new(vec![(square, 1.0)]),
//!     world: &mut Wall,
//!     random: &mut Numbers(1),
//!     starts: vec![vec![0.1, 0.9]],
//!     goal: Goal::States(vec![vec![0.9, 0.9]]),
//!     projection: None,
//!     resolution: 0.01,
//! };
//! let found = Algorithm::RrtConnect.planner().solve(&mut problem, 10_000)?.expect("there is a way");
//! assert!(found.is_exact);
//! # Ok::<(), planning::Refusal>(())
//! ```

mod graph;
pub mod path;
mod planner;
mod problem;
mod random;
pub mod space;
mod tree;

pub use planner::{Algorithm, Planner, PlannerData};
pub use problem::{Goal, Judge, Nearness, Problem, Project, Projection, Refusal, Solution, World};
pub use random::Random;
pub use space::{State, StateSpace};
