//! `sim.*`: joints: position, interval, targets, dependency.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
