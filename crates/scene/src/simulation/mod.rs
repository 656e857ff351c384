//! Settings of a run, what the physics reports, and what is restored at its end.

pub mod dynamics_report;
pub(crate) mod restore;
pub mod settings;
