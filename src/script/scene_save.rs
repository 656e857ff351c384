//! The scene and models out of it, as files.

use std::path::Path;
use std::rc::Rc;

use super::callback::SysCall;
use super::error::ApiResult;
use super::sim::Sim;
use crate::format::scene_file::{LoadedScript, save, write_whole};
use crate::scene::script_object::ScriptType;
use crate::scene::{Data, Handle};

/// Priorities of scripts count from 0 here, in files around 0.
const NORMAL_PRIORITY: i64 = 1;

impl Sim {
    /// The scene as the bytes of a `.ttt` file.
    ///
    /// # Errors
    /// When the tree of the scene is damaged.
    pub(crate) fn scene_bytes(&self) -> ApiResult<Vec<u8>> {
        let scripts = self.scripts_to_save();
        Ok(save::scene(&self.scene.borrow(), &scripts)?.write())
    }

    /// The model below `base` as the bytes of a `.ttm` file.
    ///
    /// # Errors
    /// When there is no such object.
    pub(crate) fn model_bytes(&self, base: Handle) -> ApiResult<Vec<u8>> {
        let scripts = self.scripts_to_save();
        Ok(save::model(&self.scene.borrow(), base, &scripts)?.write())
    }

    /// Writes the scene to a file, which becomes the scene's. Scripts are told before and after.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn save_scene(self: &Rc<Self>, path: &str) -> ApiResult<()> {
        let info = Data::map([("file", Data::text(path)), ("regularSave", true.into())]);
        self.broadcast(SysCall::BeforeSave, std::slice::from_ref(&info));
        let bytes = self.scene_bytes()?;
        write_whole(Path::new(path), &bytes)
            .map_err(|error| super::ApiError::Other(format!("'{path}' could not be written: {error}.")))?;
        let path = std::path::absolute(path).map_or_else(|_| path.to_owned(), |p| p.to_string_lossy().into_owned());
        self.scene.borrow_mut().modify_settings(|settings| settings.path = path);
        self.broadcast(SysCall::AfterSave, &[info]);
        Ok(())
    }

    /// The scripts outside of the tree: those attached to objects, and a main script of the scene's own.
    fn scripts_to_save(&self) -> Vec<LoadedScript> {
        let usual_main = self.registry.modules["main"].source.as_bytes();
        let scripts = self.scripts.borrow();
        let saved = scripts.values().filter(|script| script.object.is_none()).filter_map(|script| {
            let detached = script.detached.borrow();
            let own_main = script.script_type == ScriptType::Main && detached.code != usual_main;
            (own_main || detached.owner.is_some()).then(|| LoadedScript {
                script_type: script.script_type,
                owner: detached.owner,
                code: detached.code.clone(),
                language: detached.language().to_owned(),
                disabled: detached.disabled,
                exec_order: detached.priority - NORMAL_PRIORITY,
            })
        });
        saved.collect()
    }
}
