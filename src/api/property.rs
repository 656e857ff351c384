//! `sim.*`: typed properties of objects, scene and application.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
