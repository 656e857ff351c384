//! Many worlds: simulators of one scene that step together, as an environment for reinforcement learning needs them.
//!
//! A [`Declaration`] says what is read after each step and what is written before it. [`Vector`] makes `count` simulators on a few
//! threads; each thread makes, keeps and steps its own. Observations and actions lie in [`Arrays`], which the threads write and read
//! in place. Every world has the same bytes as if it were alone: nothing is shared, and its random numbers follow from its own seed.

mod arrays;
mod declaration;
mod expressions;
mod interruption;
mod quantities;
mod recordings;
mod score;
mod variations;
mod vector;
mod worker;
mod world;

#[cfg(test)]
mod tests;

pub use arrays::{Array, Arrays, Item};
pub use declaration::{
    Action, Camera, Declaration, Distribution, Quantity, Reset, Scale, Target, Variation,
};
pub use expressions::Expressions;
pub use interruption::WantsEnd;
pub use quantities::{Readers, Writers};
pub use recordings::Recording;
pub use vector::Vector;
pub use view::recording::Recorded;
pub use worker::Failure;
pub use world::Layout;
