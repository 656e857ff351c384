//! The TOML file that says what tags of a description say, for any robot.

use toml_edit::{ImDocument, Item, TableLike};

use super::controllers::{of_type, with};
use super::gazebo::sensor_of;
use super::notes::{Notes, line_at};
use super::tree::{Node, Tree};
use super::{Command, Interface};
use crate::limits;
use crate::report::{Parsed, Warning, WarningKind};
use crate::xml::short;

/// What a TOML file says about sensors and controllers.
///
/// # Errors
/// When it is no TOML; with the line.
pub fn of_toml(bytes: &[u8]) -> Result<Parsed<Interface>, Warning> {
    let refused = |line, message: String| Warning {
        line,
        element: "TOML".to_owned(),
        message,
        kind: WarningKind::NotUnderstood,
    };
    if bytes.len() > limits::BYTES {
        return Err(refused(1, "the file is too long".to_owned()));
    }
    let text = String::from_utf8_lossy(bytes);
    let document = ImDocument::parse(text.as_ref()).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        refused(line_at(&text, at), error.message().to_owned())
    })?;
    let root = Tree::new(1, table(document.as_table(), &text));
    let mut notes = Notes::default();
    let interface = interface(&root, &mut notes);
    Ok(notes.finish(interface))
}

fn line_of(span: Option<std::ops::Range<usize>>, text: &str) -> u32 {
    line_at(text, span.map_or(0, |span| span.start))
}

fn table(table: &dyn TableLike, text: &str) -> Node {
    let entry = |(name, item): (&str, &Item)| {
        let span = table.key(name).and_then(|key| key.span()).or(item.span());
        (
            name.to_owned(),
            Tree::new(line_of(span, text), item_node(item, text)),
        )
    };
    Node::Table(table.iter().map(entry).collect())
}

fn item_node(item: &Item, text: &str) -> Node {
    match item {
        Item::None => Node::Nothing,
        Item::Value(value) => value_node(value, text),
        Item::Table(inner) => table(inner, text),
        Item::ArrayOfTables(tables) => {
            let tree = |inner: &toml_edit::Table| {
                Tree::new(line_of(inner.span(), text), table(inner, text))
            };
            Node::List(tables.iter().map(tree).collect())
        }
    }
}

fn value_node(value: &toml_edit::Value, text: &str) -> Node {
    use toml_edit::Value;
    match value {
        Value::String(string) => Node::Text(string.value().clone()),
        Value::Integer(number) => Node::Number(*number.value() as f64),
        Value::Float(number) => Node::Number(*number.value()),
        Value::Boolean(flag) => Node::Flag(*flag.value()),
        Value::Datetime(date) => Node::Text(date.value().to_string()),
        Value::InlineTable(inner) => table(inner, text),
        Value::Array(array) => {
            let tree =
                |value: &Value| Tree::new(line_of(value.span(), text), value_node(value, text));
            Node::List(array.iter().map(tree).collect())
        }
    }
}

fn interface(root: &Tree, notes: &mut Notes) -> Interface {
    let mut interface = Interface::default();
    for (key, value) in root.entries() {
        match (key.as_str(), &value.node) {
            ("namespace", Node::Text(text)) => interface.namespace = Some(text.clone()),
            ("model", Node::Text(text)) => interface.model = Some(text.clone()),
            ("parameters", Node::Text(file)) => interface.parameter_files.push((file.clone(), value.line)),
            ("sensor" | "controller", Node::List(items)) => {
                for item in items {
                    read_part(key, item, &mut interface, notes);
                }
            }
            ("joint", Node::List(items)) => {
                for item in items {
                    read_joint(item, &mut interface, notes);
                }
            }
            _ => notes.add(
                value.line,
                key,
                "is not understood: there are namespace, model, parameters, [[sensor]], [[controller]] and [[joint]]",
            ),
        }
    }
    interface
}

fn text<'a>(tree: &'a Tree, key: &str) -> &'a str {
    tree.get(key).and_then(Tree::text).unwrap_or_default()
}

fn read_part(what: &str, tree: &Tree, interface: &mut Interface, notes: &mut Notes) {
    let (kind, name) = (text(tree, "type"), text(tree, "name"));
    if kind.is_empty() || name.is_empty() {
        return notes.add(tree.line, what, "needs a name and a type");
    }
    let part = if what == "controller" {
        of_type(kind, name, tree.line, notes)
    } else {
        let part = sensor_of(kind, name, tree.line);
        if part.is_none() {
            let message = format!(
                "'{}': the type '{}' is not understood",
                short(name),
                short(kind)
            );
            notes.add(tree.line, what, message);
        }
        part
    };
    let entries = tree.entries().iter().filter(|(key, _)| key != "name");
    let parameters = Tree::new(tree.line, Node::Table(entries.cloned().collect()));
    interface
        .parts
        .extend(part.and_then(|part| with(part, std::iter::once(&parameters), notes)));
}

/// `[[joint]]`: a name, what it is told, bounds, and where it is at first.
fn read_joint(tree: &Tree, interface: &mut Interface, notes: &mut Notes) {
    let joint = text(tree, "name");
    let kind = tree
        .get("command")
        .map_or("", |command| command.text().unwrap_or("?"));
    if joint.is_empty() || !matches!(kind, "" | "position" | "velocity" | "effort") {
        let message = "needs a name, and a command that is position, velocity or effort";
        return notes.add(tree.line, "joint", message);
    }
    for (key, value) in tree.entries() {
        if !matches!(key.as_str(), "name" | "command" | "min" | "max" | "initial") {
            notes.add(
                value.line,
                key,
                "is no parameter of a joint that is understood",
            );
        }
    }
    let number = |key| {
        tree.get(key)
            .and_then(Tree::number)
            .filter(|number| number.is_finite())
    };
    interface.commands.push(Command {
        joint: joint.to_owned(),
        interface: kind.to_owned(),
        range: ["min", "max"].map(number),
        initial: number("initial"),
        line: tree.line,
    });
}
