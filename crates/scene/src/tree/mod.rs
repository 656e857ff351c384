//! The tree that objects form: hierarchy, names and paths, selection, collections, copies, references.

pub mod button_interfaces;
pub mod calculation_objects;
pub(in crate::scene) mod collection;
pub(in crate::scene) mod copy;
pub(in crate::scene) mod default_scene;
pub(in crate::scene) mod hierarchy;
pub mod ik_groups;
pub(in crate::scene) mod old_names;
pub(in crate::scene) mod path;
pub(in crate::scene) mod references;
pub(in crate::scene) mod scale;
pub(in crate::scene) mod selection;
