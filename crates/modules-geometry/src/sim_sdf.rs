//! `simSDF`: robots and worlds from SDF files.

use std::path::Path;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use format::robot_file::{RobotFile, RobotFormat, RobotImportOptions};
use scene::Data;
use script::Table;
use script::log::verbosity;

/// The module `simSDF`.
pub static MODULE: Module = Module {
    about: "Robots and worlds from SDF files.",
    functions: &[("Robots and worlds", FUNCTIONS)],
    plugin_errors: true,
    ..Module::new("simSDF")
};

const FUNCTIONS: &[ApiFn] = functions![import, dump];

/// The fields of the options, with what they are without being said, and the bit of `simURDF.import` that they set; and whether it is set by true.
const FIELDS: [(&str, bool, RobotImportOptions, bool); 8] = [
    (
        "hideCollisionLinks",
        true,
        RobotImportOptions::SHOW_COLLISIONS,
        false,
    ),
    ("hideJoints", true, RobotImportOptions::SHOW_JOINTS, false),
    (
        "convexDecompose",
        true,
        RobotImportOptions::DECOMPOSE_COLLISIONS,
        true,
    ),
    (
        "createVisualIfNone",
        true,
        RobotImportOptions::CREATE_VISUALS,
        true,
    ),
    (
        "centerModel",
        true,
        RobotImportOptions::KEEP_POSITION,
        false,
    ),
    ("prepareModel", true, RobotImportOptions::NO_MODEL, false),
    (
        "noSelfCollision",
        true,
        RobotImportOptions::ALTERNATE_MASKS,
        false,
    ),
    ("positionCtrl", true, RobotImportOptions::FREE_JOINTS, false),
];

/// Adds the models of an SDF file to the scene: those of its world, or of the file itself, each as a model of its own. What is wrong in the file is logged,
/// with its line; meshes that are not found are left out.
///
/// Models of `model://` and meshes are looked for in the paths of ROS, in the folders above the file, and beside it. Files are read where permissions
/// allow it. Models of a world stay where it has them; a single model is centred on the origin and stands on the floor.
///
/// @param fileName name of the file
/// @param options fields that are true unless they are said: hideCollisionLinks, hideJoints, convexDecompose (collision meshes that are not convex),
/// createVisualIfNone, centerModel, prepareModel (as a model), noSelfCollision, positionCtrl; ignoreMissingValues and showConvexDecompositionDlg have no effect
#[api("simSDF.import")]
fn import(
    cx: &mut Cx,
    file_name: String,
    #[default(Table(Data::Nil))] options: Table,
) -> Result<()> {
    let file = read(cx, &file_name)?;
    let mut bits = import_options(&options.0)?;
    bits.set(
        RobotImportOptions::KEEP_POSITION,
        bits.contains(RobotImportOptions::KEEP_POSITION) || file.has_world(),
    );
    let imported = file.add_to(&mut cx.scene_mut(), bits)?;
    for message in &imported.messages {
        cx.env().log(
            verbosity::SCRIPT_WARNINGS,
            &format!("{}: {message}", imported.name),
        );
    }
    cx.notify_created(&imported.objects);
    Ok(())
}

/// Logs what an SDF file contains: its models with their links and joints, and what is wrong in it.
///
/// @param fileName name of the file
#[api("simSDF.dump")]
fn dump(cx: &mut Cx, file_name: String) -> Result<()> {
    for line in read(cx, &file_name)?.summary() {
        cx.env().log(verbosity::SCRIPT_INFOS, &line);
    }
    Ok(())
}

fn read(cx: &Cx, file_name: &str) -> Result<RobotFile> {
    let file = RobotFile::read_as(
        Some(RobotFormat::Sdf),
        Path::new(file_name),
        None,
        cx.permissions(),
    );
    file.map_err(|reason| ApiError::Other(format!("{file_name}: {reason}")))
}

fn import_options(fields: &Data) -> Result<RobotImportOptions> {
    let mut options = RobotImportOptions::default();
    for (name, default, option, set_by) in FIELDS {
        let value = match fields.field(name) {
            None | Some(Data::Nil) => default,
            Some(Data::Bool(value)) => *value,
            Some(_) => return Err(ApiError::Other(format!("field '{name}' must be a bool"))),
        };
        options.set(option, value == set_by);
    }
    Ok(options)
}
