//! `simIM`: images with OpenCV's operations, drawing, square markers.
//!
//! The algorithms are in `imaging`, which knows no scripts. There are no cameras: nothing here opens video devices.

mod arguments;
mod arithmetic;
mod channels;
mod drawing;
mod files;
mod images;
mod markers;
mod objects;
mod rearrange;
mod sensors;
mod vectors;

use super::Module;

/// The module `simIM`.
pub static MODULE: Module = Module {
    about: "Image processing as OpenCV does it.",
    functions: &[
        ("Images", images::FUNCTIONS),
        ("Files", files::FUNCTIONS),
        ("Channels and colours", channels::FUNCTIONS),
        ("Sizes and regions", rearrange::FUNCTIONS),
        ("Arithmetic", arithmetic::FUNCTIONS),
        ("Vectors and distances", vectors::FUNCTIONS),
        ("Drawing", drawing::FUNCTIONS),
        ("Sensors, textures and cameras", sensors::FUNCTIONS),
        ("Markers", markers::FUNCTIONS),
    ],
    constants: include_str!("constants.tsv"),
    ..Module::new("simIM")
};
