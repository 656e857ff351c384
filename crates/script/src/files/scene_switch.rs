//! Loading a scene in place of the present one, and loading models.

use std::rc::Rc;

use crate::error::{ApiError, ApiResult};
use crate::host::{Script, Sim};
use crate::log::verbosity;
use crate::sys_call::SysCall;
use c_interface::Moment;
use format::scene_file::{Loaded, LoadedScript, SceneFile};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::{Edit, Handle, InertValues, Kind, Namespace, Settings};

/// The source of a scene.
pub enum SceneSource {
    /// The default scene.
    Default,
    /// The text of a customization script of the default scene.
    Script {
        /// The text.
        code: Vec<u8>,
        /// The file of a text in Python, whose errors name it and whose imports are beside it.
        python_file: Option<String>,
    },
    /// A scene of CoppeliaSim.
    File(Box<SceneFile>),
}

impl Sim {
    /// Replaces the scene. With a file, its path becomes that of the scene.
    ///
    /// # Errors
    /// While a simulation runs; from a script that is part of the scene, which would be removed while it runs; when the file is damaged.
    pub(crate) fn switch_scene(
        self: &Rc<Self>,
        caller: &Script,
        source: SceneSource,
        path: Option<String>,
    ) -> ApiResult<()> {
        if !self.clock.is_stopped() {
            return Err(ApiError::Other("simulation is not stopped.".into()));
        }
        if caller.object.is_some()
            || caller.owner().is_some()
            || caller.script_type == ScriptType::Main
        {
            return Err(ApiError::Other(
                "a script of the scene cannot replace the scene: use an add-on.".into(),
            ));
        }
        self.broadcast(SysCall::BeforeInstanceSwitch, &[]);
        self.clear_scene()?;
        self.fill_scene(source)?;
        if let Some(path) = path {
            self.scene
                .borrow_mut()
                .modify_settings(|settings| settings.path = path);
        }
        self.note_new_scene();
        self.broadcast(SysCall::AfterInstanceSwitch, &[]);
        Ok(())
    }

    /// Fills the empty scene.
    pub fn fill_scene(self: &Rc<Self>, source: SceneSource) -> ApiResult<()> {
        match source {
            SceneSource::Default => self.scene.borrow_mut().add_default_objects()?,
            SceneSource::Script { code, python_file } => {
                self.scene.borrow_mut().add_default_objects()?;
                self.add_scene_script(code, python_file)?;
            }
            SceneSource::File(file) => {
                self.load_file(*file, true)?;
                self.notify_plugins(Moment::SceneLoaded, [0; 4]);
                self.broadcast(SysCall::AfterLoad, &[]);
            }
        }
        Ok(())
    }

    /// Adds a model to the scene; its base, or nothing where the file is empty.
    ///
    /// # Errors
    /// When the scene is full.
    pub fn load_model_file(self: &Rc<Self>, file: SceneFile) -> ApiResult<Option<Handle>> {
        let loaded = self.load_file(file, false)?;
        self.notify_created(&loaded.objects);
        self.notify_plugins(Moment::ModelLoaded, [0; 4]);
        Ok(loaded.root)
    }

    fn load_file(&self, file: SceneFile, is_scene: bool) -> ApiResult<Loaded> {
        for chunk in &file.file().skipped {
            let text = format!(
                "chunk {} of {} bytes at offset {} is unknown and was skipped.",
                chunk.path, chunk.size, chunk.offset
            );
            self.log(verbosity::INFOS, &text);
        }
        let loaded = file.add_to(&mut self.scene.borrow_mut(), is_scene)?;
        loaded
            .scripts
            .iter()
            .for_each(|script| self.add_loaded_script(script));
        Ok(loaded)
    }

    fn add_loaded_script(&self, script: &LoadedScript) {
        match (script.script_type, script.owner) {
            (ScriptType::Main, _) => {
                if let Some(main) = self.scripts.detached(ScriptType::Main) {
                    let mut main = main.detached.borrow_mut();
                    main.code.clone_from(&script.code);
                    main.language.clone_from(&script.language);
                    main.source.clone_from(&script.source);
                }
            }
            (script_type, Some(owner)) => {
                let mut object = ScriptObject::new(
                    script_type,
                    script.code.clone(),
                    &script.language,
                    script.disabled,
                );
                object.source.clone_from(&script.source);
                self.scripts.attach(owner, &object, script.exec_order);
            }
            (_, None) => {}
        }
    }

    /// Removes all objects, and forgets what belongs to a scene: settings, custom data, signals, a main script of its own.
    fn clear_scene(self: &Rc<Self>) -> ApiResult<()> {
        let everything: Vec<_> = self
            .scene
            .borrow()
            .objects()
            .map(scene::Object::handle)
            .collect();
        if !everything.is_empty() {
            self.remove_objects(&everything)?;
        }
        if let Some(main) = self.scripts.detached(ScriptType::Main) {
            let mut main = main.detached.borrow_mut();
            main.code = self.modules.registry.main_script().as_bytes().to_vec();
            main.language.clear();
            main.source = None;
        }
        self.app.borrow_mut().closed_scenes += 1;
        let mut scene = self.scene.borrow_mut();
        scene.inert = InertValues::default();
        scene.textures_mut().clear();
        *scene.collision_objects_mut() = Default::default();
        *scene.distance_objects_mut() = Default::default();
        scene.button_interfaces_mut().remove_all();
        scene.modify_settings(|settings| *settings = Settings::default());
        for namespace in [Namespace::CustomData, Namespace::Signal] {
            scene.edit_named_values(None, namespace, Edit::Clear)?;
        }
        Ok(())
    }

    fn add_scene_script(
        self: &Rc<Self>,
        code: Vec<u8>,
        python_file: Option<String>,
    ) -> ApiResult<()> {
        let language = if python_file.is_some() {
            "python"
        } else {
            "lua"
        };
        let script = ScriptObject::new(ScriptType::Customization, code, language, false);
        let handle = self
            .scene
            .borrow_mut()
            .add("Script", Kind::Script(Box::new(script)))?;
        let script = self.script(handle.raw()).ok_or(ApiError::NoSuchScript)?;
        script.file.replace(python_file);
        self.init_script(&script);
        Ok(())
    }
}
