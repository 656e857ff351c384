//! Scenes from files.

use std::path::{Path, PathBuf};

use super::{Error, ScriptKind, Simulator};
use format::scene_input::SceneInput;
use permissions::Permissions;

impl Simulator {
    /// Fills the empty scene from a file, as `swanilda run` does: a scene of CoppeliaSim, a folder made by `unpack`, or a model or script
    /// in the default scene. A Lua file becomes a script of type `kind`; its errors are logged and counted.
    ///
    /// # Errors
    /// When it cannot be read, or there is no room for it.
    pub fn open(&mut self, path: &Path, kind: ScriptKind) -> Result<(), Error> {
        let input = SceneInput::read(path, &Permissions::all()).map_err(Error::Unreadable)?;
        let absolute = std::path::absolute(path)
            .unwrap_or_else(|_| path.to_owned())
            .to_string_lossy()
            .into_owned();
        match input {
            SceneInput::Script(code) => {
                self.add_default_objects()?;
                self.scene_mut()
                    .modify_settings(|settings| settings.path.clone_from(&absolute));
                let name = path
                    .file_stem()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                self.add_script_of_file(kind, &name, &code, Some(path))?;
            }
            SceneInput::File(file) => {
                let unreadable =
                    |error| Error::Unreadable(format!("cannot read {}: {error}", path.display()));
                let file = file.scene().map_err(unreadable)?;
                if file.is_model() {
                    self.add_default_objects()?;
                }
                self.load(file)?;
            }
        }
        self.scene_mut()
            .modify_settings(|settings| settings.path.clone_from(&absolute));
        Ok(())
    }

    /// The folder of a scene, where its scripts find their modules: for `Options::package_dirs`.
    pub fn folder_of_scene(scene: &Path) -> PathBuf {
        match scene.parent() {
            Some(folder) if folder != Path::new("") => folder.to_owned(),
            _ => PathBuf::from("."),
        }
    }

    /// Adds the objects of the default scene: floor, camera, lights.
    ///
    /// # Errors
    /// When there is no room for them.
    pub fn add_default_objects(&mut self) -> Result<(), Error> {
        self.scene_mut()
            .add_default_objects()
            .map_err(|error| Error::Api(error.into()))?;
        Ok(())
    }
}
