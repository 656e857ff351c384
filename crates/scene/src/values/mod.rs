//! Values of scripts: data, custom data, types of properties, inert properties.

pub(in crate::scene) mod custom_data;
pub mod data;
pub mod extension_string;
pub(in crate::scene) mod inert;
pub(in crate::scene) mod value_type;
