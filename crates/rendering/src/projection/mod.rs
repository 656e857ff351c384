//! From things in space to faces on the picture.

pub mod chunk;
pub mod owner;
pub mod strokes;
pub mod surface;
pub mod view;
