//! Plots where the feature for them is off.

use super::samples::Curve;

/// There are none.
pub(super) fn png(_: &[Curve<'_>]) -> Option<Vec<u8>> {
    None
}
