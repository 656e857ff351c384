//! Arguments of tools: checked by their schema, and read.

use script::nearest;
use serde_json::Value;

/// The arguments of a call, which the schema of its tool allows.
#[derive(Clone, Copy)]
pub(crate) struct Arguments<'a>(&'a Value);

impl<'a> Arguments<'a> {
    pub(crate) fn new(value: &'a Value) -> Self {
        Self(value)
    }

    pub(crate) fn get(&self, name: &str) -> Option<&'a Value> {
        self.0.get(name).filter(|value| !value.is_null())
    }

    pub(crate) fn text(&self, name: &str) -> Option<&'a str> {
        self.get(name)?.as_str()
    }

    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.get(name)?.as_f64()
    }

    pub(crate) fn count(&self, name: &str) -> Option<u64> {
        self.get(name)?.as_u64()
    }

    pub(crate) fn flag(&self, name: &str) -> bool {
        self.get(name).and_then(Value::as_bool).unwrap_or_default()
    }

    pub(crate) fn texts(&self, name: &str) -> Vec<String> {
        let all = self.get(name).and_then(Value::as_array);
        all.into_iter()
            .flatten()
            .filter_map(|value| value.as_str().map(str::to_owned))
            .collect()
    }

    pub(crate) fn numbers<const N: usize>(&self, name: &str) -> Option<[f64; N]> {
        let all = self.get(name)?.as_array()?;
        let numbers: Vec<f64> = all.iter().filter_map(Value::as_f64).collect();
        numbers.try_into().ok()
    }
}

/// Whether a schema allows a value; it has the words that the schemas of the tools have.
///
/// # Errors
/// What is wrong, where, and what is right.
pub(crate) fn check(schema: &Value, value: &Value) -> Result<(), String> {
    check_at("", schema, value)
}

fn check_at(place: &str, schema: &Value, value: &Value) -> Result<(), String> {
    check_type(place, schema, value)?;
    if let Some(allowed) = schema["enum"].as_array()
        && !allowed.contains(value)
    {
        let names: Vec<String> = allowed.iter().map(Value::to_string).collect();
        return Err(format!(
            "{}: one of {} is needed",
            named(place),
            names.join(", ")
        ));
    }
    check_bounds(place, schema, value)?;
    check_fields(place, schema, value)?;
    if let (Some(items), Some(of_item)) = (value.as_array(), schema.get("items")) {
        for (at, item) in items.iter().enumerate() {
            check_at(&format!("{place}[{at}]"), of_item, item)?;
        }
    }
    Ok(())
}

/// Those of an object whose schema names them.
fn check_fields(place: &str, schema: &Value, value: &Value) -> Result<(), String> {
    let (Some(fields), Some(known)) = (value.as_object(), schema["properties"].as_object()) else {
        return Ok(());
    };
    for required in schema["required"].as_array().into_iter().flatten() {
        let name = required.as_str().unwrap_or_default();
        if value.get(name).is_none_or(Value::is_null) {
            let what = known[name]["description"].as_str().unwrap_or_default();
            let place = prefix(place);
            return Err(format!("{place}the argument {name} is missing: {what}"));
        }
    }
    for (name, field) in fields.iter().filter(|(_, field)| !field.is_null()) {
        let Some(of_field) = known.get(name) else {
            return Err(unknown(place, name, known.keys()));
        };
        check_at(&format!("{}{name}", inner(place)), of_field, field)?;
    }
    Ok(())
}

fn check_type(place: &str, schema: &Value, value: &Value) -> Result<(), String> {
    let types: Vec<&str> = match &schema["type"] {
        Value::String(one) => vec![one],
        Value::Array(all) => all.iter().filter_map(Value::as_str).collect(),
        _ => return Ok(()),
    };
    if types.iter().any(|wanted| is_of(wanted, value)) {
        return Ok(());
    }
    Err(format!(
        "{}: {} is needed, not {}",
        named(place),
        types.join(" or "),
        kind(value)
    ))
}

fn is_of(wanted: &str, value: &Value) -> bool {
    match wanted {
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        _ => value.is_null(),
    }
}

fn kind(value: &Value) -> String {
    match value {
        Value::Array(_) => "an array".into(),
        Value::Object(_) => "an object".into(),
        other => other.to_string(),
    }
}

fn check_bounds(place: &str, schema: &Value, value: &Value) -> Result<(), String> {
    let size = value
        .as_f64()
        .or(value.as_array().map(|all| all.len() as f64));
    let Some(size) = size else { return Ok(()) };
    let bound = |name: &str| schema[name].as_f64();
    let (least, most) = if value.is_array() {
        (bound("minItems"), bound("maxItems"))
    } else {
        (bound("minimum"), bound("maximum"))
    };
    let what = if value.is_array() { "its length" } else { "it" };
    if least.is_some_and(|least| size < least) {
        return Err(format!(
            "{}: {what} is at least {}",
            named(place),
            least.unwrap_or_default()
        ));
    }
    if most.is_some_and(|most| size > most) {
        return Err(format!(
            "{}: {what} is at most {}",
            named(place),
            most.unwrap_or_default()
        ));
    }
    Ok(())
}

fn unknown<'a>(place: &str, name: &str, known: impl Iterator<Item = &'a String>) -> String {
    let known: Vec<String> = known.cloned().collect();
    let near = nearest(name, known.iter().map(|name| (name.clone(), name.clone())));
    let hint = near.map_or_else(
        || format!("there are {}", known.join(", ")),
        |near| format!("did you mean {near}?"),
    );
    format!("{}there is no argument {name}; {hint}", prefix(place))
}

fn named(place: &str) -> String {
    if place.is_empty() {
        "the arguments".into()
    } else {
        format!("the argument {place}")
    }
}

fn prefix(place: &str) -> String {
    if place.is_empty() {
        String::new()
    } else {
        format!("{place}: ")
    }
}

fn inner(place: &str) -> String {
    if place.is_empty() {
        String::new()
    } else {
        format!("{place}.")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let schema = json!({
            "type": "object",
            "properties": {
                "count": {"type": "integer", "minimum": 1, "maximum": 10, "description": "how many"},
                "kind": {"type": "string", "enum": ["a", "b"]},
                "until": {"type": "object", "properties": {"pair": {"type": "array", "items": {"type": ["string", "integer"]}, "minItems": 2}}},
            },
            "required": ["count"],
        });
        for (arguments, error) in [
            (json!({"count": 3, "kind": null}), ""),
            (json!({"count": 3, "until": {"pair": ["a", 2]}}), ""),
            (json!({}), "the argument count is missing: how many"),
            (json!({"count": 0}), "the argument count: it is at least 1"),
            (json!({"count": 11}), "the argument count: it is at most 10"),
            (
                json!({"count": 1.5}),
                "the argument count: integer is needed, not 1.5",
            ),
            (
                json!({"count": 3, "kind": "c"}),
                "the argument kind: one of \"a\", \"b\" is needed",
            ),
            (
                json!({"count": 3, "kid": "c"}),
                "there is no argument kid; did you mean kind?",
            ),
            (
                json!({"count": 3, "until": {"pair": ["a"]}}),
                "the argument until.pair: its length is at least 2",
            ),
            (
                json!({"count": 3, "until": {"pair": ["a", {}]}}),
                "the argument until.pair[1]: string or integer is needed, not an object",
            ),
            (json!([]), "the arguments: object is needed, not an array"),
        ] {
            assert_eq!(
                check(&schema, &arguments).err().unwrap_or_default(),
                error,
                "{arguments}"
            );
        }
    }
}
