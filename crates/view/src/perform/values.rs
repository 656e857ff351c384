//! Values of properties as JSON, and back.

use serde_json::{Value, json};

use scene::{Data, Key, ValueType};

/// Bytes of a text or list that pages get; longer ones are only counted.
const MAX_SIZE: usize = 2000;

/// A value as JSON: strings that are no UTF-8, and what is long, as `{"bytes": length}`.
pub(crate) fn to_json(value: &Data) -> Value {
    if value.size() > MAX_SIZE {
        return json!({ "bytes": value.size() });
    }
    match value {
        Data::Nil => Value::Null,
        Data::Bool(value) => (*value).into(),
        Data::Int(value) => (*value).into(),
        Data::Float(value) => (*value).into(),
        Data::Text(bytes) => std::str::from_utf8(bytes)
            .map_or_else(|_| json!({ "bytes": bytes.len() }), |text| text.into()),
        Data::Buffer(bytes) => json!({ "bytes": bytes.len() }),
        Data::Array(items) => items.iter().map(to_json).collect(),
        Data::Map(entries) => entries
            .iter()
            .map(|(key, value)| (name(key), to_json(value)))
            .collect(),
    }
}

fn name(key: &Key) -> String {
    match key {
        Key::Bool(key) => key.to_string(),
        Key::Int(key) => key.to_string(),
        Key::Float(key) => key.to_string(),
        Key::Text(key) => String::from_utf8_lossy(key).into_owned(),
    }
}

/// A value of a property of that type; None where it is none. Tables and buffers are not written by pages.
pub(super) fn from_json(ty: ValueType, value: &Value) -> Option<Data> {
    let floats = |count: Option<usize>| {
        let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
        numbers
            .filter(|numbers| count.is_none_or(|count| numbers.len() == count))
            .map(Data::from)
    };
    let integers = |count: Option<usize>| {
        let numbers: Option<Vec<i64>> = value.as_array()?.iter().map(Value::as_i64).collect();
        numbers
            .filter(|numbers| count.is_none_or(|count| numbers.len() == count))
            .map(Data::from)
    };
    match ty {
        ValueType::Bool => value.as_bool().map(Data::Bool),
        ValueType::Int | ValueType::Long => value.as_i64().map(Data::Int),
        ValueType::Float => value.as_f64().map(Data::Float),
        ValueType::String => value.as_str().map(Data::text),
        ValueType::Vector2 => floats(Some(2)),
        ValueType::Vector3 | ValueType::Color => floats(Some(3)),
        ValueType::Quaternion => floats(Some(4)),
        ValueType::Pose => floats(Some(7)),
        ValueType::FloatArray => floats(None),
        ValueType::IntArray => integers(None),
        ValueType::IntArray2 => integers(Some(2)),
        ValueType::Buffer | ValueType::Table => None,
    }
}

/// What a value of that type is, for people.
pub(super) fn kind(ty: ValueType) -> &'static str {
    match ty {
        ValueType::Bool => "true or false",
        ValueType::Int | ValueType::Long => "a whole number",
        ValueType::Float => "a number",
        ValueType::String => "a text",
        ValueType::Vector2 => "a list of 2 numbers",
        ValueType::Vector3 => "a list of 3 numbers",
        ValueType::Color => "a list of 3 numbers from 0 to 1",
        ValueType::Quaternion => "a list of 4 numbers",
        ValueType::Pose => "a list of 7 numbers",
        ValueType::FloatArray => "a list of numbers",
        ValueType::IntArray => "a list of whole numbers",
        ValueType::IntArray2 => "a list of 2 whole numbers",
        ValueType::Buffer | ValueType::Table => "not written by pages",
    }
}
