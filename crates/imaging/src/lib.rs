//! Image processing without scenes: filters on RGB images of floats ([`rgb`]), matrices of pixels with the arithmetic of OpenCV
//! ([`matrix`]), drawing on them ([`draw`]), and square markers ([`markers`]).
//!
//! # Why no library
//!
//! Scripts expect the conventions of two programs (order of rows, rounding, saturation, units of hue): the vision filters of CoppeliaSim, and
//! OpenCV behind simIM. Crates for image processing have their own, and are large for what is needed here: `imageproc` would add `itertools`, `num`, `rand` and `rand_distr`
//! for contours and homographies of a few dozen lines. For markers, `aruco-rs` lacks the dictionary of the original ArUco and brings a second
//! version of `nalgebra`, and `kornia-apriltag` adds 300 packages. Letters are drawn with `ab_glyph`, which charts need as well.

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

pub mod draw;
pub mod markers;
pub mod matrix;
pub mod rgb;
