//! `sim.*`: old functions whose replacement differs in more than its name.

pub(crate) mod button_interfaces;
pub(crate) mod calculation_objects;
mod default_names;
pub(crate) mod engine_param;
pub(crate) mod globals;
pub(crate) mod ik_groups;
pub(crate) mod ik_postures;
pub(crate) mod joint_shape;
pub(crate) mod library;
pub(crate) mod object_param;
pub(crate) mod path_planning;
pub(crate) mod paths;
pub(crate) mod script;
pub(crate) mod signal;
pub(crate) mod tube;
mod tubes;
pub(crate) mod user_param;
pub(crate) mod vision_sensor;
