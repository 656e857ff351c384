//! Code: running it in the sandbox, and checking it before.

use std::path::Path;

use docs::{Support, Use, uses};
use mcp::Answer;
use scene::Data;
use serde_json::{Value, json};

use super::{Group, happened, object, reading, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{data, text_field, without_place};
use testing::{Excerpt, positions};

pub(crate) const GROUP: Group = Group { tools, call };

/// What the chunk of a client is called in errors.
const NAME: &str = "code";

fn tools() -> Vec<mcp::Tool> {
    vec![
        tool(
            "run_code",
            "Run Lua code",
            "Runs Lua code in the sandbox script, with `sim` and all modules: build and change the scene, measure, compute. Returns the values of an expression or of `return`, and what was printed. Globals stay for the next call. It does not advance time: use `step` or `run_until`.",
            &[("code", text("Lua code, or an expression"))],
            &["code"],
        ),
        reading(tool(
            "check_code",
            "Check code",
            "Checks Lua code without running it: syntax, unknown functions of the API with suggestions, functions that work in another way here. Without arguments: all scripts of the scene.",
            &[
                ("code", text("Lua code")),
                (
                    "path",
                    text("A Lua file, or a scene or model whose scripts are checked"),
                ),
                ("script", object("Path or handle of a script of the scene")),
            ],
            &[],
        )),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    if tool == "run_code" {
        return run(agent, arguments.text("code").unwrap_or_default());
    }
    let given = (
        arguments.text("code"),
        arguments.get("script"),
        arguments.text("path"),
    );
    let texts = match given {
        (Some(code), None, None) => vec![(NAME.to_owned(), code.to_owned())],
        (None, Some(script), None) => vec![super::scripts::source_in_lua(agent, script)?],
        (None, None, Some(path)) => super::files::scripts(agent, Path::new(path))?,
        (None, None, None) => super::scripts::all(agent)?,
        _ => return Err("give `code`, `script` or `path`, not several of them".into()),
    };
    let mut reports = String::new();
    for (name, code) in &texts {
        reports += &report(agent, name, code)?;
    }
    if reports.is_empty() {
        let count = if texts.len() == 1 {
            "The code is".to_owned()
        } else {
            format!("All {} scripts are", texts.len())
        };
        return Ok(Answer::text(format!(
            "{count} fine: the syntax is right, and all functions of the API are known."
        )));
    }
    Ok(Answer::text(reports))
}

/// Runs code in the sandbox.
pub(super) fn run(agent: &mut Agent, code: &str) -> Result<Answer, String> {
    let outcome = outcome(agent, code)?;
    let output = happened(agent);
    match outcome {
        Ok(results) if results.is_empty() && output.is_empty() => Ok(Answer::text("Done.")),
        Ok(results) => Ok(Answer::text(if results.is_empty() {
            "Done.".into()
        } else {
            results.join(", ")
        })
        .with(json!({"results": results}))
        .and_text(&output)),
        Err(error) => Err([error, output].join("\n").trim_end().to_owned()),
    }
}

/// The results of code as texts, or its error with the line it is about.
pub(super) fn outcome(
    agent: &mut Agent,
    code: &str,
) -> Result<Result<Vec<String>, String>, String> {
    let answer = agent.helper("run", &[Data::text(code), Data::text(NAME)])?;
    if let Some(error) = text_field(&answer, "error") {
        let trace = text_field(&answer, "trace").unwrap_or_default();
        return Ok(Err(with_line(NAME, code, &error, &trace)));
    }
    let results = match answer.field("results") {
        Some(Data::Array(all)) => all.iter().map(crate::values::short).collect(),
        _ => Vec::new(),
    };
    Ok(Ok(results))
}

/// An error with the lines around the one that it names, and the next step.
fn with_line(name: &str, code: &str, error: &str, trace: &str) -> String {
    let error = without_place(error);
    let line = line_of(name, &error).or_else(|| line_of(name, trace));
    let excerpt = line.and_then(|line| Excerpt::of(name, code.as_bytes(), line));
    let excerpt = excerpt.map(|excerpt| excerpt.text(">")).unwrap_or_default();
    let shown = error.replace(&format!("[string \"{name}\"]:"), "line ");
    let unknown = unknown(code, &error);
    format!("error: {shown}\n{excerpt}{unknown}{}", hint(&error))
        .trim_end()
        .to_owned()
}

/// The first line of a chunk that a text names.
fn line_of(name: &str, text: &str) -> Option<u32> {
    let places = positions(text.trim_start_matches("\nstack traceback:"));
    let found = places.into_iter().find(|(of, _)| *of == name);
    found.map(|(_, line)| line)
}

/// Functions of the API in the code that do not exist, after an error that may come of it.
fn unknown(code: &str, error: &str) -> String {
    if !error.contains("a nil value (field") {
        return String::new();
    }
    let missing = uses(code.as_bytes())
        .into_iter()
        .filter(|found| found.support == Support::Missing);
    missing
        .map(|found| format!("line {}: {}\n", found.line, described(&found)))
        .collect()
}

/// The next step after an error.
fn hint(error: &str) -> &'static str {
    if error.contains("attempt to yield") || error.contains("outside a coroutine") {
        "Code of run_code cannot wait: use `step` or `run_until`, or a script of the scene (write_script) with sysCall_thread."
    } else if error.contains("object does not exist") {
        "`scene` or `find_objects` shows the paths of objects."
    } else {
        ""
    }
}

/// What is wrong with a script; empty if nothing is.
pub(super) fn report(agent: &mut Agent, name: &str, code: &str) -> Result<String, String> {
    let mut out = String::new();
    if let Data::Text(error) = agent.helper("syntax", &[Data::text(code), Data::text(NAME)])? {
        out += &format!(
            "{}\n",
            with_line(NAME, code, &String::from_utf8_lossy(&error), "")
        );
    }
    for found in uses(code.as_bytes()) {
        if found.support != Support::Works || found.instead().is_some() || found.written.is_some() {
            out += &format!("line {}: {}\n", found.line, described(&found));
        }
    }
    Ok(if out.is_empty() {
        out
    } else {
        format!("{name}:\n{out}")
    })
}

fn described(found: &Use) -> String {
    let hint = found
        .instead()
        .map(|instead| format!("use {instead}"))
        .or(found.hint.clone());
    let hint = hint.map(|hint| format!(" ({hint})")).unwrap_or_default();
    match found.support {
        Support::Works => {
            let Some(written) = &found.written else {
                return format!("{} is deprecated{hint}", found.name);
            };
            format!("{written} is an old name of {}{hint}", found.name)
        }
        Support::Approximated(how) => format!("{} is approximated: {how}", found.name),
        Support::Missing => format!("{} does not exist{hint}", found.name),
    }
}

/// For other tools: an error if there is one in the syntax.
pub(super) fn check_syntax(agent: &mut Agent, code: &str) -> Result<(), String> {
    match agent.helper("syntax", &[Data::text(code), Data::text(NAME)])? {
        Data::Text(error) => Err(with_line(NAME, code, &String::from_utf8_lossy(&error), "")),
        _ => Ok(()),
    }
}

/// An argument that names an object.
pub(super) fn reference(value: Option<&Value>) -> Data {
    value.map_or(Data::Nil, data)
}
