//! `simOMPL.*`: what a task is to do, in words.

use api_macro::api;

use super::goals::TaskGoal;
use super::objects::{objects, task};
use super::spaces::StateSpace;
use super::tasks::Task;
use super::{ApiFn, Cx, Result, algorithm_name, functions};
use script::log::verbosity;

pub(super) const FUNCTIONS: &[ApiFn] = functions![print_task_info];

/// Prints and logs what a task is to do.
///
/// @param taskHandle the task
#[api("simOMPL.printTaskInfo")]
fn print_task_info(cx: &mut Cx, task_handle: String) -> Result<()> {
    let task = task(cx, &task_handle)?;
    let task = task.borrow();
    let spaces = objects(cx).spaces(&task.spaces)?;
    for line in lines(&task, &spaces) {
        let line = format!("OMPL: {line}");
        cx.env().log(verbosity::INFOS, &line);
        cx.print(line.as_bytes());
    }
    Ok(())
}

fn lines(task: &Task, spaces: &[StateSpace]) -> Vec<String> {
    let mut lines = vec![format!("task name: {}", task.name), "state spaces:".into()];
    lines.extend(spaces.iter().flat_map(describe_space));
    lines.push(format!("collision pairs: {:?}", task.collision_pairs));
    lines.push(format!("start state: {:?}", task.start));
    lines.extend(describe_goal(&task.goal));
    let callbacks = &task.callbacks;
    let name = |callback: Option<&super::callbacks::Callback>| {
        callback.map_or("(default)".to_owned(), |callback| {
            callback.name().to_owned()
        })
    };
    lines.push(format!(
        "state validation: {}",
        name(callbacks.validation.as_ref())
    ));
    lines.push(format!(
        "projection evaluation: {}",
        name(callbacks.projection.as_ref().map(|(callback, _)| callback))
    ));
    let [anywhere, near] =
        [0, 1].map(|which| callbacks.samplers.as_ref().map(|samplers| &samplers[which]));
    lines.push(format!(
        "valid state sampling: {}; near a state: {}",
        name(anywhere),
        name(near)
    ));
    lines.push(format!("resolution of checks: {}", task.resolution));
    let algorithm = algorithm_name(task.algorithm);
    let algorithm =
        algorithm.map_or_else(|| format!("{} (invalid)", task.algorithm), str::to_owned);
    lines.push(format!("algorithm: {algorithm}"));
    lines
}

fn describe_space(space: &StateSpace) -> Vec<String> {
    let kind = space.kind.map_or("unknown", super::spaces::Kind::name);
    vec![
        format!(
            "    {}: simompl_statespacetype_{kind}, object {}",
            space.name, space.object
        ),
        format!(
            "        bounds: {:?} to {:?}, weight {}",
            space.low, space.high, space.weight
        ),
        format!("        used for projection: {}", space.is_projected),
    ]
}

fn describe_goal(goal: &TaskGoal) -> Vec<String> {
    match goal {
        TaskGoal::States(states) => states
            .iter()
            .map(|state| format!("goal state: {state:?}"))
            .collect(),
        TaskGoal::Callback(callback) => vec![format!("goal callback: {}", callback.name())],
        TaskGoal::Dummies(pair) => vec![format!(
            "goal: dummy {} at dummy {}, tolerance {}, metric {:?}, reference {}",
            pair.robot, pair.goal, pair.tolerance, pair.metric, pair.reference
        )],
    }
}
