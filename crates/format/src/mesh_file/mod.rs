//! Mesh files of other programs: OBJ, STL, PLY, COLLADA, glTF, 3DS, DXF, as shapes and as lists of numbers.
//!
//! The formats are read and written by the crate `mesh_files`; here are paths, permissions, options, and the way to and from shapes.

mod lists;
mod shapes;

use std::path::{Path, PathBuf};

pub use lists::{to_lists, to_parts};
use mesh_files::{ExportFormat, Limits, MeshFile, MeshFormat, UpAxis};
pub use shapes::{ImportedAppearance, ShapeParts, to_shapes};

use super::scene_file::write_whole;
use permissions::Permissions;

/// What is read for scripts: their tables, and the physics, could not hold more.
const LIMITS: Limits = Limits {
    vertices: 12_000_000,
    triangles: 4_000_000,
    parts: 10_000,
};

/// Why a mesh file is not read or written.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// There is no such file.
    #[error("file does not exist.")]
    NotFound,
    /// The extension names no format of meshes.
    #[error("invalid file format.")]
    UnknownFormat,
    /// The file, and why it cannot be read.
    #[error("cannot read {0}: {1}.")]
    Read(String, std::io::Error),
    /// The file, and why it cannot be written.
    #[error("cannot write {0}: {1}.")]
    Write(String, std::io::Error),
    /// The file, and what is wrong in it.
    #[error("{0}: {1}.")]
    Damaged(String, mesh_files::ReadError),
    /// The file, and why its format cannot hold the meshes.
    #[error("{0}: {1}.")]
    NotWritable(String, mesh_files::WriteError),
    /// The factor of the coordinates is negative or not finite.
    #[error("the scaling factor must be positive, or 0.")]
    Scaling,
}

/// A factor of coordinates; 0 means that of the file.
///
/// # Errors
/// [`MeshFileError::Scaling`] if it is negative or not finite.
pub fn scaling_factor(scaling: f64) -> Result<f64, MeshFileError> {
    match scaling {
        0.0 => Ok(1.0),
        factor if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err(MeshFileError::Scaling),
    }
}

/// Which axis of the file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// What the file or its format says; z if it says nothing.
    OfFile,
    /// The y axis.
    Y,
    /// The z axis.
    Z,
}

/// How a file is read.
#[derive(Debug, Clone, Copy)]
pub struct MeshImportOptions {
    /// Factor of all coordinates, beside the unit of the file.
    pub scaling: f64,
    /// The axis that becomes z.
    pub up: Up,
    /// Whether vertices of the same coordinates stay apart.
    pub keep_identical: bool,
    /// Joins parts that look the same.
    pub merge_parts: bool,
    /// Whether textures are read.
    pub textures: bool,
}

/// Reads a mesh file and what it refers to, as far as permitted: metres, z up.
pub fn load(
    name: &str,
    options: MeshImportOptions,
    permissions: &Permissions,
) -> Result<MeshFile, MeshFileError> {
    let format = MeshFormat::of_name(name).ok_or(MeshFileError::UnknownFormat)?;
    let path = Path::new(name);
    let bytes = permissions
        .read_file(path)
        .map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => MeshFileError::NotFound,
            _ => MeshFileError::Read(name.into(), error),
        })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut resolve = |reference: &str| beside(folder, reference, options.textures, permissions);
    let file = mesh_files::read(&bytes, format, LIMITS, &mut resolve);
    let mut file = file.map_err(|error| MeshFileError::Damaged(name.into(), error))?;
    file.scale(file.unit.unwrap_or(1.0) * options.scaling);
    match options.up {
        Up::OfFile => file.turn_up(file.up.unwrap_or(UpAxis::Z)),
        Up::Y => file.turn_up(UpAxis::Y),
        Up::Z => {}
    }
    if options.merge_parts {
        file.merge_parts();
    }
    if !options.keep_identical {
        file.merge_identical();
    }
    Ok(file)
}

/// A file that a mesh file names: at its path, else of the same name beside the mesh file, since paths come from other machines.
fn beside(
    folder: &Path,
    reference: &str,
    with_textures: bool,
    permissions: &Permissions,
) -> Result<Vec<u8>, String> {
    let path = reference.replace('\\', "/");
    let is_geometry = ["bin", "mtl"]
        .iter()
        .any(|kind| path.to_lowercase().ends_with(&format!(".{kind}")));
    if !with_textures && !is_geometry {
        return Err("left out".into());
    }
    let paths: [PathBuf; 2] = [
        folder.join(&path),
        folder.join(path.rsplit('/').next().unwrap_or(&path)),
    ];
    let found = permissions
        .read_file(&paths[0])
        .or_else(|first| permissions.read_file(&paths[1]).map_err(|_| first));
    found.map_err(|error| error.to_string())
}

/// Writes a mesh file, and beside it the materials and textures it refers to.
pub fn store(
    file: &MeshFile,
    format: ExportFormat,
    name: &str,
    permissions: &Permissions,
) -> Result<(), MeshFileError> {
    let path = Path::new(name);
    let last = path.file_name().unwrap_or_default().to_string_lossy();
    let written = mesh_files::write(file, format, &last)
        .map_err(|error| MeshFileError::NotWritable(name.into(), error))?;
    for (number, file) in written.iter().enumerate() {
        let path = if number == 0 {
            path.to_owned()
        } else {
            path.with_file_name(&file.name)
        };
        let written = permissions
            .check_write(&path)
            .map_err(Into::into)
            .and_then(|()| permissions.write(&path, || write_whole(&path, &file.bytes)));
        written
            .map_err(|error| MeshFileError::Write(path.to_string_lossy().into_owned(), error))?;
    }
    Ok(())
}

/// Turns what is z-up so that y points up: (x, y, z) becomes (x, z, -y).
pub fn turn_to_y_up(file: &mut MeshFile) {
    let turn = |[x, y, z]: [f64; 3]| [x, z, -y];
    for part in &mut file.parts {
        part.vertices
            .iter_mut()
            .for_each(|vertex| *vertex = turn(*vertex));
        part.normals
            .as_flattened_mut()
            .iter_mut()
            .for_each(|normal| *normal = turn(*normal));
    }
    file.up = Some(UpAxis::Y);
}
