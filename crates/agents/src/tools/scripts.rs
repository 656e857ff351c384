//! Scripts of the scene: reading and writing them.

use format::script_file::language;
use mcp::Answer;
use scene::Data;
use serde_json::{Value, json};

use super::code::{check_syntax, reference, report};
use super::{Group, count, happened, object, reading, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::data;

pub(crate) const GROUP: Group = Group { tools, call };

/// Lines of an answer.
const MAX_LINES: usize = 400;

fn tools() -> Vec<mcp::Tool> {
    vec![
        reading(tool(
            "read_script",
            "Read script",
            "Shows the text of a script of the scene, with line numbers.",
            &[
                ("script", object("Path or handle of the script")),
                ("from", count("First line [default: 1]", 1_000_000)),
                ("to", count("Last line [default: the last]", 1_000_000)),
            ],
            &["script"],
        )),
        tool(
            "write_script",
            "Write script",
            "Changes a script of the scene, or adds one. Either `code` (the whole text), or `old` and `new` (a part of the text that occurs once). To add one: leave `script` out. Code with a wrong syntax is refused and nothing changes. Customization scripts start again at once, simulation scripts with the simulation.",
            &[
                ("script", object("Path or handle of the script to change")),
                (
                    "code",
                    text(
                        "The whole text, in Lua: functions sysCall_init, sysCall_actuation, sysCall_sensing, sysCall_cleanup, or sysCall_thread",
                    ),
                ),
                ("old", text("A part of the text, which occurs once")),
                ("new", text("What replaces it")),
                (
                    "type",
                    json!({"type": "string", "enum": ["simulation", "customization"], "description": "Of a script that is added [default: simulation]"}),
                ),
                (
                    "parent",
                    object("The object to which a script is added [default: the scene]"),
                ),
                (
                    "alias",
                    text("Name of a script that is added [default: Script]"),
                ),
            ],
            &[],
        ),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    if tool == "read_script" {
        let script = arguments.get("script").unwrap_or(&Value::Null);
        let (path, code) = source(agent, script)?;
        return Ok(Answer::text(numbered(&path, &code, arguments)));
    }
    match arguments.get("script") {
        Some(script) => change(agent, script, arguments),
        None => add(agent, arguments),
    }
}

/// A script of the scene.
struct Found {
    path: String,
    language: String,
    code: String,
}

/// Path and text of a script.
pub(crate) fn source(agent: &mut Agent, script: &Value) -> Result<(String, String), String> {
    found(agent, script).map(|found| (found.path, found.code))
}

/// The same of one in Lua.
pub(super) fn source_in_lua(agent: &mut Agent, script: &Value) -> Result<(String, String), String> {
    let found = found(agent, script)?;
    if found.language == "lua" {
        return Ok((found.path, found.code));
    }
    Err(format!(
        "{} is in {}: only Lua is checked here",
        found.path, found.language
    ))
}

fn found(agent: &mut Agent, script: &Value) -> Result<Found, String> {
    let Data::Int(handle) = agent.helper("find", &[data(script)])? else {
        return Err("a script is named by its path or its handle".into());
    };
    let (_, language, code) = agent.sim.script_text(handle).map_err(|_| {
        format!("{script} is no script: find_objects with type \"script\" lists them")
    })?;
    let path = agent.helper("path", &[Data::Int(handle)])?;
    Ok(Found {
        path: crate::values::short(&path),
        language,
        code: String::from_utf8_lossy(&code).into_owned(),
    })
}

/// Path and text of all scripts of the scene in Lua.
pub(crate) fn all(agent: &mut Agent) -> Result<Vec<(String, String)>, String> {
    let Data::Array(handles) = agent.helper("scripts", &[])? else {
        return Ok(Vec::new());
    };
    let handles = handles.iter().map(crate::values::value);
    handles.map(|handle| source(agent, &handle)).collect()
}

fn numbered(path: &str, code: &str, arguments: Arguments<'_>) -> String {
    let lines: Vec<&str> = code.lines().collect();
    let from = arguments.count("from").unwrap_or(1).max(1) as usize;
    let to = arguments
        .count("to")
        .map_or(lines.len(), |to| to as usize)
        .min(lines.len());
    let to = to.min(from + MAX_LINES - 1);
    let shown = lines.iter().enumerate().take(to).skip(from - 1);
    let text: String = shown
        .map(|(at, line)| format!("{:>4} | {line}\n", at + 1))
        .collect();
    let rest = if to < lines.len() {
        format!("({} lines more: from {})\n", lines.len() - to, to + 1)
    } else {
        String::new()
    };
    format!("{path}, {} lines\n{text}{rest}", lines.len())
}

fn change(agent: &mut Agent, script: &Value, arguments: Arguments<'_>) -> Result<Answer, String> {
    let Found {
        path,
        language,
        code: before,
    } = found(agent, script)?;
    let code = match (
        arguments.text("code"),
        arguments.text("old"),
        arguments.text("new"),
    ) {
        (Some(code), None, None) => code.to_owned(),
        (None, Some(old), Some(new)) => replaced(&path, &before, old, new)?,
        _ => return Err("give either `code`, or both `old` and `new`".into()),
    };
    let is_lua = language == "lua" && !is_python(&code);
    if is_lua {
        check_syntax(agent, &code).map_err(refused)?;
    }
    agent.helper("write", &[data(script), Data::text(&code)])?;
    finished(agent, &path, "was changed", is_lua.then_some(code.as_str()))
}

fn replaced(path: &str, code: &str, old: &str, new: &str) -> Result<String, String> {
    match code.matches(old).count() {
        1 => Ok(code.replacen(old, new, 1)),
        0 => Err(format!(
            "`old` does not occur in {path}: read_script shows its text; spaces and line ends count"
        )),
        count => Err(format!(
            "`old` occurs {count} times in {path}: give more of the text around it"
        )),
    }
}

/// Whether the first line says so.
fn is_python(code: &str) -> bool {
    language(None, code.as_bytes()) == "python"
}

fn refused(error: String) -> String {
    format!("{error}\nThe script was not changed.")
}

fn add(agent: &mut Agent, arguments: Arguments<'_>) -> Result<Answer, String> {
    let code = arguments
        .text("code")
        .ok_or("give `script` to change a script, or `code` to add one")?;
    let is_lua = !is_python(code);
    if is_lua {
        check_syntax(agent, code).map_err(refused)?;
    }
    let kind = arguments.text("type").unwrap_or("simulation");
    let alias = arguments.text("alias").map_or(Data::Nil, Data::text);
    let parent = reference(arguments.get("parent"));
    let path = agent.helper("add", &[Data::text(kind), Data::text(code), alias, parent])?;
    let path = crate::values::short(&path);
    finished(agent, &path, "was added", is_lua.then_some(code))
}

/// The answer, with what is suspicious in Lua code and what happened when it began.
fn finished(
    agent: &mut Agent,
    path: &str,
    done: &str,
    code: Option<&str>,
) -> Result<Answer, String> {
    let suspicious = match code {
        Some(code) => report(agent, path, code)?,
        None => String::new(),
    };
    let output = happened(agent);
    Ok(Answer::text(format!("{path} {done}."))
        .and_text(&suspicious)
        .and_text(&output))
}
