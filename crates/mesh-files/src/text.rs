//! Words and numbers of text formats, with the lines they are on.

use crate::error::{Location, ReadError, Result};

/// The words of a text, divided by white space.
pub(crate) struct Words<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Words<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self {
            rest: text,
            line: 1,
        }
    }

    /// The line of the word that was read last.
    pub(crate) fn place(&self) -> Location {
        Location::Line(self.line)
    }

    /// What is left of this line, without spaces around it.
    pub(crate) fn rest_of_line(&mut self) -> &'a [u8] {
        let end = self
            .rest
            .iter()
            .position(|&byte| byte == b'\n')
            .unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        line.trim_ascii()
    }

    /// A coordinate.
    pub(crate) fn number(&mut self, element: &str) -> Result<f64> {
        let word = self.next();
        word.and_then(number)
            .ok_or_else(|| ReadError::new(self.place(), element, no_number(word)))
    }

    /// Three coordinates.
    pub(crate) fn vector(&mut self, element: &str) -> Result<[f64; 3]> {
        Ok([
            self.number(element)?,
            self.number(element)?,
            self.number(element)?,
        ])
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self
            .rest
            .iter()
            .position(|byte| !byte.is_ascii_whitespace())
            .unwrap_or(self.rest.len());
        self.line += self.rest[..start]
            .iter()
            .filter(|&&byte| byte == b'\n')
            .count();
        let rest = &self.rest[start..];
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }
}

/// A finite number.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word)
        .ok()?
        .parse()
        .ok()
        .filter(|x: &f64| x.is_finite())
}

/// A finite number, or 0: for normals and texture coordinates, where programs write `nan` for what they could not compute.
pub(crate) fn number_or_zero(word: Option<&[u8]>) -> f64 {
    word.and_then(number).unwrap_or(0.0)
}

/// The words of one line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// What to say of a word that is no number; long words are cut.
pub(crate) fn no_number(word: Option<&[u8]>) -> String {
    match word {
        None => "a number is missing".into(),
        Some(word) => format!("not a finite number: {}", quoted(word)),
    }
}

/// A word of the file in an error; long ones are cut.
pub(crate) fn quoted(word: &[u8]) -> String {
    let cut = &word[..word.len().min(40)];
    format!("{:?}", String::from_utf8_lossy(cut))
}

/// A name without the folders before it, of either kind of slash.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// A name in the text, whatever its encoding.
pub(crate) fn name(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A path whose bytes may be written as `%20`, as in URIs.
pub(crate) fn percent_decoded(path: &str) -> String {
    let mut decoded = Vec::new();
    let mut rest = path.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after
            .get(..2)
            .filter(|_| first == b'%')
            .and_then(|code| std::str::from_utf8(code).ok());
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                decoded.push(byte);
                rest = &after[2..];
            }
            None => {
                decoded.push(first);
                rest = after;
            }
        }
    }
    name(&decoded)
}
