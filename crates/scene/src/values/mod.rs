//! Values of scripts: data, custom data, types of properties, inert properties.

pub(crate) mod custom_data;
pub mod data;
pub mod extension_string;
pub(crate) mod inert;
pub(crate) mod numbered;
pub(crate) mod value_type;
