//! A text as a tree of elements, each of which knows where it stands. Document types, and so entities of one's own, are refused; depth is
//! bounded; memory is in proportion to the text.

use std::cell::Cell;

use quick_xml::Reader;
use quick_xml::events::{BytesRef, BytesStart, Event};

use crate::ttt::{FileError, FileResult, decode};

/// Deeper elements than any scene has: objects in objects, groups in groups.
const MAX_DEPTH: usize = 1000;

#[derive(Debug, Default)]
struct Node {
    name: String,
    parent: Option<usize>,
    children: Vec<usize>,
    attributes: Vec<(String, String)>,
    /// Its text, without CDATA sections.
    pieces: Vec<(bool, String)>,
    begin: usize,
    end: usize,
    used: Cell<bool>,
}

#[derive(Debug)]
pub(super) struct Document {
    text: String,
    nodes: Vec<Node>,
}

/// An element of a document.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element<'a> {
    document: &'a Document,
    at: usize,
}

impl Document {
    /// # Errors
    /// When the text is no XML: what is wrong, and where.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "positions in a text that is in memory"
    )]
    pub(super) fn parse(bytes: &[u8]) -> FileResult<Self> {
        let text = decode(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
        let mut building = Building {
            text: &text,
            nodes: Vec::new(),
            open: Vec::new(),
        };
        let mut reader = Reader::from_str(&text);
        loop {
            let begin = reader.buffer_position() as usize;
            let event = reader.read_event();
            let event = event
                .map_err(|e| building.error(reader.error_position() as usize, e.to_string()))?;
            let end = reader.buffer_position() as usize;
            if let Event::Eof = event {
                break;
            }
            building
                .take(event, begin, end)
                .map_err(|what| building.error(begin, what))?;
        }
        if !building.open.is_empty() || building.nodes.is_empty() {
            return Err(building.error(text.len(), "the file ends too early".into()));
        }
        let nodes = building.nodes;
        Ok(Self { text, nodes })
    }

    pub(super) fn root(&self) -> Element<'_> {
        Element {
            document: self,
            at: 0,
        }
    }

    /// The outermost elements that were not read.
    pub(super) fn unused(&self) -> impl Iterator<Item = Element<'_>> {
        let unused = self.nodes.iter().enumerate().filter(|(_, node)| {
            !node.used.get()
                && node
                    .parent
                    .is_none_or(|parent| self.nodes[parent].used.get())
        });
        unused.map(|(at, _)| Element { document: self, at })
    }
}

/// A document as it grows.
struct Building<'a> {
    text: &'a str,
    nodes: Vec<Node>,
    open: Vec<usize>,
}

impl Building<'_> {
    fn take(&mut self, event: Event<'_>, begin: usize, end: usize) -> Result<(), String> {
        match event {
            Event::Start(start) => self.start(&start, begin)?,
            Event::Empty(start) => {
                self.start(&start, begin)?;
                self.close(end);
            }
            Event::End(_) => self.close(end),
            Event::Text(text) => self.piece(false, &text)?,
            Event::GeneralRef(reference) => self.piece(false, &resolved(&reference)?)?,
            Event::CData(data) => self.piece(true, &data)?,
            Event::DocType(_) => return Err("document types are not accepted".into()),
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::Eof => {}
        }
        Ok(())
    }

    fn start(&mut self, start: &BytesStart<'_>, begin: usize) -> Result<(), String> {
        if self.open.len() >= MAX_DEPTH {
            return Err("it is nested too deeply".into());
        }
        let parent = self.open.last().copied();
        if parent.is_none() && !self.nodes.is_empty() {
            return Err("there is a second root element".into());
        }
        let mut node = Node {
            name: start.name().as_ref().to_owned(),
            parent,
            begin,
            ..Node::default()
        };
        // The check for doubles would compare each with each.
        for attribute in start.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| error.to_string())?;
            let value =
                quick_xml::escape::unescape(&attribute.value).map_err(|error| error.to_string())?;
            node.attributes
                .push((attribute.key.as_ref().to_owned(), value.into_owned()));
        }
        let at = self.nodes.len();
        self.nodes.push(node);
        if let Some(parent) = parent {
            self.nodes[parent].children.push(at);
        }
        self.open.push(at);
        Ok(())
    }

    fn close(&mut self, end: usize) {
        if let Some(at) = self.open.pop() {
            self.nodes[at].end = end;
        }
    }

    fn piece(&mut self, data: bool, text: &str) -> Result<(), String> {
        let Some(at) = self.open.last() else {
            return if text.trim().is_empty() {
                Ok(())
            } else {
                Err("there is text outside of the elements".into())
            };
        };
        let pieces = &mut self.nodes[*at].pieces;
        match pieces.last_mut() {
            Some((false, last)) if !data => last.push_str(text),
            _ => pieces.push((data, text.to_owned())),
        }
        Ok(())
    }

    fn error(&self, offset: usize, what: String) -> FileError {
        let names: Vec<&str> = self
            .open
            .iter()
            .map(|at| self.nodes[*at].name.as_str())
            .collect();
        error_at(self.text, offset, names.join("/"), what)
    }
}

fn resolved(reference: &BytesRef<'_>) -> Result<String, String> {
    if let Some(character) = reference
        .resolve_char_ref()
        .map_err(|error| error.to_string())?
    {
        return Ok(character.to_string());
    }
    let known = quick_xml::escape::resolve_predefined_entity(reference);
    known
        .map(str::to_owned)
        .ok_or_else(|| format!("the entity `{}` is unknown", &**reference))
}

fn error_at(text: &str, offset: usize, path: String, what: String) -> FileError {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = memchr::memchr_iter(b'\n', before).count() + 1;
    let column = before.len() - memchr::memrchr(b'\n', before).map_or(0, |at| at + 1) + 1;
    FileError::Element {
        line,
        column,
        path: if path.is_empty() {
            "the text".into()
        } else {
            path
        },
        what,
    }
}

impl<'a> Element<'a> {
    fn node(self) -> &'a Node {
        &self.document.nodes[self.at]
    }

    pub(super) fn name(self) -> &'a str {
        &self.node().name
    }

    pub(super) fn offset(self) -> usize {
        self.node().begin
    }

    /// The bytes of the text it takes.
    pub(super) fn size(self) -> usize {
        self.node().end.saturating_sub(self.node().begin)
    }

    pub(super) fn children(self) -> impl Iterator<Item = Element<'a>> {
        self.node().children.iter().map(move |at| Element {
            document: self.document,
            at: *at,
        })
    }

    pub(super) fn named(self, name: &str) -> impl Iterator<Item = Element<'a>> {
        self.children().filter(move |child| child.name() == name)
    }

    /// Marks it as read.
    pub(super) fn mark(self) -> Self {
        self.node().used.set(true);
        self
    }

    /// The first element that a way leads to. Those on the way are marked.
    pub(super) fn find(self, way: &[&str]) -> Option<Element<'a>> {
        let Some((first, rest)) = way.split_first() else {
            return Some(self);
        };
        let found = self
            .named(first)
            .find_map(|child| Some((child, child.find(rest)?)));
        found.map(|(child, found)| {
            if !rest.is_empty() {
                child.mark();
            }
            found
        })
    }

    pub(super) fn attribute(self, name: &str) -> Option<&'a str> {
        self.node()
            .attributes
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value.as_str())
    }

    /// Its text. The newlines that were added to CDATA sections are removed; blanks around them do not count.
    pub(super) fn text(self) -> String {
        let pieces = &self.node().pieces;
        let any_data = pieces.iter().any(|(data, _)| *data);
        let texts = pieces
            .iter()
            .filter(|(data, text)| *data || !any_data || !text.trim().is_empty());
        texts
            .map(|(data, text)| {
                if *data {
                    without_newlines(text)
                } else {
                    text.as_str()
                }
            })
            .collect()
    }

    /// The names that lead to it.
    pub(super) fn path(self) -> String {
        let up = |element: &Element<'a>| {
            element.node().parent.map(|at| Element {
                document: self.document,
                at,
            })
        };
        let mut names: Vec<&str> = std::iter::successors(Some(self), up)
            .map(Element::name)
            .collect();
        names.reverse();
        names.join("/")
    }

    pub(super) fn error(self, what: impl Into<String>) -> FileError {
        error_at(&self.document.text, self.offset(), self.path(), what.into())
    }
}

fn without_newlines(text: &str) -> &str {
    let text = text
        .strip_prefix("\r\n")
        .or_else(|| text.strip_prefix('\n'))
        .unwrap_or(text);
    text.strip_suffix("\r\n")
        .or_else(|| text.strip_suffix('\n'))
        .unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> String {
        Document::parse(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn texts_come_out_of_their_sections() {
        let text = "<a>\n  <b x='1&lt;2'><![CDATA[\nif a[b[1]\n]]>]]&gt;<![CDATA[\n 2 then\n]]></b><c>1 &amp; &#50;</c>\n</a>";
        let document = Document::parse(text.as_bytes()).unwrap();
        let b = document.root().find(&["b"]).unwrap();
        assert_eq!(b.text(), "if a[b[1]]]> 2 then");
        assert_eq!(b.attribute("x"), Some("1<2"));
        assert_eq!(document.root().find(&["c"]).unwrap().text(), "1 & 2");
        assert!(document.root().find(&["b", "c"]).is_none());
    }

    #[test]
    fn what_is_no_xml_is_an_error_with_its_place() {
        assert_eq!(
            wrong("<a>\n <b></c>\n</a>").split(':').next().unwrap(),
            "line 2, column 5, in a/b"
        );
        for text in [
            "",
            "<a>",
            "<a></a><b/>",
            "x<a/>",
            "<a>&b;</a>",
            "<a x=1/>",
            "<a",
            "<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>",
        ] {
            assert!(wrong(text).starts_with("line 1"), "{text}");
        }
        assert!(wrong(&"<a>".repeat(100_000)).contains("nested too deeply"));
    }
}
