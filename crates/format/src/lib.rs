//! Files of other programs.

pub(crate) mod gltf_file;
pub(crate) mod graph_file;
pub(crate) mod mesh_file;
pub(crate) mod picture;
#[cfg(feature = "plots")]
pub(crate) mod plot;

pub(crate) mod robot_file;
pub(crate) mod scene_file;
pub(crate) mod scene_folder;
pub(crate) mod scene_input;
pub(crate) mod scene_outline;
pub(crate) mod script_file;
pub mod ttt;
pub(crate) mod video;
pub(crate) mod xml;
