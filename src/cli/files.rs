//! Scenes and models of the command line: files, robots in URDF, glTF files, folders made by `unpack`, and scripts that build a scene.

use std::path::Path;

use super::{built, complain};
use format::scene_file::SceneFile;
use format::scene_input::{Bases, InputFile, SceneInput};
use format::ttt::File;
use permissions::Permissions;

/// # Errors
/// When it cannot be read or built; in words, with the path.
pub(super) fn file(path: &Path) -> Result<File, String> {
    file_with(path, Bases::AsDescribed)
}

/// The same, with the bases of a robot's description held if they are to be.
///
/// # Errors
/// As [`file`], and when bases are to be held of what is no description of a robot.
pub(super) fn file_with(path: &Path, bases: Bases) -> Result<File, String> {
    Ok(input(path, bases)?.into_file())
}

/// # Errors
/// When it cannot be read or built, or its geometry is damaged.
pub(super) fn scene(path: &Path) -> Result<SceneFile, String> {
    input(path, Bases::AsDescribed)?
        .scene()
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn input(path: &Path, bases: Bases) -> Result<InputFile, String> {
    match SceneInput::read_with(path, bases, &Permissions::all())? {
        SceneInput::File(file) => {
            file.messages()
                .iter()
                .for_each(|message| complain(&format!("{}: {message}", path.display())));
            Ok(*file)
        }
        SceneInput::Script(code) => built::scene_of(path, &code).map(InputFile::made),
    }
}
