//! Values as a script would write them.

use std::fmt::Write as _;

use scene::{Data, Key};

/// The value in Lua.
pub fn literal(value: &Data) -> String {
    match value {
        Data::Nil => "nil".to_owned(),
        Data::Bool(value) => value.to_string(),
        Data::Int(value) => value.to_string(),
        Data::Float(value) => float(*value),
        Data::Text(bytes) | Data::Buffer(bytes) => string(bytes),
        Data::Array(items) => format!(
            "{{{}}}",
            items.iter().map(literal).collect::<Vec<_>>().join(", ")
        ),
        Data::Map(entries) => format!(
            "{{{}}}",
            entries.iter().map(entry).collect::<Vec<_>>().join(", ")
        ),
    }
}

fn float(value: f64) -> String {
    match value {
        f64::INFINITY => "math.huge".to_owned(),
        f64::NEG_INFINITY => "-math.huge".to_owned(),
        _ if value.is_nan() => "0/0".to_owned(),
        _ => format!("{value:?}"),
    }
}

fn entry((key, value): &(Key, Data)) -> String {
    let key = match key {
        Key::Text(name) if is_name(name) => String::from_utf8_lossy(name).into_owned(),
        Key::Text(text) => format!("[{}]", string(text)),
        Key::Bool(value) => format!("[{value}]"),
        Key::Int(value) => format!("[{value}]"),
        Key::Float(value) => format!("[{}]", float(*value)),
    };
    format!("{key} = {}", literal(value))
}

fn is_name(text: &[u8]) -> bool {
    text.first().is_some_and(|first| !first.is_ascii_digit())
        && text
            .iter()
            .all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_')
}

/// Three digits are an escape whatever follows.
fn string(bytes: &[u8]) -> String {
    let mut out = String::from("'");
    for &byte in bytes {
        match byte {
            b'\'' | b'\\' => out.extend(['\\', byte.into()]),
            b' '..=b'~' => out.push(byte.into()),
            _ => write!(out, "\\{byte:03}").expect("strings take any text"),
        }
    }
    out + "'"
}

#[cfg(test)]
mod tests {
    use super::literal;
    use scene::{Data, Key};

    #[test]
    fn values_are_written_as_in_lua() {
        let written = |value: Data, text: &str| assert_eq!(literal(&value), text);
        written(Data::Nil, "nil");
        written((-1).into(), "-1");
        written(Data::Float(-1.0), "-1.0");
        written(Data::Float(f64::NEG_INFINITY), "-math.huge");
        written(Data::text("it's \\\n1"), "'it\\'s \\\\\\0101'");
        written(
            [[0.0, 0.5], [1.0, 1e-9]].into(),
            "{{0.0, 0.5}, {1.0, 1e-9}}",
        );
        let entries = vec![
            (Key::Text(b"noError".to_vec()), true.into()),
            (Key::Text(b"a b".to_vec()), Data::Array(Vec::new())),
            (Key::Int(0), Data::Nil),
        ];
        written(
            Data::Map(entries),
            "{noError = true, ['a b'] = {}, [0] = nil}",
        );
    }
}
