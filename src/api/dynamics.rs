//! `sim.*`: forces, velocities, contacts.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
