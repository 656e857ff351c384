//! XML trees of [`roxmltree`], read in bounded time and memory: for files and answers that a stranger has written.
//!
//! roxmltree compares each attribute with all others of its element, and each declaration of a namespace with those of all elements around
//! it: a text of one megabyte could take minutes. Here such texts are refused before they are parsed.

#![forbid(unsafe_code)]

use roxmltree::ParsingOptions;
pub use roxmltree::{Attribute, Document, Node, NodeId};

/// Attributes of an element.
pub const MAX_ATTRIBUTES: usize = 200;
/// Declarations of namespaces in a text.
pub const MAX_NAMESPACES: usize = 1000;

/// What is done with a document type (`<!DOCTYPE ...>`), whose entities could grow without end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DocumentType {
    /// A text with one has no tree.
    Refused,
    /// Accepted as long as it declares no entities.
    WithoutEntities,
}

/// Why a text has no tree. The messages do not name the [line](Error::line).
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// An element has more than [`MAX_ATTRIBUTES`].
    #[error("an element has more than {MAX_ATTRIBUTES} attributes")]
    TooManyAttributes {
        /// Its line, from 1.
        line: u32,
    },
    /// There are more than [`MAX_NAMESPACES`].
    #[error("more than {MAX_NAMESPACES} namespaces are declared")]
    TooManyNamespaces,
    /// There are more nodes than the caller allows.
    #[error("there are more elements, attributes and texts than are read")]
    TooManyNodes,
    /// There is a document type, and the caller refuses it.
    #[error("it has a document type, which is not read")]
    DocumentType {
        /// Its line, from 1.
        line: u32,
    },
    /// A document type declares entities.
    #[error("it declares entities, which are not expanded")]
    Entities {
        /// Its line, from 1.
        line: u32,
    },
    /// The text is not well-formed XML.
    #[error("{message}")]
    Syntax {
        /// The line where that shows, from 1.
        line: u32,
        /// What is wrong.
        message: String,
    },
}

impl Error {
    /// The line where the text is wrong, if that is one place.
    pub fn line(&self) -> Option<u32> {
        match self {
            Self::TooManyNamespaces | Self::TooManyNodes => None,
            Self::TooManyAttributes { line }
            | Self::DocumentType { line }
            | Self::Entities { line }
            | Self::Syntax { line, .. } => Some(*line),
        }
    }
}

/// The tree of a text with up to `max_nodes` elements, attributes and texts.
///
/// # Errors
/// For text that is no XML, or exceeds a limit.
pub fn parse(
    text: &str,
    max_nodes: u32,
    document_type: DocumentType,
) -> Result<Document<'_>, Error> {
    if let Some(at) = crowded(text) {
        return Err(Error::TooManyAttributes {
            line: line_at(text, at),
        });
    }
    if text.matches("xmlns").nth(MAX_NAMESPACES).is_some() {
        return Err(Error::TooManyNamespaces);
    }
    let options = |allow_dtd| ParsingOptions {
        allow_dtd,
        nodes_limit: max_nodes,
        ..ParsingOptions::default()
    };
    let parsed = match Document::parse_with_options(text, options(false)) {
        Err(roxmltree::Error::DtdDetected) => {
            check_document_type(text, document_type)?;
            Document::parse_with_options(text, options(true))
        }
        parsed => parsed,
    };
    parsed.map_err(Error::from)
}

impl From<roxmltree::Error> for Error {
    fn from(error: roxmltree::Error) -> Self {
        if error == roxmltree::Error::NodesLimitReached {
            return Self::TooManyNodes;
        }
        let position = error.pos();
        let place = format!(" at {}:{}", position.row, position.col);
        Self::Syntax {
            line: position.row,
            message: error.to_string().replace(&place, ""),
        }
    }
}

fn check_document_type(text: &str, document_type: DocumentType) -> Result<(), Error> {
    let line = |at| line_at(text, at);
    match document_type {
        DocumentType::Refused => Err(Error::DocumentType {
            line: text.find("<!DOCTYPE").map_or(1, line),
        }),
        DocumentType::WithoutEntities => match text.find("<!ENTITY").map(line) {
            Some(line) => Err(Error::Entities { line }),
            None => Ok(()),
        },
    }
}

/// Where an element begins that has more attributes than are read.
fn crowded(text: &str) -> Option<usize> {
    const OTHERS: [(&str, &str); 3] = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
    let mut at = 0;
    loop {
        let start = at + text[at..].find('<')?;
        let rest = &text[start..];
        let length = match OTHERS.iter().find(|(open, _)| rest.starts_with(open)) {
            Some((open, close)) => rest[open.len()..].find(close)? + open.len(),
            None => tag_length(rest)?,
        };
        at = start + length;
        if length == 0 {
            return Some(start);
        }
    }
}

/// How long a tag is, up to its end; 0 if it has too many attributes. `None` without an end.
fn tag_length(text: &str) -> Option<usize> {
    let (mut quote, mut attributes) = (None, 0);
    for (length, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'>') => return Some(length),
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
        if attributes > MAX_ATTRIBUTES {
            return Some(0);
        }
    }
    None
}

fn line_at(text: &str, at: usize) -> u32 {
    text.as_bytes()[..at]
        .iter()
        .filter(|byte| **byte == b'\n')
        .count() as u32
        + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> Error {
        parse(text, 1000, DocumentType::WithoutEntities).expect_err("it is refused")
    }

    fn attributes(count: usize) -> String {
        (0..count)
            .map(|number| format!(" a{number}='a=\"b\">'"))
            .collect()
    }

    #[test]
    fn elements_with_very_many_attributes_are_refused() {
        let many = attributes(300);
        let text = |attributes: String| {
            format!(
                "<?xml version='1.0'?><?p a='<'{many}?>\n<!-- <a{many}/> --><a>\n<![CDATA[<a{many}>]]><b{attributes}/></a>"
            )
        };
        assert!(parse(&text(attributes(200)), 1000, DocumentType::Refused).is_ok());
        for count in [201, 200_000] {
            assert_eq!(
                error(&text(attributes(count))),
                Error::TooManyAttributes { line: 3 }
            );
        }
    }

    #[test]
    fn very_many_namespaces_are_refused() {
        let many: String = (0..60_000).map(|n| format!("<a xmlns:x{n}='x'>")).collect();
        assert_eq!(error(&many), Error::TooManyNamespaces);
    }

    #[test]
    fn very_many_elements_are_refused() {
        assert_eq!(
            error(&format!("<a>{}</a>", "<b/>".repeat(1000))),
            Error::TooManyNodes
        );
    }

    #[test]
    fn document_types_are_accepted_on_demand_and_entities_never() {
        let text = "<?xml version='1.0'?>\n<!DOCTYPE a><a/>";
        assert!(parse(text, 1000, DocumentType::WithoutEntities).is_ok());
        let refused = parse(text, 1000, DocumentType::Refused).expect_err("a document type");
        assert_eq!(
            (refused.line(), &refused),
            (Some(2), &Error::DocumentType { line: 2 })
        );
        let bomb = "<!DOCTYPE a [\n<!ENTITY b 'bb'>]><a>&b;</a>";
        assert_eq!(error(bomb), Error::Entities { line: 2 });
    }

    #[test]
    fn damaged_texts_are_errors_with_their_line() {
        for text in [
            "",
            "<",
            "<a",
            "<a b='",
            "<!--",
            "<![CDATA[",
            "<?",
            "\n<a></b>",
            "<a xmlns:b='' b:c=''",
        ] {
            assert!(error(text).line().is_none_or(|line| line <= 2), "{text}");
        }
    }
}
