//! Files of other programs.

pub(crate) mod picture;

pub(crate) mod scene_file;
pub mod ttt;
