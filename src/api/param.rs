//! `sim.*`: numbered parameters of the simulator.

use super::{ApiFn, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![];
