//! The formats, and the way in and out.

use crate::error::{Place, ReadError, Result, WriteError};
use crate::limits::Limits;
use crate::mesh_file::{MeshFile, Part};
use crate::{Resolve, collada, dxf, gltf, obj, ply, stl, three_ds};

/// A format that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Format {
    Obj,
    Stl,
    Ply,
    Collada,
    /// JSON or binary.
    Gltf,
    ThreeDs,
    Dxf,
}

impl Format {
    /// All, with extension and description.
    pub const ALL: [(Format, &'static str, &'static str); 8] = [
        (Format::Obj, "obj", "Wavefront OBJ"),
        (Format::Stl, "stl", "Stereolithography"),
        (Format::Ply, "ply", "Stanford polygon file"),
        (Format::Collada, "dae", "COLLADA"),
        (Format::Gltf, "gltf", "glTF 2.0"),
        (Format::Gltf, "glb", "glTF 2.0, binary"),
        (Format::ThreeDs, "3ds", "3D Studio"),
        (Format::Dxf, "dxf", "AutoCAD drawing exchange"),
    ];

    /// The format of a file, by the extension of its name in either case.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        Self::ALL.iter().find(|(_, known, _)| known.eq_ignore_ascii_case(extension)).map(|(format, ..)| *format)
    }
}

/// A format that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum ExportFormat {
    Obj,
    StlText,
    StlBinary,
    PlyText,
    PlyBinary,
    Collada,
    Glb,
}

/// A file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Its name; that of the mesh file itself is the one asked for.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// Reads a mesh file. What it names, `resolve` looks up.
///
/// # Errors
///
/// Where the file is damaged, exceeds the limits, or has no triangles.
pub fn read(bytes: &[u8], format: Format, limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    let largest = largest_file(format);
    if bytes.len() > largest {
        return Err(ReadError::new(Place::File, "file", format!("larger than {} MiB", largest >> 20)));
    }
    let file = match format {
        Format::Obj => obj::read(bytes, limits, resolve)?,
        Format::Stl => stl::read(bytes, limits)?,
        Format::Ply => ply::read(bytes, limits, resolve)?,
        Format::Collada => collada::read(bytes, limits, resolve)?,
        Format::Gltf => gltf::read(bytes, limits, resolve)?,
        Format::ThreeDs => three_ds::read(bytes, limits, resolve)?,
        Format::Dxf => dxf::read(bytes, limits)?,
    };
    file.checked()
}

/// Bytes of the largest file that is read: what has a structure of its own takes up to twenty times as much memory.
fn largest_file(format: Format) -> usize {
    match format {
        Format::Collada | Format::Gltf | Format::Dxf => 256 << 20,
        Format::Obj | Format::Stl | Format::Ply | Format::ThreeDs => 2 << 30,
    }
}

/// Writes a mesh file of a name: itself first, then the files it refers to (materials, textures). Coordinates are written as they are.
///
/// # Errors
///
/// Triangles of vertices that are not there, coordinates that are not finite, and more elements than the format can count.
pub fn write(file: &MeshFile, format: ExportFormat, name: &str) -> std::result::Result<Vec<Written>, WriteError> {
    check_parts(file.parts.iter())?;
    let bytes = match format {
        ExportFormat::Obj => return Ok(obj::write(file, name)),
        ExportFormat::Collada => return Ok(collada::write(file, name)),
        ExportFormat::StlText => stl::write_text(file),
        ExportFormat::StlBinary => stl::write_binary(file)?,
        ExportFormat::PlyText => ply::write_text(file),
        ExportFormat::PlyBinary => ply::write_binary(file),
        ExportFormat::Glb => gltf::write(file)?,
    };
    Ok(vec![Written { name: name.into(), bytes }])
}

/// What every writer relies on.
pub(crate) fn check_parts<'a>(parts: impl Iterator<Item = &'a Part> + Clone) -> std::result::Result<(), WriteError> {
    for (number, part) in parts.clone().enumerate() {
        if let Some(vertex) = part.vertices.iter().position(|vertex| !vertex.iter().all(|x| x.is_finite())) {
            return Err(WriteError::NotFinite { part: number, vertex });
        }
        let is_wrong = |triangle: &[u32; 3]| triangle.iter().any(|&index| index as usize >= part.vertices.len());
        if let Some(triangle) = part.triangles.iter().position(is_wrong) {
            return Err(WriteError::NoSuchVertex { part: number, triangle });
        }
    }
    let vertices: usize = parts.clone().map(|part| part.vertices.len()).sum();
    let triangles: usize = parts.map(|part| part.triangles.len()).sum();
    // Indices, byte lengths of 60 bytes a triangle included, stay below 2^32.
    if vertices.max(triangles) > u32::MAX as usize / 60 { Err(WriteError::TooLarge) } else { Ok(()) }
}
