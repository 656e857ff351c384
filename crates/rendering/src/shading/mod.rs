//! From visible faces to colours, depths and ids.

pub mod attributes;
pub mod bytes;
pub mod lighting;
pub mod painter;
pub mod row;
pub mod shadows;
pub mod strip;
pub mod visible;
