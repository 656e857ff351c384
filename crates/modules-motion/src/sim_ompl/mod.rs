//! `simOMPL`: motion planning for objects and joints of the scene (spec: simompl).
//!
//! The planners are those of `planning`. Here are tasks and state spaces by handle, states in the scene, collision checks and callbacks. Helpers around paths and drawings
//! are in `lua/modules/simOMPL.lua`.

mod callbacks;
mod goals;
mod info;
mod objects;
mod paths;
mod places;
mod session;
mod setup;
mod solving;
mod spaces;
mod states;
mod tasks;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};

/// The module `simOMPL`.
pub static MODULE: Module = Module {
    about: "Motion planning by sampling.",
    functions: &[
        ("State spaces", spaces::FUNCTIONS),
        ("Tasks", tasks::FUNCTIONS),
        ("Starts and goals", goals::FUNCTIONS),
        ("Callbacks", callbacks::FUNCTIONS),
        ("Planning", solving::FUNCTIONS),
        ("Paths", paths::FUNCTIONS),
        ("States", states::FUNCTIONS),
        ("Information", info::FUNCTIONS),
    ],
    constants: CONSTANTS,
    plugin_errors: true,
    ..Module::new("simOMPL")
};

const CONSTANTS: &str = include_str!("constants.tsv");

/// The name of `simOMPL.Algorithm` for a number, if it has one.
fn algorithm_name(number: i64) -> Option<&'static str> {
    let named = CONSTANTS
        .lines()
        .filter_map(|line| line.strip_prefix("Algorithm.")?.split_once('\t'));
    named
        .into_iter()
        .find(|(_, value)| value.parse() == Ok(number))
        .map(|(name, _)| name)
}

fn refused(why: impl Into<String>) -> ApiError {
    ApiError::Other(why.into())
}
