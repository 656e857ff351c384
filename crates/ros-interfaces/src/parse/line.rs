//! One line of a text: a constant, a field, or nothing.

use super::TextFile;
use crate::{
    Array, Constant, Element, Field, FieldType, Generation, InterfaceKind, NumberType, Shape,
    TypeName, Value, limits,
};

/// What a line says.
pub(super) enum Member {
    Constant(Constant),
    Field(Field<TypeName>),
}

impl Member {
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Constant(constant) => &constant.name,
            Self::Field(field) => &field.name,
        }
    }
}

/// None for an empty line or one with a comment only.
pub(super) fn parse_line(line: &str, file: TextFile) -> Result<Option<Member>, String> {
    let line = line.trim();
    if line.is_empty() || line.starts_with('#') {
        return Ok(None);
    }
    let Some((type_text, rest)) = line.split_once(char::is_whitespace) else {
        return Err(format!("'{line}' is a type without a name"));
    };
    let field_type = parse_type(type_text, file)?;
    let rest = rest.trim_start();
    let end = rest
        .find(|c: char| c.is_whitespace() || c == '=' || c == '#')
        .unwrap_or(rest.len());
    let (name, rest) = rest.split_at(end);
    let rest = rest.trim_start();
    match rest.strip_prefix('=') {
        Some(value) => constant(field_type, name, value.trim(), file).map(Some),
        None => field(field_type, name, rest, file).map(Some),
    }
}

fn constant(
    field_type: FieldType<TypeName>,
    name: &str,
    text: &str,
    file: TextFile,
) -> Result<Member, String> {
    if field_type.shape != Shape::Single {
        return Err(format!("constant '{name}' is an array"));
    }
    let element = field_type.element;
    let is_string = matches!(element, Element::String(_) | Element::WString(_));
    // In ROS 1 a string is all that follows, quotes and number signs included.
    let raw = is_string && file.generation == Generation::Ros1;
    let text = if raw { text } else { without_comment(text) };
    let value = if raw {
        Some(Value::String(text.into()))
    } else {
        scalar(&element, text)
    };
    let value =
        value.ok_or_else(|| format!("'{text}' is no value of {element} for constant '{name}'"))?;
    Ok(Member::Constant(Constant {
        name: name.into(),
        element,
        value,
        text: text.into(),
    }))
}

fn field(
    field_type: FieldType<TypeName>,
    name: &str,
    rest: &str,
    file: TextFile,
) -> Result<Member, String> {
    let text = without_comment(rest);
    let default = match text {
        "" => None,
        _ if file.generation == Generation::Ros1 => {
            return Err(format!("'{text}' after the name of a field"));
        }
        _ => {
            let value = default(&field_type, text);
            Some(value.ok_or_else(|| {
                format!("'{text}' is no value of {field_type} for field '{name}'")
            })?)
        }
    };
    Ok(Member::Field(Field {
        name: name.into(),
        field_type,
        default,
    }))
}

/// `float64`, `string<=10`, `geometry_msgs/Point[]`, `Pose[3]`, `uint8[<=4]`.
fn parse_type(text: &str, file: TextFile) -> Result<FieldType<TypeName>, String> {
    let (element, shape) = match text
        .strip_suffix(']')
        .and_then(|text| text.rsplit_once('['))
    {
        Some((element, length)) => (element, parse_shape(length, file)?),
        None => (text, Shape::Single),
    };
    Ok(FieldType {
        element: parse_element(element, file)?,
        shape,
    })
}

fn parse_shape(length: &str, file: TextFile) -> Result<Shape, String> {
    let bounded = length
        .strip_prefix("<=")
        .filter(|_| file.generation == Generation::Ros2);
    match (length, bounded) {
        ("", _) => Ok(Shape::Sequence(None)),
        (_, Some(bound)) => parse_length(bound).map(|bound| Shape::Sequence(Some(bound))),
        _ => match parse_length(length)? {
            length if length > limits::FIXED_VALUES => {
                Err(format!("an array of {length} elements is too long"))
            }
            length => Ok(Shape::Array(length)),
        },
    }
}

/// Lengths on the wire have 32 bits.
fn parse_length(text: &str) -> Result<usize, String> {
    let length: u32 = text.parse().map_err(|_| format!("'{text}' is no length"))?;
    Ok(length as usize)
}

fn parse_element(text: &str, file: TextFile) -> Result<Element<TypeName>, String> {
    if let Some(number) = NumberType::of_word(text) {
        return Ok(Element::Number(number));
    }
    if file.generation == Generation::Ros2
        && let Some((word @ ("string" | "wstring"), bound)) = text.split_once("<=")
    {
        let bound = Some(parse_length(bound)?);
        return Ok(if word == "string" {
            Element::String(bound)
        } else {
            Element::WString(bound)
        });
    }
    match (text, file.generation) {
        ("string", _) => Ok(Element::String(None)),
        ("wstring", Generation::Ros2) => Ok(Element::WString(None)),
        ("time", Generation::Ros1) => Ok(Element::Time),
        ("duration", Generation::Ros1) => Ok(Element::Duration),
        _ => nested(text, file).map(Element::Nested),
    }
}

fn nested(text: &str, file: TextFile) -> Result<TypeName, String> {
    let wrong = || format!("'{text}' is no type");
    let name = match text {
        // A type of its own in ROS 1, whichever package uses it.
        "Header" if file.generation == Generation::Ros1 => "std_msgs/Header".into(),
        _ if text.contains('/') => text.to_string(),
        _ => format!("{}/{text}", file.package),
    };
    // A word in small letters without a package is a misspelt primitive type.
    let misspelt = !text.contains('/') && !text.starts_with(|c: char| c.is_ascii_uppercase());
    let name = TypeName::parse(&name, InterfaceKind::Message).map_err(|_| wrong())?;
    if misspelt || name.kind != InterfaceKind::Message {
        Err(wrong())
    } else {
        Ok(name)
    }
}

/// Up to a number sign that is not within quotes.
fn without_comment(text: &str) -> &str {
    let mut quote = None;
    let mut escaped = false;
    for (index, c) in text.char_indices() {
        match quote {
            _ if escaped => escaped = false,
            Some(_) if c == '\\' => escaped = true,
            Some(open) if c == open => quote = None,
            None if c == '#' => return text[..index].trim_end(),
            // An apostrophe within a word does not begin a quoted text.
            None if matches!(c, '"' | '\'') && opens(&text[..index]) => quote = Some(c),
            _ => {}
        }
    }
    text.trim_end()
}

fn opens(before: &str) -> bool {
    before.trim_end().is_empty() || before.trim_end().ends_with(['[', ','])
}

fn scalar(element: &Element<TypeName>, text: &str) -> Option<Value> {
    match element {
        Element::Number(number) => number.parse(text).map(Value::Number),
        Element::String(bound) | Element::WString(bound) => {
            let text = string(text)?;
            bound
                .is_none_or(|bound| text.len() <= bound)
                .then(|| Value::String(text.into_bytes()))
        }
        Element::Time | Element::Duration | Element::Nested(_) => None,
    }
}

/// A string with or without quotes.
fn string(text: &str) -> Option<String> {
    let Some(quote) = text.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
        return Some(text.into());
    };
    let (string, rest) = quoted(text, quote)?;
    rest.is_empty().then_some(string)
}

/// The string that starts with this quote, and what follows it.
fn quoted(text: &str, quote: char) -> Option<(String, &str)> {
    let mut string = String::new();
    let mut chars = text.char_indices().skip(1);
    while let Some((index, c)) = chars.next() {
        match c {
            _ if c == quote => {
                return Some((string, text[index + quote.len_utf8()..].trim_start()));
            }
            '\\' => string.push(escape(chars.next()?.1)),
            _ => string.push(c),
        }
    }
    None
}

fn escape(c: char) -> char {
    match c {
        'n' => '\n',
        't' => '\t',
        'r' => '\r',
        other => other,
    }
}

fn default(field_type: &FieldType<TypeName>, text: &str) -> Option<Value> {
    if field_type.shape == Shape::Single {
        return scalar(&field_type.element, text);
    }
    let items = items(text.strip_prefix('[')?.strip_suffix(']')?.trim())?;
    let fits = match field_type.shape {
        Shape::Array(length) => items.len() == length,
        Shape::Sequence(bound) => bound.is_none_or(|bound| items.len() <= bound),
        Shape::Single => false,
    };
    let values = items.iter().map(|item| scalar(&field_type.element, item));
    fits.then(|| array(&field_type.element, values))?
}

/// The texts between commas that are not within quotes.
fn items(mut text: &str) -> Option<Vec<String>> {
    let mut items = Vec::new();
    while !text.is_empty() {
        let quote = text.chars().next().filter(|c| matches!(c, '"' | '\''));
        let rest = match quote {
            Some(quote) => {
                let rest = quoted(text, quote)?.1;
                items.push(text[..text.len() - rest.len()].trim_end().into());
                rest
            }
            None => {
                let end = text.find(',').unwrap_or(text.len());
                items.push(text[..end].trim_end().into());
                &text[end..]
            }
        };
        text = match rest.strip_prefix(',') {
            Some(more) => more.trim_start(),
            None if rest.is_empty() => rest,
            None => return None,
        };
    }
    Some(items)
}

fn array(
    element: &Element<TypeName>,
    values: impl Iterator<Item = Option<Value>>,
) -> Option<Value> {
    let values = values.collect::<Option<Vec<_>>>()?;
    if let Element::Number(number) = element {
        let mut numbers = number.zeros(0);
        let all = values
            .into_iter()
            .all(|value| matches!(value, Value::Number(number) if numbers.push(number)));
        return all.then_some(Value::Array(Array::Numbers(numbers)));
    }
    let strings = values.into_iter().map(|value| match value {
        Value::String(text) => Some(text),
        _ => None,
    });
    strings
        .collect::<Option<Vec<_>>>()
        .map(|strings| Value::Array(Array::Strings(strings)))
}
