//! Types of messages, services and actions.

use std::sync::Arc;

use api_macro::api;
use ros_interfaces::{InterfaceError, InterfaceKind, Layout, Record, TypeName};

use super::node::node;
use super::ros_values::{self, Style};
use super::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_interface,
    get_interface_constants,
    supported_interfaces
];

/// A table of a type with all fields at their default values.
///
/// @param type `pkg/msg/Name`, `pkg/srv/NameRequest`, `pkg/srv/NameResponse`, `pkg/action/NameGoal`, `NameResult`, `NameFeedback`
/// @return result
#[api("simROS2.createInterface")]
fn create_interface(cx: &Cx, r#type: String) -> Result<Data> {
    let layout = layout(cx, &r#type).map_err(|error| unsupported("interface", &r#type, &error))?;
    Ok(ros_values::to_data(&Record::new(&layout), Style::default()))
}

/// The constants of a type.
///
/// @param type as in simROS2.createInterface
/// @return result names and values
#[api("simROS2.getInterfaceConstants")]
fn get_interface_constants(cx: &Cx, r#type: String) -> Result<Data> {
    let layout = layout(cx, &r#type).map_err(|error| unsupported("interface", &r#type, &error))?;
    Ok(ros_values::constants(&layout))
}

/// The types that are known: those that are built in, and those of the folders with interfaces.
///
/// @return result `pkg/msg/Name`, `pkg/srv/Name`, `pkg/action/Name`
#[api("simROS2.supportedInterfaces")]
fn supported_interfaces(cx: &Cx) -> Result<Vec<String>> {
    let names = node(cx).with_catalogue(&cx.options().ros, |catalogue| catalogue.names());
    Ok(names.iter().map(ToString::to_string).collect())
}

fn layout(cx: &Cx, name: &str) -> std::result::Result<Arc<Layout>, InterfaceError> {
    node(cx).with_catalogue(&cx.options().ros, |catalogue| catalogue.layout(name))
}

fn unsupported(kind: &str, name: &str, error: &InterfaceError) -> ApiError {
    ApiError::Other(format!(
        "Unsupported {kind} type '{name}': {error}. Folders with .msg, .srv and .action files: --ros-interfaces"
    ))
}

/// The type of a topic.
pub(super) fn message(cx: &Cx, name: &str) -> Result<Arc<Layout>> {
    let is_message = TypeName::parse(name, InterfaceKind::Message)
        .is_ok_and(|name| name.kind == InterfaceKind::Message);
    let layout = if is_message {
        layout(cx, name)
    } else {
        Err(InterfaceError::Unknown(name.into()))
    };
    layout.map_err(|error| unsupported("message", name, &error))
}

/// The types of request and response of a service.
pub(super) fn service(cx: &Cx, name: &str) -> Result<[Arc<Layout>; 2]> {
    let layouts = node(cx).with_catalogue(&cx.options().ros, |catalogue| catalogue.service(name));
    layouts.map_err(|error| unsupported("service", name, &error))
}

/// The types of what an action exchanges: requests and responses for goals and results, feedback.
pub(super) fn action(cx: &Cx, name: &str) -> Result<ActionLayouts> {
    let parsed = TypeName::parse(name, InterfaceKind::Action)
        .ok()
        .filter(|name| name.kind == InterfaceKind::Action);
    let Some(parsed) = parsed else {
        return Err(unsupported(
            "action",
            name,
            &InterfaceError::Unknown(name.into()),
        ));
    };
    let part = |suffix: &str| {
        layout(cx, &format!("{parsed}{suffix}"))
            .map_err(|error| unsupported("action", name, &error))
    };
    Ok(ActionLayouts {
        send_goal: [part("_SendGoal_Request")?, part("_SendGoal_Response")?],
        get_result: [part("_GetResult_Request")?, part("_GetResult_Response")?],
        feedback: part("_FeedbackMessage")?,
        cancel: service(cx, "action_msgs/srv/CancelGoal")?,
        status: message(cx, "action_msgs/msg/GoalStatusArray")?,
    })
}

/// What an action exchanges.
pub(super) struct ActionLayouts {
    pub(super) send_goal: [Arc<Layout>; 2],
    pub(super) get_result: [Arc<Layout>; 2],
    pub(super) cancel: [Arc<Layout>; 2],
    pub(super) feedback: Arc<Layout>,
    pub(super) status: Arc<Layout>,
}
