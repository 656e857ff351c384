//! Objects and the tree they form: handles, names, paths, collections, copies, references.

pub mod assembly;
pub(in crate::scene) mod collection;
pub(in crate::scene) mod copy;
pub(in crate::scene) mod default_scene;
pub mod dummy;
pub mod flags;
pub mod handle;
pub(in crate::scene) mod hierarchy;
pub(in crate::scene) mod identity;
pub(in crate::scene) mod movement;
pub(in crate::scene) mod object;
pub(in crate::scene) mod objects;
pub(in crate::scene) mod path;
pub(in crate::scene) mod references;
pub(in crate::scene) mod scale;
pub mod script_object;
pub(in crate::scene) mod selection;
