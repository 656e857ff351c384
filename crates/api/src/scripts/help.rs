//! What is known of functions by their names, for consoles and editors.

use api_macro::api;

use crate::{ApiFn, Cx, Result, SIM, functions};
use script::{Number, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![get_api_info, get_api_func];

/// The columns of the reference: name, category, replacement, calltip.
const CALLTIP: usize = 3;

/// The calltip of a function: `RESULTS = NAME(PARAMETERS)`.
///
/// @param scriptHandle not used: all scripts have the same functions
/// @param apiWord `sim.getObject`, or a function of another module
/// @return info empty for what is not known
#[api("sim.getApiInfo")]
fn get_api_info(cx: &Cx, script_handle: Number, api_word: String) -> Result<Text> {
    let _ = script_handle;
    let known = calltip_of_reference(&api_word).map(str::to_owned);
    let known = known.or_else(|| cx.native_function(&api_word).map(calltip));
    Ok(Text(known.unwrap_or_default().into_bytes()))
}

/// The names of functions and constants that begin with a word.
///
/// @param scriptHandle not used: all scripts have the same functions
/// @param apiWord `sim.getObj`
/// @return funcsAndVars in alphabetical order
#[api("sim.getApiFunc")]
fn get_api_func(cx: &Cx, script_handle: Number, api_word: String) -> Result<Vec<String>> {
    let _ = script_handle;
    let Some((module, beginning)) = api_word.split_once('.') else {
        return Ok(Vec::new());
    };
    let names = cx.member_names(module).unwrap_or_default().into_iter();
    let names = names.filter(|name| name.starts_with(beginning) && !name.starts_with('_'));
    Ok(names.map(|name| format!("{module}.{name}")).collect())
}

/// The calltip of a function of CoppeliaSim's module `sim`.
fn calltip_of_reference(name: &str) -> Option<&'static str> {
    let member = name.strip_prefix("sim.")?;
    let rows = SIM.reference.lines();
    let mut columns = rows.map(|row| row.split('\t'));
    let row = columns.find(|columns| columns.clone().next() == Some(member))?;
    row.clone().nth(CALLTIP).filter(|text| !text.is_empty())
}

/// The same from the row of a function in Rust.
fn calltip(function: &ApiFn) -> String {
    let parameters: Vec<String> = function.params.iter().map(declaration).collect();
    let names = function
        .doc
        .lines()
        .filter_map(|line| line.trim().strip_prefix("@return "));
    let mut names = names.map(|line| line.split(' ').next().unwrap_or_default());
    let results = function.returns.iter().map(|ty| match names.next() {
        Some(name) => format!("{ty} {name}"),
        None => (*ty).to_owned(),
    });
    let results = results.collect::<Vec<_>>().join(", ");
    let assignment = if results.is_empty() { "" } else { " = " };
    format!(
        "{results}{assignment}{}({})",
        function.name,
        parameters.join(", ")
    )
}

fn declaration(parameter: &script::Param) -> String {
    let (ty, name) = (parameter.ty, parameter.name);
    match parameter.default {
        _ if name == "..." => name.to_owned(),
        Some(default) => format!("{ty} {name}={}", default.text()),
        None => format!("{ty} {name}"),
    }
}
