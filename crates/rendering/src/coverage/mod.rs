//! Which pixels faces cover, and which face is in front.

pub mod band;
pub mod face;
