//! What scripts and the simulator print: levels, consoles.

pub(in crate::script) mod auxiliary_consoles;
pub(in crate::script) mod console;
pub mod verbosity;
