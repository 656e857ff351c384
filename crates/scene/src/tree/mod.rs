//! The tree that objects form: hierarchy, names and paths, selection, collections, copies, references.

pub mod button_interfaces;
pub mod calculation_objects;
pub(crate) mod collection;
pub mod companions;
pub(crate) mod copy;
pub(crate) mod default_scene;
pub(crate) mod hierarchy;
pub mod ik_groups;
pub(crate) mod namesakes;
mod number_runs;
pub(crate) mod old_names;
pub(crate) mod path;
pub(crate) mod references;
pub(crate) mod scale;
mod search;
pub(crate) mod selection;
mod siblings;
