//! `sim.*`: numbered and named parameters.

pub(crate) mod param;
pub(crate) mod param_property;
