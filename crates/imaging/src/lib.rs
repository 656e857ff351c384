//! Image processing without scenes: filters on RGB images of floats ([`rgb`]), matrices of pixels with the arithmetic of OpenCV
//! ([`matrix`]), drawing on them ([`draw`]), and square markers ([`markers`]).

pub mod draw;
pub mod markers;
pub mod matrix;
pub mod rgb;
