//! Name, text and flags of a script: the scene holds those of script objects, a detached script its own.

use crate::host::{Script, Sim};
use scene::Scene;
use scene::object::script_object::{ScriptObject, ScriptType};

/// A file as Lua shows it in positions: as it is, without quotes.
fn file_name(path: &str) -> String {
    format!("@{path}")
}

impl Sim {
    /// Name in the log, language and text of a script.
    pub fn text_of(&self, script: &Script) -> (String, String, Vec<u8>) {
        let scene = self.scene.borrow();
        (
            script.log_name(&scene),
            script.language(&scene),
            script.code(&scene).0,
        )
    }
}

impl Script {
    /// The name in the log.
    pub(crate) fn log_name(&self, scene: &Scene) -> String {
        let path = |handle| scene.print_path(handle).unwrap_or_default();
        match (self.object, self.owner()) {
            (Some(handle), _) => path(handle),
            (None, Some(owner)) => path(owner) + log_suffix(self.script_type),
            (None, None) => self.detached.borrow().name.clone(),
        }
    }

    /// The text, and the name Lua shows for it in positions.
    pub(crate) fn code(&self, scene: &Scene) -> (Vec<u8>, String) {
        if let Some(object) = self.script_object(scene) {
            let name = object.source.as_deref().map(file_name);
            return (
                object.code.clone(),
                name.unwrap_or_else(|| self.log_name(scene)),
            );
        }
        let detached = self.detached.borrow();
        let name = match &detached.source {
            Some(file) => file_name(file),
            None if detached.owner.is_some() => self.log_name(scene),
            None => detached.chunk_name.clone(),
        };
        (detached.code.clone(), name)
    }

    /// `lua` or `python`.
    pub(crate) fn language(&self, scene: &Scene) -> String {
        match self.object {
            Some(_) => self
                .script_object(scene)
                .map(|object| object.language.clone())
                .unwrap_or_default(),
            None => self.detached.borrow().language().to_owned(),
        }
    }

    /// A script whose object is gone counts as disabled.
    pub(crate) fn is_disabled(&self, scene: &Scene) -> bool {
        match self.object {
            Some(_) => self
                .script_object(scene)
                .is_none_or(|object| object.disabled),
            None => self.detached.borrow().disabled,
        }
    }

    fn script_object<'a>(&self, scene: &'a Scene) -> Option<&'a ScriptObject> {
        scene.object(self.object?).ok()?.script().ok()
    }
}

/// The part after the object's path in the name of an attached script.
pub(crate) fn log_suffix(script_type: ScriptType) -> &'static str {
    if script_type == ScriptType::Customization {
        "@customizationScript"
    } else {
        "@simulationScript"
    }
}
