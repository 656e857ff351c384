//! `simVision`: filters on the images of vision sensors, detection, and sensors composed of several.
//!
//! The algorithms are in `imaging::rgb`, which knows no sensors.

mod buffers;
mod checked;
mod composed;
mod detection;
mod distort;
mod filters;
mod images;
mod velodyne;
mod velodyne_cloud;

use super::Module;

/// The module `simVision`.
pub static MODULE: Module = Module {
    about: "Image processing of vision sensors.",
    functions: &[
        ("Sensors and buffers", buffers::FUNCTIONS),
        ("Filters", filters::FUNCTIONS),
        ("Detection", detection::FUNCTIONS),
        ("Special sensors", distort::FUNCTIONS),
        ("Special sensors", composed::FUNCTIONS),
        ("Laser scanners", velodyne::FUNCTIONS),
    ],
    ..Module::new("simVision")
};
