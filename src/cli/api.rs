//! `swanilda api`: the reference, from the binary.

use std::collections::BTreeMap;
use std::process::ExitCode;

use super::{Outcome, say};
use docs::{self, FunctionDoc};

/// Largest edit distance of a suggested name.
const NEAR: usize = 3;
/// Largest number of suggestions.
const SUGGESTIONS: usize = 5;

/// Print the documentation of a function, or list all functions
#[derive(clap::Args)]
pub(super) struct Args {
    /// Function name, such as sim.getObjectPosition; the prefix is optional
    name: Option<String>,
}

pub(super) fn api(args: &Args) -> Outcome {
    let mut functions = docs::functions();
    let Some(name) = &args.name else {
        say(list(&functions).as_bytes());
        return Ok(ExitCode::SUCCESS);
    };
    functions.extend(docs::module_functions());
    if docs::module_names().contains(name) {
        say(list_module(name, &functions).as_bytes());
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(function) = functions
        .iter()
        .find(|function| function.name == *name || function.member() == name)
    {
        say(docs::function_text(function).as_bytes());
        return Ok(ExitCode::SUCCESS);
    }
    Err(unknown(name, &functions))
}

/// Names with their summaries, by category.
fn list(functions: &[FunctionDoc]) -> String {
    let mut categories: BTreeMap<&str, String> = BTreeMap::new();
    for function in functions
        .iter()
        .filter(|function| function.alias_of.is_none())
    {
        let lines = categories.entry(&function.category).or_default();
        let mark = if docs::difference(&function.name).is_some() {
            " (approximated)"
        } else {
            ""
        };
        lines.push_str(&format!(
            "  {:<36} {}{mark}\n",
            function.name,
            function.summary()
        ));
    }
    categories
        .iter()
        .map(|(category, lines)| format!("{category}\n{lines}"))
        .collect::<Vec<_>>()
        .join("\n")
}

/// Summary of a module, and its functions with their summaries.
fn list_module(module: &str, functions: &[FunctionDoc]) -> String {
    let of_module = functions
        .iter()
        .filter(|function| function.category == module);
    let lines: String = of_module
        .map(|function| format!("{:<38} {}\n", function.name, function.summary()))
        .collect();
    match docs::module_summary(module) {
        "" => lines,
        summary => format!("{summary}\n\n{lines}"),
    }
}

/// The message for an unknown name.
fn unknown(name: &str, functions: &[FunctionDoc]) -> String {
    if let Some(signature) = docs::reference_signature(name) {
        return format!(
            "{name} is not implemented in Swanilda. CoppeliaSim's reference: {signature}"
        );
    }
    let wanted = name.strip_prefix("sim.").unwrap_or(name).to_lowercase();
    let distance = |f: &FunctionDoc| {
        let member = f.member().to_lowercase();
        if wanted.len() > NEAR && member.contains(&wanted) {
            1
        } else {
            strsim::levenshtein(&wanted, &member)
        }
    };
    let mut near: Vec<(usize, &str)> = functions
        .iter()
        .map(|f| (distance(f), f.name.as_str()))
        .collect();
    near.retain(|(distance, _)| *distance <= NEAR);
    near.sort_unstable();
    let names: Vec<&str> = near
        .into_iter()
        .take(SUGGESTIONS)
        .map(|(_, name)| name)
        .collect();
    match names.as_slice() {
        [] => format!("there is no function {name}; `swanilda api` lists all"),
        names => format!(
            "there is no function {name}; did you mean {}?",
            names.join(", ")
        ),
    }
}
