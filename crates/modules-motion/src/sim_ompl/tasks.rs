//! `simOMPL.*`: tasks and their settings.

use std::rc::Rc;

use api_macro::api;
use planning::State;

use super::callbacks::Callbacks;
use super::goals::TaskGoal;
use super::objects::{invalid, objects, task, task_number};
use super::setup::Setup;
use super::{ApiError, ApiFn, Cx, Result, functions, refused};
use script::{Number, log::verbosity};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_task,
    destroy_task,
    set_algorithm,
    set_collision_pairs,
    set_state_validity_checking_resolution,
    set_verbose_level,
];

/// `simOMPL.Algorithm.KPIECE1`.
const DEFAULT_ALGORITHM: i64 = 30007;

/// What a script has asked for, and the setup made of it.
pub(super) struct Task {
    pub name: String,
    /// Numbers of its state spaces.
    pub spaces: Vec<u64>,
    /// Numbers of a state.
    pub dimension: usize,
    pub resolution: f64,
    /// Two by two.
    pub collision_pairs: Vec<i64>,
    pub start: State,
    pub goal: TaskGoal,
    pub callbacks: Callbacks,
    pub algorithm: i64,
    pub verbosity: i64,
    pub setup: Option<Rc<Setup>>,
}

impl Task {
    fn new(name: String) -> Self {
        Self {
            name,
            spaces: Vec::new(),
            dimension: 0,
            resolution: 0.01,
            collision_pairs: Vec::new(),
            start: State::new(),
            goal: TaskGoal::States(Vec::new()),
            callbacks: Callbacks::default(),
            algorithm: DEFAULT_ALGORITHM,
            verbosity: 0,
            setup: None,
        }
    }

    /// Whether a state has as many numbers as those of the task; `what` begins the error.
    ///
    /// # Errors
    /// When it has not.
    pub(super) fn check_size(&self, what: &str, state: &[f64]) -> Result<()> {
        if state.len() == self.dimension && !state.is_empty() {
            return Ok(());
        }
        let mut text = match state.len() {
            0 => format!("{what} is empty."),
            found => format!(
                "{what} is of incorrect size. Expected {}, got {found}.",
                self.dimension
            ),
        };
        if self.dimension == 0 && !state.is_empty() {
            text.push_str(" Did you forget to set the state space for this task?");
        }
        Err(refused(text))
    }

    /// Logs what a script wants to know of planning.
    pub(super) fn report(&self, cx: &Cx, least_verbosity: i64, text: &str) {
        if self.verbosity >= least_verbosity {
            cx.env().log(verbosity::SCRIPT_INFOS, text);
        }
    }
}

/// A new task: states without numbers, no goal, algorithm KPIECE1, resolution 0.01.
///
/// @param name for simOMPL.printTaskInfo
/// @return taskHandle ends with the script
#[api("simOMPL.createTask")]
fn create_task(cx: &mut Cx, name: String) -> Result<String> {
    Ok(objects(cx).add_task(cx, Task::new(name)))
}

/// Removes a task. Its state spaces stay.
///
/// @param taskHandle the task
#[api("simOMPL.destroyTask")]
fn destroy_task(cx: &mut Cx, task_handle: String) -> Result<()> {
    let number = task_number(&task_handle)?;
    let removed = objects(cx).tasks.borrow_mut().remove(&number);
    removed.map(drop).ok_or_else(invalid)
}

/// Sets the planner. It counts from the next simOMPL.setup on, which checks it.
///
/// @param taskHandle the task
/// @param algorithm simOMPL.Algorithm
#[api("simOMPL.setAlgorithm")]
fn set_algorithm(cx: &mut Cx, task_handle: String, algorithm: Number) -> Result<()> {
    task(cx, &task_handle)?.borrow_mut().algorithm = algorithm.0;
    Ok(())
}

/// Sets which entities must not collide in a valid state. They are looked up at each check.
///
/// @param taskHandle the task
/// @param collisionPairHandles objects or collections, two by two; the second may be sim.handle_all. A pair whose first handle is negative is left out
#[api("simOMPL.setCollisionPairs")]
fn set_collision_pairs(
    cx: &mut Cx,
    task_handle: String,
    collision_pair_handles: Vec<i64>,
) -> Result<()> {
    task(cx, &task_handle)?.borrow_mut().collision_pairs = collision_pair_handles;
    Ok(())
}

/// Sets how closely motions are checked. It counts from the next simOMPL.setup on, which checks it.
///
/// @param taskHandle the task
/// @param resolution the longest part, as a fraction of the extent of each state space: above 0 and below 1
#[api("simOMPL.setStateValidityCheckingResolution")]
fn set_state_validity_checking_resolution(
    cx: &mut Cx,
    task_handle: String,
    resolution: f64,
) -> Result<()> {
    task(cx, &task_handle)?.borrow_mut().resolution = resolution;
    Ok(())
}

/// Sets how much is logged.
///
/// @param taskHandle the task
/// @param verboseLevel 0 nothing, 1 results, 2 also what begins
#[api("simOMPL.setVerboseLevel")]
fn set_verbose_level(cx: &mut Cx, task_handle: String, verbose_level: Number) -> Result<()> {
    task(cx, &task_handle)?.borrow_mut().verbosity = verbose_level.0;
    Ok(())
}

/// The setup of a task.
///
/// # Errors
/// When there is none, or a state space is gone.
pub(super) fn ready(cx: &Cx, task: &Task) -> Result<Rc<Setup>> {
    objects(cx).spaces(&task.spaces)?;
    task.setup.clone().ok_or_else(not_ready)
}

fn not_ready() -> ApiError {
    refused("simOMPL.setup(taskHandle) has not been called")
}
