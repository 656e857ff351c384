//! Scenes and models as files.

use std::rc::Rc;

use super::Cx;
use crate::error::ApiResult;
use crate::files::scene_switch::SceneSource;
use format::scene_file::SceneFile;
use format::ttt::File;
use scene::Handle;

impl Cx<'_> {
    /// The scene as a file in memory. Scripts are notified before and after.
    ///
    /// # Errors
    /// When the scene is locked, or its tree is damaged.
    pub fn scene_in_memory(&mut self) -> ApiResult<File> {
        self.sim.scene_in_memory()
    }

    /// The model below `base` as a file. Scripts are notified of the copy before and after.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn model_file(&mut self, base: Handle) -> ApiResult<File> {
        self.sim.model_file(base)
    }

    /// Writes the scene to a file, which becomes the scene's. Scripts are notified before and after.
    ///
    /// # Errors
    /// When the scene is locked, or the file cannot be written.
    pub fn save_scene(&mut self, name: &str) -> ApiResult<()> {
        self.sim.save_scene(name)
    }

    /// Writes a model to a file in the format of its name: XML where it ends so, in the simple variant with `@simpleXml` behind it.
    ///
    /// # Errors
    /// When the file may not or cannot be written.
    pub fn save_model(&mut self, model: &File, name: &str) -> ApiResult<()> {
        self.sim.save_model(model, name)
    }

    /// Replaces the scene on behalf of the calling script. With a file, its path becomes that of the scene.
    ///
    /// # Errors
    /// While a simulation runs; from a script that is part of the scene; when the file is damaged.
    pub fn switch_scene(&mut self, source: SceneSource, path: Option<String>) -> ApiResult<()> {
        let caller = Rc::clone(self.script());
        self.sim.switch_scene(&caller, source, path)
    }

    /// Adds a model to the scene; its base, or nothing where the file is empty.
    ///
    /// # Errors
    /// When the scene is full.
    pub fn load_model(&mut self, file: SceneFile) -> ApiResult<Option<Handle>> {
        self.sim.load_model_file(file)
    }
}
