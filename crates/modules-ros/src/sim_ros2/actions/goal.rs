//! Identities and states of goals.

use ros_interfaces::{Array, Number, Numbers, Record, Value};

use crate::ros_values::{self, Style};
use scene::Data;

/// The identity of a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct GoalId(pub [u8; 16]);

/// The states of a goal, with the numbers of `action_msgs/msg/GoalStatus`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    Unknown = 0,
    Accepted = 1,
    Executing = 2,
    Canceling = 3,
    Succeeded = 4,
    Canceled = 5,
    Aborted = 6,
}

impl Status {
    pub(super) fn is_active(self) -> bool {
        matches!(self, Self::Accepted | Self::Executing | Self::Canceling)
    }

    /// `simROS2.action_result_code` for the number of a state.
    pub(super) fn result_code(number: i64) -> i64 {
        match number {
            4 => 8564,
            6 => 8565,
            5 => 8566,
            _ => 8567,
        }
    }
}

impl GoalId {
    /// 32 lowercase hexadecimal digits.
    pub(super) fn text(self) -> String {
        format!("{:032x}", u128::from_be_bytes(self.0))
    }

    pub(super) fn parse(text: &str) -> Option<Self> {
        let id = Self(u128::from_str_radix(text, 16).ok()?.to_be_bytes());
        (id.text() == text).then_some(id)
    }

    /// `unique_identifier_msgs/msg/UUID` as a table.
    pub(super) fn to_data(self) -> Data {
        let bytes = self
            .0
            .iter()
            .map(|byte| Data::Int((*byte).into()))
            .collect();
        Data::map([("uuid", Data::Array(bytes))])
    }

    /// The field `goal_id` of a message.
    pub(super) fn of(record: &Record) -> Option<Self> {
        let Value::Record(id) = record.get("goal_id")? else {
            return None;
        };
        let Value::Array(Array::Numbers(Numbers::UInt8(bytes))) = id.get("uuid")? else {
            return None;
        };
        bytes.as_slice().try_into().ok().map(Self)
    }
}

/// A message with a goal's identity, and another field that a script states.
pub(super) fn message(
    layout: &std::sync::Arc<ros_interfaces::Layout>,
    id: GoalId,
    field: &str,
    data: &Data,
    style: Style,
) -> Result<Record, String> {
    let mut record = ros_values::from_data(
        layout,
        &Data::map([("goal_id", id.to_data())]),
        Style::default(),
    )?;
    if let Some(nested) = nested_layout(layout, field) {
        let nested = ros_values::from_data(&nested, data, style)?;
        record
            .set(field, Value::Record(nested))
            .map_err(|error| error.to_string())?;
    }
    Ok(record)
}

/// The type of a field that is a structure.
pub(super) fn nested_layout(
    layout: &ros_interfaces::Layout,
    field: &str,
) -> Option<std::sync::Arc<ros_interfaces::Layout>> {
    match &layout.field(field)?.1.field_type.element {
        ros_interfaces::Element::Nested(nested) => Some(nested.clone()),
        _ => None,
    }
}

/// A field that is a structure, as scripts see it.
pub(super) fn nested_data(record: &Record, field: &str, style: Style) -> Data {
    record
        .get(field)
        .map_or(Data::Nil, |value| ros_values::value_to_data(value, style))
}

/// A field that is an integer or a truth value.
pub(super) fn integer(record: &Record, field: &str) -> Option<i64> {
    match record.get(field)? {
        Value::Number(Number::Int8(value)) => Some((*value).into()),
        Value::Number(Number::Bool(value)) => Some((*value).into()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identities_are_32_digits() {
        let id = GoalId([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 255]);
        assert_eq!(id.text(), "000102030405060708090a0b0c0d0eff");
        assert_eq!(GoalId::parse(&id.text()), Some(id));
        for bad in [
            "",
            "1",
            "000102030405060708090A0B0C0D0EFF",
            "+00102030405060708090a0b0c0d0eff",
        ] {
            assert_eq!(GoalId::parse(bad), None, "{bad}");
        }
    }
}
