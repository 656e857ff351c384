//! The tools, in groups.

mod branches;
mod code;
mod files;
mod physics;
mod picture;
#[cfg(feature = "plots")]
mod plot;
#[cfg(not(feature = "plots"))]
#[path = "plot_left_out.rs"]
mod plot;
mod properties;
mod reference;
mod samples;
pub(crate) mod scene;
mod scripts;
mod tests;
mod time;

use mcp::{Answer, Tool};
use serde_json::{Map, Value, json};

pub(crate) use properties::with_near_objects;
pub(crate) use scripts::{all as all_scripts, source as script_source};

use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::console::shown;
use testing::{Excerpt, positions};

/// Tools that belong together.
pub(crate) struct Group {
    pub tools: fn() -> Vec<Tool>,
    /// Calls one of them.
    pub call: fn(&mut Agent, &str, Arguments<'_>) -> Result<Answer, String>,
}

/// All tools, in the order in which clients list them.
pub(crate) const GROUPS: &[Group] = &[
    scene::GROUP,
    properties::GROUP,
    code::GROUP,
    scripts::GROUP,
    files::GROUP,
    time::GROUP,
    picture::GROUP,
    physics::GROUP,
    branches::GROUP,
    tests::GROUP,
    reference::GROUP,
];

/// A tool whose arguments are those `fields`, of which `required` have to be there.
fn tool(
    name: &'static str,
    title: &'static str,
    description: &str,
    fields: &[(&str, Value)],
    required: &[&str],
) -> Tool {
    let fields: Map<String, Value> = fields
        .iter()
        .map(|(name, schema)| ((*name).to_owned(), schema.clone()))
        .collect();
    Tool {
        name,
        title,
        description: description.to_owned(),
        arguments: json!({
            "type": "object", "properties": fields, "required": required, "additionalProperties": false,
        }),
        reads_only: false,
    }
}

/// The same for a tool that changes nothing.
fn reading(tool: Tool) -> Tool {
    Tool {
        reads_only: true,
        ..tool
    }
}

fn text(description: &str) -> Value {
    json!({"type": "string", "description": description})
}

fn flag(description: &str) -> Value {
    json!({"type": "boolean", "description": description})
}

fn number(description: &str) -> Value {
    json!({"type": "number", "description": description})
}

fn count(description: &str, most: u64) -> Value {
    json!({"type": "integer", "minimum": 0, "maximum": most, "description": description})
}

fn list(description: &str) -> Value {
    json!({"type": "array", "items": {"type": "string"}, "description": description})
}

fn point(description: &str) -> Value {
    json!({"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3, "description": description})
}

/// A path or a handle.
fn object(description: &str) -> Value {
    json!({"type": ["string", "integer"], "description": description})
}

/// What was printed and logged since the last answer, with the source of the first error; empty if nothing was.
fn happened(agent: &mut Agent) -> String {
    let (lines, left_out) = agent.lines.take();
    if lines.is_empty() {
        return String::new();
    }
    let mut out = format!("Output:\n{}", shown(&lines, left_out));
    if let Some(error) = lines.iter().find(|line| line.is_error) {
        for (name, line) in positions(&error.text) {
            let found = agent.sim.source_shown_as(name);
            let excerpt = found.and_then(|(path, code)| Excerpt::of(&path, &code, line));
            out += &excerpt.map(|excerpt| excerpt.text(">")).unwrap_or_default();
        }
    }
    out
}

/// Where the simulation is.
fn moment(agent: &Agent) -> String {
    use simulator::SimulationState;
    let state = match agent.sim.state() {
        SimulationState::Stopped => "stopped",
        SimulationState::Paused => "paused",
        state if state.is_advancing() => "running",
        _ => "stopping",
    };
    if agent.sim.state() == SimulationState::Stopped {
        return state.into();
    }
    format!("{state}, t = {} s", crate::values::number(agent.sim.time()))
}
