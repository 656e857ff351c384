//! Files of scripts: scenes, persistent data, locks.

pub(in crate::script) mod app_storage;
pub(in crate::script) mod scene_save;
pub(in crate::script) mod scene_switch;
