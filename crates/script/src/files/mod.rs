//! Files of scripts: scenes, persistent data, locks.

pub(crate) mod app_storage;
pub(crate) mod scene_save;
pub(crate) mod scene_switch;
