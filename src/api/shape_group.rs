//! `sim.*`: grouping, merging and dividing.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
