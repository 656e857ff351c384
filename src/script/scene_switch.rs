//! Putting another scene in the place of the present one.

use std::rc::Rc;

use super::callback::SysCall;
use super::error::{ApiError, ApiResult};
use super::instance::Script;
use super::sim::Sim;
use crate::scene::script_object::{ScriptObject, ScriptType};
use crate::scene::{Edit, Kept, Kind, Namespace, Settings};

impl Sim {
    /// Puts the default scene in place of the present one on behalf of `caller`, and adds the script in `file`, path and code, if there is
    /// one.
    ///
    /// # Errors
    /// When the simulation is not stopped, or the caller is a script of the scene: it would remove itself while running.
    pub(crate) fn switch_scene(self: &Rc<Self>, caller: &Script, file: Option<(String, Vec<u8>)>) -> ApiResult<()> {
        if !self.is_stopped() {
            return Err(ApiError::Other("simulation is not stopped.".into()));
        }
        if caller.object.is_some() {
            return Err(ApiError::Other("a script of the scene cannot replace the scene: use an add-on.".into()));
        }
        self.broadcast(SysCall::BeforeInstanceSwitch, &[]);
        self.clear_scene()?;
        self.scene.borrow_mut().add_default_objects()?;
        if let Some((path, code)) = file {
            self.scene.borrow_mut().modify_settings(|settings| settings.path = path);
            self.add_scene_script(code)?;
        }
        self.note_new_scene();
        self.broadcast(SysCall::AfterInstanceSwitch, &[]);
        Ok(())
    }

    fn clear_scene(self: &Rc<Self>) -> ApiResult<()> {
        let everything: Vec<_> = self.scene.borrow().objects().map(crate::scene::Object::handle).collect();
        if !everything.is_empty() {
            self.remove_objects(&everything)?;
        }
        self.app.borrow_mut().closed_scenes += 1;
        let mut scene = self.scene.borrow_mut();
        scene.kept = Kept::default();
        scene.modify_settings(|settings| *settings = Settings::default());
        for namespace in [Namespace::CustomData, Namespace::Signal] {
            scene.edit_named_values(None, namespace, Edit::Clear)?;
        }
        Ok(())
    }

    /// A Lua file as a scene is a customization script, as on the command line.
    fn add_scene_script(self: &Rc<Self>, code: Vec<u8>) -> ApiResult<()> {
        let script = ScriptObject::new(ScriptType::Customization, code, "lua", false);
        let handle = self.scene.borrow_mut().add("Script", Kind::Script(Box::new(script)))?;
        let script = self.script(handle.raw()).ok_or(ApiError::NoSuchScript)?;
        self.init_script(&script);
        Ok(())
    }
}
