//! The reference, generated from the rows of the functions: Markdown pages, editor stubs, coverage.
//!
//! Everything is read from `#[api]` rows, from the comments of the Lua library, and from the tables of the crate `api`; nothing runs.
//! `tests/repository/generated.rs` holds the committed files to what this module makes.

mod approximated;
mod callbacks;
mod coverage;
mod lua;
mod markdown;
mod modules;
mod names;
mod overview;
mod plugin_header;
mod plugins;
mod properties;
mod row;
mod stubs;
mod suspicions;
mod usage;

use std::collections::BTreeMap;

use ::modules::registry;
use script::{Member, pairs};

pub use approximated::difference;
pub use markdown::function_text;
pub use names::{callback_summaries, constants};
pub use overview::with_overview;
pub use row::{FunctionDoc, ParameterDoc, ResultDoc};
pub use usage::{
    Support, Use, foreign_script, unreadable_script, use_of_member, use_of_module, uses,
    uses_beside,
};

/// Where the editor stubs are kept in the repository.
pub const STUBS: &str = "docs/stubs";

/// Every documented function, sorted by name: native ones, those of the Lua library, and other names for them. Names that begin with
/// an underscore are inner ones and not listed.
pub fn functions() -> Vec<FunctionDoc> {
    let mut all: BTreeMap<String, FunctionDoc> = BTreeMap::new();
    for function in lua::comments::functions() {
        all.insert(function.name.clone(), function);
    }
    for (category, functions) in api::SIM.functions {
        for function in functions
            .iter()
            .map(|function| FunctionDoc::native(category, function))
        {
            all.insert(function.name.clone(), function);
        }
    }
    for (old, new) in pairs(api::SIM.aliases) {
        if let Some(alias) = all
            .get(&full(new))
            .or_else(|| all.get(new))
            .map(|known| known.renamed(&full(old)))
        {
            all.insert(alias.name.clone(), alias);
        }
    }
    for (name, replacement) in pairs(api::SIM.deprecated) {
        if let Some(function) = all.get_mut(&full(name)) {
            function.deprecated = Some(replacement.to_owned());
        }
    }
    all.into_values()
        .filter(|function| !function.is_inner())
        .collect()
}

/// Replacement of a missing function of CoppeliaSim; None without one.
pub fn remedy(name: &str) -> Option<&'static str> {
    let member = name.strip_prefix("sim.")?;
    let (_, replacement) = pairs(api::SIM.deprecated).find(|(old, _)| *old == member)?;
    let is_built = |name: &str| matches!(registry().find(name), Some(member) if !matches!(member, Member::Missing(_)));
    Some(replacement).filter(|replacement| is_built(replacement))
}

/// Every function of the modules beside `sim`, module by module.
pub fn module_functions() -> Vec<FunctionDoc> {
    modules::names()
        .flat_map(|module| stubs::modules::of_module(&module))
        .collect()
}

/// Summary of a module, in a line or two; empty if it has none.
pub fn module_summary(module: &str) -> &'static str {
    modules::summary(module)
}

/// The names of the modules beside `sim`.
pub fn module_names() -> Vec<String> {
    modules::names().collect()
}

/// The names of the native functions of `sim`, and of the global ones.
pub fn native_functions() -> impl Iterator<Item = &'static str> {
    api::SIM.public_functions().map(|function| function.name)
}

/// Every generated file: path below the repository and text.
pub fn files() -> Vec<(String, String)> {
    let functions = functions();
    let mut files = markdown::pages(&functions);
    files.push(("docs/api/modules.md".to_owned(), modules::page()));
    files.extend(modules::own_pages());
    files.extend(
        stubs()
            .into_iter()
            .map(|(path, text)| (format!("{STUBS}/{path}"), text)),
    );
    files.push((stubs::python::PATH.to_owned(), stubs::python::text()));
    files.push(("docs/COVERAGE.md".to_owned(), coverage::text(&functions)));
    files.push(("docs/PROPERTIES.md".to_owned(), properties::text()));
    files.push(("docs/CALLBACKS.md".to_owned(), callbacks::text()));
    files.push(("docs/PLUGINS.md".to_owned(), plugins::text()));
    files.push((
        "include/swanilda_plugin.h".to_owned(),
        plugin_header::text(),
    ));
    files
}

/// The editor stubs: path below their folder and text.
pub fn stubs() -> Vec<(String, String)> {
    let sim = ("sim.lua".to_owned(), stubs::text(&functions()));
    let callbacks = ("callbacks.lua".to_owned(), callbacks::stub());
    [sim, callbacks]
        .into_iter()
        .chain(stubs::modules::files())
        .collect()
}

/// Signature of a function of CoppeliaSim's reference, empty when unknown; None when there is no such function.
pub fn reference_signature(name: &str) -> Option<&'static str> {
    let member = name.strip_prefix("sim.").unwrap_or(name);
    reference()
        .find(|row| row.name == member)
        .map(|row| row.signature)
}

/// One row of CoppeliaSim's reference.
/// The age of a function in the reference.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Age {
    Current,
    Deprecated,
    /// In versions after 4.10 only.
    Later,
}

impl Age {
    fn from_word(word: &str) -> Self {
        match word {
            "deprecated" => Self::Deprecated,
            "later" => Self::Later,
            _ => Self::Current,
        }
    }
}

struct ReferenceRow {
    name: &'static str,
    category: &'static str,
    age: Age,
    signature: &'static str,
}

fn reference() -> impl Iterator<Item = ReferenceRow> {
    api::SIM.reference.lines().map(|line| {
        let mut columns = line.split('\t');
        let mut next = || columns.next().unwrap_or_default();
        ReferenceRow {
            name: next(),
            category: next(),
            age: Age::from_word(next()),
            signature: next(),
        }
    })
}

fn full(member: &str) -> String {
    format!("sim.{member}")
}
