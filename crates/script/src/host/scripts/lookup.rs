//! Finding scripts by type and by object (spec: calls 2).

use crate::error::{ApiError, ApiResult};
use crate::host::Sim;
use scene::object::script_object::ScriptType;
use scene::{Handle, Object};

impl Sim {
    /// The script of that type attached to an object: the first of its children by priority, else the object itself.
    pub(crate) fn script_attached_to(
        &self,
        object: Handle,
        script_type: ScriptType,
    ) -> Option<i64> {
        let scripts = self
            .scripts_of_object(object)
            .into_iter()
            .chain(self.script(object.raw()));
        scripts
            .into_iter()
            .find(|script| script.script_type == script_type)
            .map(|script| script.id)
    }

    /// The script of that type and name: a path for scene scripts, the display name for add-ons, nothing for main and sandbox.
    ///
    /// # Errors
    /// When there is none.
    pub(crate) fn script_by_name(&self, script_type: ScriptType, name: &str) -> ApiResult<i64> {
        let found = match script_type {
            ScriptType::Main | ScriptType::Sandbox => {
                self.scripts.detached(script_type).map(|script| script.id)
            }
            ScriptType::AddOn => self
                .scripts
                .add_on(name)
                .map(|script| script.id)
                .or_else(|| self.add_on_object(name)),
            ScriptType::Simulation | ScriptType::Customization | ScriptType::Passive => {
                let object = self.object_by_name(name).ok_or(ApiError::NoSuchScript)?;
                self.script_attached_to(object, script_type)
            }
        };
        found.ok_or(ApiError::NoSuchScript)
    }

    /// The add-on that a script or program has made as an object, by its alias.
    fn add_on_object(&self, alias: &str) -> Option<i64> {
        let scene = self.scene.borrow();
        let is_it = |object: &&Object| {
            let is_add_on = object
                .script()
                .is_ok_and(|script| script.script_type == ScriptType::AddOn);
            is_add_on && object.alias() == alias
        };
        let found = scene.objects().find(is_it)?;
        Some(found.handle().raw())
    }

    /// The object at a path or with an old-style name.
    fn object_by_name(&self, name: &str) -> Option<Handle> {
        let scene = self.scene.borrow();
        match name.starts_with(['/', '.', ':']) {
            true => scene.find(name, None, None).ok(),
            false => scene.find_old_name(name).ok(),
        }
    }
}
