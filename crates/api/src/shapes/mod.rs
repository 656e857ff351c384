//! `sim.*`: shapes: geometry, mass, groups, colours, textures.

pub(in crate::api) mod colour;
pub(in crate::api) mod convex;
pub(in crate::api) mod group;
pub(in crate::api) mod mass;
pub(crate) mod mesh_file;
pub(in crate::api) mod shape;
pub(in crate::api) mod texture;
