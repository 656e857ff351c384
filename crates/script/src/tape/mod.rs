//! What scripts get from the world outside, as a tape captures and replays it.
//!
//! Functions that call the world outside are marked by their modules ([`Outside`](crate::binding::module::Outside)); here is what happens around each call of
//! one: a captured run writes what the function has returned, a replay returns that and does not call the function.

mod outcome;
mod values;

pub(crate) use outcome::{Outcome, Output};
pub use values::Taped;
