//! The reference of the API.

use docs::FunctionDoc;
use mcp::Answer;

use super::{Group, reading, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;

pub(crate) const GROUP: Group = Group { tools, call };

/// Functions that a search lists.
const MAX_FOUND: usize = 25;

fn tools() -> Vec<mcp::Tool> {
    vec![reading(tool(
        "api",
        "API reference",
        "Explains a function of the API (sim.getObjectPosition, simIK.handleGroup), lists those of a module (simIK), or searches by words.",
        &[
            ("name", text("A function or a module")),
            (
                "search",
                text("Words that occur in names or summaries, such as \"joint velocity\""),
            ),
        ],
        &[],
    ))]
}

fn call(_: &mut Agent, _: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let mut functions = docs::functions();
    functions.extend(docs::module_functions());
    match (arguments.text("name"), arguments.text("search")) {
        (Some(name), None) => explain(name, &functions),
        (None, Some(words)) => search(words, &functions),
        _ => Err("give `name` or `search`".into()),
    }
}

fn explain(name: &str, functions: &[FunctionDoc]) -> Result<Answer, String> {
    if docs::module_names().iter().any(|module| module == name) {
        let of_module: Vec<&FunctionDoc> = functions
            .iter()
            .filter(|function| function.category == name)
            .collect();
        return Ok(Answer::text(lines(&of_module, usize::MAX)));
    }
    let is_meant = |function: &&FunctionDoc| function.name == name || function.member() == name;
    if let Some(function) = functions.iter().find(is_meant) {
        return Ok(Answer::text(docs::function_text(function)));
    }
    if let Some(signature) = docs::reference_signature(name) {
        return Err(format!(
            "{name} is not implemented here. CoppeliaSim's reference: {signature}"
        ));
    }
    let pairs = functions
        .iter()
        .map(|function| (function.member().to_owned(), function.name.clone()));
    let member = name.rsplit('.').next().unwrap_or(name);
    let near = script::nearest(member, pairs);
    Err(match near {
        Some(near) => format!("there is no function {name}; did you mean {near}?"),
        None => format!("there is no function {name}; give words as `search`"),
    })
}

fn search(words: &str, functions: &[FunctionDoc]) -> Result<Answer, String> {
    let words: Vec<String> = words.split_whitespace().map(str::to_lowercase).collect();
    let fits = |function: &&FunctionDoc| {
        let text = format!("{} {}", function.name, function.summary()).to_lowercase();
        function.alias_of.is_none() && words.iter().all(|word| text.contains(word))
    };
    let mut found: Vec<&FunctionDoc> = functions.iter().filter(fits).collect();
    // Short names are rather what is meant.
    found.sort_by_key(|function| function.name.len());
    if found.is_empty() {
        return Err("no function has all of these words: try fewer, or others (position, orientation, joint, target, velocity, force, shape, sensor)".into());
    }
    Ok(Answer::text(lines(&found, MAX_FOUND)))
}

fn lines(functions: &[&FunctionDoc], most: usize) -> String {
    let mut out: String = functions
        .iter()
        .take(most)
        .map(|function| format!("{}: {}\n", function.name, function.summary()))
        .collect();
    if functions.len() > most {
        out += &format!("({} more: give more words)\n", functions.len() - most);
    }
    out
}
