//! The header: which elements there are, with which properties.

use crate::error::{Location, ReadError, Result};
use crate::text::{name, quoted, words};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    pub(super) texture: Option<String>,
    /// The first byte after it.
    pub(super) end: usize,
    /// How many lines it has.
    pub(super) lines: usize,
}

impl Scalar {
    fn of(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Kind {
    /// In a binary file; a list may be empty.
    pub(super) fn least_bytes(&self) -> usize {
        match self {
            Kind::Scalar(scalar) | Kind::List { count: scalar, .. } => scalar.bytes(),
        }
    }
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self> {
        let mut header = Self {
            encoding: Encoding::Text,
            elements: Vec::new(),
            texture: None,
            end: 0,
            lines: 0,
        };
        let mut has_format = false;
        for line in bytes.split_inclusive(|&byte| byte == b'\n') {
            header.end += line.len();
            header.lines += 1;
            let content: Vec<&[u8]> = words(line).collect();
            match (header.lines, &content[..]) {
                (1, [b"ply"]) => {}
                (1, _) => return Err(header.refused("the first line is not `ply`")),
                (_, [b"format", kind, ..]) => {
                    header.encoding = header.encoding(kind)?;
                    has_format = true;
                }
                (_, [b"comment", keyword, path])
                    if keyword.eq_ignore_ascii_case(b"TextureFile") =>
                {
                    header.texture = Some(name(path));
                }
                (_, [b"comment" | b"obj_info", ..] | []) => {}
                (_, [b"element", name, count]) => header.element(name, count)?,
                (_, [b"property", property @ ..]) => header.property(property)?,
                (_, [b"end_header"]) if has_format => return Ok(header),
                (_, [word, ..]) => {
                    return Err(header.refused(&format!("{} was not expected", quoted(word))));
                }
            }
        }
        Err(header.refused("the file ends before `end_header`"))
    }

    fn refused(&self, problem: &str) -> ReadError {
        ReadError::new(Location::Line(self.lines), "header", problem)
    }

    fn encoding(&self, kind: &[u8]) -> Result<Encoding> {
        match kind {
            b"ascii" => Ok(Encoding::Text),
            b"binary_little_endian" => Ok(Encoding::LittleEndian),
            b"binary_big_endian" => Ok(Encoding::BigEndian),
            _ => Err(self.refused(&format!("unknown format {}", quoted(kind)))),
        }
    }

    fn element(&mut self, element: &[u8], count: &[u8]) -> Result<()> {
        let count = std::str::from_utf8(count)
            .ok()
            .and_then(|count| count.parse().ok());
        let count = count.ok_or_else(|| self.refused("the count of an element is not a number"))?;
        self.elements.push(Element {
            name: name(element),
            count,
            properties: Vec::new(),
        });
        Ok(())
    }

    fn property(&mut self, content: &[&[u8]]) -> Result<()> {
        let (kind, property) = match content {
            [b"list", count, item, property] => (
                Scalar::of(count)
                    .zip(Scalar::of(item))
                    .map(|(count, item)| Kind::List { count, item }),
                property,
            ),
            [kind, property] => (Scalar::of(kind).map(Kind::Scalar), property),
            _ => return Err(self.refused("a property is a type and a name")),
        };
        let kind = kind.ok_or_else(|| {
            self.refused(&format!("unknown type of property {}", quoted(property)))
        })?;
        let problem = self.refused("a property before any element");
        let element = self.elements.last_mut().ok_or(problem)?;
        element.properties.push(Property {
            name: name(property),
            kind,
        });
        Ok(())
    }
}
