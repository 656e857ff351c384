//! The formats.

use api_macro::api;
use mesh_files::{ExportFormat, MeshFormat};

use crate::{ApiError, ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![get_import_format, get_export_format];

/// Description, extension and name of what is written.
const EXPORT: [(&str, &str, &str, ExportFormat); 7] = [
    ("COLLADA", "dae", "collada", ExportFormat::Collada),
    ("Wavefront OBJ", "obj", "obj", ExportFormat::Obj),
    ("Stereolithography", "stl", "stl", ExportFormat::StlText),
    (
        "Stereolithography (binary)",
        "stl",
        "stlb",
        ExportFormat::StlBinary,
    ),
    ("Stanford polygon file", "ply", "ply", ExportFormat::PlyText),
    (
        "Stanford polygon file (binary)",
        "ply",
        "plyb",
        ExportFormat::PlyBinary,
    ),
    ("glTF 2.0 (binary)", "glb", "glb2", ExportFormat::Glb),
];

/// A format that is read.
///
/// @param index from 0
/// @return formatDescription empty past the last
/// @return formatExtension without a dot
#[api("simAssimp.getImportFormat")]
fn get_import_format(_cx: &Cx, index: i64) -> Result<(String, String)> {
    let format = usize::try_from(index)
        .ok()
        .and_then(|index| MeshFormat::ALL.get(index));
    Ok(
        format.map_or_else(Default::default, |(_, extension, description)| {
            ((*description).into(), (*extension).into())
        }),
    )
}

/// A format that is written.
///
/// @param index from 0
/// @return formatDescription empty past the last
/// @return formatExtension without a dot
/// @return formatId for the exports
#[api("simAssimp.getExportFormat")]
fn get_export_format(_cx: &Cx, index: i64) -> Result<(String, String, String)> {
    let format = usize::try_from(index)
        .ok()
        .and_then(|index| EXPORT.get(index));
    Ok(
        format.map_or_else(Default::default, |(description, extension, id, _)| {
            ((*description).into(), (*extension).into(), (*id).into())
        }),
    )
}

/// The format of a name.
pub(super) fn export_format(id: &str) -> Result<ExportFormat> {
    let known = EXPORT
        .iter()
        .find(|(_, _, known, _)| *known == id)
        .map(|(.., format)| *format);
    known.ok_or_else(|| {
        let all: Vec<&str> = EXPORT.iter().map(|(_, _, id, _)| *id).collect();
        ApiError::Other(format!(
            "invalid file format: {id} (known: {}).",
            all.join(", ")
        ))
    })
}
