//! `simOMPL.*`: setup and planning.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;
use planning::{Refusal, Solution, path};

use super::objects::task;
use super::paths::{flat, interpolate, simplify};
use super::session::{Limit, Session};
use super::setup::Setup;
use super::tasks::{Task, ready};
use super::{ApiFn, Cx, Result, algorithm_name, functions, refused};
use scene::Data;
use script::log::verbosity;
use script::{Number, Results};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    setup,
    solve,
    compute,
    has_solution,
    has_exact_solution,
    has_approximate_solution,
    get_goal_distance,
    get_planner_data,
];

/// Reads all that a task is to do, and begins anew. What is changed later counts from the next setup on, except for collision pairs and callbacks.
///
/// @param taskHandle the task
#[api("simOMPL.setup")]
fn setup(cx: &mut Cx, task_handle: String) -> Result<()> {
    let task = task(cx, &task_handle)?;
    set_up(cx, &task)
}

fn set_up(cx: &Cx, task: &RefCell<Task>) -> Result<()> {
    let setup = Setup::new(cx, &task.borrow())?;
    task.borrow_mut().setup = Some(Rc::new(setup));
    Ok(())
}

/// Plans, or goes on planning. Most planners end with the first path; those that make it shorter use the time.
///
/// @param taskHandle the task
/// @param maxTime seconds at most, counted as 20000 checks and iterations each
/// @return solved whether there is a path, which may end near the goal only: simOMPL.hasExactSolution
#[api("simOMPL.solve")]
fn solve(cx: &mut Cx, task_handle: String, max_time: f64) -> Result<bool> {
    let task = task(cx, &task_handle)?;
    plan(cx, &task, max_time)
}

/// Plans, and makes the path shorter and denser: simOMPL.solve, simplifyPath, interpolatePath and getPath.
///
/// @param taskHandle the task
/// @param maxTime seconds of planning at most
/// @param maxSimplificationTime seconds at most; -1: until nothing helps
/// @param stateCnt how many states; 0: as dense as states are checked
/// @return solved whether there is a path
/// @return states from the start to the goal; empty without a path
#[api("simOMPL.compute")]
fn compute(
    cx: &mut Cx,
    task_handle: String,
    max_time: f64,
    #[default(-1.0)] max_simplification_time: f64,
    #[default(Number(0))] state_cnt: Number,
) -> Result<(bool, Vec<f64>)> {
    let task = task(cx, &task_handle)?;
    if cx.options().sets_up_plans {
        set_up(cx, &task)?;
    }
    if !plan(cx, &task, max_time)? {
        return Ok((false, Vec::new()));
    }
    simplify(cx, &task, max_simplification_time)?;
    interpolate(cx, &task, state_cnt.0)?;
    let setup = ready(cx, &task.borrow())?;
    let states = flat(&setup.path()?.states);
    Ok((true, states))
}

fn plan(cx: &mut Cx, task: &Rc<RefCell<Task>>, max_time: f64) -> Result<bool> {
    let setup = ready(cx, &task.borrow())?;
    let session = Session::new(cx, task, &setup, Limit::seconds(max_time));
    if session.projection_size() == 0 {
        return Err(refused(Refusal::NoProjection.to_string()));
    }
    let found = setup.with_progress(|progress| {
        session.run(&mut progress.random, |problem| {
            progress.planner.solve(problem, u64::MAX)
        })
    })??;
    drop(session);
    let found = found.unwrap_or_else(|refusal| {
        log_refusal(cx, &setup, refusal);
        None
    });
    keep(&setup, found);
    report(cx, &task.borrow(), &setup);
    Ok(setup.solution.borrow().is_some())
}

/// Keeps the better one of two paths: one that was made shorter stays.
fn keep(setup: &Setup, found: Option<Solution>) {
    let mut solution = setup.solution.borrow_mut();
    if let Some(found) = found
        && solution
            .as_ref()
            .is_none_or(|known| found.is_better(known, &setup.space))
    {
        *solution = Some(found);
    }
}

fn log_refusal(cx: &Cx, setup: &Setup, refusal: Refusal) {
    let planner = algorithm_name(setup.algorithm as i64).unwrap_or_default();
    let log = |level, text: &str| cx.env().log(level, &format!("OMPL: {planner}: {text}"));
    if refusal == Refusal::NoValidStart {
        log(verbosity::SCRIPT_WARNINGS, "Skipping invalid start state");
    }
    log(verbosity::SCRIPT_ERRORS, &refusal.to_string());
}

fn report(cx: &Cx, task: &Task, setup: &Setup) {
    match &*setup.solution.borrow() {
        None => task.report(cx, 1, "could not find solution."),
        Some(found) => {
            let kind = if found.is_exact {
                "exact"
            } else {
                "approximate"
            };
            task.report(
                cx,
                1,
                &format!("found solution: {kind}, {}", measures(setup, found)),
            );
        }
    }
}

/// States and length of a path.
pub(super) fn measures(setup: &Setup, found: &Solution) -> String {
    format!(
        "{} states, length {}",
        found.states.len(),
        path::length(&setup.space, &found.states)
    )
}

fn solution_is(cx: &Cx, handle: &str, test: impl FnOnce(&Solution) -> bool) -> Result<bool> {
    let task = task(cx, handle)?;
    let setup = ready(cx, &task.borrow())?;
    let solution = setup.solution.borrow();
    Ok(solution.as_ref().is_some_and(test))
}

/// Whether there is a path, to the goal or near it.
///
/// @param taskHandle the task
/// @return result
#[api("simOMPL.hasSolution")]
fn has_solution(cx: &Cx, task_handle: String) -> Result<bool> {
    solution_is(cx, &task_handle, |_| true)
}

/// Whether there is a path to the goal.
///
/// @param taskHandle the task
/// @return result
#[api("simOMPL.hasExactSolution")]
fn has_exact_solution(cx: &Cx, task_handle: String) -> Result<bool> {
    solution_is(cx, &task_handle, |found| found.is_exact)
}

/// Whether there is a path that ends near the goal only.
///
/// @param taskHandle the task
/// @return result
#[api("simOMPL.hasApproximateSolution")]
fn has_approximate_solution(cx: &Cx, task_handle: String) -> Result<bool> {
    solution_is(cx, &task_handle, |found| !found.is_exact)
}

/// How far the end of the path is from the goal.
///
/// @param taskHandle the task
/// @return distance 0 for a path to the goal, -1 without a path
#[api("simOMPL.getGoalDistance")]
fn get_goal_distance(cx: &Cx, task_handle: String) -> Result<f64> {
    let task = task(cx, &task_handle)?;
    let setup = ready(cx, &task.borrow())?;
    let solution = setup.solution.borrow();
    Ok(solution.as_ref().map_or(-1.0, |found| found.difference))
}

/// The states that the planner has reached, and the motions between them.
///
/// @param taskHandle the task
/// @return states flat list
/// @return tags of each state: 1 for those of a tree from the start, 2 for those of a tree from the goal, where there are both; else 0
/// @return tagsReal the bits of the tags read as float32
/// @return edges places of states, two by two, from 0
/// @return edgeWeights lengths of the motions
/// @return startVertices places of states, from 0
/// @return goalVertices places of states, from 0
#[api("simOMPL.getPlannerData")]
fn get_planner_data(cx: &Cx, task_handle: String) -> Result<Results> {
    let task = task(cx, &task_handle)?;
    let setup = ready(cx, &task.borrow())?;
    let data = setup.with_progress(|progress| progress.planner.data())?;
    let length = |&(from, to): &(usize, usize)| {
        planning::StateSpace::distance(&setup.space, &data.states[from], &data.states[to])
    };
    let places =
        |places: &[usize]| Data::from(places.iter().map(|&place| place as i64).collect::<Vec<_>>());
    let edges: Vec<usize> = data
        .edges
        .iter()
        .flat_map(|&(from, to)| [from, to])
        .collect();
    let bits = |&tag: &u32| f64::from(f32::from_bits(tag));
    Ok(Results(vec![
        flat(&data.states).into(),
        data.tags
            .iter()
            .map(|&tag| i64::from(tag))
            .collect::<Vec<_>>()
            .into(),
        data.tags.iter().map(bits).collect::<Vec<_>>().into(),
        places(&edges),
        data.edges.iter().map(length).collect::<Vec<_>>().into(),
        places(&data.starts),
        places(&data.goals),
    ]))
}
