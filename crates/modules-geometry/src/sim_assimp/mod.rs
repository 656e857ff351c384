//! `simAssimp`: shapes and meshes from files, and to files, with their appearance.
//!
//! The dialogs of CoppeliaSim's module are missing: there is no window to ask in.

mod export;
mod formats;

use api_macro::api;
use mesh_files::MeshFile;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use format::mesh_file::{
    ImportedAppearance, MeshImportOptions, Up, load, scaling_factor, to_lists, to_shapes,
};
use scene::shape::Shape;
use scene::{Data, Handle, Kind};
use script::Number;
use script::log::verbosity;

/// The module `simAssimp`.
pub static MODULE: Module = Module {
    about: "Shapes and meshes from files (OBJ, STL, PLY, COLLADA, glTF, 3DS, DXF), and to files.",
    functions: &[
        ("Import", IMPORT),
        ("Export", export::FUNCTIONS),
        ("Formats", formats::FUNCTIONS),
    ],
    constants: include_str!("constants.tsv"),
    reference: "importShapesDlg\tDialogs\t\tint[] handles = simAssimp.importShapesDlg(string filename)\n\
        exportShapesDlg\tDialogs\t\tsimAssimp.exportShapesDlg(string filename, int[] shapeHandles)\n",
    ..Module::new("simAssimp")
};

const IMPORT: &[ApiFn] = functions![import_shapes, import_meshes];

/// Bits of the options of an import.
mod option {
    pub const DROP_TEXTURES: i64 = 1;
    pub const DROP_COLOURS: i64 = 2;
    pub const DROP_TRANSPARENCY: i64 = 4;
    pub const NO_OPTIMISATION: i64 = 8;
    pub const KEEP_IDENTICAL: i64 = 16;
    pub const ONE_PER_FILE: i64 = 32;
    pub const ALIGNED: i64 = 64;
    pub const IGNORE_UP_AXIS: i64 = 128;
    pub const SILENT: i64 = 256;
}

/// New shapes from mesh files; the frames of all are the world's.
///
/// @param filenames the files, with `;` between them
/// @param maxTextureSize pixels on a side; larger textures are made smaller
/// @param scaling of all coordinates, beside the unit of the file; 0 for 1
/// @param upVector simAssimp.upVector.auto: what the file says, .z, .y
/// @param options 1: without textures, 2: without colours, 4: opaque, 8: meshes that look the same stay apart, 16: identical vertices stay,
/// 32: one shape for each file, 64: bounding boxes along the axes of the world, 128: the up axis of the file is ignored, 256: no warnings
/// @return shapeHandles static and not respondable
#[api("simAssimp.importShapes")]
fn import_shapes(
    cx: &mut Cx,
    filenames: String,
    #[default(512)] max_texture_size: Number,
    #[default(0.0)] scaling: f64,
    #[default(0, "simAssimp.upVector.auto")] up_vector: Number,
    #[default(0)] options: Number,
) -> Result<Vec<Handle>> {
    let has = |bit: i64| options.0 & bit != 0;
    let longest = u32::try_from(max_texture_size.0)
        .ok()
        .filter(|longest| *longest > 0);
    let imported = ImportedAppearance {
        colours: !has(option::DROP_COLOURS),
        transparency: !has(option::DROP_TRANSPARENCY),
        textures: longest.filter(|_| !has(option::DROP_TEXTURES)),
    };
    let import = import_options(scaling, up_vector.0, options.0, imported.textures.is_some())?;
    // All are read before the first shape is made: a file that is refused leaves the scene as it is.
    let mut shapes = Vec::new();
    for name in names(&filenames) {
        let mut file = load(name, import, cx.permissions())?;
        let own = to_shapes(&mut file, imported, &mut cx.scene_mut())?;
        warn(cx, name, &file, options.0);
        if has(option::ONE_PER_FILE) {
            shapes.push(Shape::compound(own)?);
        } else {
            shapes.extend(own);
        }
    }
    shapes
        .iter_mut()
        .try_for_each(|shape| finish(shape, has(option::ALIGNED)))?;
    shapes
        .into_iter()
        .map(|shape| cx.add_object("shape", Kind::Shape(Box::new(shape))))
        .collect()
}

fn finish(shape: &mut Shape, is_aligned: bool) -> Result<()> {
    if is_aligned {
        shape.fit_box(Some(nalgebra::UnitQuaternion::identity()));
    }
    Ok(shape.check_extent(1.0)?)
}

/// The meshes of files.
///
/// @param filenames the files, with `;` between them
/// @param scaling of all coordinates, beside the unit of the file; 0 for 1
/// @param upVector simAssimp.upVector.auto: what the file says, .z, .y
/// @param options 8: meshes that look the same stay apart, 16: identical vertices stay, 32: one mesh for each file, 128: the up axis of the file is
/// ignored
/// @return allVertices for each mesh a table of three coordinates each, metres
/// @return allIndices for each mesh a table of three vertices per triangle, from 0
#[api("simAssimp.importMeshes")]
fn import_meshes(
    cx: &Cx,
    filenames: String,
    #[default(0.0)] scaling: f64,
    #[default(0, "simAssimp.upVector.auto")] up_vector: Number,
    #[default(0)] options: Number,
) -> Result<(Data, Data)> {
    let import = import_options(scaling, up_vector.0, options.0, false)?;
    let mut all = MeshFile::default();
    for name in names(&filenames) {
        let mut file = load(name, import, cx.permissions())?;
        if options.0 & option::ONE_PER_FILE != 0 {
            file.parts
                .iter_mut()
                .for_each(|part| part.material = Default::default());
            file.merge_parts();
        }
        all.parts.append(&mut file.parts);
    }
    to_lists(&all).ok_or_else(|| ApiError::Other("the meshes are too large for tables.".into()))
}

fn names(filenames: &str) -> impl Iterator<Item = &str> {
    filenames
        .split(';')
        .map(str::trim)
        .filter(|name| !name.is_empty())
}

fn import_options(
    scaling: f64,
    up: i64,
    options: i64,
    textures: bool,
) -> Result<MeshImportOptions> {
    let has = |bit: i64| options & bit != 0;
    Ok(MeshImportOptions {
        scaling: scaling_factor(scaling)?,
        up: match up_axis(up)? {
            Up::OfFile if has(option::IGNORE_UP_AXIS) => Up::Z,
            axis => axis,
        },
        keep_identical: has(option::KEEP_IDENTICAL),
        merge_parts: !has(option::NO_OPTIMISATION),
        textures,
    })
}

/// `simAssimp.upVector`.
fn up_axis(up: i64) -> Result<Up> {
    match up {
        0 => Ok(Up::OfFile),
        1 => Ok(Up::Z),
        2 => Ok(Up::Y),
        _ => Err(ApiError::Other("invalid up vector.".into())),
    }
}

/// Logs what a file has and could not be used.
fn warn(cx: &Cx, name: &str, file: &MeshFile, options: i64) {
    if options & option::SILENT == 0 {
        for warning in &file.warnings {
            cx.env()
                .log(verbosity::SCRIPT_WARNINGS, &format!("{name}: {warning}"));
        }
    }
}
