//! What scripts call for servers of actions.

use std::rc::Rc;

use api_macro::api;

use super::goal::{GoalId, Status};
use super::server::{ActionServer, Callbacks};
use crate::ros_values::Style;
use crate::sim_ros2::node::{Entity, add, get, running, shut_down};
use crate::sim_ros2::{ApiError, ApiFn, Cx, Result, functions, interfaces};
use script::{ScriptCallback, ScriptFunction, Table};

pub(in crate::sim_ros2) const FUNCTIONS: &[ApiFn] = functions![
    create_action_server,
    action_server_publish_feedback,
    action_server_action_execute,
    action_server_action_succeed,
    action_server_action_abort,
    action_server_action_canceled,
    action_server_action_is_active,
    action_server_action_is_executing,
    action_server_action_is_canceling,
    shutdown_action_server,
    action_server_treat_u_int8_array_as_string,
];

fn server(entity: Entity) -> Option<Rc<ActionServer>> {
    match entity {
        Entity::ActionServer(server) => Some(server),
        _ => None,
    }
}

/// The server, and one of its goals with its state.
fn goal(cx: &Cx, handle: &str, uuid: &str) -> Result<(Rc<ActionServer>, GoalId, Status)> {
    let server = get(cx, handle, server)?;
    let known = GoalId::parse(uuid).and_then(|id| Some((id, server.status_of(id)?)));
    let (id, status) =
        known.ok_or_else(|| ApiError::Other(format!("goal handle '{uuid}' does not exist")))?;
    Ok((server, id, status))
}

/// Ends a goal that is in one of these states.
fn finish(
    cx: &Cx,
    handle: &str,
    uuid: &str,
    result: &Table,
    from: &[Status],
    to: Status,
) -> Result<()> {
    let (server, id, status) = goal(cx, handle, uuid)?;
    if !from.contains(&status) {
        return Err(ApiError::Other(format!(
            "goal '{uuid}' is {status:?} and cannot become {to:?}"
        )));
    }
    server.finish(id, to, &result.0)
}

/// Creates a server of an action.
///
/// @param actionName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param actionType `pkg/action/Name`
/// @param handleGoalCallback gets the goal's identity and the goal as a table, returns simROS2.goal_response.*
/// @param handleCancelCallback gets the same, returns simROS2.cancel_response.*
/// @param handleAcceptedCallback gets the same for a goal that was accepted
/// @return actionServerHandle it ends with the script
#[api("simROS2.createActionServer")]
fn create_action_server(
    cx: &mut Cx,
    action_name: String,
    action_type: String,
    handle_goal_callback: ScriptFunction,
    handle_cancel_callback: ScriptFunction,
    handle_accepted_callback: ScriptFunction,
) -> Result<String> {
    let layouts = interfaces::action(cx, &action_type)?;
    let running = running(cx)?;
    let callbacks = Callbacks {
        goal: ScriptCallback::new(cx, handle_goal_callback),
        cancel: ScriptCallback::new(cx, handle_cancel_callback),
        accepted: ScriptCallback::new(cx, handle_accepted_callback),
    };
    let server = ActionServer::new(
        &running,
        &running.resolve(&action_name)?,
        layouts,
        callbacks,
    )?;
    Ok(add(cx, Entity::ActionServer(Rc::new(server))))
}

/// Publishes feedback about a goal.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @param feedback a table with the fields of the feedback
#[api("simROS2.actionServerPublishFeedback")]
fn action_server_publish_feedback(
    cx: &mut Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
    feedback: Table,
) -> Result<()> {
    let (server, id, _) = goal(cx, &action_server_handle, &goal_uuid)?;
    server.publish_feedback(id, &feedback.0)
}

/// Begins a goal that was accepted with accept_and_defer.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
#[api("simROS2.actionServerActionExecute")]
fn action_server_action_execute(
    cx: &mut Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
) -> Result<()> {
    let (server, id, status) = goal(cx, &action_server_handle, &goal_uuid)?;
    if status != Status::Accepted {
        return Err(ApiError::Other(format!(
            "goal '{goal_uuid}' is {status:?} and cannot become Executing"
        )));
    }
    server.execute(id);
    Ok(())
}

/// Ends a goal with success.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @param result a table with the fields of the result
#[api("simROS2.actionServerActionSucceed")]
fn action_server_action_succeed(
    cx: &mut Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
    result: Table,
) -> Result<()> {
    let from = [Status::Executing, Status::Canceling];
    finish(
        cx,
        &action_server_handle,
        &goal_uuid,
        &result,
        &from,
        Status::Succeeded,
    )
}

/// Ends a goal that failed.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @param result a table with the fields of the result
#[api("simROS2.actionServerActionAbort")]
fn action_server_action_abort(
    cx: &mut Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
    result: Table,
) -> Result<()> {
    let from = [Status::Executing, Status::Canceling];
    finish(
        cx,
        &action_server_handle,
        &goal_uuid,
        &result,
        &from,
        Status::Aborted,
    )
}

/// Ends a goal that is being cancelled.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @param result a table with the fields of the result
#[api("simROS2.actionServerActionCanceled")]
fn action_server_action_canceled(
    cx: &mut Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
    result: Table,
) -> Result<()> {
    finish(
        cx,
        &action_server_handle,
        &goal_uuid,
        &result,
        &[Status::Canceling],
        Status::Canceled,
    )
}

/// Whether a goal is not finished.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @return result
#[api("simROS2.actionServerActionIsActive")]
fn action_server_action_is_active(
    cx: &Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
) -> Result<bool> {
    Ok(goal(cx, &action_server_handle, &goal_uuid)?.2.is_active())
}

/// Whether a goal has begun and is not being cancelled.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @return result
#[api("simROS2.actionServerActionIsExecuting")]
fn action_server_action_is_executing(
    cx: &Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
) -> Result<bool> {
    Ok(goal(cx, &action_server_handle, &goal_uuid)?.2 == Status::Executing)
}

/// Whether a goal is being cancelled.
///
/// @param actionServerHandle the server
/// @param goalUUID the goal's identity
/// @return result
#[api("simROS2.actionServerActionIsCanceling")]
fn action_server_action_is_canceling(
    cx: &Cx,
    action_server_handle: String,
    #[name("goalUUID")] goal_uuid: String,
) -> Result<bool> {
    Ok(goal(cx, &action_server_handle, &goal_uuid)?.2 == Status::Canceling)
}

/// Ends a server of an action.
///
/// @param actionServerHandle the server
#[api("simROS2.shutdownActionServer")]
fn shutdown_action_server(cx: &mut Cx, action_server_handle: String) -> Result<()> {
    shut_down(cx, &action_server_handle, server)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param actionServerHandle the server
#[api("simROS2.actionServerTreatUInt8ArrayAsString")]
fn action_server_treat_u_int8_array_as_string(
    cx: &mut Cx,
    action_server_handle: String,
) -> Result<()> {
    get(cx, &action_server_handle, server)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}
