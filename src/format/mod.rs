//! Files of other programs.

pub(crate) mod picture;

pub mod ttt;
