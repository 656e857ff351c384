//! `simOMPL.*`: single states.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;
use planning::StateSpace;

use super::objects::task;
use super::session::{Limit, Session};
use super::setup::Setup;
use super::tasks::{Task, ready};
use super::{ApiFn, Cx, Result, functions, places, refused};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    read_state,
    write_state,
    is_state_valid,
    is_state_within_bounds,
    enforce_bounds,
    state_distance,
    project_states,
];

/// The setup of a task and its states of the right size.
fn with_states(cx: &Cx, handle: &str, states: &[&[f64]]) -> Result<(Rc<RefCell<Task>>, Rc<Setup>)> {
    let task = task(cx, handle)?;
    let setup = ready(cx, &task.borrow())?;
    states
        .iter()
        .try_for_each(|state| task.borrow().check_size("State", state))?;
    let is_same_size = states
        .iter()
        .all(|state| state.len() == setup.space.dimension());
    // The state spaces were replaced after the setup.
    let sizes = || {
        refused("State is of incorrect size. Call simOMPL.setup again for the new state spaces.")
    };
    if is_same_size {
        Ok((task, setup))
    } else {
        Err(sizes())
    }
}

/// The present state of the objects of a task.
///
/// @param taskHandle the task
/// @return state
#[api("simOMPL.readState")]
fn read_state(cx: &Cx, task_handle: String) -> Result<Vec<f64>> {
    let (_, setup) = with_states(cx, &task_handle, &[])?;
    places::read(&setup.spaces, &cx.scene())
}

/// Moves the objects of a task.
///
/// @param taskHandle the task
/// @param state where to
#[api("simOMPL.writeState")]
fn write_state(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<()> {
    let (_, setup) = with_states(cx, &task_handle, &[&state])?;
    places::write(&setup.spaces, &mut *cx.scene_mut(), &state)
}

/// Whether a state is valid: without collisions, or as the callback says. Bounds do not count.
///
/// @param taskHandle the task
/// @param state the state
/// @return valid
#[api("simOMPL.isStateValid")]
fn is_state_valid(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<bool> {
    let (task, setup) = with_states(cx, &task_handle, &[&state])?;
    Session::new(cx, &task, &setup, Limit::NONE).is_valid(&state)
}

/// Whether a state is within the bounds. Collisions do not count.
///
/// @param taskHandle the task
/// @param state the state
/// @return valid
#[api("simOMPL.isStateWithinBounds")]
fn is_state_within_bounds(cx: &Cx, task_handle: String, state: Vec<f64>) -> Result<bool> {
    let (_, setup) = with_states(cx, &task_handle, &[&state])?;
    Ok(setup.space.is_within_bounds(&state))
}

/// The nearest state within the bounds: positions clamped, angles within half a turn, quaternions of length one.
///
/// @param taskHandle the task
/// @param state the state
/// @return state
#[api("simOMPL.enforceBounds")]
fn enforce_bounds(cx: &Cx, task_handle: String, mut state: Vec<f64>) -> Result<Vec<f64>> {
    let (_, setup) = with_states(cx, &task_handle, &[&state])?;
    setup.space.enforce_bounds(&mut state);
    Ok(state)
}

/// The distance of two states: the sum over the state spaces, each with its weight.
///
/// @param taskHandle the task
/// @param a from
/// @param b to
/// @return distance
#[api("simOMPL.stateDistance")]
fn state_distance(cx: &Cx, task_handle: String, a: Vec<f64>, b: Vec<f64>) -> Result<f64> {
    let (_, setup) = with_states(cx, &task_handle, &[&a, &b])?;
    Ok(setup.space.distance(&a, &b))
}

/// The projections of states.
///
/// @param taskHandle the task
/// @param state one state or several, one after the other
/// @return projection one after the other; empty without a projection
#[api("simOMPL.projectStates")]
fn project_states(cx: &mut Cx, task_handle: String, state: Vec<f64>) -> Result<Vec<f64>> {
    let (task, setup) = with_states(cx, &task_handle, &[])?;
    let dimension = setup.space.dimension().max(1);
    if !state.len().is_multiple_of(dimension) {
        task.borrow().check_size("State", &state)?;
    }
    let session = Session::new(cx, &task, &setup, Limit::NONE);
    let mut projections = Vec::new();
    for state in state.chunks_exact(dimension) {
        projections.extend(session.project(state)?);
    }
    Ok(projections)
}
