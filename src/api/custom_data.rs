//! `sim.*`: data blocks and referenced handles.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
