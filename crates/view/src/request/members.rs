//! Members of requests: each is checked, and what is wrong is said.

use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use serde_json::{Map, Value};

use crate::edit::Files;

/// Code and texts of a page, bytes.
const MAX_TEXT_LENGTH: usize = 100_000;
/// Handles in one request.
const MAX_HANDLES: usize = 100_000;
/// Steps of one request.
const MAX_STEPS: i64 = 1_000_000;

/// Members of a request.
pub(super) type Members = Map<String, Value>;

/// Lua, where nothing is said.
pub(super) fn is_python(members: &Members) -> Result<bool, String> {
    let said = members.get("language").map_or(Some("lua"), Value::as_str);
    [false, true]
        .into_iter()
        .find(|is_python| said == Some(language(*is_python)))
        .ok_or_else(|| "`language` is `lua` or `python`".to_owned())
}

pub(super) const fn language(is_python: bool) -> &'static str {
    if is_python { "python" } else { "lua" }
}

/// The number that changes have in common which are one step of undo.
pub(super) fn gesture(members: &Members) -> Option<u64> {
    members.get("gesture").and_then(Value::as_u64)
}

/// Whether what other pages have done is meant as well.
pub(super) fn others(members: &Members) -> bool {
    members.get("others").and_then(Value::as_bool) != Some(false)
}

pub(super) fn shortened(text: &str) -> &str {
    text.char_indices()
        .nth(50)
        .map_or(text, |(end, _)| &text[..end])
}

pub(super) fn count(members: &Members) -> Result<i64, String> {
    let Some(count) = members.get("count") else {
        return Ok(1);
    };
    let is_count = |count: &i64| *count != 0 && (-MAX_STEPS..=MAX_STEPS).contains(count);
    let count = count.as_i64().filter(is_count);
    count.ok_or_else(|| format!("`count` is a whole number, 1 to {MAX_STEPS}, or below zero"))
}

pub(super) fn frame(members: &Members) -> Result<usize, String> {
    let frame = members.get("frame").and_then(Value::as_u64);
    let frame = frame.and_then(|frame| usize::try_from(frame).ok());
    frame.ok_or_else(|| "`frame` is a whole number, zero or more".to_owned())
}

pub(super) fn factor(members: &Members) -> Result<f64, String> {
    let factor = members.get("factor").and_then(Value::as_f64);
    let factor = factor.filter(|factor| *factor == 0.0 || (0.001..=100.0).contains(factor));
    factor.ok_or_else(|| "`factor` is 0, or a number from 0.001 to 100".to_owned())
}

pub(super) fn handle(members: &Members) -> Result<i64, String> {
    members
        .get("handle")
        .and_then(Value::as_i64)
        .ok_or_else(|| "`handle` is a whole number".to_owned())
}

pub(super) fn handles(members: &Members) -> Result<Vec<i64>, String> {
    let wrong = || "`handles` is a list of whole numbers".to_owned();
    let list = members
        .get("handles")
        .and_then(Value::as_array)
        .ok_or_else(wrong)?;
    if list.len() > MAX_HANDLES {
        return Err(format!("`handles` has at most {MAX_HANDLES} items"));
    }
    list.iter()
        .map(Value::as_i64)
        .collect::<Option<_>>()
        .ok_or_else(wrong)
}

pub(super) fn text(members: &Members, name: &str) -> Result<String, String> {
    text_up_to(members, name, MAX_TEXT_LENGTH)
}

pub(super) fn text_up_to(members: &Members, name: &str, length: usize) -> Result<String, String> {
    let text = members
        .get(name)
        .and_then(Value::as_str)
        .ok_or_else(|| format!("`{name}` is a text"))?;
    if text.len() > length {
        return Err(format!("`{name}` is too long"));
    }
    Ok(text.to_owned())
}

pub(super) fn flag(members: &Members, name: &str) -> Result<bool, String> {
    members
        .get(name)
        .and_then(Value::as_bool)
        .ok_or_else(|| format!("`{name}` is true or false"))
}

/// Three numbers; None where there are none, or null.
pub(super) fn point(members: &Members, name: &str) -> Result<Option<[f64; 3]>, String> {
    let wrong = || format!("`{name}` is a list of 3 numbers");
    let Some(list) = members.get(name).filter(|list| !list.is_null()) else {
        return Ok(None);
    };
    let numbers: Option<Vec<f64>> = list
        .as_array()
        .ok_or_else(wrong)?
        .iter()
        .map(Value::as_f64)
        .collect();
    let point = numbers.and_then(|numbers| numbers.try_into().ok());
    point.map(Some).ok_or_else(wrong)
}

/// Bytes in base64.
pub(super) fn bytes(value: Option<&Value>) -> Result<Vec<u8>, String> {
    let text = value.and_then(Value::as_str);
    let bytes = text.and_then(|text| BASE64.decode(text).ok());
    bytes.ok_or_else(|| "`data` is a text in base64".to_owned())
}

/// The files of a captured request; a page sends them before.
pub(super) fn files(members: &Members) -> Result<Arc<Files>, String> {
    let Some(files) = members.get("files").and_then(Value::as_object) else {
        return Ok(Arc::default());
    };
    let decoded = files
        .iter()
        .map(|(name, data)| Ok((name.clone(), bytes(Some(data))?)));
    decoded.collect::<Result<Files, String>>().map(Arc::new)
}
