//! The structures of services and actions, which have names of their own, and those that actions of ROS 2 exchange.

use crate::types::Structure;
use crate::{
    Element, Field, FieldType, Generation, Interface, InterfaceKind, NumberType, Shape, TypeName,
};

/// A structure of a service or an action.
pub(super) struct Part {
    /// The service or the action.
    pub(super) interface: TypeName,
    /// Of this structure, with an underscore.
    pub(super) name: TypeName,
    which: Which,
}

#[derive(Clone, Copy)]
enum Which {
    /// As the text says it.
    Written(usize),
    SendGoalRequest,
    SendGoalResponse,
    GetResultRequest,
    GetResultResponse,
    FeedbackMessage,
    /// What service introspection publishes.
    Event,
}

const SERVICE: &[(&str, Which)] = &[
    ("_Request", Which::Written(0)),
    ("_Response", Which::Written(1)),
];
/// Without the underscore, as simROS2 calls them.
const SERVICE_JOINED: &[(&str, Which)] = &[
    ("Request", Which::Written(0)),
    ("Response", Which::Written(1)),
];
const SERVICE_EVENT: &[(&str, Which)] = &[("_Event", Which::Event)];
const ACTION: &[(&str, Which)] = &[
    ("_Goal", Which::Written(0)),
    ("_Result", Which::Written(1)),
    ("_Feedback", Which::Written(2)),
];
const ACTION_JOINED: &[(&str, Which)] = &[
    ("Goal", Which::Written(0)),
    ("Result", Which::Written(1)),
    ("Feedback", Which::Written(2)),
];
const ACTION_MESSAGES: &[(&str, Which)] = &[
    ("_SendGoal_Request", Which::SendGoalRequest),
    ("_SendGoal_Response", Which::SendGoalResponse),
    ("_GetResult_Request", Which::GetResultRequest),
    ("_GetResult_Response", Which::GetResultResponse),
    ("_FeedbackMessage", Which::FeedbackMessage),
];

/// Which structure a name means. Longer endings come first, since a service may be called `Request` itself.
pub(super) fn part_of(name: &TypeName, generation: Generation) -> Option<Part> {
    let endings: &[&[(&str, Which)]] = match (name.kind, generation) {
        (InterfaceKind::Message, _) => return None,
        (InterfaceKind::Service, Generation::Ros1) => &[SERVICE, SERVICE_JOINED],
        (InterfaceKind::Service, Generation::Ros2) => &[SERVICE, SERVICE_EVENT, SERVICE_JOINED],
        (InterfaceKind::Action, Generation::Ros1) => &[ACTION, ACTION_JOINED],
        (InterfaceKind::Action, Generation::Ros2) => &[ACTION_MESSAGES, ACTION, ACTION_JOINED],
    };
    endings
        .iter()
        .copied()
        .flatten()
        .find_map(|&(ending, which)| {
            let interface = name
                .name
                .strip_suffix(ending)
                .filter(|rest| !rest.is_empty())?;
            let canonical = format!("{interface}_{}", ending.trim_start_matches('_'));
            let of_package = |word: &str| TypeName {
                name: word.into(),
                ..name.clone()
            };
            Some(Part {
                interface: of_package(interface),
                name: of_package(&canonical),
                which,
            })
        })
}

impl Part {
    /// Its fields and constants.
    pub(super) fn structure(&self, interface: &Interface) -> Structure {
        let fields = match self.which {
            Which::Written(part) => return interface.parts.get(part).cloned().unwrap_or_default(),
            Which::SendGoalRequest => vec![goal_id(), self.part("goal", "_Goal", Shape::Single)],
            Which::SendGoalResponse => {
                vec![
                    number("accepted", NumberType::Bool),
                    of_package("stamp", "builtin_interfaces", "Time"),
                ]
            }
            Which::GetResultRequest => vec![goal_id()],
            Which::GetResultResponse => {
                vec![
                    number("status", NumberType::Int8),
                    self.part("result", "_Result", Shape::Single),
                ]
            }
            Which::FeedbackMessage => {
                vec![goal_id(), self.part("feedback", "_Feedback", Shape::Single)]
            }
            Which::Event => vec![
                of_package("info", "service_msgs", "ServiceEventInfo"),
                self.part("request", "_Request", Shape::Sequence(Some(1))),
                self.part("response", "_Response", Shape::Sequence(Some(1))),
            ],
        };
        Structure {
            constants: Vec::new(),
            fields,
        }
    }

    /// A field that is another structure of the same interface.
    fn part(&self, name: &str, ending: &str, shape: Shape) -> Field<TypeName> {
        let part = TypeName {
            name: format!("{}{ending}", self.interface.name),
            ..self.interface.clone()
        };
        field(name, Element::Nested(part), shape)
    }
}

fn field(name: &str, element: Element<TypeName>, shape: Shape) -> Field<TypeName> {
    Field {
        name: name.into(),
        field_type: FieldType { element, shape },
        default: None,
    }
}

fn number(name: &str, number: NumberType) -> Field<TypeName> {
    field(name, Element::Number(number), Shape::Single)
}

fn of_package(name: &str, package: &str, nested: &str) -> Field<TypeName> {
    let nested = TypeName {
        package: package.into(),
        kind: InterfaceKind::Message,
        name: nested.into(),
    };
    field(name, Element::Nested(nested), Shape::Single)
}

fn goal_id() -> Field<TypeName> {
    of_package("goal_id", "unique_identifier_msgs", "UUID")
}
