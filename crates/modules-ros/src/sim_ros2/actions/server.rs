//! Servers of actions: what becomes of goals.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use ros_interfaces::{Record, Value};
use rtps::{Correlation, Durability, History, Qos};

use super::goal::{self, GoalId, Status};
use crate::ros_values::{self, Style};
use crate::sim_ros2::endpoint::Endpoint;
use crate::sim_ros2::interfaces::ActionLayouts;
use crate::sim_ros2::node::Running;
use crate::sim_ros2::services::Server;
use crate::sim_ros2::{ApiError, Result, times};
use scene::Data;
use script::ScriptCallback;

const ACCEPT_AND_EXECUTE: i64 = 12857;
const ACCEPT_AND_DEFER: i64 = 12858;
const ACCEPT_CANCEL: i64 = 16100;
/// Goals that are not finished; further ones are rejected.
const MAX_ACTIVE: usize = 1000;
/// Finished goals whose result can be asked for.
const MAX_FINISHED: usize = 100;

/// What the functions of a script decide.
pub(super) struct Callbacks {
    pub(super) goal: ScriptCallback,
    pub(super) cancel: ScriptCallback,
    pub(super) accepted: ScriptCallback,
}

/// What carries out goals.
pub(in crate::sim_ros2) struct ActionServer {
    send_goal: Server,
    cancel: Server,
    get_result: Server,
    feedback: Endpoint,
    status: Endpoint,
    layouts: ActionLayouts,
    callbacks: Callbacks,
    pub(super) style: Cell<Style>,
    /// In the order of their arrival.
    goals: RefCell<Vec<Goal>>,
}

struct Goal {
    id: GoalId,
    goal: Record,
    /// When it was accepted, seconds since 1970.
    stamp: f64,
    status: Status,
    result: Option<Record>,
    /// Who waits for the result.
    waiting: Vec<Correlation>,
}

impl Goal {
    fn info(&self) -> Data {
        Data::map([
            ("goal_id", self.id.to_data()),
            ("stamp", times::to_data(self.stamp)),
        ])
    }
}

impl ActionServer {
    /// `full` is the name as all nodes know it.
    ///
    /// # Errors
    /// When it is none.
    pub(super) fn new(
        running: &Rc<Running>,
        full: &str,
        layouts: ActionLayouts,
        callbacks: Callbacks,
    ) -> Result<Self> {
        let durable = Qos {
            durability: Durability::TransientLocal,
            history: History::KeepLast(1),
            ..Qos::default()
        };
        Ok(Self {
            send_goal: Server::new(
                running,
                &format!("{full}/_action/send_goal"),
                layouts.send_goal.clone(),
            ),
            cancel: Server::new(
                running,
                &format!("{full}/_action/cancel_goal"),
                layouts.cancel.clone(),
            ),
            get_result: Server::new(
                running,
                &format!("{full}/_action/get_result"),
                layouts.get_result.clone(),
            ),
            feedback: running.publisher(
                &format!("{full}/_action/feedback"),
                &layouts.feedback,
                Qos::default(),
            )?,
            status: running.publisher(
                &format!("{full}/_action/status"),
                &layouts.status,
                durable,
            )?,
            layouts,
            callbacks,
            style: Cell::default(),
            goals: RefCell::default(),
        })
    }

    /// Calls back for goals and cancellations that have arrived, and notes who asks for results.
    pub(in crate::sim_ros2) fn spin(&self) {
        for (call, request) in self.send_goal.arrived() {
            self.goal_arrived(call, &request);
        }
        for (call, request) in self.cancel.arrived() {
            self.cancel_arrived(call, &request);
        }
        for (call, request) in self.get_result.arrived() {
            self.result_asked(call, &request);
        }
    }

    fn goal_arrived(&self, call: Correlation, request: &Record) {
        let (Some(id), Some(Value::Record(goal))) = (GoalId::of(request), request.get("goal"))
        else {
            return;
        };
        let args = [
            Data::text(&id.text()),
            ros_values::to_data(goal, self.style.get()),
        ];
        let active = self
            .goals
            .borrow()
            .iter()
            .filter(|goal| goal.status.is_active())
            .count();
        let is_possible = active < MAX_ACTIVE && self.status_of(id).is_none();
        let decision = if is_possible {
            self.callbacks.goal.call_logged(&args)
        } else {
            None
        };
        let status = match decision.and_then(|results| results.into_iter().next()) {
            Some(Data::Int(ACCEPT_AND_EXECUTE)) => Some(Status::Executing),
            Some(Data::Int(ACCEPT_AND_DEFER)) => Some(Status::Accepted),
            _ => None,
        };
        let stamp = times::ros_time(&self.feedback.node.tape);
        if let Some(status) = status {
            let (goal, waiting) = (goal.clone(), Vec::new());
            self.goals.borrow_mut().push(Goal {
                id,
                goal,
                stamp,
                status,
                result: None,
                waiting,
            });
        }
        let response = Data::map([
            ("accepted", Data::Bool(status.is_some())),
            ("stamp", times::to_data(stamp)),
        ]);
        self.reply(&self.send_goal, call, &response);
        if status.is_some() {
            self.publish_status();
            self.callbacks.accepted.call_logged(&args);
        }
    }

    /// One goal is meant, or all without an identity.
    fn cancel_arrived(&self, call: Correlation, request: &Record) {
        let Some(Value::Record(info)) = request.get("goal_info") else {
            return;
        };
        let asked = GoalId::of(info).filter(|id| id.0 != [0; 16]);
        let is_meant = |goal: &&Goal| asked.is_none_or(|id| goal.id == id);
        let meant: Vec<(GoalId, Record, Status, Data)> = self
            .goals
            .borrow()
            .iter()
            .filter(is_meant)
            .map(|goal| (goal.id, goal.goal.clone(), goal.status, goal.info()))
            .collect();
        let mut cancelling = Vec::new();
        for (id, goal, status, info) in &meant {
            let args = [
                Data::text(&id.text()),
                ros_values::to_data(goal, self.style.get()),
            ];
            if matches!(status, Status::Accepted | Status::Executing)
                && let Some(results) = self.callbacks.cancel.call_logged(&args)
                && results.first() == Some(&Data::Int(ACCEPT_CANCEL))
                && self.change(*id, Status::Canceling)
            {
                cancelling.push(info.clone());
            }
        }
        let code = match (cancelling.is_empty(), meant.first()) {
            (false, _) => 0,
            (true, None) if asked.is_some() => 2,
            (true, Some((_, _, status, _))) if asked.is_some() && !status.is_active() => 3,
            (true, _) => 1,
        };
        let response = Data::map([
            ("return_code", Data::Int(code)),
            ("goals_canceling", Data::Array(cancelling)),
        ]);
        self.reply(&self.cancel, call, &response);
        self.publish_status();
    }

    fn result_asked(&self, call: Correlation, request: &Record) {
        let Some(id) = GoalId::of(request) else {
            return;
        };
        let mut goals = self.goals.borrow_mut();
        match goals.iter_mut().find(|goal| goal.id == id) {
            Some(goal) if goal.status.is_active() => goal.waiting.push(call),
            Some(goal) => self.send_result(call, goal.status, goal.result.clone()),
            None => self.send_result(call, Status::Unknown, None),
        }
    }

    fn send_result(&self, call: Correlation, status: Status, result: Option<Record>) {
        let mut response = Record::new(&self.layouts.get_result[1]);
        // Every action's messages have both fields.
        let status = ros_interfaces::Number::Int8(status as i8);
        response.set("status", Value::Number(status)).ok();
        result.and_then(|result| response.set("result", Value::Record(result)).ok());
        self.get_result.reply(call, &response);
    }

    fn reply(&self, server: &Server, call: Correlation, response: &Data) {
        if let Ok(response) = ros_values::from_data(&server.response, response, Style::default()) {
            server.reply(call, &response);
        }
    }

    /// The state of a goal.
    pub(super) fn status_of(&self, id: GoalId) -> Option<Status> {
        self.goals
            .borrow()
            .iter()
            .find(|goal| goal.id == id)
            .map(|goal| goal.status)
    }

    fn change(&self, id: GoalId, status: Status) -> bool {
        let mut goals = self.goals.borrow_mut();
        let goal = goals
            .iter_mut()
            .find(|goal| goal.id == id && goal.status.is_active());
        goal.map(|goal| goal.status = status).is_some()
    }

    /// A goal that was deferred begins.
    pub(super) fn execute(&self, id: GoalId) {
        self.change(id, Status::Executing);
        self.publish_status();
    }

    /// # Errors
    /// When the table is none of the feedback's type.
    pub(super) fn publish_feedback(&self, id: GoalId, feedback: &Data) -> Result<()> {
        let message = goal::message(
            &self.layouts.feedback,
            id,
            "feedback",
            feedback,
            self.style.get(),
        );
        self.feedback.publish(&message.map_err(ApiError::Other)?);
        Ok(())
    }

    /// A goal ends, and everybody who waits gets its result.
    ///
    /// # Errors
    /// When the table is none of the result's type.
    pub(super) fn finish(&self, id: GoalId, status: Status, result: &Data) -> Result<()> {
        let Some(layout) = goal::nested_layout(&self.layouts.get_result[1], "result") else {
            return Ok(());
        };
        let result =
            ros_values::from_data(&layout, result, self.style.get()).map_err(ApiError::Other)?;
        let waiting = {
            let mut goals = self.goals.borrow_mut();
            let Some(goal) = goals.iter_mut().find(|goal| goal.id == id) else {
                return Ok(());
            };
            (goal.status, goal.result) = (status, Some(result.clone()));
            std::mem::take(&mut goal.waiting)
        };
        waiting
            .into_iter()
            .for_each(|call| self.send_result(call, status, Some(result.clone())));
        self.publish_status();
        self.forget_finished();
        Ok(())
    }

    fn forget_finished(&self) {
        let mut goals = self.goals.borrow_mut();
        let mut finished = goals.iter().filter(|goal| !goal.status.is_active()).count();
        goals.retain(|goal| {
            let is_old = !goal.status.is_active() && finished > MAX_FINISHED;
            finished -= usize::from(is_old);
            !is_old
        });
    }

    fn publish_status(&self) {
        let entry = |goal: &Goal| {
            Data::map([
                ("goal_info", goal.info()),
                ("status", Data::Int(goal.status as i64)),
            ])
        };
        let list = Data::map([(
            "status_list",
            Data::Array(self.goals.borrow().iter().map(entry).collect()),
        )]);
        if let Ok(message) = ros_values::from_data(&self.layouts.status, &list, Style::default()) {
            self.status.publish(&message);
        }
    }
}
