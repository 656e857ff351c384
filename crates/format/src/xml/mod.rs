//! Scenes and models as XML, in both variants: exhaustive, and simple for editing by hand (spec: scene-files 12).
//!
//! An XML file becomes the same tree of chunks as a binary file. `fields.tsv` maps elements to fields, for reader and writer; unknown
//! elements are reported like unknown chunks.

mod arrays;
mod document;
mod geometry;
mod read;
mod scene;
mod side_files;
mod table;
mod write;

#[cfg(test)]
mod tests;

use std::path::Path;

use super::ttt::{File, FileResult};
use document::Document;
use permissions::Permissions;
use side_files::SideFiles;

/// Which of the two XML formats is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// All fields of the file.
    Exhaustive,
    /// Fields that people edit.
    Simple,
}

impl Variant {
    /// The variant that a file name selects, and the name without its mark; None for other formats.
    pub fn of_name(name: &str) -> (Option<Self>, &str) {
        match name.strip_suffix("@simpleXml") {
            Some(name) => (Some(Self::Simple), name),
            None if name.ends_with(".xml") => (Some(Self::Exhaustive), name),
            None => (None, name),
        }
    }
}

/// True where the bytes begin as XML does: no script and no binary scene begins so.
pub fn is_xml(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    text.trim_ascii_start().starts_with(b"<")
}

/// The scene or model of an XML file. Files that it names are below `folder`, where they may be read; a buffer has none.
///
/// # Errors
/// Describes the fault, with line, column and the names of the elements.
pub fn read(bytes: &[u8], folder: Option<&Path>, permissions: &Permissions) -> FileResult<File> {
    scene::read(
        &Document::parse(bytes)?,
        SideFiles {
            folder,
            permissions,
        },
    )
}

/// A file of the savers as XML.
pub fn write(file: &File, variant: Variant) -> String {
    scene::write(file, variant == Variant::Simple)
}
