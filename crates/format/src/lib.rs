//! Files of other programs.

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

pub mod gltf_file;
pub mod graph_file;
pub mod mesh_file;
pub mod picture;
#[cfg(feature = "plots")]
pub mod plot;

pub mod robot_file;
pub mod scene_file;
pub mod scene_folder;
pub mod scene_input;
pub mod scene_outline;
pub mod script_file;
pub mod ttt;
pub mod video;
pub mod xml;
