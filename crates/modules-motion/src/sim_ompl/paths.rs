//! `simOMPL.*`: the path that was found.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;
use planning::{State, StateSpace, path};

use super::objects::task;
use super::session::{Limit, Session};
use super::solving::measures;
use super::tasks::{Task, ready};
use super::{ApiFn, Cx, Result, functions, refused};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![get_path, simplify_path, interpolate_path];

/// Numbers of a path at most: more would not fit into the memory of a script.
const MAX_NUMBERS: usize = 1 << 24;

/// States one after the other.
pub(super) fn flat(states: &[State]) -> Vec<f64> {
    states.iter().flatten().copied().collect()
}

/// The path found, from the start to the goal.
///
/// @param taskHandle the task
/// @return states flat list
#[api("simOMPL.getPath")]
fn get_path(cx: &Cx, task_handle: String) -> Result<Vec<f64>> {
    let task = task(cx, &task_handle)?;
    let setup = ready(cx, &task.borrow())?;
    let states = flat(&setup.path()?.states);
    Ok(states)
}

/// Makes the path shorter: leaves out states, cuts corners, and rounds them.
///
/// @param taskHandle the task
/// @param maxSimplificationTime seconds at most, counted as 20000 checks each; -1: until nothing helps
#[api("simOMPL.simplifyPath")]
fn simplify_path(
    cx: &mut Cx,
    task_handle: String,
    #[default(-1.0)] max_simplification_time: f64,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    simplify(cx, &task, max_simplification_time)
}

pub(super) fn simplify(cx: &mut Cx, task: &Rc<RefCell<Task>>, max_time: f64) -> Result<()> {
    let setup = ready(cx, &task.borrow())?;
    let mut found = setup.path()?.clone();
    task.borrow().report(cx, 2, "simplifying solution...");
    let limit = if max_time < 0.0 {
        Limit::NONE
    } else {
        Limit::seconds(max_time)
    };
    let session = Session::new(cx, task, &setup, limit);
    setup.with_progress(|progress| {
        session.run(&mut progress.random, |problem| {
            path::simplify(problem, &mut found.states);
        })
    })??;
    drop(session);
    task.borrow().report(
        cx,
        1,
        &format!("simplified solution: {}", measures(&setup, &found)),
    );
    setup.solution.replace(Some(found));
    Ok(())
}

/// Adds states to the path.
///
/// @param taskHandle the task
/// @param stateCnt so many in all, distributed by length, if there are not more; 0: as dense as states are checked
#[api("simOMPL.interpolatePath")]
fn interpolate_path(
    cx: &mut Cx,
    task_handle: String,
    #[default(Number(0))] state_cnt: Number,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    interpolate(cx, &task, state_cnt.0)
}

pub(super) fn interpolate(cx: &Cx, task: &Rc<RefCell<Task>>, count: i64) -> Result<()> {
    let setup = ready(cx, &task.borrow())?;
    let mut found = setup.path()?.clone();
    task.borrow().report(cx, 2, "interpolating solution...");
    let needed = match usize::try_from(count) {
        Ok(count @ 1..) => count,
        _ => {
            let parts = |pair: &[State]| setup.space.parts(&pair[0], &pair[1], setup.resolution);
            found
                .states
                .windows(2)
                .map(parts)
                .fold(1, usize::saturating_add)
        }
    };
    if needed.saturating_mul(setup.space.dimension()) > MAX_NUMBERS {
        return Err(refused(format!("a path of {needed} states is too long.")));
    }
    found.states = match count {
        1.. => path::interpolate(&setup.space, &found.states, needed),
        _ => path::densify(&setup.space, &found.states, setup.resolution),
    };
    setup.solution.replace(Some(found));
    Ok(())
}
