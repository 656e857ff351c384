//! What scripts read from and write to files: scenes, data that outlives the program, locks.

pub(in crate::script) mod app_storage;
pub(in crate::script) mod scene_save;
pub(in crate::script) mod scene_switch;
