//! `sim.*`: motion profiles.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
