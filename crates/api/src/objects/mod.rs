//! `sim.*`: objects: names, poses, the tree, copies, collections.

pub(crate) mod alias;
pub(crate) mod collection;
pub(crate) mod copy;
pub(crate) mod dummy;
pub(crate) mod old_name;
pub(crate) mod pose;
pub(crate) mod pose_maths;
pub(crate) mod property;
pub(crate) mod tree;
