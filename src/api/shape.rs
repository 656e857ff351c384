//! `sim.*`: creating shapes, their meshes and boxes.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
