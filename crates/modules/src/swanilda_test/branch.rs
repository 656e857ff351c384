//! `t.branch`: a part of a test that is undone.

use std::cell::Cell;

use api_macro::api;

use super::super::{ApiError, ApiFn, Cx, Result, functions};
use super::bench;
use scene::Data;
use script::{ScriptCallback, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![branch];

/// How many branches are being made within each other.
#[derive(Default)]
pub(super) struct Branches {
    pub(super) depth: Cell<usize>,
}

/// Calls a function, and undoes all that it did.
///
/// @param fn the function, without arguments
/// @return results what it returned; or nothing, and its error
/// @return error
#[api("swanilda.test.branch")]
fn branch(cx: &mut Cx, r#fn: ScriptFunction) -> Result<(Data, Data)> {
    bench(cx)?;
    let open = cx.open_resources();
    if !open.is_empty() {
        return Err(not_undone(&open));
    }
    let callback = ScriptCallback::new(cx, r#fn);
    let outcome = cx.undone(|| called(cx, &callback));
    let (results, open) = outcome.get();
    if !open.is_empty() {
        return Err(not_undone(open));
    }
    Ok(match results {
        Ok(results) => (Data::Array(results.clone()), Data::Nil),
        Err(error) => (Data::Nil, Data::text(error)),
    })
}

/// What a function returned, or its error, and what it has left open.
pub(super) type Called = (std::result::Result<Vec<Data>, String>, Vec<String>);

/// Calls a function in a part that is undone.
pub(super) fn called(cx: &Cx, callback: &ScriptCallback) -> Called {
    let branches = cx.module_state::<Branches>();
    branches.depth.set(branches.depth.get() + 1);
    let results = callback.call(&[]).map_err(|error| error.to_string());
    (results, cx.open_resources())
}

pub(super) fn not_undone(open: &[String]) -> ApiError {
    let names = open.join(", ");
    ApiError::Other(format!("a branch does not undo {names}: close it before."))
}
