//! `sim.*`: meshes and shapes from files, and to files.

use api_macro::api;
use mesh_files::{ExportFormat, MeshFile};

use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::mesh_file::{
    self, ImportedAppearance, MeshFileError, MeshImportOptions, Up, load, store, to_lists,
    to_parts, to_shapes,
};
use scene::shape::Shape;
use scene::{Data, Handle, Kind};
use script::{Number, Table};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![import_shape, import_mesh, export_mesh];

/// Bits of the options of an import.
mod option {
    pub const KEEP_IDENTICAL: i64 = 1;
    pub const DROP_COLOURS: i64 = 8;
    pub const KEEP_TEXTURES: i64 = 16;
    pub const ALIGN_BOX: i64 = 32;
    pub const IGNORE_UP_AXIS: i64 = 128;
}

/// Most pixels on a side of the texture of an imported shape.
const MAX_TEXTURE_SIZE: u32 = 512;

/// A new shape from a mesh file: OBJ, STL, PLY, COLLADA, glTF, 3DS or DXF; its frame is the world's. Several meshes are one compound.
///
/// @param fileformat not used: the name's extension says it
/// @param pathAndFilename the file
/// @param options 1: identical vertices stay, 8: without colours, 16: with textures, 32: bounding box along the axes of the world, 128: the up
/// axis of the file is ignored
/// @param identicalVerticeTolerance not used: vertices of the same coordinates become one
/// @param scalingFactor of all coordinates, beside the unit of the file; 0 for 1
/// @return shapeHandle the shape, static and not respondable
#[api("sim.importShape")]
fn import_shape(
    cx: &mut Cx,
    fileformat: Number,
    path_and_filename: String,
    options: Number,
    identical_vertice_tolerance: f64,
    scaling_factor: f64,
) -> Result<Handle> {
    let _ = (fileformat, identical_vertice_tolerance);
    let has = |bit: i64| options.0 & bit != 0;
    let import = import_options(options.0, scaling_factor, has(option::KEEP_TEXTURES))?;
    let mut file = load(&path_and_filename, import, cx.permissions())?;
    let imported = ImportedAppearance {
        colours: !has(option::DROP_COLOURS),
        transparency: !has(option::DROP_COLOURS),
        textures: has(option::KEEP_TEXTURES).then_some(MAX_TEXTURE_SIZE),
    };
    let shapes = to_shapes(&mut file, imported, &mut cx.scene_mut())?;
    let mut shape = Shape::compound(shapes)?;
    if has(option::ALIGN_BOX) {
        shape.fit_box(Some(nalgebra::UnitQuaternion::identity()));
    }
    shape.check_extent(1.0)?;
    cx.add_object("shape", Kind::Shape(Box::new(shape)))
}

/// The meshes of a file: OBJ, STL, PLY, COLLADA, glTF, 3DS or DXF.
///
/// @param fileformat not used: the name's extension says it
/// @param pathAndFilename the file
/// @param options 1: identical vertices stay, 128: the up axis of the file is ignored
/// @param identicalVerticeTolerance not used: vertices of the same coordinates become one
/// @param scalingFactor of all coordinates, beside the unit of the file; 0 for 1
/// @return vertices for each mesh a table of three coordinates each, metres
/// @return indices for each mesh a table of three vertices per triangle, from 0
#[api("sim.importMesh")]
fn import_mesh(
    cx: &Cx,
    fileformat: Number,
    path_and_filename: String,
    options: Number,
    identical_vertice_tolerance: f64,
    scaling_factor: f64,
) -> Result<(Data, Data)> {
    let _ = (fileformat, identical_vertice_tolerance);
    let import = import_options(options.0, scaling_factor, false)?;
    let file = load(&path_and_filename, import, cx.permissions())?;
    to_lists(&file).ok_or_else(|| ApiError::Other("the meshes are too large for tables.".into()))
}

/// Writes meshes to a file.
///
/// @param fileformat 0: OBJ, 3: STL, text, 4: STL, binary, 5: COLLADA, 6: PLY, text, 7: PLY, binary
/// @param pathAndFilename the file
/// @param options not used
/// @param scalingFactor of all coordinates; 0 for 1
/// @param vertices for each mesh a table of three coordinates each
/// @param indices for each mesh a table of three vertices per triangle, from 0
#[api("sim.exportMesh")]
fn export_mesh(
    cx: &Cx,
    fileformat: Number,
    path_and_filename: String,
    options: Number,
    scaling_factor: f64,
    vertices: Table,
    indices: Table,
) -> Result<()> {
    let _ = options;
    let format = match fileformat.0 {
        0 => ExportFormat::Obj,
        3 => ExportFormat::StlText,
        4 => ExportFormat::StlBinary,
        5 => ExportFormat::Collada,
        6 => ExportFormat::PlyText,
        7 => ExportFormat::PlyBinary,
        _ => return Err(MeshFileError::UnknownFormat.into()),
    };
    let parts = to_parts(&vertices.0, &indices.0).ok_or(ApiError::TableSize)?;
    let mut file = MeshFile {
        parts,
        ..MeshFile::default()
    };
    file.scale(mesh_file::scaling_factor(scaling_factor)?);
    Ok(store(&file, format, &path_and_filename, cx.permissions())?)
}

fn import_options(options: i64, scaling: f64, textures: bool) -> Result<MeshImportOptions> {
    Ok(MeshImportOptions {
        scaling: mesh_file::scaling_factor(scaling)?,
        up: if options & option::IGNORE_UP_AXIS != 0 {
            Up::Z
        } else {
            Up::OfFile
        },
        keep_identical: options & option::KEEP_IDENTICAL != 0,
        merge_parts: false,
        textures,
    })
}
