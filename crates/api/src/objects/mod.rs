//! `sim.*`: objects: names, poses, the tree, copies, collections.

pub(in crate::api) mod alias;
pub(in crate::api) mod collection;
pub(in crate::api) mod copy;
pub(in crate::api) mod dummy;
pub(in crate::api) mod old_name;
pub(in crate::api) mod pose;
pub(in crate::api) mod pose_maths;
pub(in crate::api) mod property;
pub(in crate::api) mod tree;
