//! The page of CoppeliaSim's plugins and Lua modules: which are here.

use std::fmt::Write as _;

#[cfg(test)]
mod rows;

use super::{approximated::difference, modules};
use c_interface::plugin_interface;
use script::ReferenceModule;

/// State of a module.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Works,
    Approximated(&'static str),
    Missing,
}

/// Every module of CoppeliaSim, with its state.
pub(super) fn all() -> Vec<(ReferenceModule, State)> {
    let here: Vec<String> = modules::names().collect();
    let state = |name: &str| match difference(name) {
        Some(difference) => State::Approximated(difference),
        None if here.iter().any(|known| known == name) => State::Works,
        None => State::Missing,
    };
    ReferenceModule::all()
        .map(|module| (module, state(module.name)))
        .collect()
}

/// `docs/PLUGINS.md`.
pub(super) fn text() -> String {
    let mut out = String::from(
        "# Plugins and Lua modules\n\nGenerated from the sources: `UPDATE=1 cargo test --test repository generated`. What `require` finds in CoppeliaSim 4.10, \
         and its state in Swanilda. `require` of a missing one raises an error that names this page; `swanilda doctor` finds such calls \
         before a scene runs. Plugins in C and C++ made for CoppeliaSim can be loaded ([NATIVE_PLUGINS](NATIVE_PLUGINS.md)), Lua modules in C as well, and programs \
         in Rust add modules of their own ([EMBEDDING](EMBEDDING.md)). [Functions of the modules that are here](api/modules.md).\n",
    );
    for (kind, title) in [
        ("plugin", "Plugins"),
        ("library", "Lua modules of CoppeliaSim"),
        (
            "third-party library",
            "Third-party Lua modules that come with CoppeliaSim",
        ),
    ] {
        let rows: Vec<_> = all()
            .into_iter()
            .filter(|(module, _)| module.kind == kind)
            .collect();
        let here = rows
            .iter()
            .filter(|(_, state)| *state != State::Missing)
            .count();
        let _ = write!(
            out,
            "\n## {title}\n\n{here} of {} are here.\n\n| module | for | state | instead |\n|---|---|---|---|\n",
            rows.len()
        );
        for (module, state) in rows {
            out.push_str(&row(module, state));
        }
    }
    out.push_str(&c_interface());
    out
}

/// Which functions native plugins can call.
fn c_interface() -> String {
    let missing: Vec<String> = plugin_interface()
        .symbols()
        .filter(|row| row.is_missing() || row.is_launch())
        .map(|row| format!("`{}`", row.symbol))
        .collect();
    let all = plugin_interface().symbols().count();
    format!(
        "\n## Functions of the C interface\n\n{} of the {all} functions that the two versions of CoppeliaSim's loaders for plugins look up \
         are here ([NATIVE_PLUGINS](NATIVE_PLUGINS.md)). These are missing; a call fails and is named in the log:\n\n{}\n",
        all - missing.len(),
        missing.join(", ")
    )
}

fn row(module: ReferenceModule, state: State) -> String {
    let ReferenceModule { name, purpose, .. } = module;
    let (state, instead) = match state {
        State::Works => ("works".to_owned(), ""),
        State::Approximated(difference) => (format!("approximated: {difference}"), ""),
        State::Missing => ("missing".to_owned(), module.instead),
    };
    format!("| `{name}` | {purpose} | {state} | {instead} |\n")
}
