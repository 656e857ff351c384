//! Scripts of objects: script objects (since 4.7), and attached scripts of older scenes.

use std::rc::Rc;

use crate::host::{Script, Sim};
use scene::object::script_object::ScriptType;
use scene::{Handle, Scene};

impl Sim {
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
