//! `sim.*`: flags of objects and models, layers, selection.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
