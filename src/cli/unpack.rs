//! `swanilda unpack` and `swanilda pack`: scenes as folders for version control, and back.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::{Outcome, files};
use format::scene_file::{SceneFile, save, write_whole};
use format::scene_folder::{self, Edits};
use format::ttt::File;
use format::xml::{self, Variant};
use scene::Scene;
use script::readable_bytes;

/// Unpack a scene or model into a folder: tree as JSON, scripts as Lua files, meshes as OBJ files
#[derive(clap::Args)]
pub(super) struct UnpackArgs {
    /// A .ttt or .ttm file, or XML
    file: PathBuf,
    /// New or empty folder, or one that was unpacked before
    folder: PathBuf,
    /// Replace files of the folder that were changed since it was unpacked
    #[arg(long)]
    force: bool,
}

/// Create a scene or model file from a folder made by unpack
#[derive(clap::Args)]
pub(super) struct PackArgs {
    /// A folder made by unpack, or a file
    folder: PathBuf,
    /// Output file: .ttt, .ttm, .simscene.xml or .simmodel.xml; append @simpleXml for the simple XML variant
    file: PathBuf,
}

pub(super) fn unpack(args: &UnpackArgs) -> Outcome {
    scene_folder::unpack(&files::file(&args.file)?, &args.folder, edits(args.force))?;
    Ok(ExitCode::SUCCESS)
}

pub(super) fn pack(args: &PackArgs) -> Outcome {
    write(files::file(&args.folder)?, &args.file)?;
    if scene_folder::is_scene(&args.folder) {
        // What is packed is not lost when the folder is unpacked again. Without the note, in a folder that cannot be written, unpacking asks for --force.
        let _ = scene_folder::note(&args.folder);
    }
    Ok(ExitCode::SUCCESS)
}

/// What `--force` means.
pub(super) fn edits(are_discarded: bool) -> Edits {
    if are_discarded {
        Edits::Discard
    } else {
        Edits::Keep
    }
}

/// Writes a scene or model; the ending of the name says in which format.
pub(super) fn write(file: File, path: &Path) -> Result<(), String> {
    let (variant, name) = Variant::of_name(path.to_str().unwrap_or_default());
    let (path, bytes) = match variant {
        Some(variant) => (
            Path::new(name),
            xml::write(&as_saved(file)?, variant).into_bytes(),
        ),
        None => (
            path,
            readable_bytes(&file, None).map_err(|error| error.to_string())?,
        ),
    };
    write_whole(path, &bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

/// XML has elements for what CoppeliaSim saves today, not for data of older versions.
fn as_saved(file: File) -> Result<File, String> {
    let damaged = |error: &dyn std::fmt::Display| format!("cannot write XML: {error}");
    let file = SceneFile::new(file).map_err(|error| damaged(&error))?;
    let is_model = file.is_model();
    let mut scene = Scene::new();
    let loaded = file
        .add_to(&mut scene, !is_model)
        .map_err(|error| damaged(&error))?;
    let saved = match loaded.root.filter(|_| is_model) {
        Some(base) => save::model(&scene, base, &loaded.scripts),
        None => save::scene(&scene, &loaded.scripts),
    };
    saved.map_err(|error| damaged(&error))
}
