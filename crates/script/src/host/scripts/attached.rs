//! Scripts of objects: script objects (since 4.7), and attached scripts of older scenes.

use std::rc::Rc;

use super::instance::{Detached, Script};
use crate::sim::Sim;
use scene::object::script_object::{ExecutionPriority, ScriptObject, ScriptType};
use scene::{Handle, Scene};

impl Sim {
    /// Attaches a script to an object, as scenes before 4.7 have it.
    pub(crate) fn attach_script(
        &self,
        owner: Handle,
        script: &ScriptObject,
        exec_order: i64,
    ) -> Rc<Script> {
        self.scripts.add_detached(
            script.script_type,
            Detached {
                code: script.code.clone(),
                language: script.language.clone(),
                disabled: script.disabled,
                priority: ExecutionPriority::from_order(exec_order),
                owner: Some(owner),
                source: script.source.clone(),
                ..Detached::default()
            },
        )
    }

    /// A new script without an object; returns its handle.
    pub(crate) fn add_script_without_object(&self, script_type: ScriptType) -> i64 {
        let detached = Detached {
            priority: ExecutionPriority::Normal,
            ..Detached::default()
        };
        self.scripts.add_detached(script_type, detached).id
    }

    /// Attaches a script that is no object to an object, or to none.
    pub(crate) fn reattach_script(&self, script: &Script, owner: Option<Handle>) {
        script.detached.borrow_mut().owner = owner;
        self.scripts.note_attached();
    }

    /// The scripts of an object: those attached to it, simulation scripts first, then those among its children by priority.
    pub(crate) fn scripts_of_object(&self, object: Handle) -> Vec<Rc<Script>> {
        let children = script_children(&self.scene.borrow(), object);
        let mut scripts = self.scripts.attached_to(object);
        scripts.extend(
            children
                .into_iter()
                .filter_map(|handle| self.script(handle.raw())),
        );
        scripts
    }

    /// The scripts a sensor calls: old ones before script objects, in each simulation scripts before customization scripts.
    pub(crate) fn sensor_scripts(&self, sensor: Handle) -> Vec<Rc<Script>> {
        let mut scripts = self.scripts_of_object(sensor);
        scripts.retain(|script| {
            matches!(
                script.script_type,
                ScriptType::Simulation | ScriptType::Customization
            )
        });
        scripts.sort_by_key(|script| {
            (
                script.object.is_some(),
                script.script_type != ScriptType::Simulation,
            )
        });
        scripts
    }

    /// The script that Lua calls `name` in positions, under its full name, and its text. Lua cuts long names and ends them with dots.
    pub fn code_shown_as(&self, name: &str) -> Option<(String, Vec<u8>)> {
        let start = name.strip_suffix("...").filter(|start| !start.is_empty());
        let scripts = self.scripts.all();
        let found = scripts
            .iter()
            .map(|script| script.code(&self.scene.borrow()));
        let mut named = found
            .filter(|(_, full)| full == name || start.is_some_and(|start| full.starts_with(start)));
        named.next().map(|(code, full)| (full, code))
    }

    /// Attaches to a copy what is attached to its original.
    pub(crate) fn copy_attached(&self, original: Handle, copy: Handle) {
        for script in self.scripts.attached_to(original) {
            let detached = Detached {
                owner: Some(copy),
                ..script.detached.borrow().clone()
            };
            self.scripts.add_detached(script.script_type, detached);
        }
    }
}

/// The scripts among the children of an object, by priority.
fn script_children(scene: &Scene, object: Handle) -> Vec<Handle> {
    let children = scene
        .object(object)
        .map(|o| o.children().to_vec())
        .unwrap_or_default();
    let mut scripts: Vec<_> = children
        .into_iter()
        .filter_map(|h| scene.object(h).ok())
        .filter(|o| o.script().is_ok())
        .collect();
    scripts.sort_by_key(|object| object.priority);
    scripts.into_iter().map(scene::Object::handle).collect()
}
