//! The text of a window as a tree of elements. As forgiving as the parser of the original in texts: an ampersand may stand for itself, unknown
//! entities stay, and what follows the first root element is not looked at.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// Limit of the nesting of elements.
const MAX_DEPTH: usize = 100;
/// Limits of a text: its size in bytes, and the number of its elements.
const MAX_SIZE: usize = 16 << 20;
const MAX_ELEMENTS: usize = 100_000;

/// An element with what is in it.
#[derive(Debug, Default, Clone, PartialEq)]
pub(super) struct Element {
    pub name: String,
    /// In the order of the text; of equal names the first counts.
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    /// The text directly in it.
    pub text: String,
    /// The element as it is written.
    pub source: String,
}

/// The first root element; None for what is no XML, has no element, or is too large or too deep.
pub(super) fn parse(text: &str) -> Option<Element> {
    if text.len() > MAX_SIZE {
        return None;
    }
    let mut reader = Reader::from_str(text);
    reader.config_mut().allow_dangling_amp = true;
    let mut open: Vec<Open> = Vec::new();
    let mut count = 0;
    loop {
        let begin = reader.buffer_position() as usize;
        let event = reader.read_event().ok()?;
        let end = reader.buffer_position() as usize;
        let closed = match event {
            Event::Start(start) => {
                open.push(Open {
                    begin,
                    element: element(&start)?,
                });
                None
            }
            Event::Empty(start) => Some(Open {
                begin,
                element: element(&start)?,
            }),
            Event::End(_) => Some(open.pop()?),
            Event::Eof => return None,
            other => {
                if let Some(last) = open.last_mut() {
                    last.add_text(&other);
                }
                None
            }
        };
        count += 1;
        if open.len() > MAX_DEPTH || count > MAX_ELEMENTS {
            return None;
        }
        if let Some(Open { begin, mut element }) = closed {
            // Only pictures in SVG are read as they are written.
            if element.name == "svg" {
                element.source = text.get(begin..end)?.to_owned();
            }
            match open.last_mut() {
                Some(parent) => parent.element.children.push(element),
                None => return Some(element),
            }
        }
    }
}

struct Open {
    begin: usize,
    element: Element,
}

impl Open {
    fn add_text(&mut self, event: &Event<'_>) {
        let text = &mut self.element.text;
        match event {
            Event::Text(piece) => text.push_str(piece),
            Event::CData(piece) => text.push_str(piece),
            Event::GeneralRef(reference) => {
                text.push_str(&unescaped(&format!("&{};", &**reference)));
            }
            _ => {}
        }
    }
}

fn element(start: &BytesStart<'_>) -> Option<Element> {
    let mut element = Element {
        name: start.name().as_ref().to_owned(),
        ..Element::default()
    };
    // The check for doubles would compare each with each.
    for attribute in start.attributes().with_checks(false) {
        let attribute = attribute.ok()?;
        element.attributes.push((
            attribute.key.as_ref().to_owned(),
            unescaped(&attribute.value),
        ));
    }
    Some(element)
}

/// The text with its entities replaced; those that are none stay as they are.
fn unescaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('&') {
        out.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        match rest
            .split_once(';')
            .and_then(|(name, after)| Some((entity(name)?, after)))
        {
            Some((character, after)) => {
                out.push(character);
                rest = after;
            }
            None => out.push('&'),
        }
    }
    out.push_str(rest);
    out
}

fn entity(name: &str) -> Option<char> {
    let number = name.strip_prefix('#');
    match (name, number) {
        ("amp", _) => Some('&'),
        ("lt", _) => Some('<'),
        ("gt", _) => Some('>'),
        ("quot", _) => Some('"'),
        ("apos", _) => Some('\''),
        (_, Some(digits)) => {
            let code = match digits.strip_prefix(['x', 'X']) {
                Some(hex) => u32::from_str_radix(hex, 16).ok()?,
                None => digits.parse().ok()?,
            };
            char::from_u32(code).filter(|character| *character != '\0')
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn elements_have_attributes_children_and_texts() {
        let root = parse(
            "<!-- a --><ui title='a &amp; b & c &nbsp;'><item>1 &lt; 2<br/>x</item></ui><b/>",
        )
        .expect("XML");
        assert_eq!(
            root.attributes,
            [("title".to_owned(), "a & b & c &nbsp;".to_owned())]
        );
        assert_eq!(
            (
                root.children[0].text.as_str(),
                root.children[0].children[0].name.as_str()
            ),
            ("1 < 2x", "br")
        );
        let svg = parse("<ui><svg><svg a='1'><g/></svg></svg></ui>").expect("XML");
        assert_eq!(svg.children[0].children[0].source, "<svg a='1'><g/></svg>");
    }

    #[test]
    fn what_is_no_xml_is_none() {
        for text in [
            "",
            "<ui",
            "<ui>",
            "<ui></b>",
            "<!-- -->",
            "x",
            "<ui a=1/>",
            "</ui>",
            "<ui a='1/>",
        ] {
            assert_eq!(parse(text), None, "{text}");
        }
        assert_eq!(parse(&"<a>".repeat(1_000_000)), None);
        assert_eq!(parse(&format!("<a>{}</a>", "<b/>".repeat(200_000))), None);
    }
}
