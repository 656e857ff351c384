//! The tables that map elements to fields: `fields.tsv`, `engines.tsv`, `words.tsv`. Reader and writer share them.

use heap::Lazy;
use std::collections::BTreeMap;

/// A step from a node to a part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Name(&'static str),
    Item(usize),
    /// Items of a list: the first, and how many.
    Items(usize, usize),
}

/// Unit of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unit {
    Int,
    Real,
    Degrees,
    /// Degrees where the joint turns.
    Motion,
    /// A part of a colour: 0 to 1, in the simple variant 0 to 255.
    Colour,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Count {
    One,
    Exactly(usize),
    Any,
}

/// How an element says a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Numbers(Unit, Count),
    /// True where these bits are set; the other way round with the second.
    Bits(i64, bool),
    /// A word of an enumeration.
    Word(&'static str),
    Text,
    /// In the simple variant with a handle behind `*`.
    Alias,
    Texts,
    Blob,
    /// The pixels of a texture: a blob, or a picture beside the scene.
    Pixels,
    /// Three angles for a quaternion.
    Euler,
    /// An object or collection, by its alias or name.
    Reference,
    Section(&'static str),
    Sections(&'static str),
    /// The meshes and groups of a group of meshes.
    Children,
    /// The arrays of a mesh, which files keep in a pool.
    Arrays,
}

/// An element, the field it says, and how.
#[derive(Debug)]
pub(super) struct Row {
    exhaustive: bool,
    simple: bool,
    /// Ways to the element; it is written the first way. None for a constant.
    pub elements: Vec<Vec<&'static str>>,
    pub field: Vec<Step>,
    pub kind: Kind,
    /// The value when the element is missing, and whether it is taken even if nothing of the field is there.
    pub default: Option<(&'static str, bool)>,
}

impl Row {
    pub(super) fn is_in(&self, simple: bool) -> bool {
        if simple { self.simple } else { self.exhaustive }
    }
}

type Sections = BTreeMap<&'static str, Vec<Row>>;

static SECTIONS: Lazy<Sections> = Lazy::new(|| {
    let mut sections = Sections::new();
    let mut rows = Vec::new();
    let lines = include_str!("fields.tsv")
        .lines()
        .chain(include_str!("engines.tsv").lines());
    for line in lines
        .rev()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
    {
        match line
            .strip_prefix('[')
            .and_then(|line| line.strip_suffix(']'))
        {
            Some(name) => {
                rows.reverse();
                sections.insert(name, std::mem::take(&mut rows));
            }
            None => rows.push(row(line)),
        }
    }
    sections
});

static WORDS: Lazy<BTreeMap<&'static str, Vec<(&'static str, i64)>>> = Lazy::new(|| {
    let lines = include_str!("words.tsv")
        .lines()
        .filter(|line| !line.starts_with('#'));
    let words = lines.map(|line| {
        let mut columns = line.split('\t');
        let name = columns.next().unwrap_or_default();
        (
            name,
            columns
                .filter_map(|word| word.split_once('='))
                .map(|(word, n)| (word, numbers::count(number(n))))
                .collect(),
        )
    });
    words.collect()
});

/// The rows of a section, in their order.
pub(super) fn rows(section: &str) -> &'static [Row] {
    SECTIONS.get(section).map(Vec::as_slice).unwrap_or_default()
}

/// The number of a word.
pub(super) fn number_of(enumeration: &str, word: &str) -> Option<i64> {
    WORDS
        .get(enumeration)?
        .iter()
        .find(|(known, _)| *known == word)
        .map(|(_, number)| *number)
}

/// The word of a number.
pub(super) fn word_of(enumeration: &str, number: i64) -> Option<&'static str> {
    WORDS
        .get(enumeration)?
        .iter()
        .find(|(_, known)| *known == number)
        .map(|(word, _)| *word)
}

fn row(line: &'static str) -> Row {
    let mut columns = line.split('\t');
    let mut next = || columns.next().unwrap_or_default();
    let (variant, elements, field, kind) = (next(), next(), next(), kind(next()));
    let default = columns.next().map(|text| {
        text.strip_prefix('!')
            .map_or((text, false), |text| (text, true))
    });
    Row {
        exhaustive: variant != "s",
        simple: variant != "x",
        elements: if elements == "-" {
            Vec::new()
        } else {
            elements.split('|').map(way).collect()
        },
        field: if field == "." {
            Vec::new()
        } else {
            field.split('/').map(step).collect()
        },
        kind,
        default,
    }
}

fn way(element: &'static str) -> Vec<&'static str> {
    if element == "." {
        Vec::new()
    } else {
        element.split('/').collect()
    }
}

fn step(text: &'static str) -> Step {
    match text.split_once('+') {
        Some((first, count)) => Step::Items(number(first), number(count)),
        None if text.starts_with(|c: char| c.is_ascii_digit()) => Step::Item(number(text)),
        None => Step::Name(text),
    }
}

fn kind(text: &'static str) -> Kind {
    let (name, argument) = text.split_once([':', '*']).unwrap_or((text, ""));
    let count = match (text.contains('*'), argument) {
        (false, _) => Count::One,
        (true, "") => Count::Any,
        (true, count) => Count::Exactly(number(count)),
    };
    match name {
        "int" => Kind::Numbers(Unit::Int, count),
        "real" => Kind::Numbers(Unit::Real, count),
        "degrees" => Kind::Numbers(Unit::Degrees, count),
        "motion" => Kind::Numbers(Unit::Motion, count),
        "rgb" => Kind::Numbers(Unit::Colour, Count::Exactly(3)),
        "bit" => Kind::Bits(1 << number(argument), false),
        "nobit" => Kind::Bits(1 << number(argument), true),
        "bits" => Kind::Bits(numbers::count(number(argument)), false),
        "word" => Kind::Word(argument),
        "text" => Kind::Text,
        "alias" => Kind::Alias,
        "texts" => Kind::Texts,
        "blob" => Kind::Blob,
        "pixels" => Kind::Pixels,
        "euler" => Kind::Euler,
        "ref" => Kind::Reference,
        "children" => Kind::Children,
        "arrays" => Kind::Arrays,
        section if count == Count::Any => Kind::Sections(section),
        section => Kind::Section(section),
    }
}

fn number(text: &str) -> usize {
    text.parse().expect("numbers of the tables are numbers")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_are_complete() {
        for (name, rows) in SECTIONS.iter() {
            assert!(!rows.is_empty(), "{name}");
            for row in rows {
                if let Kind::Section(inner) | Kind::Sections(inner) = row.kind {
                    assert!(SECTIONS.contains_key(inner), "{name}: {inner}");
                }
                if let Kind::Word(words) = row.kind {
                    assert!(WORDS.contains_key(words), "{name}: {words}");
                }
                assert!(
                    !row.elements.is_empty() || row.default.is_some(),
                    "{name}: {row:?}"
                );
            }
        }
    }
}
