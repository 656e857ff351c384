//! Files of either format, recognised by their first bytes.

use std::path::Path;

use crate::ttt::{self, File, FileError, FileResult};
use crate::xml;
use permissions::{Permissions, read_bounded};

/// True where the bytes begin as a scene or model does, binary or XML.
pub fn is_scene(bytes: &[u8]) -> bool {
    ttt::is_binary(bytes) || xml::is_xml(bytes)
}

/// Content of a file. XML may name files beside it, which are looked for in `folder`, where they may be read.
///
/// # Errors
/// Describes the fault in the bytes, and its position.
pub fn read_file(
    bytes: &[u8],
    folder: Option<&Path>,
    permissions: &Permissions,
) -> FileResult<File> {
    if xml::is_xml(bytes) {
        xml::read(bytes, folder, permissions)
    } else {
        File::read(bytes)
    }
}

/// The file at a path.
///
/// # Errors
/// In words.
pub fn read_path(path: &Path) -> Result<File, String> {
    let bytes = read_bounded(path).map_err(|error| error.to_string())?;
    read_file(&bytes, path.parent(), &Permissions::all())
        .map_err(|error: FileError| error.to_string())
}
