//! Files of scripts: scenes and models.

pub(crate) mod scene_save;
pub(crate) mod scene_switch;
