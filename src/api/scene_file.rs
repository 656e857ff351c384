//! `sim.*`: loading, saving and closing scenes.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
