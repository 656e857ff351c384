//! Elements of XML become parameters, by their paths.

use bounded_xml::Node;

use super::notes::Notes;
use super::{Part, Value};
use crate::xml::{Source, elements, short};

/// What becomes of an element.
#[derive(Debug, Clone, Copy)]
pub(super) enum To {
    /// A parameter.
    Key(&'static str),
    /// A number in another unit: times a factor.
    Scaled(&'static str, f64),
    /// Nothing: it has no meaning in this simulation, or is the default.
    Nothing,
    /// Nothing, if it is zero or false: there is no such thing here.
    Zero,
    /// `a:=b`, by the names of topics.
    Remapping(&'static [(&'static str, &'static str)]),
}

/// The path of an element inside of its sensor or plugin, and what becomes of it.
pub(super) type Rule = (&'static str, To);

/// Rules whose paths live as long.
type Rules<'a> = &'a [&'a [(&'a str, To)]];

/// Reads the elements inside of one, by rules; others are reported.
pub(super) fn apply(part: &mut Part, root: Node, rules: Rules, source: &Source, notes: &mut Notes) {
    below(part, root, "", rules, source, notes);
}

fn below(
    part: &mut Part,
    node: Node,
    path: &str,
    rules: Rules,
    source: &Source,
    notes: &mut Notes,
) {
    for child in elements(node) {
        let name = child.tag_name().name();
        let path = if path.is_empty() {
            name.to_owned()
        } else {
            format!("{path}/{name}")
        };
        let inside = format!("{path}/");
        let all = || rules.iter().flat_map(|rules| rules.iter());
        if let Some((_, to)) = all().find(|(rule, _)| *rule == path) {
            set(part, child, *to, source, notes);
        } else if all().any(|(rule, _)| rule.starts_with(&inside)) {
            below(part, child, &path, rules, source, notes);
        } else {
            let parent = short(node.tag_name().name());
            notes.add(
                source.line(child),
                name,
                format!("not understood inside of <{parent}>"),
            );
        }
    }
}

fn set(part: &mut Part, node: Node, to: To, source: &Source, notes: &mut Notes) {
    let text = node.text().unwrap_or_default().trim();
    let (key, factor) = match to {
        To::Nothing => return,
        To::Zero => return report_unless_zero(node, text, source, notes),
        To::Key(key) => (key, 1.0),
        To::Scaled(key, factor) => (key, factor),
        To::Remapping(names) => return remap(part, node, text, names, source, notes),
    };
    let Some(form) = part.kind.form(key) else {
        return;
    };
    match form.read_text(text) {
        Ok(Some(value)) => add(part, key, scaled(value, factor)),
        Ok(None) => {}
        Err(needed) => notes.add(
            source.line(node),
            node.tag_name().name(),
            format!("has '{}', where {needed}", short(text)),
        ),
    }
}

fn report_unless_zero(node: Node, text: &str, source: &Source, notes: &mut Notes) {
    let is_zero = text.parse() == Ok(0.0) || text.eq_ignore_ascii_case("false");
    if !is_zero && !text.is_empty() {
        let message = format!("has '{}', which has no effect", short(text));
        notes.add(source.line(node), node.tag_name().name(), message);
    }
}

fn scaled(value: Value, factor: f64) -> Value {
    match value {
        Value::Number(number) => Value::Number(number * factor),
        other => other,
    }
}

/// Elements that may be there several times add to each other; of others the last one counts.
fn add(part: &mut Part, key: &str, value: Value) {
    match (part.values.get_mut(key), value) {
        (Some(Value::Texts(texts)), Value::Texts(more)) => texts.extend(more),
        (_, value) => drop(part.values.insert(key.to_owned(), value)),
    }
}

fn remap(
    part: &mut Part,
    node: Node,
    text: &str,
    names: &[(&str, &str)],
    source: &Source,
    notes: &mut Notes,
) {
    let found = text.split_once(":=").and_then(|(from, to)| {
        let from = from.trim().trim_start_matches("~/");
        let (_, key) = names.iter().find(|(name, _)| *name == from)?;
        Some((*key, to.trim()))
    });
    match found {
        Some((key, topic)) if !topic.is_empty() => part.set_text(key, topic.to_owned()),
        _ => notes.add(
            source.line(node),
            node.tag_name().name(),
            format!("the remapping '{}' is not understood", short(text)),
        ),
    }
}
