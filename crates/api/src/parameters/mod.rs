//! `sim.*`: numbered and named parameters.

pub(in crate::api) mod param;
pub(in crate::api) mod param_property;
