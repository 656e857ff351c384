//! `sim.*`: copying objects, models, scaling.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
