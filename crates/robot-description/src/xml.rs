//! Elements with lines, numbers that are written in odd ways, and the warnings about them.

use bounded_xml::{Document, DocumentType, Error, Node};

use crate::limits;
use crate::report::{Parsed, ReadError, Warning, WarningKind};

/// Numbers beyond are taken for errors: what is computed from them would not be finite.
const MAX_NUMBER: f64 = 1e100;

/// The text of a file, without blanks and zero bytes around it. Bytes that are no UTF-8 are replaced.
pub fn text_of(bytes: &[u8]) -> Result<String, ReadError> {
    if bytes.len() > limits::BYTES {
        return Err(ReadError::TooLong(bytes.len()));
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    Ok(text
        .trim_end_matches(|c: char| c == '\0' || c.is_whitespace())
        .to_owned())
}

/// How many lines [`text_of`] takes away.
pub fn lines_before(bytes: &[u8]) -> u32 {
    let blank = |byte: &&u8| byte.is_ascii_whitespace() || [0xef, 0xbb, 0xbf].contains(*byte);
    bytes
        .iter()
        .take_while(blank)
        .filter(|byte| **byte == b'\n')
        .count() as u32
}

/// The tree of elements. A document type is accepted, entities of its own are not.
pub fn document(text: &str, lines_before: u32) -> Result<Document<'_>, ReadError> {
    bounded_xml::parse(text, limits::NODES, DocumentType::WithoutEntities).map_err(|error| {
        match error {
            Error::TooManyAttributes { line } => ReadError::TooManyAttributes {
                line: line + lines_before,
            },
            Error::TooManyNamespaces => ReadError::TooManyNamespaces,
            Error::TooManyNodes => ReadError::TooManyNodes,
            Error::Entities { line } | Error::DocumentType { line } => ReadError::Entities {
                line: line + lines_before,
            },
            Error::Syntax { line, message } => {
                ReadError::Xml(format!("line {}: {message}", line + lines_before))
            }
        }
    })
}

/// Reads elements and collects warnings.
pub struct Source {
    /// Where each line begins.
    lines: Vec<usize>,
    lines_before: u32,
    warnings: Vec<Warning>,
    further: usize,
}

impl Source {
    pub fn new(text: &str, lines_before: u32) -> Self {
        let ends = text
            .bytes()
            .enumerate()
            .filter(|(_, byte)| *byte == b'\n')
            .map(|(at, _)| at + 1);
        Self {
            lines: std::iter::once(0).chain(ends).collect(),
            lines_before,
            warnings: Vec::new(),
            further: 0,
        }
    }

    pub fn finish<T>(self, value: T) -> Parsed<T> {
        let mut warnings = self.warnings;
        warnings.sort_by_key(|warning| warning.line);
        Parsed {
            value,
            warnings,
            further_warnings: self.further,
        }
    }

    pub fn line(&self, node: Node) -> u32 {
        let line = self
            .lines
            .partition_point(|start| *start <= node.range().start);
        u32::try_from(line)
            .unwrap_or(u32::MAX)
            .saturating_add(self.lines_before)
    }

    /// Something is wrong, and was read as the message says.
    pub fn warn(&mut self, node: Node, message: impl Into<String>) {
        self.report(node, WarningKind::Corrected, message.into());
    }

    /// Something is left out.
    pub fn leave_out(&mut self, node: Node, message: impl Into<String>) {
        self.report(node, WarningKind::NotUnderstood, message.into());
    }

    fn report(&mut self, node: Node, kind: WarningKind, message: String) {
        if self.warnings.len() >= limits::WARNINGS {
            self.further += 1;
            return;
        }
        let line = self.line(node);
        self.warnings.push(Warning {
            line,
            element: short(node.tag_name().name()),
            message,
            kind,
        });
    }

    /// The first child of that name; others are reported.
    pub fn child<'a, 'input>(
        &mut self,
        node: Node<'a, 'input>,
        name: &str,
    ) -> Option<Node<'a, 'input>> {
        let mut all = elements(node).filter(|child| child.tag_name().name() == name);
        let first = all.next();
        for further in all {
            self.warn(further, "there is one before it, which counts");
        }
        first
    }

    /// Reports children that are not among the known ones, and text between them.
    pub fn expect_children(&mut self, node: Node, known: &[&str]) {
        for child in node.children() {
            if child.is_element() && !known.contains(&child.tag_name().name()) {
                self.leave_out(
                    child,
                    format!(
                        "not understood inside of <{}>",
                        short(node.tag_name().name())
                    ),
                );
            } else if child.is_text() && child.text().is_some_and(|text| !text.trim().is_empty()) {
                let text = short(child.text().unwrap_or_default().trim());
                self.leave_out(node, format!("the text '{text}' has no meaning here"));
            }
        }
    }

    /// An attribute; one that is not there is reported and empty.
    pub fn required(&mut self, node: Node, attribute: &str) -> String {
        node.attribute(attribute).map_or_else(
            || {
                self.warn(node, format!("has no {attribute}"));
                String::new()
            },
            |text| text.trim().to_owned(),
        )
    }

    /// A number of an attribute, if it is there and one.
    pub fn number(&mut self, node: Node, attribute: &str) -> Option<f64> {
        let text = node.attribute(attribute)?;
        self.numbers_in(node, attribute, text).first().copied()
    }

    /// Numbers of an attribute; those that are not there are the given ones.
    pub fn numbers<const N: usize>(
        &mut self,
        node: Node,
        attribute: &str,
        otherwise: [f64; N],
    ) -> [f64; N] {
        match node.attribute(attribute) {
            Some(text) => self.numbers_of(node, attribute, text, otherwise),
            None => otherwise,
        }
    }

    /// Numbers of a text.
    pub fn numbers_of<const N: usize>(
        &mut self,
        node: Node,
        what: &str,
        text: &str,
        otherwise: [f64; N],
    ) -> [f64; N] {
        let found = self.numbers_in(node, what, text);
        if found.len() != N && !(found.is_empty() && text.trim().is_empty()) {
            self.warn(
                node,
                format!("{what} has {} numbers instead of {N}", found.len()),
            );
        }
        std::array::from_fn(|i| found.get(i).copied().unwrap_or(otherwise[i]))
    }

    fn numbers_in(&mut self, node: Node, what: &str, text: &str) -> Vec<f64> {
        let separator = |c: char| c.is_whitespace() || matches!(c, ',' | '[' | ']' | ';');
        let mut numbers = Vec::new();
        // Longer lists are no list of a robot; the rest is only counted as one too many.
        for word in text
            .split(separator)
            .filter(|word| !word.is_empty())
            .take(64)
        {
            match word.parse::<f64>() {
                Ok(number) if number.abs() <= MAX_NUMBER => numbers.push(number),
                _ => {
                    self.warn(
                        node,
                        format!("{what} has '{}', which is no number", short(word)),
                    );
                    return numbers;
                }
            }
        }
        if text.contains([',', '[', ';']) {
            self.warn(
                node,
                format!("{what} has more than spaces between its numbers"),
            );
        }
        numbers
    }
}

/// The elements inside of an element.
pub fn elements<'a, 'input>(node: Node<'a, 'input>) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children().filter(Node::is_element)
}

/// The elements of that name inside of an element.
pub fn named<'a, 'input: 'a>(
    node: Node<'a, 'input>,
    name: &'a str,
) -> impl Iterator<Item = Node<'a, 'input>> + 'a {
    elements(node).filter(move |child| child.tag_name().name() == name)
}

/// A text that fits into a message.
pub fn short(text: &str) -> String {
    const LENGTH: usize = 60;
    match text.char_indices().nth(LENGTH) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
