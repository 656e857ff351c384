//! `sim.*`: old functions whose replacement differs in more than its name.

pub(in crate::api) mod button_interfaces;
pub(in crate::api) mod calculation_objects;
pub(in crate::api) mod engine_param;
pub(in crate::api) mod globals;
pub(in crate::api) mod ik_groups;
pub(in crate::api) mod ik_postures;
pub(in crate::api) mod joint_shape;
pub(in crate::api) mod object_param;
pub(in crate::api) mod path_planning;
pub(in crate::api) mod paths;
pub(in crate::api) mod script;
pub(in crate::api) mod signal;
pub(in crate::api) mod tube;
mod tubes;
pub(in crate::api) mod user_param;
pub(in crate::api) mod vision_sensor;
