//! JSON as values of scripts.

use scene::{Data, Key};
use serde_json::Value;

/// A value for a script: objects are tables by their names.
pub fn data_of_json(value: &Value) -> Data {
    match value {
        Value::Null => Data::Nil,
        Value::Bool(value) => Data::Bool(*value),
        Value::Number(number) => number.as_i64().map_or_else(
            || Data::Float(number.as_f64().unwrap_or_default()),
            Data::Int,
        ),
        Value::String(text) => Data::text(text),
        Value::Array(all) => Data::Array(all.iter().map(data_of_json).collect()),
        Value::Object(fields) => Data::Map(
            fields
                .iter()
                .map(|(name, value)| (Key::Text(name.clone().into_bytes()), data_of_json(value)))
                .collect(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn all_kinds_of_json_are_values() {
        let given = json!({"a": [1, 2.5, true, "x"], "b": null, "large": 1e300, "2": -3});
        let text = |name: &str| Key::Text(name.as_bytes().to_vec());
        let list = vec![
            Data::Int(1),
            Data::Float(2.5),
            Data::Bool(true),
            Data::text("x"),
        ];
        let wanted = vec![
            (text("2"), Data::Int(-3)),
            (text("a"), Data::Array(list)),
            (text("b"), Data::Nil),
            (text("large"), Data::Float(1e300)),
        ];
        assert_eq!(data_of_json(&given), Data::Map(wanted));
    }
}
