//! A scene as users name it: a Lua file, a file of CoppeliaSim, a robot in URDF, SDF or MJCF, a glTF file, or a folder made by `unpack`.

use std::path::Path;

use super::gltf_file::GltfFile;
use super::robot_file::RobotFile;
use super::scene_file::{self, SceneFile, ScriptSources};
use super::scene_folder;
use super::script_file;
use super::ttt::{File, FileResult};
use permissions::Permissions;

/// A scene or model that has been read, from which any number of simulators can be filled.
#[derive(Debug)]
pub enum SceneInput {
    /// The text of a script.
    Script(Vec<u8>),
    /// A scene or model.
    File(Box<InputFile>),
}

/// A file of CoppeliaSim.
#[derive(Debug, Clone)]
pub struct InputFile {
    file: File,
    /// Where the texts of its scripts are, of an unpacked scene.
    sources: ScriptSources,
    messages: Vec<String>,
    is_robot: bool,
}

/// What becomes of the base of a robot that is described by URDF, SDF or MJCF.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bases {
    /// It is free, unless the description fixes it.
    #[default]
    AsDescribed,
    /// It is held in place.
    Fixed,
}

impl InputFile {
    /// A scene or model that was made, not read.
    pub fn made(file: File) -> Self {
        Self {
            file,
            sources: ScriptSources::default(),
            messages: Vec::new(),
            is_robot: false,
        }
    }

    /// The file itself.
    pub fn into_file(self) -> File {
        self.file
    }

    /// What was guessed or left out while it was read, a line each.
    pub fn messages(&self) -> &[String] {
        &self.messages
    }

    /// A copy of the file with the texts of its scripts, from which a scene can be filled.
    ///
    /// # Errors
    /// When geometry is damaged.
    pub fn scene(&self) -> FileResult<SceneFile> {
        Ok(SceneFile::new(self.file.clone())?.with_sources(self.sources.clone()))
    }
}

impl SceneInput {
    /// Reads a scene, a model, the folder of an unpacked one, a robot's description or a script.
    ///
    /// # Errors
    /// When it may not or cannot be read; in words, with the path.
    pub fn read(path: &Path, permissions: &Permissions) -> Result<Self, String> {
        Self::read_with(path, Bases::AsDescribed, permissions)
    }

    /// The same, with the bases of a robot's description held if they are to be.
    ///
    /// # Errors
    /// As [`read`](Self::read), and when bases are to be held of what is no description of a robot.
    pub fn read_with(path: &Path, bases: Bases, permissions: &Permissions) -> Result<Self, String> {
        permissions
            .check_read(path)
            .map_err(|denied| denied.to_string())?;
        let input = if permissions.is_dir(path) {
            read_folder(path, permissions)
        } else {
            read_file(path, bases, permissions)
        };
        let input = input.map_err(|reason| format!("cannot read {}: {reason}", path.display()))?;
        if bases == Bases::Fixed && !input.is_robot() {
            return Err(format!(
                "{}: only the bases of robots in URDF, SDF and MJCF can be fixed (--fix-base)",
                path.display()
            ));
        }
        Ok(input)
    }

    /// Whether it was the description of a robot: URDF, SDF or MJCF.
    pub fn is_robot(&self) -> bool {
        matches!(self, Self::File(file) if file.is_robot)
    }

    /// All it says, in one file.
    pub fn bytes(self) -> Vec<u8> {
        match self {
            Self::Script(code) => code,
            Self::File(file) => file.file.write(),
        }
    }
}

fn read_folder(path: &Path, permissions: &Permissions) -> Result<SceneInput, String> {
    if !scene_folder::is_read_as_scene(path, permissions) {
        return Err("it is a folder, and no unpacked scene: scene.json is missing".into());
    }
    let (file, sources) = (
        scene_folder::pack(path, permissions)?,
        scene_folder::sources(path, permissions)?,
    );
    Ok(SceneInput::File(Box::new(InputFile {
        file,
        sources,
        messages: Vec::new(),
        is_robot: false,
    })))
}

/// A robot becomes a model, with the default options.
fn read_robot(path: &Path, bases: Bases, permissions: &Permissions) -> Result<SceneInput, String> {
    let robot = RobotFile::read(path, permissions)?;
    let (file, messages) = match bases {
        Bases::AsDescribed => robot,
        Bases::Fixed => robot.with_fixed_bases(),
    }
    .model()?;
    Ok(model_input(file, messages, true))
}

fn model_input(file: File, messages: Vec<String>, is_robot: bool) -> SceneInput {
    SceneInput::File(Box::new(InputFile {
        file,
        sources: ScriptSources::default(),
        messages,
        is_robot,
    }))
}

fn read_file(path: &Path, bases: Bases, permissions: &Permissions) -> Result<SceneInput, String> {
    if RobotFile::is_one(path, permissions) {
        return read_robot(path, bases, permissions);
    }
    if GltfFile::has_name_of(path) {
        let (file, messages) = GltfFile::open(path, permissions)?.model(path)?;
        return Ok(model_input(file, messages, false));
    }
    let bytes = permissions
        .read_checked(path)
        .map_err(|error| error.to_string())?;
    if !scene_file::is_scene(&bytes) || script_file::check_no_xacro(path).is_err() {
        script_file::check(path, &bytes).map_err(|reason| reason.to_string())?;
        return Ok(SceneInput::Script(bytes));
    }
    let file = scene_file::read_file(&bytes, path.parent(), permissions)
        .map_err(|error| error.to_string())?;
    Ok(SceneInput::File(Box::new(InputFile::made(file))))
}
