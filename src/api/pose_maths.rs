//! `sim.*`: poses, matrices, angles: pure functions.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
