//! `sim.*`: mass, inertia, materials.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
