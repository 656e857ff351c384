//! Values of scripts, JSON, and short texts.

use scene::{Data, Key};
pub(crate) use script::data_of_json as data;
use serde_json::{Map, Value, json};

/// Characters of a value in an answer.
const MAX_LENGTH: usize = 400;

/// A value of a script. Numbers that JSON does not have become texts.
pub(crate) fn value(data: &Data) -> Value {
    match data {
        Data::Nil => Value::Null,
        Data::Bool(value) => json!(value),
        Data::Int(value) => json!(value),
        Data::Float(value) if value.is_finite() => json!(value),
        Data::Float(value) => value.to_string().into(),
        Data::Text(bytes) => String::from_utf8_lossy(bytes).into(),
        Data::Buffer(bytes) => format!("({} bytes)", bytes.len()).into(),
        Data::Array(all) => all.iter().map(value).collect(),
        Data::Map(entries) => {
            let fields = entries.iter().map(|(name, data)| (key(name), value(data)));
            Value::Object(fields.collect::<Map<_, _>>())
        }
    }
}

fn key(key: &Key) -> String {
    match key {
        Key::Bool(value) => value.to_string(),
        Key::Int(value) => value.to_string(),
        Key::Float(value) => value.to_string(),
        Key::Text(bytes) => String::from_utf8_lossy(bytes).into_owned(),
    }
}

/// A value in few characters.
pub(crate) fn short(data: &Data) -> String {
    let text = match data {
        Data::Nil => "nil".into(),
        Data::Bool(value) => value.to_string(),
        Data::Int(value) => value.to_string(),
        Data::Float(value) => number(*value),
        Data::Text(bytes) => String::from_utf8_lossy(bytes).into_owned(),
        Data::Buffer(bytes) => format!("({} bytes)", bytes.len()),
        Data::Array(all) => format!("({})", all.iter().map(short).collect::<Vec<_>>().join(", ")),
        Data::Map(_) => value(data).to_string(),
    };
    match text.char_indices().nth(MAX_LENGTH) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// A number with five significant digits at most.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 {
            "0".into()
        } else {
            value.to_string()
        };
    }
    let size = value.abs();
    if !(1e-4..1e6).contains(&size) {
        // What is as small as this beside metres and newtons is noise.
        return if size < 1e-9 {
            "0".into()
        } else {
            format!("{value:.3e}")
        };
    }
    let before = format!("{size:.0}").len();
    let decimals = if size >= 1.0 {
        5_usize.saturating_sub(before)
    } else {
        5
    };
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// The field of a table as a text.
pub(crate) fn text_field(data: &Data, name: &str) -> Option<String> {
    match data.field(name) {
        Some(Data::Text(bytes)) => Some(String::from_utf8_lossy(bytes).into_owned()),
        _ => None,
    }
}

/// An error without its traceback, and without places in the library and in the helper, which nobody can look up.
pub(crate) fn without_place(text: &str) -> String {
    let first = text.split("\nstack traceback:").next().unwrap_or_default();
    let mut rest = first;
    for own in ["swanilda mcp", "sim/", "swanilda/"] {
        while let Some(after) = rest.strip_prefix(&format!("[string \"{own}")) {
            rest = after.split_once(": ").map_or(after, |(_, reason)| reason);
        }
    }
    // `50: in sim.setObjectPosition: `: a line of the helper.
    if let Some((line, after)) = rest.split_once(": in ")
        && line.bytes().all(|byte| byte.is_ascii_digit())
    {
        rest = after;
    }
    rest.to_owned()
}

/// The unit at the end of the description of a property; empty where there is none.
pub(crate) fn unit(description: &str) -> &'static str {
    const UNITS: &[(&str, &str)] = &[
        ("radians or metres per second", "rad/s or m/s"),
        ("metres per second squared", "m/s²"),
        ("metres per second", "m/s"),
        ("radians per second", "rad/s"),
        ("radians or metres", "rad or m"),
        ("newtons or newton metres", "Nm or N"),
        ("newton metres", "Nm"),
        ("kilograms", "kg"),
        ("newtons", "N"),
        ("radians", "rad"),
        ("seconds", "s"),
        ("metres", "m"),
    ];
    let sentence = description.trim_end_matches('.');
    let found = UNITS.iter().find(|(words, _)| sentence.ends_with(words));
    found.map_or("", |(_, unit)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_the_library_are_left_out() {
        for (text, reason) in [
            (
                "[string \"swanilda mcp\"]:12: [string \"sim/property\"]:71: no such property",
                "no such property",
            ),
            (
                "[string \"code\"]:3: oh\nstack traceback:\n\tx",
                "[string \"code\"]:3: oh",
            ),
            ("there is no object /a", "there is no object /a"),
            (
                "50: in sim.x: argument 3 is not a number.",
                "sim.x: argument 3 is not a number.",
            ),
        ] {
            assert_eq!(without_place(text), reason);
        }
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (12.345678, "12.346"),
            (123456.78, "123457"),
            (1.0 / 3.0, "0.33333"),
            (1e-17, "0"),
            (2.5e-6, "2.500e-6"),
            (1e7, "1.000e7"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn units_stand_at_the_end_of_descriptions() {
        assert_eq!(
            unit("The velocity in the physics, metres per second."),
            "m/s"
        );
        assert_eq!(
            unit("The position the joint moves to, radians or metres."),
            "rad or m"
        );
        assert_eq!(unit("Whether it moves."), "");
    }

    #[test]
    fn values_come_back_as_they_were() {
        let given = json!({"a": [1, 2.5, true, "x"], "b": {"c": null}});
        assert_eq!(value(&data(&given)), given);
    }
}
