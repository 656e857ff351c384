//! Shapes and meshes to files.

use std::path::Path;

use api_macro::api;
use geometry::Pose;
use mesh_files::{ExportFormat, MeshFile, UpAxis};

use super::formats::export_format;
use super::up_axis;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::mesh_file::{ShapeParts, Up, scaling_factor, store, to_parts, turn_to_y_up};
use scene::{Handle, Scene, SceneError};
use script::{Number, Table};

pub(super) const FUNCTIONS: &[ApiFn] = functions![export_shapes, export_meshes];

/// Bits of the options of an export.
mod option {
    pub const DROP_TEXTURES: i64 = 1;
    pub const DROP_COLOURS: i64 = 2;
    pub const DROP_NORMALS: i64 = 4;
    pub const VISIBLE_ONLY: i64 = 8;
    pub const RELATIVE_TO_FIRST: i64 = 512;
}

/// Writes shapes to a file.
///
/// @param shapeHandles the shapes; other objects are left out
/// @param filename the file
/// @param formatId see simAssimp.getExportFormat
/// @param scaling of all coordinates; 0 for 1
/// @param upVector simAssimp.upVector.z or .y: the axis of the file that points up
/// @param options 1: without textures, 2: without colours, 4: without normals, 8: only visible shapes, 256: not used, 512: in the frame of the first
/// shape instead of the world's
#[api("simAssimp.exportShapes")]
fn export_shapes(
    cx: &Cx,
    shape_handles: Vec<i64>,
    filename: String,
    format_id: String,
    #[default(1.0)] scaling: f64,
    #[default(1, "simAssimp.upVector.z")] up_vector: Number,
    #[default(0)] options: Number,
) -> Result<()> {
    let format = export_format(&format_id)?;
    let parts = parts(&cx.scene(), &shape_handles, options.0)?;
    write(cx, parts.file, format, &filename, scaling, up_vector.0)
}

fn parts(scene: &Scene, handles: &[i64], options: i64) -> Result<ShapeParts> {
    let has = |bit: i64| options & bit != 0;
    let mut parts = ShapeParts {
        file: MeshFile::default(),
        textures: (!has(option::DROP_TEXTURES)).then_some("png"),
        colours: !has(option::DROP_COLOURS),
        normals: !has(option::DROP_NORMALS),
    };
    let mut origin = None;
    for raw in handles {
        let handle = Handle::from_raw(*raw).ok_or(SceneError::NoSuchObject)?;
        let object = scene.object(handle)?;
        let Ok(shape) = object.shape() else { continue };
        if has(option::VISIBLE_ONLY) && !scene.is_visible(handle)? {
            continue;
        }
        let pose = scene.world_pose(handle)?;
        let origin = *origin.get_or_insert(if has(option::RELATIVE_TO_FIRST) {
            pose
        } else {
            Pose::identity()
        });
        parts.add(object.alias(), shape, &(origin.inverse() * pose), scene)?;
    }
    if parts.file.parts.is_empty() {
        Err(ApiError::Other("there are no shapes to export.".into()))
    } else {
        Ok(parts)
    }
}

/// Writes meshes to a file.
///
/// @param allVertices for each mesh a table of three coordinates each
/// @param allIndices for each mesh a table of three vertices per triangle, from 0
/// @param filename the file
/// @param formatId see simAssimp.getExportFormat
/// @param scaling of all coordinates; 0 for 1
/// @param upVector simAssimp.upVector.z or .y: the axis of the file that points up
/// @param options not used
#[api("simAssimp.exportMeshes")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn export_meshes(
    cx: &Cx,
    all_vertices: Table,
    all_indices: Table,
    filename: String,
    format_id: String,
    #[default(1.0)] scaling: f64,
    #[default(1, "simAssimp.upVector.z")] up_vector: Number,
    #[default(0)] options: Number,
) -> Result<()> {
    let _ = options;
    let format = export_format(&format_id)?;
    let parts = to_parts(&all_vertices.0, &all_indices.0).ok_or(ApiError::TableSize)?;
    write(
        cx,
        MeshFile {
            parts,
            ..MeshFile::default()
        },
        format,
        &filename,
        scaling,
        up_vector.0,
    )
}

fn write(
    cx: &Cx,
    mut file: MeshFile,
    format: ExportFormat,
    name: &str,
    scaling: f64,
    up: i64,
) -> Result<()> {
    file.scale(scaling_factor(scaling)?);
    // Textures lie beside the file: those of another file in the same folder stay as they are.
    let stem = Path::new(name)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    file.textures
        .iter_mut()
        .for_each(|texture| texture.name = format!("{stem}-{}", texture.name));
    match up_axis(up)? {
        Up::Y => turn_to_y_up(&mut file),
        Up::Z | Up::OfFile => file.up = Some(UpAxis::Z),
    }
    Ok(store(&file, format, name, cx.permissions())?)
}
