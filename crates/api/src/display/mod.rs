//! `sim.*`: display functions: drawing objects, graphs, consoles, images.

pub(in crate::api) mod auxiliary_console;
pub(in crate::api) mod banners;
pub(in crate::api) mod drawing;
pub(in crate::api) mod graph;
pub(in crate::api) mod images;
pub(in crate::api) mod text_editor;
pub(in crate::api) mod views;
