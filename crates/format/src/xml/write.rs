//! Converts nodes of chunks to elements, by the tables.

use base64::Engine;
use geometry::pose::euler::rotation_to_euler;

use super::arrays;
use super::read::{CODED, get};
use super::table::{Kind, Row, Unit, rows, word_of};
use crate::ttt::Node;
use crate::ttt::chunks::MeshPool;
use crate::ttt::unit_quaternion;

const REVOLUTE: i64 = 10;

/// An element to be written.
#[derive(Debug, Default)]
pub(super) struct Item {
    name: String,
    text: String,
    /// The text is in CDATA sections.
    is_data: bool,
    children: Vec<Item>,
}

impl Item {
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..Self::default()
        }
    }

    /// A new child.
    pub(super) fn push(&mut self, name: &str) -> &mut Item {
        self.children.push(Item::new(name));
        self.children.last_mut().expect("a child was just pushed")
    }

    pub(super) fn leaf(&mut self, name: &str, text: impl Into<String>) {
        self.push(name).text = text.into();
    }

    /// The element at the end of a way, with those on the way.
    pub(super) fn at(&mut self, way: &[&str]) -> &mut Item {
        let Some((first, rest)) = way.split_first() else {
            return self;
        };
        let known = self.children.iter().position(|child| child.name == *first);
        let at = known.unwrap_or(self.children.len());
        if known.is_none() {
            self.children.push(Item::new(first));
        }
        self.children[at].at(rest)
    }

    pub(super) fn print(&self) -> String {
        let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n".to_owned();
        self.print_at(&mut out, 0);
        out
    }

    fn print_at(&self, out: &mut String, depth: usize) {
        let (indent, name) = ("  ".repeat(depth), &self.name);
        if self.children.is_empty() {
            let text = if self.is_data {
                data(&self.text)
            } else {
                escaped(&self.text)
            };
            out.push_str(&format!("{indent}<{name}>{text}</{name}>\n"));
            return;
        }
        out.push_str(&format!("{indent}<{name}>\n"));
        self.children
            .iter()
            .for_each(|child| child.print_at(out, depth + 1));
        out.push_str(&format!("{indent}</{name}>\n"));
    }
}

/// In a CDATA section. An end mark in the text is written outside of it.
fn data(text: &str) -> String {
    let pieces: Vec<String> = text
        .split("]]>")
        .map(|piece| format!("<![CDATA[\n{piece}\n]]>"))
        .collect();
    pieces.join("]]&gt;")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('\r', "&#13;")
}

/// State while a file is written.
pub(super) struct Writing<'a> {
    pub simple: bool,
    pub pool: &'a MeshPool,
    /// How an object or a collection is referred to, by its handle.
    pub names: std::collections::BTreeMap<i64, String>,
}

impl Writing<'_> {
    /// Writes the fields of a section into an element.
    pub(super) fn section(&self, name: &str, node: &Node, out: &mut Item) {
        for row in rows(name).iter().filter(|row| row.is_in(self.simple)) {
            if let (Some(way), Some(value)) = (row.elements.first(), get(node, &row.field)) {
                self.row(row, way, &value, node, out);
            }
        }
    }

    fn row(&self, row: &Row, way: &[&str], value: &Node, node: &Node, out: &mut Item) {
        match (row.kind, way.split_last()) {
            (Kind::Arrays, _) => arrays::write(self.pool, node, out),
            (Kind::Children, _) => self.children(value, out),
            (Kind::Section(section), _) => self.section(section, value, out.at(way)),
            (Kind::Sections(section), Some((last, groups))) => {
                let items = value.list().unwrap_or_default();
                items
                    .iter()
                    .for_each(|item| self.section(section, item, out.at(groups).push(last)));
            }
            (Kind::Text, Some((last, groups))) => text(value, last, out.at(groups)),
            (kind, Some((last, groups))) => {
                if let Some(text) = self.value(kind, value, node) {
                    out.at(groups).leaf(last, text);
                }
            }
            _ => {}
        }
    }

    fn children(&self, children: &Node, out: &mut Item) {
        for child in children.list().unwrap_or_default() {
            match child.get("group") {
                Some(group) => self.section("MeshNode", group, out.push("compound")),
                None => self.section("Mesh", child, out.push("mesh")),
            }
        }
    }

    /// The text of a value; nothing where the variant has none for it.
    fn value(&self, kind: Kind, value: &Node, node: &Node) -> Option<String> {
        Some(match kind {
            Kind::Numbers(unit, _) => self.numbers(unit, value, node)?,
            Kind::Bits(mask, inverted) => ((value.int().ok()? & mask != 0) != inverted).to_string(),
            Kind::Word(words) => word_of(words, value.int().ok()?)
                .map_or(value.int().ok()?.to_string(), str::to_owned),
            Kind::Alias if self.simple => self.names.get(&handle(node)?)?.clone(),
            Kind::Alias => string(value)?,
            Kind::Texts => value
                .list()
                .ok()?
                .iter()
                .filter_map(string)
                .collect::<Vec<_>>()
                .join(";"),
            Kind::Blob | Kind::Pixels => {
                base64::engine::general_purpose::STANDARD.encode(value.bytes().ok()?)
            }
            Kind::Euler => {
                let [w, x, y, z] = value
                    .items()
                    .ok()?
                    .each_ref()
                    .map(|part| part.real().unwrap_or(0.0));
                let angles = rotation_to_euler(&unit_quaternion([w, x, y, z]));
                angles.map(|angle| number(angle.to_degrees())).join(" ")
            }
            Kind::Reference => match value.int().ok()? {
                handle if handle < 0 => handle.to_string(),
                handle => self.names.get(&handle)?.clone(),
            },
            Kind::Text | Kind::Section(_) | Kind::Sections(_) | Kind::Children | Kind::Arrays => {
                return None;
            }
        })
    }

    pub(super) fn numbers(&self, unit: Unit, value: &Node, node: &Node) -> Option<String> {
        if let Node::List(items) = value {
            let all = items
                .iter()
                .map(|item| self.numbers(unit, item, node))
                .collect::<Option<Vec<String>>>()?;
            return Some(all.join(" "));
        }
        let turns = node
            .get("joint_type")
            .is_none_or(|found| *found == Node::Int(REVOLUTE));
        let real = value.real().ok()?;
        Some(match unit {
            Unit::Int => value.int().ok()?.to_string(),
            Unit::Degrees => number(real.to_degrees()),
            Unit::Motion if turns => number(real.to_degrees()),
            Unit::Colour if self.simple => (real * 255.0).round().to_string(),
            Unit::Real | Unit::Motion | Unit::Colour => match value {
                Node::Single(single) => single.to_string(),
                _ => number(real),
            },
        })
    }
}

/// The handle of an object, out of the node of what all have.
fn handle(node: &Node) -> Option<i64> {
    node.get("handles")?.list().ok()?.first()?.int().ok()
}

fn string(node: &Node) -> Option<String> {
    node.bytes().ok().map(|bytes| crate::ttt::decode(&bytes))
}

/// All digits it has.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// The texts of scripts are CDATA sections; bytes that XML cannot contain are encoded.
fn text(value: &Node, name: &str, out: &mut Item) {
    let Ok(bytes) = value.bytes() else { return };
    let holdable = |text: &str| {
        !text
            .chars()
            .any(|c| c.is_control() && !matches!(c, '\t' | '\n' | '\r'))
    };
    match String::from_utf8(bytes) {
        Ok(text) if holdable(&text) => {
            let item = out.push(name);
            (item.text, item.is_data) = (text, matches!(value, Node::Script(_)));
        }
        Ok(text) => out.leaf(
            &format!("{name}{CODED}"),
            base64::engine::general_purpose::STANDARD.encode(text),
        ),
        Err(error) => {
            let coded = base64::engine::general_purpose::STANDARD.encode(error.as_bytes());
            out.leaf(&format!("{name}{CODED}"), coded);
        }
    }
}
