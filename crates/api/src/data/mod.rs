//! `sim.*`: properties, custom data, packing.

pub(crate) mod custom_data;
pub(crate) mod packing;
pub(crate) mod property;
