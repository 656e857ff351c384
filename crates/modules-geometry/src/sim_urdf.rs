//! `simURDF`: robots from URDF files, and models as URDF files (spec: import 1).

use std::path::Path;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use format::robot_file::{RobotExportOptions, RobotFile, RobotFormat, RobotImportOptions, export};
use scene::Handle;
use script::Number;
use script::log::verbosity;

/// The module `simURDF`.
pub static MODULE: Module = Module {
    about: "Robots from URDF files, and models as URDF files.",
    functions: &[("Robots", FUNCTIONS)],
    aliases: "importFile\timport\n",
    plugin_errors: true,
    ..Module::new("simURDF")
};

const FUNCTIONS: &[ApiFn] = functions![import, export_model];

/// Adds the robot of a URDF file to the scene. What is wrong in the file is logged, with its line; meshes that are not found are left out.
///
/// Meshes of `package://` are looked for in `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`, and in the folders above the file. Files are read where
/// permissions allow it.
///
/// @param urdf name of a file, or its text, if it begins with `<?xml`
/// @param options 1: collision shapes are visible, 2: joints are visible, 4: collision meshes that are not convex are decomposed, 8: links without
/// visuals get some, 32: the position is kept, 64: no model, 128: every second link collides with the robot's other ones, 256: joints are free, 512: collision meshes
/// become their hulls, 1024: frames of shapes are those of their joints
/// @param packageStrReplace stands for `package://`
/// @return robotName
/// @return modelHandles objects without a parent
#[api("simURDF.import")]
fn import(
    cx: &mut Cx,
    urdf: String,
    #[default(0)] options: Number,
    #[default(None)] package_str_replace: Option<String>,
) -> Result<(String, Vec<Handle>)> {
    let file = if urdf.trim_start().starts_with("<?xml") {
        let beside = cx.permissions().absolute(Path::new("robot.urdf"));
        let beside = beside.unwrap_or_default();
        RobotFile::parse(
            urdf.as_bytes(),
            RobotFormat::Urdf,
            &beside,
            package_str_replace,
            cx.permissions(),
        )
    } else {
        RobotFile::read_as(
            Some(RobotFormat::Urdf),
            Path::new(&urdf),
            package_str_replace,
            cx.permissions(),
        )
        .map_err(|reason| format!("{urdf}: {reason}"))
    };
    let file = file.map_err(ApiError::Other)?;
    let imported = file.add_to(
        &mut cx.scene_mut(),
        RobotImportOptions::from_bits_retain(options.0),
    )?;
    for message in &imported.messages {
        cx.env().log(
            verbosity::SCRIPT_WARNINGS,
            &format!("{}: {message}", imported.name),
        );
    }
    cx.notify_created(&imported.objects);
    Ok((imported.name, imported.roots))
}

/// Writes a model as a URDF file, with files in OBJ beside it for meshes that are no primitives.
///
/// Shapes become links: those that others touch are collisions, those on visible layers are visuals, those that are not static have mass. Force
/// sensors become fixed joints.
///
/// @param modelHandle the base of the model
/// @param fileName ends with `.urdf`
/// @param options 1: dummies become small red cubes, 2: frames of meshes are those of their joints, 4: joints are exported with their positions as zero
#[api("simURDF.export")]
fn export_model(
    cx: &mut Cx,
    model_handle: Handle,
    file_name: String,
    #[default(0)] options: Number,
) -> Result<()> {
    let path = Path::new(&file_name);
    let stem = path
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_default();
    let files = export(
        &cx.scene(),
        model_handle,
        &stem,
        RobotExportOptions::from_bits_retain(options.0),
    )?;
    for file in files {
        let path = path.with_file_name(&file.name);
        cx.permissions().check_write(&path)?;
        let written = cx
            .permissions()
            .write(&path, || std::fs::write(&path, &file.bytes));
        written.map_err(|error| {
            ApiError::Other(format!("cannot write {}: {error}", path.display()))
        })?;
    }
    Ok(())
}
