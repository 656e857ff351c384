//! The scripts of a simulator: each one, all of them, and the order in which they are called.

mod attached;
mod detached;
mod lookup;
pub(super) mod order;
pub(super) mod script;
pub(super) mod set;
pub(super) mod source;
