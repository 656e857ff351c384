//! Modules for meshes, matrices and model files.

pub mod sim_assimp;
pub mod sim_convex;
pub mod sim_eigen;
pub mod sim_geom;
pub mod sim_gltf;
pub mod sim_open_mesh;
pub mod sim_sdf;
pub mod sim_urdf;

use script::{ApiError, ApiFn, ApiResult as Result, Args, Cx, FromScript, Module, functions};
