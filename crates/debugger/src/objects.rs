//! The objects of the scene as variables: their properties and children.

use std::rc::Rc;

use scene::object::script_object::ScriptType;
use scene::{Data, Handle, Key};
use script::Sim;
use simulator::{property_rows, property_setter};

/// Longer values are cut.
const MAX_LENGTH: usize = 500;

/// A variable: a property, or another object.
#[derive(Debug, Clone)]
pub struct Entry {
    pub name: String,
    pub value: String,
    pub kind: &'static str,
    /// The handle, if it is an object.
    pub object: Option<i64>,
    /// What a script writes for it.
    pub expression: Option<String>,
    pub is_read_only: bool,
}

/// The handle of the sandbox.
pub fn sandbox(sim: &Rc<Sim>) -> i64 {
    let sandbox = sim.scripts.detached(ScriptType::Sandbox);
    sandbox.map_or(-1, |sandbox| sandbox.id)
}

/// The properties and children of an object, or the objects without a parent.
pub fn entries(sim: &Rc<Sim>, handle: Option<i64>) -> Vec<Entry> {
    sim.copied_out(|sim| entries_inside(sim, handle))
}

fn entries_inside(sim: &Rc<Sim>, handle: Option<i64>) -> Vec<Entry> {
    let Some(handle) = handle else {
        return children(sim, None);
    };
    let rows = property_rows(sim, handle).unwrap_or_default().into_iter();
    let mut entries: Vec<Entry> = rows
        .map(|row| Entry {
            value: shown(&row.value),
            kind: kind(&row.value),
            object: None,
            expression: None,
            is_read_only: !row.is_writable,
            name: row.name,
        })
        .collect();
    entries.extend(children(sim, Handle::from_raw(handle)));
    entries
}

fn children(sim: &Rc<Sim>, parent: Option<Handle>) -> Vec<Entry> {
    let Ok(scene) = sim.scene.try_borrow() else {
        return Vec::new();
    };
    let children = scene.objects().filter(|object| object.parent() == parent);
    let entries = children.map(|object| {
        let path = scene.short_path(object.handle()).unwrap_or_default();
        Entry {
            name: format!("/{}", object.alias()),
            value: format!("{path} ({})", object.handle().raw()),
            kind: "object",
            object: Some(object.handle().raw()),
            expression: Some(format!("sim.getObject('{path}')")),
            is_read_only: true,
        }
    });
    entries.collect()
}

/// Sets a property, with the function that scripts use; the new value.
///
/// # Errors
/// When there is no such property, or it refuses the value.
pub fn set_property(
    sim: &Rc<Sim>,
    handle: i64,
    name: &str,
    value: &Data,
) -> Result<String, String> {
    sim.copied_out(|sim| set_property_inside(sim, handle, name, value.clone()))
}

fn set_property_inside(
    sim: &Rc<Sim>,
    handle: i64,
    name: &str,
    value: Data,
) -> Result<String, String> {
    let sandbox = sim
        .scripts
        .detached(ScriptType::Sandbox)
        .ok_or("the simulator is gone")?;
    let target = sim
        .property_target(handle, &sandbox)
        .map_err(|error| error.to_string())?;
    let (ty, _) = sim
        .property_info(&target, name)
        .ok_or_else(|| format!("there is no property {name}"))?;
    let arguments = [Data::Int(handle), Data::text(name), value];
    sim.call_api(&sandbox, property_setter(ty), &arguments)
        .map_err(|error| error.to_string())?;
    let new = sim.read_property(&target, name, ty);
    new.map(|new| shown(&new))
        .map_err(|error| error.to_string())
}

/// A value as a script would write it.
pub fn shown(value: &Data) -> String {
    let text = written(value);
    match text.char_indices().nth(MAX_LENGTH) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

fn written(value: &Data) -> String {
    match value {
        Data::Nil => "nil".into(),
        Data::Bool(value) => value.to_string(),
        Data::Int(value) => value.to_string(),
        Data::Float(value) => value.to_string(),
        Data::Text(bytes) => format!("{:?}", String::from_utf8_lossy(bytes)),
        Data::Buffer(bytes) => format!("buffer of {} bytes", bytes.len()),
        Data::Array(items) => {
            let items: Vec<String> = items.iter().map(written).collect();
            format!("{{{}}}", items.join(", "))
        }
        Data::Map(entries) => {
            let entries = entries.iter();
            let entries: Vec<String> = entries
                .map(|(key, value)| format!("{} = {}", key_name(key), written(value)))
                .collect();
            format!("{{{}}}", entries.join(", "))
        }
    }
}

fn key_name(key: &Key) -> String {
    match key {
        Key::Bool(key) => format!("[{key}]"),
        Key::Int(key) => format!("[{key}]"),
        Key::Float(key) => format!("[{key}]"),
        Key::Text(key) => String::from_utf8_lossy(key).into_owned(),
    }
}

fn kind(value: &Data) -> &'static str {
    match value {
        Data::Nil => "nil",
        Data::Bool(_) => "boolean",
        Data::Int(_) | Data::Float(_) => "number",
        Data::Text(_) => "string",
        Data::Buffer(_) => "buffer",
        Data::Array(_) | Data::Map(_) => "table",
    }
}
