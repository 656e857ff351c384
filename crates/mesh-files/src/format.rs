//! The formats, and the way in and out.

use crate::error::{Location, ReadError, Result, WriteError};
use crate::limits::Limits;
use crate::mesh_file::{MeshFile, Part};
use crate::{Resolve, collada, dxf, gltf, obj, ply, stl, three_ds};

/// A format that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ, with its MTL materials.
    Obj,
    /// Stereolithography, text or binary.
    Stl,
    /// Stanford polygon file, text or binary.
    Ply,
    /// COLLADA 1.4 and 1.5.
    Collada,
    /// JSON or binary.
    Gltf,
    /// 3D Studio.
    ThreeDs,
    /// AutoCAD drawing exchange, text.
    Dxf,
}

impl MeshFormat {
    /// All, with extension and description.
    pub const ALL: [(MeshFormat, &'static str, &'static str); 8] = [
        (MeshFormat::Obj, "obj", "Wavefront OBJ"),
        (MeshFormat::Stl, "stl", "Stereolithography"),
        (MeshFormat::Ply, "ply", "Stanford polygon file"),
        (MeshFormat::Collada, "dae", "COLLADA"),
        (MeshFormat::Gltf, "gltf", "glTF 2.0"),
        (MeshFormat::Gltf, "glb", "glTF 2.0, binary"),
        (MeshFormat::ThreeDs, "3ds", "3D Studio"),
        (MeshFormat::Dxf, "dxf", "AutoCAD drawing exchange"),
    ];

    /// The format of a file, by the extension of its name in either case.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        Self::ALL
            .iter()
            .find(|(_, known, _)| known.eq_ignore_ascii_case(extension))
            .map(|(format, ..)| *format)
    }
}

/// A format that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography, text.
    StlText,
    /// Stereolithography, binary.
    StlBinary,
    /// Stanford polygon file, text.
    PlyText,
    /// Stanford polygon file, binary.
    PlyBinary,
    /// COLLADA.
    Collada,
    /// glTF 2.0 in one binary file.
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
pub fn read(
    bytes: &[u8],
    format: MeshFormat,
    limits: Limits,
    resolve: Resolve,
) -> Result<MeshFile> {
    let largest = largest_file(format);
    if bytes.len() > largest {
        return Err(ReadError::new(
            Location::File,
            "file",
            format!("larger than {} MiB", largest >> 20),
        ));
    }
    let file = match format {
        MeshFormat::Obj => obj::read(bytes, limits, resolve)?,
        MeshFormat::Stl => stl::read(bytes, limits)?,
        MeshFormat::Ply => ply::read(bytes, limits, resolve)?,
        MeshFormat::Collada => collada::read(bytes, limits, resolve)?,
        MeshFormat::Gltf => gltf::read(bytes, limits, resolve)?,
        MeshFormat::ThreeDs => three_ds::read(bytes, limits, resolve)?,
        MeshFormat::Dxf => dxf::read(bytes, limits)?,
    };
    file.checked()
}

/// Bytes of the largest file that is read: what has a structure of its own takes up to twenty times as much memory.
fn largest_file(format: MeshFormat) -> usize {
    match format {
        MeshFormat::Collada | MeshFormat::Gltf | MeshFormat::Dxf => 256 << 20,
        MeshFormat::Obj | MeshFormat::Stl | MeshFormat::Ply | MeshFormat::ThreeDs => 2 << 30,
    }
}

/// Writes a mesh file of a name: itself first, then the files it refers to (materials, textures). Coordinates are written as they are.
///
/// # Errors
///
/// Triangles of vertices that are not there, coordinates that are not finite, and more elements than the format can count.
pub fn write(
    file: &MeshFile,
    format: ExportFormat,
    name: &str,
) -> std::result::Result<Vec<Written>, WriteError> {
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
    Ok(vec![Written {
        name: name.into(),
        bytes,
    }])
}

/// What every writer relies on.
pub(crate) fn check_parts<'a>(
    parts: impl Iterator<Item = &'a Part> + Clone,
) -> std::result::Result<(), WriteError> {
    for (number, part) in parts.clone().enumerate() {
        if let Some(vertex) = part
            .vertices
            .iter()
            .position(|vertex| !vertex.iter().all(|x| x.is_finite()))
        {
            return Err(WriteError::NotFinite {
                part: number,
                vertex,
            });
        }
        let is_wrong = |triangle: &[u32; 3]| {
            triangle
                .iter()
                .any(|&index| numbers::place(index) >= part.vertices.len())
        };
        if let Some(triangle) = part.triangles.iter().position(is_wrong) {
            return Err(WriteError::NoSuchVertex {
                part: number,
                triangle,
            });
        }
    }
    let vertices: usize = parts.clone().map(|part| part.vertices.len()).sum();
    let triangles: usize = parts.map(|part| part.triangles.len()).sum();
    // Indices, byte lengths of 60 bytes a triangle included, stay below 2^32.
    if vertices.max(triangles) > u32::MAX as usize / 60 {
        Err(WriteError::TooLarge)
    } else {
        Ok(())
    }
}
