//! `swanilda convert`: scenes, models and robots from one format to another.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::setup::bases;
use super::{Outcome, files, unpack};
use format::gltf_file::GltfFile;
use format::robot_file::{RobotExportOptions, RobotFile, export};
use format::scene_file::{SceneFile, write_whole};
use format::scene_folder;
use format::ttt::File;
use scene::{Handle, Scene};

/// Convert a scene, a model or a robot to another format
#[derive(clap::Args)]
pub(super) struct Args {
    /// A .ttt, .ttm, .urdf, .sdf, .glb or .gltf file, MJCF, XML, a folder made by unpack, or a .lua or .py file that builds a scene when it is loaded
    from: PathBuf,
    /// Output: .ttt, .ttm, .urdf, .glb, .gltf, .simscene.xml or .simmodel.xml (append @simpleXml for the simple XML variant); a name without ending becomes a folder
    to: PathBuf,
    /// Hold the base of a robot in URDF, SDF or MJCF in place
    #[arg(long)]
    fix_base: bool,
    /// Replace files of a folder that were changed since it was unpacked
    #[arg(long)]
    force: bool,
}

pub(super) fn convert(args: &Args) -> Outcome {
    let file = files::file_with(&args.from, bases(args.fix_base))?;
    match args.to.extension() {
        Some(_) if RobotFile::has_name_of_urdf(&args.to) => write_robot(file, &args.to)?,
        Some(_) if GltfFile::has_name_of(&args.to) => write_gltf(file, &args.to)?,
        Some(_) => unpack::write(file, &args.to)?,
        None => scene_folder::unpack(&file, &args.to, unpack::edits(args.force))?,
    }
    Ok(ExitCode::SUCCESS)
}

fn write_gltf(file: File, path: &Path) -> Result<(), String> {
    let reason =
        |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let mut scene = Scene::new();
    let file = SceneFile::new(file).map_err(|error| reason(&error))?;
    file.add_to(&mut scene, false)
        .map_err(|error| reason(&error))?;
    let file = GltfFile::of_scene(&scene).map_err(|error| reason(&error))?;
    file.write(path).map_err(|error| reason(&error))
}

fn write_robot(file: File, path: &Path) -> Result<(), String> {
    let reason =
        |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let file = SceneFile::new(file).map_err(|error| reason(&error))?;
    let mut scene = Scene::new();
    let loaded = file
        .add_to(&mut scene, false)
        .map_err(|error| reason(&error))?;
    let base = match loaded.root {
        Some(root) => root,
        None => only_model(&scene).map_err(|error| reason(&error))?,
    };
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    for file in export(&scene, base, &stem, RobotExportOptions::default())
        .map_err(|error| reason(&error))?
    {
        let path = path.with_file_name(&file.name);
        write_whole(&path, &file.bytes)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    Ok(())
}

/// A URDF file has one robot: the model of a scene that has joints.
fn only_model(scene: &Scene) -> Result<Handle, String> {
    let has_joints = |base: &Handle| {
        scene
            .subtree(*base)
            .iter()
            .any(|handle| is_joint(scene, *handle))
    };
    let models = scene
        .objects()
        .filter(|object| object.is_model() && object.parent().is_none())
        .map(|object| object.handle());
    match models.filter(has_joints).collect::<Vec<_>>().as_slice() {
        [model] => Ok(*model),
        models => Err(format!(
            "a URDF file has one robot, and the scene has {} models with joints",
            models.len()
        )),
    }
}

fn is_joint(scene: &Scene, handle: Handle) -> bool {
    scene
        .object(handle)
        .is_ok_and(|object| object.joint().is_ok())
}
