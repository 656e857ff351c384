//! `simOMPL.*`: functions of scripts that planning calls.

use std::rc::Rc;

use api_macro::api;
use planning::{Nearness, State};

use super::goals::TaskGoal;
use super::objects::task;
use super::{ApiError, ApiFn, Cx, Result, functions, refused};
use scene::Data;
use script::log::verbosity;
use script::{Env, Number, ScriptCallback, ScriptFunction};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    set_state_validation_callback,
    set_goal_callback,
    set_projection_evaluation_callback,
    set_valid_state_sampler_callback,
];

/// Those of a task. They are looked up at each use.
#[derive(Default)]
pub(super) struct Callbacks {
    pub validation: Option<Callback>,
    /// With the numbers of a projected state.
    pub projection: Option<(Callback, usize)>,
    pub samplers: Option<[Callback; 2]>,
}

/// A function of a script, with its purpose in the words of errors.
#[derive(Clone)]
pub(super) struct Callback {
    purpose: &'static str,
    name: Rc<str>,
    function: Rc<ScriptCallback>,
}

impl Callback {
    /// None for the empty name.
    fn new(cx: &Cx, purpose: &'static str, given: ScriptFunction) -> Option<Self> {
        let name = match &given {
            ScriptFunction::Name(name) if name.is_empty() => return None,
            ScriptFunction::Name(name) => name.as_str().into(),
            ScriptFunction::Value(_) => "function".into(),
        };
        Some(Self {
            purpose,
            name,
            function: Rc::new(ScriptCallback::new(cx, given)),
        })
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Calls it, and reads its results; None for those it must not have.
    ///
    /// # Errors
    /// When it fails, or has other results. The log says why it fails.
    fn call<R>(
        &self,
        env: &Env,
        args: &[Data],
        read: impl FnOnce(&[Data]) -> Option<R>,
    ) -> Result<R> {
        let results = self.function.call(args).inspect_err(|reason| {
            let reason = reason.to_string();
            let reason = reason.lines().next().unwrap_or_default();
            env.log(
                verbosity::SCRIPT_WARNINGS,
                &format!("{} callback {}: {reason}", self.purpose, self.name),
            );
        });
        let read = results.ok().and_then(|results| read(&results));
        read.ok_or_else(|| self.failure())
    }

    fn failure(&self) -> ApiError {
        refused(format!(
            "{} callback {} returned an error",
            self.purpose, self.name
        ))
    }

    pub(super) fn is_valid(&self, env: &Env, state: &[f64]) -> Result<bool> {
        self.call(env, &[state.to_vec().into()], |results| match results {
            [Data::Bool(is_valid), ..] => Some(*is_valid),
            _ => None,
        })
    }

    pub(super) fn nearness(&self, env: &Env, state: &[f64]) -> Result<Nearness> {
        self.call(env, &[state.to_vec().into()], |results| match results {
            [Data::Bool(is_reached), distance, ..] => Some(Nearness {
                is_reached: *is_reached,
                distance: distance.as_f64()?,
            }),
            _ => None,
        })
    }

    /// The first `size` numbers of a table.
    pub(super) fn numbers(&self, env: &Env, args: &[Data], size: usize) -> Result<State> {
        self.call(env, args, |results| match results {
            [Data::Array(items), ..] => items.get(..size)?.iter().map(Data::as_f64).collect(),
            _ => None,
        })
    }
}

/// Sets a function that says which states are valid, instead of collision checks. The objects are not moved for it.
///
/// @param taskHandle the task
/// @param callback valid = f(state); an empty name for collision checks
#[api("simOMPL.setStateValidationCallback")]
fn set_state_validation_callback(
    cx: &mut Cx,
    task_handle: String,
    callback: ScriptFunction,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    task.borrow_mut().callbacks.validation = Callback::new(cx, "State validation", callback);
    Ok(())
}

/// Sets a function that says which states are the goal. Planners that begin at the goal as well refuse it.
///
/// @param taskHandle the task
/// @param callback satisfied, distance = f(state)
#[api("simOMPL.setGoalCallback")]
fn set_goal_callback(cx: &mut Cx, task_handle: String, callback: ScriptFunction) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let callback = Callback::new(cx, "Goal", callback).ok_or_else(unnamed)?;
    task.borrow_mut().goal = TaskGoal::Callback(callback);
    Ok(())
}

/// Sets a function that maps states to a few numbers, in which planners see how far they have spread.
///
/// @param taskHandle the task
/// @param callback projection = f(state); an empty name for the position of the first state space that is used for it
/// @param projectionSize how many numbers
#[api("simOMPL.setProjectionEvaluationCallback")]
fn set_projection_evaluation_callback(
    cx: &mut Cx,
    task_handle: String,
    callback: ScriptFunction,
    projection_size: Number,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let Some(callback) = Callback::new(cx, "Projection evaluation", callback) else {
        task.borrow_mut().callbacks.projection = None;
        return Ok(());
    };
    let size = usize::try_from(projection_size.0)
        .ok()
        .filter(|size| *size > 0);
    let size = size.ok_or_else(|| refused("Projection size must be positive."))?;
    task.borrow_mut().callbacks.projection = Some((callback, size));
    Ok(())
}

/// Sets functions that draw valid states, for planners that ask for such. What they return is not checked.
///
/// @param taskHandle the task
/// @param callback state = f()
/// @param callbackNear state = f(state, distance): one that is not further away
#[api("simOMPL.setValidStateSamplerCallback")]
fn set_valid_state_sampler_callback(
    cx: &mut Cx,
    task_handle: String,
    callback: ScriptFunction,
    callback_near: ScriptFunction,
) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let anywhere = Callback::new(cx, "Valid state sampling", callback).ok_or_else(unnamed)?;
    let near = Callback::new(cx, "Near valid state sampling", callback_near).ok_or_else(unnamed)?;
    task.borrow_mut().callbacks.samplers = Some([anywhere, near]);
    Ok(())
}

fn unnamed() -> ApiError {
    refused("Invalid callback name.")
}
