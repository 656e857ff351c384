//! Converts elements to nodes of chunks, by the tables.

use std::collections::BTreeMap;

use base64::Engine;
use geometry::pose::euler::rotation_from_euler;

use super::document::Element;
use super::side_files::SideFiles;
use super::table::{Count, Kind, Row, Step, Unit, number_of, rows};
use crate::ttt::chunks::MeshPool;
use crate::ttt::{FileError, FileResult, Node};

/// Deeper groups of meshes are as wrong here as in binary files.
const MAX_GROUPS: usize = 90;
const REVOLUTE: i64 = 10;
/// How the names of elements end whose bytes are coded in base64.
pub(super) const CODED: &str = "_base64Coded";

/// State while a document is read.
pub(super) struct Reading<'a> {
    pub simple: bool,
    /// Objects and collections by what refers to them.
    pub references: BTreeMap<String, i32>,
    pub side_files: SideFiles<'a>,
    pub pool: MeshPool,
    pub groups: usize,
}

impl Reading<'_> {
    /// Fields of a section in the element.
    ///
    /// # Errors
    /// When a value has the wrong type or form.
    pub(super) fn section(&mut self, name: &str, element: Element<'_>) -> FileResult<Node> {
        element.mark();
        let mut node = Node::Table(Vec::new());
        let rows: Vec<&Row> = rows(name)
            .iter()
            .filter(|row| row.is_in(self.simple))
            .collect();
        let mut missing = Vec::new();
        for row in rows {
            if !self.row(row, element, &mut node)? {
                missing.push(row);
            }
        }
        for row in missing {
            if let Some((text, always)) = row.default
                && (always || has_root(&node, &row.field))
            {
                let value = self
                    .value(row.kind, text, &node)
                    .map_err(|what| element.error(what))?;
                put_value(&mut node, row, value);
            }
        }
        Ok(node)
    }

    /// Whether the element of a row was there.
    fn row(&mut self, row: &Row, element: Element<'_>, node: &mut Node) -> FileResult<bool> {
        if let Kind::Sections(section) = row.kind {
            return self.sections(section, row, element, node);
        }
        let found = row.elements.iter().find_map(|way| element.find(way));
        let Some(found) = found.or_else(|| coded(row, element)) else {
            return Ok(false);
        };
        match row.kind {
            Kind::Section(section) => put(node, &row.field, self.section(section, found)?),
            Kind::Children => self.children(found, node)?,
            Kind::Arrays => self.arrays(found, node)?,
            Kind::Reference => {
                let text = found.text();
                let known = self.reference(text.trim());
                put(node, &row.field, Node::Int(known.unwrap_or(-1).into()));
                if known.is_none() {
                    // An element that is not marked is reported.
                    return Ok(true);
                }
            }
            Kind::Pixels
                if found.attribute("name").is_some() || found.named("file").next().is_some() =>
            {
                self.picture(found, node)?;
            }
            Kind::Text if found.name().ends_with(CODED) => put(node, &row.field, of_base64(found)?),
            kind => {
                let value = self
                    .value(kind, &found.text(), node)
                    .map_err(|what| found.error(what))?;
                put_value(node, row, value);
            }
        }
        found.mark();
        Ok(true)
    }

    fn sections(
        &mut self,
        section: &str,
        row: &Row,
        element: Element<'_>,
        node: &mut Node,
    ) -> FileResult<bool> {
        let Some((last, groups)) = row.elements.first().and_then(|way| way.split_last()) else {
            return Ok(false);
        };
        let Some(group) = element.find(groups) else {
            return Ok(false);
        };
        let items = group
            .mark()
            .named(last)
            .map(|item| self.section(section, item))
            .collect::<FileResult<Vec<_>>>()?;
        let any = !items.is_empty();
        if any || row.field.is_empty() {
            put(node, &row.field, Node::List(items));
        }
        Ok(any)
    }

    fn children(&mut self, group: Element<'_>, node: &mut Node) -> FileResult<()> {
        self.groups += 1;
        if self.groups > MAX_GROUPS {
            return Err(group.error("groups of meshes are nested too deeply"));
        }
        let mut items = Vec::new();
        for child in group.children() {
            match child.name() {
                "mesh" => items.push(self.section("Mesh", child)?),
                "compound" => {
                    items.push(Node::table([("group", self.section("MeshNode", child)?)]));
                }
                _ => {}
            }
        }
        self.groups -= 1;
        if !items.is_empty() {
            put(node, &[Step::Name("children")], Node::List(items));
        }
        Ok(())
    }

    fn reference(&self, name: &str) -> Option<i32> {
        match self.references.get(name) {
            Some(handle) => Some(*handle),
            None => name.parse().ok().filter(|handle| *handle < 0),
        }
    }

    fn value(&self, kind: Kind, text: &str, node: &Node) -> Result<Node, String> {
        Ok(match kind {
            Kind::Numbers(unit, count) => self.numbers(unit, count, text, node)?,
            Kind::Bits(..) => Node::Int(truth(text)?.into()),
            Kind::Word(words) => Node::Int(word(words, text)?),
            Kind::Alias if self.simple => {
                Node::Text(text.trim().split('*').next().unwrap_or_default().to_owned())
            }
            Kind::Alias | Kind::Text => Node::Text(text.to_owned()),
            Kind::Texts => {
                let texts = text.split(';').filter(|text| !text.is_empty());
                Node::List(texts.map(|text| Node::Text(text.to_owned())).collect())
            }
            Kind::Blob | Kind::Pixels => Node::Bytes(bytes_of(text)?),
            Kind::Euler => {
                let angles = numbers::<3>(text)?.map(f64::to_radians);
                let q = rotation_from_euler(&angles);
                Node::List([q.w, q.i, q.j, q.k].map(Node::Real).to_vec())
            }
            Kind::Reference => Node::Int(whole(text)?),
            Kind::Section(_) | Kind::Sections(_) | Kind::Children | Kind::Arrays => {
                return Err("an element has no value of its own".into());
            }
        })
    }

    fn numbers(&self, unit: Unit, count: Count, text: &str, node: &Node) -> Result<Node, String> {
        let turns = node
            .get("joint_type")
            .is_none_or(|found| *found == Node::Int(REVOLUTE));
        let one = |text: &str| {
            Ok(match unit {
                Unit::Int => Node::Int(whole(text)?),
                Unit::Real => Node::Real(real(text)?),
                Unit::Degrees => Node::Real(real(text)?.to_radians()),
                Unit::Motion => Node::Real(if turns {
                    real(text)?.to_radians()
                } else {
                    real(text)?
                }),
                Unit::Colour => Node::Real(if self.simple {
                    real(text)? / 255.0
                } else {
                    real(text)?
                }),
            })
        };
        let all = || {
            text.split_ascii_whitespace()
                .map(one)
                .collect::<Result<Vec<Node>, String>>()
        };
        match count {
            Count::One => one(text.trim()),
            Count::Any => all().map(Node::List),
            Count::Exactly(count) => match all()? {
                items if items.len() == count => Ok(Node::List(items)),
                items => Err(format!(
                    "{count} numbers are needed, {} are there",
                    items.len()
                )),
            },
        }
    }
}

/// Text that XML cannot represent is in an element of its own.
fn coded<'a>(row: &Row, element: Element<'a>) -> Option<Element<'a>> {
    let (last, groups) = row
        .elements
        .first()
        .filter(|_| row.kind == Kind::Text)?
        .split_last()?;
    element
        .find(groups)?
        .named(&format!("{last}{CODED}"))
        .next()
}

/// Whether anything of a field is there.
fn has_root(node: &Node, field: &[Step]) -> bool {
    match field.first() {
        Some(Step::Name(name)) => node.get(name).is_some(),
        _ => true,
    }
}

/// Puts a value; of bits, those of the row.
fn put_value(node: &mut Node, row: &Row, value: Node) {
    let Kind::Bits(mask, inverted) = row.kind else {
        return put(node, &row.field, value);
    };
    let before = get(node, &row.field)
        .and_then(|bits| bits.int().ok())
        .unwrap_or(0);
    let on = (value == Node::Int(1)) != inverted;
    put(
        node,
        &row.field,
        Node::Int(if on { before | mask } else { before & !mask }),
    );
}

/// The part of a node.
pub(super) fn get(node: &Node, field: &[Step]) -> Option<Node> {
    let Some((step, rest)) = field.split_first() else {
        return Some(node.clone());
    };
    match (step, node) {
        (Step::Name(name), node) => get(node.get(name)?, rest),
        (Step::Item(at), Node::List(items)) => get(items.get(*at)?, rest),
        (Step::Items(first, count), Node::List(items)) => items
            .get(*first..first + count)
            .map(|items| Node::List(items.to_vec())),
        _ => None,
    }
}

/// Puts a part into a node. Lists grow as needed; elements that are still unknown are zero.
pub(super) fn put(node: &mut Node, field: &[Step], value: Node) {
    let Some((step, rest)) = field.split_first() else {
        *node = value;
        return;
    };
    if let Step::Name(name) = step {
        if !matches!(node, Node::Table(_)) {
            *node = Node::Table(Vec::new());
        }
        if let Some(entry) = node.get_mut(name) {
            return put(entry, rest, value);
        }
        let mut entry = Node::Int(0);
        put(&mut entry, rest, value);
        if let Node::Table(entries) = node {
            entries.push(((*name).to_owned(), entry));
        }
        return;
    }
    if !matches!(node, Node::List(_)) {
        *node = Node::List(Vec::new());
    }
    let Node::List(items) = node else { return };
    let (first, count) = match step {
        Step::Items(first, count) => (*first, *count),
        Step::Item(at) => (*at, 1),
        Step::Name(_) => return,
    };
    items.resize(items.len().max(first + count), Node::Int(0));
    match (step, value) {
        (Step::Items(..), Node::List(values)) => {
            items[first..first + count]
                .iter_mut()
                .zip(values)
                .for_each(|(item, value)| *item = value);
        }
        (_, value) => put(&mut items[first], rest, value),
    }
}

fn truth(text: &str) -> Result<bool, String> {
    match text.trim() {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        other => Err(format!("'{}' is neither true nor false", short(other))),
    }
}

fn whole(text: &str) -> Result<i64, String> {
    let number = text.trim().parse::<i32>();
    number
        .map(i64::from)
        .map_err(|_| format!("'{}' is no whole number", short(text.trim())))
}

fn real(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .map_err(|_| format!("'{}' is no number", short(text.trim())))
}

/// As many numbers as a thing has.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let all = text
        .split_ascii_whitespace()
        .map(real)
        .collect::<Result<Vec<f64>, String>>()?;
    all.try_into()
        .map_err(|all: Vec<f64>| format!("{N} numbers are needed, {} are there", all.len()))
}

/// A word of an enumeration, or any number in its place.
pub(super) fn word(words: &str, text: &str) -> Result<i64, String> {
    let text = text.trim();
    let known = number_of(words, text).map_or_else(|| whole(text), Ok);
    known.map_err(|_| format!("'{}' is unknown here", short(text)))
}

fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

fn bytes_of(text: &str) -> Result<Vec<u8>, String> {
    let text: String = text.split_ascii_whitespace().collect();
    base64::engine::general_purpose::STANDARD
        .decode(text)
        .map_err(|error| format!("it is not in base64: {error}"))
}

pub(super) fn of_base64(element: Element<'_>) -> Result<Node, FileError> {
    bytes_of(&element.text())
        .map(Node::Bytes)
        .map_err(|what| element.error(what))
}
