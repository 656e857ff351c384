//! `sim.*`: parents, children, enumeration, removal.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
