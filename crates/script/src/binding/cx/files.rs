//! Scenes and models as files.

use std::rc::Rc;

use super::Cx;
use crate::format::scene_file::SceneFile;
use crate::format::ttt::File;
use crate::scene::Handle;
use crate::script::error::ApiResult;
use crate::script::files::scene_switch::SceneSource;

impl Cx<'_> {
    /// The scene as a file.
    ///
    /// # Errors
    /// When the scene is locked, or its tree is damaged.
    pub(crate) fn scene_file(&self) -> ApiResult<File> {
        self.sim.scene_file()
    }

    /// The model below `base` as a file.
    ///
    /// # Errors
    /// When there is no such object.
    pub(crate) fn model_file(&self, base: Handle) -> ApiResult<File> {
        self.sim.model_file(base)
    }

    /// Writes the scene to a file, which becomes the scene's. Scripts are notified before and after.
    ///
    /// # Errors
    /// When the scene is locked, or the file cannot be written.
    pub(crate) fn save_scene(&mut self, name: &str) -> ApiResult<()> {
        self.sim.save_scene(name)
    }

    /// Writes a model to a file in the format of its name: XML where it ends so, in the simple variant with `@simpleXml` behind it.
    ///
    /// # Errors
    /// When the file may not or cannot be written.
    pub(crate) fn save_model(&mut self, model: &File, name: &str) -> ApiResult<()> {
        self.sim.save_model(model, name)
    }

    /// Replaces the scene on behalf of the calling script. With a file, its path becomes that of the scene.
    ///
    /// # Errors
    /// While a simulation runs; from a script that is part of the scene; when the file is damaged.
    pub(crate) fn switch_scene(&mut self, source: SceneSource, path: Option<String>) -> ApiResult<()> {
        let caller = Rc::clone(self.script());
        self.sim.switch_scene(&caller, source, path)
    }

    /// Adds a model to the scene; its base, or nothing where the file is empty.
    ///
    /// # Errors
    /// When the scene is full.
    pub(crate) fn load_model(&mut self, file: SceneFile) -> ApiResult<Option<Handle>> {
        self.sim.load_model_file(file)
    }
}
