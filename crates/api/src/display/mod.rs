//! `sim.*`: display functions: drawing objects, particles, graphs, consoles, images.

pub(crate) mod auxiliary_console;
pub(crate) mod banners;
pub(crate) mod drawing;
pub(crate) mod graph;
pub(crate) mod images;
pub(crate) mod particles;
pub(crate) mod text_editor;
pub(crate) mod views;
pub(crate) mod window;
