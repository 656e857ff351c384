//! `sim.*`: shapes: geometry, mass, groups, colours, textures.

pub(crate) mod colour;
pub(crate) mod convex;
pub(crate) mod group;
pub(crate) mod mass;
pub(crate) mod mesh_file;
pub(crate) mod shape;
pub(crate) mod texture;
