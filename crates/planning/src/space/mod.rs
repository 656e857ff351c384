//! Spaces of states: what a state is, how far two are apart, and what lies between them.

mod component;
mod compound;
mod dubins;

pub use component::{Bounds, Component};
pub use compound::CompoundSpace;

use crate::Random;

/// A state: the numbers of all components, one after the other.
pub type State = Vec<f64>;

/// What planners need of a space.
pub trait StateSpace {
    /// Numbers of a state.
    fn dimension(&self) -> usize;

    /// The distance of two states.
    fn distance(&self, from: &[f64], to: &[f64]) -> f64;

    /// The state at `part` (0 to 1) of the way.
    fn interpolate(&self, from: &[f64], to: &[f64], part: f64) -> State;

    /// The largest distance of two states within the bounds.
    fn extent(&self) -> f64;

    /// A state within the bounds, all equally likely.
    fn sample(&self, random: &mut dyn Random) -> State;

    /// A state within the bounds and at most about `distance` from another.
    fn sample_near(&self, random: &mut dyn Random, near: &[f64], distance: f64) -> State;

    /// Whether a state lies within the bounds of all components.
    fn is_within_bounds(&self, state: &[f64]) -> bool;

    /// Moves a state to the nearest one within the bounds.
    fn enforce_bounds(&self, state: &mut [f64]);

    /// The number of equal parts a motion is checked at, if they are to be as long as `fraction` of the extent in each component; a hundred thousand at most.
    fn parts(&self, from: &[f64], to: &[f64], fraction: f64) -> usize;

    /// Whether the way back has the same states.
    fn is_symmetric(&self) -> bool {
        true
    }
}
