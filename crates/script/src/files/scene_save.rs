//! Saving the scene, and models of it.

use std::path::Path;
use std::rc::Rc;

use crate::error::{ApiError, ApiResult};
use crate::host::Sim;
use crate::sys_call::SysCall;
use c_interface::Moment;
use format::scene_file::{LoadedScript, SceneFile, save, write_whole};
use format::ttt::File;
use format::xml::{self, Variant};
use scene::object::script_object::ScriptType;
use scene::{Data, Handle, SceneError};

impl Sim {
    /// The scene as a file in memory. Scripts are notified before and after.
    ///
    /// # Errors
    /// When the scene is locked, or its tree is damaged.
    pub(crate) fn scene_in_memory(self: &Rc<Self>) -> ApiResult<File> {
        self.check_unlocked()?;
        let info = Data::map([("file", Data::text("")), ("regularSave", true.into())]);
        self.broadcast(SysCall::BeforeSave, std::slice::from_ref(&info));
        let file = self.scene_file()?;
        self.broadcast(SysCall::AfterSave, &[info]);
        Ok(file)
    }

    /// The scene as a file.
    ///
    /// # Errors
    /// When the scene is locked, or its tree is damaged.
    fn scene_file(&self) -> ApiResult<File> {
        self.check_unlocked()?;
        let scripts = self.scripts_to_save();
        Ok(save::scene(&self.scene.borrow(), &scripts)?)
    }

    /// The model below `base` as a file, which is a copy: scripts are notified before and after.
    ///
    /// # Errors
    /// When there is no such object.
    pub(crate) fn model_file(self: &Rc<Self>, base: Handle) -> ApiResult<File> {
        let members = self.scene.borrow().subtree(base);
        self.with_copy_callbacks(&members, || {
            let scripts = self.scripts_to_save();
            Ok(save::model(&self.scene.borrow(), base, &scripts)?)
        })
    }

    /// Writes the scene to a file in the format of its name, which becomes the scene's. Scripts are notified before and after.
    ///
    /// # Errors
    /// When the scene is locked, or the file cannot be written.
    pub(crate) fn save_scene(self: &Rc<Self>, name: &str) -> ApiResult<()> {
        self.check_unlocked()?;
        let (_, path) = Variant::of_name(name);
        self.options.permissions.check_write(Path::new(path))?;
        let info = Data::map([("file", Data::text(path)), ("regularSave", true.into())]);
        self.broadcast(SysCall::BeforeSave, std::slice::from_ref(&info));
        self.write_named(&self.scene_file()?, name)?;
        let path = self
            .options
            .permissions
            .absolute(Path::new(path))
            .map_or_else(|_| path.to_owned(), |p| p.to_string_lossy().into_owned());
        self.scene
            .borrow_mut()
            .modify_settings(|settings| settings.path = path);
        self.broadcast(SysCall::AfterSave, &[info]);
        self.notify_plugins(Moment::SceneSaved, [0; 4]);
        Ok(())
    }

    /// Writes a model to a file in the format of its name.
    ///
    /// # Errors
    /// When the file may not or cannot be written, or could not be loaded again.
    pub(crate) fn save_model(self: &Rc<Self>, model: &File, name: &str) -> ApiResult<()> {
        self.write_named(model, name)?;
        self.notify_plugins(Moment::ModelSaved, [0; 4]);
        Ok(())
    }

    /// Writes a file in the format of its name: XML where it ends so, in the simple variant with `@simpleXml` behind it.
    ///
    /// # Errors
    /// When the file may not or cannot be written, or could not be loaded again. A file of that name is as it was then.
    fn write_named(&self, file: &File, name: &str) -> ApiResult<()> {
        let (variant, path) = Variant::of_name(name);
        self.options.permissions.check_write(Path::new(path))?;
        let bytes = readable_bytes(file, variant)?;
        let place = Path::new(path);
        let written = self
            .options
            .permissions
            .write(place, || write_whole(place, &bytes));
        written.map_err(|error| ApiError::Other(format!("'{path}' could not be written: {error}.")))
    }

    fn check_unlocked(&self) -> ApiResult<()> {
        if self.scene.borrow().settings().locked {
            Err(SceneError::Locked.into())
        } else {
            Ok(())
        }
    }

    /// The scripts outside of the tree: those attached to objects, and a main script of the scene's own.
    fn scripts_to_save(&self) -> Vec<LoadedScript> {
        let usual_main = self.modules.registry.main_script().as_bytes();
        let saved = self
            .scripts
            .all_detached()
            .into_iter()
            .filter_map(|script| {
                let detached = script.detached.borrow();
                let own_main =
                    script.script_type == ScriptType::Main && detached.code != usual_main;
                (own_main || detached.owner.is_some()).then(|| LoadedScript {
                    script_type: script.script_type,
                    owner: detached.owner,
                    code: detached.code.clone(),
                    language: detached.language().to_owned(),
                    disabled: detached.disabled,
                    source: None,
                    exec_order: detached.priority.order(),
                })
            });
        saved.collect()
    }
}

/// The bytes of a file, binary or XML, once they were read back: what cannot be loaded again must not replace what can.
///
/// # Errors
/// When they cannot be read.
pub fn readable_bytes(file: &File, variant: Option<Variant>) -> ApiResult<Vec<u8>> {
    let bytes = variant.map_or_else(
        || file.write(),
        |variant| xml::write(file, variant).into_bytes(),
    );
    match SceneFile::read(&bytes) {
        Ok(_) => Ok(bytes),
        Err(error) => Err(ApiError::Other(format!(
            "not saved, since it could not be loaded again: {error}"
        ))),
    }
}
