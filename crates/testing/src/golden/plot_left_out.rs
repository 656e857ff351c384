//! In place of plots of traces, in builds without the feature `plots`: a line that says so.

use super::{Comparison, Recordings};

/// The line as SVG; None when there is nothing to compare.
pub(super) fn svg(comparison: &Comparison) -> Option<String> {
    let Recordings::Traces {
        expected: Some(_), ..
    } = &comparison.recordings
    else {
        return None;
    };
    let text = "This build draws no traces: build Swanilda with the feature plots.";
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"40\"><text x=\"8\" y=\"24\">{text}</text></svg>"
    ))
}

/// There is no picture.
pub(super) fn png(_: &Comparison) -> Option<Vec<u8>> {
    None
}
