//! The elements of a file and of those it includes, as one tree.

use std::rc::Rc;

use bounded_xml::{Attribute, Node};

use super::Files;
use crate::limits;
use crate::report::{Parsed, ReadError, Warning, WarningKind};
use crate::xml::{self, Source, short};

/// Levels of elements within elements, such as bodies.
const MAX_DEPTH: usize = 128;
/// Bytes of an attribute: very many parts of the model may get a copy of its value.
const MAX_ATTRIBUTE_BYTES: usize = 2000;
/// Lists of nodes, of which no defaults make copies, may be as long as the file.
const LISTS: &[&str] = &["vertex", "id", "point", "element"];
/// Levels of files that include files.
const MAX_INCLUDE_DEPTH: usize = 8;
/// Included files in all.
const MAX_INCLUDES: usize = 500;
/// Numbers beyond are taken for errors: what is computed from them would not be finite.
pub const MAX_NUMBER: f64 = 1e30;

/// An element, wherever it was written.
#[derive(Debug, Clone, Default)]
pub struct Element {
    /// Its name.
    pub name: String,
    /// Names and values.
    pub attributes: Vec<(String, String)>,
    /// The elements inside of it.
    pub children: Vec<Element>,
    /// From 1.
    pub line: u32,
    /// The file that it is in, if that is included.
    file: Option<Rc<str>>,
}

impl Element {
    /// An element that no file has.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            line: 1,
            ..Self::default()
        }
    }

    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value.as_str())
    }

    /// The elements of that name inside of this one.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }
}

/// The warnings about a file.
#[derive(Debug, Default)]
pub struct Report {
    warnings: Vec<Warning>,
    further: usize,
}

impl Report {
    /// Something is wrong, and was read as the message says.
    pub fn warn(&mut self, element: &Element, message: impl Into<String>) {
        self.add(element, WarningKind::Corrected, message.into());
    }

    /// Something is left out.
    pub fn leave_out(&mut self, element: &Element, message: impl Into<String>) {
        self.add(element, WarningKind::NotUnderstood, message.into());
    }

    fn add(&mut self, element: &Element, kind: WarningKind, mut message: String) {
        if self.warnings.len() >= limits::WARNINGS {
            self.further += 1;
            return;
        }
        if let Some(file) = &element.file {
            message = format!("{message} (in {})", short(file));
        }
        self.warnings.push(Warning {
            line: element.line,
            element: short(&element.name),
            message,
            kind,
        });
    }

    pub fn finish<T>(self, value: T) -> Parsed<T> {
        Parsed {
            value,
            warnings: self.warnings,
            further_warnings: self.further,
        }
    }

    /// The numbers of a text; what is no number ends them.
    pub fn numbers(&mut self, element: &Element, what: &str, text: &str) -> Vec<f64> {
        let mut numbers = Vec::new();
        for word in text.split_whitespace().take(64) {
            match word.parse::<f64>() {
                Ok(number) if number.abs() <= MAX_NUMBER => numbers.push(number),
                _ => {
                    self.warn(
                        element,
                        format!("{what} has '{}', which is no number", short(word)),
                    );
                    break;
                }
            }
        }
        numbers
    }
}

/// Reads a file and those it includes.
pub fn read(
    bytes: &[u8],
    files: &mut dyn Files,
    report: &mut Report,
) -> Result<Element, ReadError> {
    let root = read_any(bytes, files, report)?;
    if root.name != "mujoco" {
        return Err(ReadError::WrongRoot {
            line: root.line,
            found: short(&root.name),
            expected: "mujoco",
        });
    }
    Ok(root)
}

/// The outermost element, whatever its name is.
pub fn read_any(
    bytes: &[u8],
    files: &mut dyn Files,
    report: &mut Report,
) -> Result<Element, ReadError> {
    let mut reader = Reader {
        files,
        report,
        open: Vec::new(),
        count: 0,
        bytes: 0,
        nodes: 0,
    };
    let mut roots = Vec::new();
    reader.add_file(bytes, None, 0, &mut roots)?;
    Ok(roots.pop().unwrap_or_default())
}

fn is_read(attribute: &Attribute) -> bool {
    attribute.value().len() <= MAX_ATTRIBUTE_BYTES || LISTS.contains(&attribute.name())
}

struct Reader<'a> {
    files: &'a mut dyn Files,
    report: &'a mut Report,
    open: Vec<String>,
    count: usize,
    bytes: usize,
    nodes: usize,
}

impl Reader<'_> {
    /// Adds the root of a file; of one that is included, what is inside of it.
    fn add_file(
        &mut self,
        bytes: &[u8],
        file: Option<Rc<str>>,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Result<(), ReadError> {
        let before = xml::lines_before(bytes);
        let text = xml::text_of(bytes)?;
        let document = xml::document(&text, before)?;
        let source = Source::new(&text, before);
        let root = document.root_element();
        match &file {
            None => into.push(self.element(root, &source, None, depth)?),
            Some(_) => self.add_children(root, &source, file.as_ref(), depth, into)?,
        }
        Ok(())
    }

    fn element(
        &mut self,
        node: Node,
        source: &Source,
        file: Option<Rc<str>>,
        depth: usize,
    ) -> Result<Element, ReadError> {
        self.nodes += 1 + node.attributes().len();
        if self.nodes > limits::NODES as usize {
            return Err(ReadError::TooManyNodes);
        }
        let (attributes, long): (Vec<_>, Vec<_>) =
            node.attributes().partition(|attribute| is_read(attribute));
        let owned = |attribute: Attribute| {
            (
                attribute.name().to_owned(),
                attribute.value().trim().to_owned(),
            )
        };
        let mut element = Element {
            name: node.tag_name().name().to_owned(),
            attributes: attributes.into_iter().map(owned).collect(),
            children: Vec::new(),
            line: source.line(node),
            file: file.clone(),
        };
        for attribute in long {
            let (name, length) = (short(attribute.name()), attribute.value().len());
            self.report.leave_out(
                &element,
                format!(
                    "{name} has {length} bytes, more than the {MAX_ATTRIBUTE_BYTES} that are read"
                ),
            );
        }
        if depth >= MAX_DEPTH && node.first_element_child().is_some() {
            self.report.leave_out(
                &element,
                format!("more than {MAX_DEPTH} elements inside of each other are not read"),
            );
            return Ok(element);
        }
        let mut children = Vec::new();
        self.add_children(node, source, file.as_ref(), depth + 1, &mut children)?;
        element.children = children;
        Ok(element)
    }

    fn add_children(
        &mut self,
        node: Node,
        source: &Source,
        file: Option<&Rc<str>>,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Result<(), ReadError> {
        for child in xml::elements(node) {
            let is_include = child.tag_name().name() == "include";
            if depth > MAX_DEPTH {
                break;
            }
            let element = self.element(child, source, file.cloned(), depth)?;
            if is_include {
                self.include(&element, depth, into)?;
            } else {
                into.push(element);
            }
        }
        Ok(())
    }

    fn include(
        &mut self,
        element: &Element,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Result<(), ReadError> {
        let name = element.attribute("file").unwrap_or_default().to_owned();
        let reason = match self.open(&name) {
            Ok(bytes) => {
                self.open.push(name.clone());
                let outcome = self.add_file(&bytes, Some(name.as_str().into()), depth, into);
                self.open.pop();
                match outcome {
                    Err(ReadError::TooManyNodes) => return Err(ReadError::TooManyNodes),
                    outcome => outcome.err().map(|error| error.to_string()),
                }
            }
            Err(reason) => Some(reason),
        };
        if let Some(reason) = reason {
            self.report
                .leave_out(element, format!("'{}': {reason}", short(&name)));
        }
        Ok(())
    }

    fn open(&mut self, name: &str) -> Result<Vec<u8>, String> {
        if self.open.iter().any(|open| open == name) {
            return Err("it includes itself".into());
        }
        if self.open.len() >= MAX_INCLUDE_DEPTH || self.count >= MAX_INCLUDES {
            return Err(format!(
                "more than {MAX_INCLUDE_DEPTH} files inside of each other, or {MAX_INCLUDES} in all, are not read"
            ));
        }
        let bytes = self.files.include(name)?;
        (self.count, self.bytes) = (self.count + 1, self.bytes + bytes.len());
        if self.bytes > limits::BYTES {
            return Err(format!(
                "the files have more than {} bytes together",
                limits::BYTES
            ));
        }
        Ok(bytes)
    }
}
