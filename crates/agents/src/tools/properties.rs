//! Search, reading and setting of properties.

use mcp::Answer;
use scene::Data;
use serde_json::{Map, Value, json};
use simulator::PropertyRow;

use super::scene::matches;
use super::{Group, happened, list, object, reading, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{data, short, text_field, unit, value, without_place};

pub(crate) const GROUP: Group = Group { tools, call };

/// Properties of an answer.
const MAX_SHOWN: usize = 80;
/// Names that are suggested.
const MAX_NEAR: usize = 4;
/// What all objects have beside their properties, as the helper has them.
const PLACED: [&str; 4] = [
    "position",
    "orientation",
    "linearVelocity",
    "angularVelocity",
];

fn tools() -> Vec<mcp::Tool> {
    vec![
        reading(tool(
            "find_properties",
            "Find properties",
            "Lists properties of an object with their types, values, and what they are. The object may be \"scene\" or \"app\".",
            &[
                (
                    "object",
                    object("Path or handle, or \"scene\" (gravity, time step, ...) or \"app\""),
                ),
                (
                    "pattern",
                    text("Part of a name or of a description, or a pattern with *"),
                ),
            ],
            &["object"],
        )),
        reading(tool(
            "get_properties",
            "Read properties",
            "Reads properties of objects: masses, joint positions, colours, sensor readings, custom data, ...; find_properties lists them. All objects also have position, orientation (Euler angles), linearVelocity and angularVelocity, in the frame of the world.",
            &[(
                "items",
                list(
                    "Properties such as \"/Cuboid.mass\", \"/Arm/Joint.jointPosition\", \"scene.gravity\", \"/Ball.position[3]\"",
                ),
            )],
            &["items"],
        )),
        tool(
            "set_properties",
            "Set properties",
            "Sets properties of objects (position and orientation too). Nothing is set if one of them does not exist. Answers what they are afterwards.",
            &[(
                "values",
                json!({"type": "object", "description": "Values by property, such as {\"/Cuboid.mass\": 2.5, \"/Cuboid.position\": [0, 0, 1], \"scene.gravity\": [0, 0, -1.6]}"}),
            )],
            &["values"],
        ),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    match tool {
        "find_properties" => find(agent, arguments),
        "get_properties" => read(agent, &arguments.texts("items")),
        _ => set(agent, arguments.get("values").and_then(Value::as_object)),
    }
}

fn find(agent: &mut Agent, arguments: Arguments<'_>) -> Result<Answer, String> {
    let wanted = arguments.get("object").map_or(Data::Nil, data);
    let Data::Int(handle) = agent.helper("find", &[wanted])? else {
        return Err("the object is a path or a handle".into());
    };
    let rows = agent
        .sim
        .property_rows(handle)
        .map_err(|error| error.to_string())?;
    let pattern = arguments.text("pattern").unwrap_or_default().to_lowercase();
    let fits = |row: &&PropertyRow| {
        let name = row.name.to_lowercase();
        matches(&pattern, &name)
            || matches(&pattern, &format!("/{name}"))
            || !pattern.is_empty() && row.description.to_lowercase().contains(&pattern)
    };
    let found: Vec<&PropertyRow> = rows.iter().filter(fits).collect();
    if found.is_empty() {
        return Ok(Answer::text(format!(
            "None of {} properties fits. A shorter pattern finds more.",
            rows.len()
        )));
    }
    let mut out: String = found.iter().take(MAX_SHOWN).map(|row| line(row)).collect();
    if found.len() > MAX_SHOWN {
        out += &format!("({} more: give a pattern)\n", found.len() - MAX_SHOWN);
    }
    if handle >= 0 {
        out += "All objects also have position, orientation (Euler angles), linearVelocity and angularVelocity, in the frame of the world.\n";
    }
    Ok(Answer::text(out))
}

fn line(row: &PropertyRow) -> String {
    let access = if row.is_writable { "" } else { ", read only" };
    let what = if row.description.is_empty() { "" } else { ": " };
    let shown = short(&row.value);
    let shown = shown.get(..100).unwrap_or(&shown);
    format!(
        "{} = {shown} ({}{access}){what}{}\n",
        row.name,
        row.ty.word(),
        row.description
    )
}

/// Reads properties; what cannot be read has its error instead.
fn read(agent: &mut Agent, items: &[String]) -> Result<Answer, String> {
    if items.is_empty() {
        return Err("no property is named in `items`: \"/Cuboid.mass\" for example".into());
    }
    let texts = items.iter().map(|item| Data::text(item)).collect();
    let Data::Array(values) = agent.helper("get", &[Data::Array(texts)])? else {
        return Err("the properties cannot be read".into());
    };
    let (mut out, mut all, mut failed) = (String::new(), Map::new(), 0);
    for (item, found) in items.iter().zip(&values) {
        if let Some(error) = text_field(found, "error") {
            failed += 1;
            out += &format!("{item}: {}\n", explained(agent, item, &error));
        } else if let Some(read) = found.field("value") {
            out += format!("{item} = {} {}", short(read), unit_of(agent, item)).trim_end();
            out += "\n";
            all.insert(item.clone(), value(read));
        }
    }
    let answer = Answer::text(out).with(json!({"values": all}));
    Ok(Answer {
        is_error: failed == items.len(),
        ..answer
    }
    .and_text(&happened(agent)))
}

fn set(agent: &mut Agent, values: Option<&Map<String, Value>>) -> Result<Answer, String> {
    let values = values.filter(|values| !values.is_empty());
    let values =
        values.ok_or("no property is named in `values`: {\"/Cuboid.mass\": 2} for example")?;
    check_all(agent, values)?;
    let mut done = Vec::new();
    for (item, new) in values {
        let error = agent.helper("set", &[Data::text(item), data(new)])?;
        if let Data::Text(error) = error {
            let error = explained(agent, item, &String::from_utf8_lossy(&error));
            let before = if done.is_empty() {
                "nothing was set".to_owned()
            } else {
                format!("set before: {}", done.join(", "))
            };
            return Err(format!("{item}: {error} ({before})"));
        }
        done.push(item.clone());
    }
    read(agent, &done)
}

/// All of them exist, so that nothing is set otherwise. What can only be written has no value to read.
fn check_all(agent: &mut Agent, values: &Map<String, Value>) -> Result<(), String> {
    let texts = values.keys().map(|item| Data::text(item)).collect();
    let Data::Array(found) = agent.helper("get", &[Data::Array(texts)])? else {
        return Ok(());
    };
    for (item, found) in values.keys().zip(&found) {
        let error = text_field(found, "error").unwrap_or_default();
        if error.contains("no such property")
            || error.contains("there is no object")
            || error.contains("PATH.NAME")
        {
            return Err(format!(
                "{item}: {} (nothing was set)",
                explained(agent, item, &error)
            ));
        }
    }
    Ok(())
}

/// An error about a property or an expression, with what else there is.
pub(super) fn explained(agent: &mut Agent, item: &str, error: &str) -> String {
    let error = with_near_objects(agent, &without_place(error));
    let error = error.trim_end_matches('.');
    if !error.contains("no such property") {
        return if error.ends_with('?') {
            error.to_owned()
        } else {
            format!("{error}.")
        };
    }
    let owner = agent
        .helper("owner", &[Data::text(item)])
        .unwrap_or(Data::Nil);
    let rows = match owner.field("handle") {
        Some(Data::Int(handle)) => agent.sim.property_rows(*handle).unwrap_or_default(),
        _ => Vec::new(),
    };
    let name = text_field(&owner, "name").unwrap_or_default();
    format!("{error}. {}", near_names(&name, &rows))
}

/// An error about an object that is not there, with the names of those that may be meant.
pub(crate) fn with_near_objects(agent: &mut Agent, error: &str) -> String {
    let Some((_, path)) = error.split_once("there is no object /") else {
        return error.to_owned();
    };
    let path = path.trim_end_matches('.').to_owned();
    format!(
        "{}. {}",
        error.trim_end_matches('.'),
        near_objects(agent, &path)
    )
}

fn near_names(name: &str, rows: &[PropertyRow]) -> String {
    let wanted = name.to_lowercase();
    let contains = |known: &&String| {
        let known = known.to_lowercase();
        known.contains(&wanted) || wanted.contains(&known)
    };
    let known: Vec<String> = rows
        .iter()
        .map(|row| row.name.clone())
        .chain(PLACED.map(str::to_owned))
        .collect();
    let nearest = script::nearest(name, known.iter().map(|name| (name.clone(), name.clone())));
    let mut names: Vec<String> = nearest.into_iter().collect();
    for name in known.iter().filter(contains).take(MAX_NEAR) {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    if names.is_empty() {
        return "find_properties lists what there is.".into();
    }
    format!(
        "Did you mean {}? find_properties lists all.",
        names.join(", ")
    )
}

/// Objects whose names are near to that in a path.
fn near_objects(agent: &mut Agent, text: &str) -> String {
    let Ok(rows) = super::scene::rows(agent, None) else {
        return String::new();
    };
    let last = |path: &str| path.rsplit('/').next().unwrap_or_default().to_lowercase();
    let wanted = last(text.split('.').next().unwrap_or(text));
    let alike = rows
        .iter()
        .filter(|row| !wanted.is_empty() && last(&row.path).contains(&wanted));
    let mut names: Vec<String> = alike.map(|row| row.path.clone()).take(5).collect();
    let nearest = script::nearest(
        &wanted,
        rows.iter().map(|row| (last(&row.path), row.path.clone())),
    );
    names.extend(nearest.filter(|near| !names.contains(near)));
    if names.is_empty() {
        return "find_objects searches for objects.".into();
    }
    format!("Did you mean {}?", names.join(", "))
}

/// The unit of a property; empty where there is none.
pub(super) fn unit_of(agent: &mut Agent, item: &str) -> &'static str {
    let name = item.rsplit_once('.').map_or(item, |(_, name)| name);
    let name = name.split('[').next().unwrap_or(name);
    match name {
        "position" => return "m",
        "orientation" => return "rad",
        "linearVelocity" => return "m/s",
        "angularVelocity" => return "rad/s",
        _ => {}
    }
    let known = script::property_table::described();
    let line = known.iter().find(|line| line.name == name);
    let unit = line.map(|line| unit(line.description)).unwrap_or_default();
    // Of a joint that turns, and of one that slides.
    let Some((turning, sliding)) = unit.split_once(" or ") else {
        return unit;
    };
    match agent.helper("slides", &[Data::text(item)]) {
        Ok(Data::Bool(true)) => sliding,
        Ok(Data::Bool(false)) => turning,
        _ => unit,
    }
}
