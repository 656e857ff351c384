//! Scenes and models of the command line: files, robots in URDF, glTF files, and folders made by `unpack`.

use std::path::Path;

use super::complain;
use format::gltf_file::GltfFile;
use format::robot_file::RobotFile;
use format::scene_file::{self, SceneFile};
use format::scene_folder;
use format::script_file;
use format::ttt::File;
use permissions::Permissions;

/// # Errors
/// When it cannot be read; in words, with the path.
pub(super) fn file(path: &Path) -> Result<File, String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    if scene_folder::is_scene(path) {
        return scene_folder::pack(path, &Permissions::all()).map_err(unreadable);
    }
    let model = if RobotFile::is_one(path, &Permissions::all()) {
        Some(RobotFile::read(path, &Permissions::all()).and_then(RobotFile::model))
    } else {
        let is_gltf = GltfFile::has_name_of(path);
        is_gltf.then(|| GltfFile::open(path, &Permissions::all()).and_then(|file| file.model(path)))
    };
    if let Some(model) = model {
        let (file, messages) = model.map_err(unreadable)?;
        messages
            .iter()
            .for_each(|message| complain(&format!("{}: {message}", path.display())));
        return Ok(file);
    }
    script_file::check_no_xacro(path).map_err(|reason| unreadable(reason.to_string()))?;
    scene_file::read_path(path).map_err(unreadable)
}

/// # Errors
/// When it cannot be read, or its geometry is damaged.
pub(super) fn scene(path: &Path) -> Result<SceneFile, String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    let scene = SceneFile::new(file(path)?).map_err(|error| unreadable(error.to_string()))?;
    if !scene_folder::is_scene(path) {
        return Ok(scene);
    }
    Ok(scene.with_sources(scene_folder::sources(path, &Permissions::all()).map_err(unreadable)?))
}
