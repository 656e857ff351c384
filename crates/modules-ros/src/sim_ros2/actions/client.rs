//! Clients of actions.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use api_macro::api;
use ros_interfaces::{Layout, Record, Value, cdr};
use rtps::Qos;

use super::goal::{self, GoalId, Status};
use crate::ros_values::{self, Style};
use crate::sim_ros2::endpoint::Endpoint;
use crate::sim_ros2::node::{Entity, add, get, node, running, shut_down};
use crate::sim_ros2::services::{Client, ask};
use crate::sim_ros2::{ApiError, ApiFn, Cx, Result, functions, interfaces};
use scene::Data;
use script::{ScriptCallback, ScriptFunction, Table};

pub(in crate::sim_ros2) const FUNCTIONS: &[ApiFn] = functions![
    create_action_client,
    send_goal,
    cancel_last_goal,
    shutdown_action_client,
    action_client_treat_u_int8_array_as_string,
];

/// How long a goal waits for a server.
const SERVER_TIMEOUT: Duration = Duration::from_secs(5);

/// What sends goals.
pub(in crate::sim_ros2) struct ActionClient {
    goals: Client,
    cancel: Client,
    results: Client,
    feedback: Endpoint,
    feedback_layout: Arc<Layout>,
    on_goal_response: ScriptCallback,
    on_feedback: ScriptCallback,
    on_result: ScriptCallback,
    style: Cell<Style>,
    /// Goals that are not finished, by the number of the request for their result.
    pending: RefCell<BTreeMap<i64, GoalId>>,
    last: Cell<Option<GoalId>>,
    count: Cell<u32>,
}

impl ActionClient {
    /// Calls back for feedback and results that have arrived.
    pub(in crate::sim_ros2) fn spin(&self) {
        for _ in 0..self.feedback.waiting() {
            let Some(sample) = self.feedback.take() else {
                break;
            };
            let Ok(message) = cdr::decode(&self.feedback_layout, &sample.payload) else {
                continue;
            };
            // Feedback of all clients' goals comes here.
            if let Some(id) = GoalId::of(&message).filter(|id| self.is_pending(*id)) {
                let feedback = goal::nested_data(&message, "feedback", self.style.get());
                self.on_feedback
                    .call_logged(&[Data::text(&id.text()), feedback]);
            }
        }
        let pending: Vec<(i64, GoalId)> = self
            .pending
            .borrow()
            .iter()
            .map(|(number, id)| (*number, *id))
            .collect();
        for (number, id) in pending {
            if let Some(answer) = self.results.answer(number) {
                self.pending.borrow_mut().remove(&number);
                self.finish(id, answer);
            }
        }
    }

    fn is_pending(&self, id: GoalId) -> bool {
        self.pending.borrow().values().any(|pending| *pending == id)
    }

    fn finish(&self, id: GoalId, answer: Result<Record>) {
        match answer {
            Ok(answer) => {
                let code = Status::result_code(goal::integer(&answer, "status").unwrap_or(0));
                let result = goal::nested_data(&answer, "result", self.style.get());
                self.on_result
                    .call_logged(&[Data::text(&id.text()), Data::Int(code), result]);
            }
            Err(error) => self
                .on_result
                .warn(&format!("the result of an action was left out: {error}")),
        }
    }

    /// An identity that no other goal has: the client's name in the domain is part of it.
    fn new_id(&self) -> GoalId {
        self.count.set(self.count.get().wrapping_add(1));
        let mut id = self.feedback.guid().to_bytes();
        id[..2].copy_from_slice(&[0x51, 0x0b]);
        for (place, byte) in id[12..].iter_mut().zip(self.count.get().to_be_bytes()) {
            *place ^= byte.rotate_left(4);
        }
        GoalId(id)
    }
}

fn client(entity: Entity) -> Option<Rc<ActionClient>> {
    match entity {
        Entity::ActionClient(client) => Some(client),
        _ => None,
    }
}

/// Creates a client of an action.
///
/// @param actionName `/x`, `x` in the node's namespace, or `~/x` below the node
/// @param actionType `pkg/action/Name`
/// @param goalResponseCallback gets the goal's identity and whether it was accepted
/// @param feedbackCallback gets the goal's identity and the feedback as a table
/// @param resultCallback gets the goal's identity, simROS2.action_result_code.*, and the result as a table
/// @return actionClientHandle it ends with the script
#[api("simROS2.createActionClient")]
fn create_action_client(
    cx: &mut Cx,
    action_name: String,
    action_type: String,
    goal_response_callback: ScriptFunction,
    feedback_callback: ScriptFunction,
    result_callback: ScriptFunction,
) -> Result<String> {
    let layouts = interfaces::action(cx, &action_type)?;
    let running = running(cx)?;
    let full = running.resolve(&action_name)?;
    let feedback = running.subscription(
        &format!("{full}/_action/feedback"),
        &layouts.feedback,
        Qos::default(),
    )?;
    let client = ActionClient {
        goals: Client::new(
            &running,
            &format!("{full}/_action/send_goal"),
            layouts.send_goal,
        ),
        cancel: Client::new(
            &running,
            &format!("{full}/_action/cancel_goal"),
            layouts.cancel,
        ),
        results: Client::new(
            &running,
            &format!("{full}/_action/get_result"),
            layouts.get_result,
        ),
        feedback,
        feedback_layout: layouts.feedback,
        on_goal_response: ScriptCallback::new(cx, goal_response_callback),
        on_feedback: ScriptCallback::new(cx, feedback_callback),
        on_result: ScriptCallback::new(cx, result_callback),
        style: Cell::default(),
        pending: RefCell::default(),
        last: Cell::default(),
        count: Cell::default(),
    };
    Ok(add(cx, Entity::ActionClient(Rc::new(client))))
}

/// Sends a goal and waits until the server accepts or rejects it. Callbacks run in the meantime.
///
/// @param actionClientHandle the client
/// @param goal a table with the fields of the goal
/// @return success whether it was accepted
#[api("simROS2.sendGoal")]
fn send_goal(cx: &mut Cx, action_client_handle: String, goal: Table) -> Result<bool> {
    let client = get(cx, &action_client_handle, client)?;
    let id = client.new_id();
    let request = goal::message(
        &client.goals.request,
        id,
        "goal",
        &goal.0,
        client.style.get(),
    );
    let request = request.map_err(ApiError::Other)?;
    let node = node(cx);
    let found = cx.wait_for(Some(SERVER_TIMEOUT), || {
        node.spin();
        (client.goals.has_server() && client.results.has_server()).then_some(())
    })?;
    found.ok_or_else(|| ApiError::Other("action server not available after wait".into()))?;
    let response = ask(cx, &client.goals, &request)?;
    let accepted = goal::integer(&response, "accepted") == Some(1);
    if accepted {
        let asked = ros_values::from_data(
            &client.results.request,
            &Data::map([("goal_id", id.to_data())]),
            Style::default(),
        );
        let number = client.results.send(&asked.map_err(ApiError::Other)?);
        client.pending.borrow_mut().insert(number, id);
        client.last.set(Some(id));
    }
    client
        .on_goal_response
        .call_logged(&[Data::text(&id.text()), Data::Bool(accepted)]);
    Ok(accepted)
}

/// Asks the server to cancel the goal that was sent last, and waits for its answer.
///
/// @param actionClientHandle the client
/// @return success whether the goal is being cancelled
#[api("simROS2.cancelLastGoal")]
fn cancel_last_goal(cx: &mut Cx, action_client_handle: String) -> Result<bool> {
    let client = get(cx, &action_client_handle, client)?;
    let Some(id) = client.last.get() else {
        return Ok(false);
    };
    let info = Data::map([("goal_info", Data::map([("goal_id", id.to_data())]))]);
    let request = ros_values::from_data(&client.cancel.request, &info, Style::default())
        .map_err(ApiError::Other)?;
    let response = ask(cx, &client.cancel, &request)?;
    let cancelling = match response.get("goals_canceling") {
        Some(Value::Array(goals)) => !goals.is_empty(),
        _ => false,
    };
    Ok(cancelling && goal::integer(&response, "return_code") == Some(0))
}

/// Ends a client of an action.
///
/// @param actionClientHandle the client
#[api("simROS2.shutdownActionClient")]
fn shutdown_action_client(cx: &mut Cx, action_client_handle: String) -> Result<()> {
    shut_down(cx, &action_client_handle, client)
}

/// From now on fields of type `uint8[]` are strings.
///
/// @param actionClientHandle the client
#[api("simROS2.actionClientTreatUInt8ArrayAsString")]
fn action_client_treat_u_int8_array_as_string(
    cx: &mut Cx,
    action_client_handle: String,
) -> Result<()> {
    get(cx, &action_client_handle, client)?.style.set(Style {
        bytes_as_strings: true,
    });
    Ok(())
}
