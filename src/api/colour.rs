//! `sim.*`: colours of shapes and other objects.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
