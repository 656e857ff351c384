//! `sim.*`: numbered parameters of objects (deprecated names).

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
