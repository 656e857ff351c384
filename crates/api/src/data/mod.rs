//! `sim.*`: properties, custom data, packing.

pub(in crate::api) mod custom_data;
pub(in crate::api) mod packing;
pub(in crate::api) mod property;
