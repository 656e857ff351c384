//! Reading and writing of Lua 5.4 bytecode.
//!
//! Parts that need no interpretation are copied as bytes.

use std::borrow::Cow;
use std::ops::Range;

/// Signature, version, format, check data, sizes, two check numbers.
const HEADER_SIZE: usize = 4 + 1 + 1 + 6 + 3 + 8 + 8;

/// In place of a difference between lines: the line itself is in the list of absolute lines.
const ABSOLUTE: i8 = -0x80;
/// An absolute line comes at least once in so many instructions.
const MAX_DIFFERENCES: usize = 128;

/// Types of constants.
const FLOAT: u8 = 0x13;
const INTEGER: u8 = 0x03;
const SHORT_STRING: u8 = 0x04;
const LONG_STRING: u8 = 0x14;
const TRUE: u8 = 0x11;

/// A compiled chunk.
pub(super) struct Chunk<'a> {
    header: &'a [u8],
    pub main: Prototype<'a>,
}

/// A function of a chunk.
pub(crate) struct Prototype<'a> {
    /// The bytes it was read from.
    pub(super) raw: &'a [u8],
    source: &'a [u8],
    /// Its first line; 0 for the main function.
    pub line: usize,
    pub(super) last_line: usize,
    pub(super) parameters: u8,
    pub is_vararg: bool,
    pub registers: u8,
    pub code: Vec<u32>,
    /// Type and value, encoded.
    pub(super) constants: Vec<Cow<'a, [u8]>>,
    /// For each: whether it is a local variable of the enclosing function, its index, and its kind.
    upvalues: Vec<[u8; 3]>,
    pub inner: Vec<Prototype<'a>>,
    /// The line of each instruction.
    pub lines: Vec<u32>,
    locals: Vec<Local<'a>>,
    upvalue_names: Vec<Cow<'a, [u8]>>,
}

/// A local variable: its name, and the instructions between which it is live.
struct Local<'a> {
    name: &'a [u8],
    begin: usize,
    end: usize,
}

impl<'a> Chunk<'a> {
    /// None for bytes that this version of Lua has not written.
    pub(super) fn read(bytes: &'a [u8]) -> Option<Self> {
        let mut reader = Reader(bytes);
        let header = reader.take(HEADER_SIZE)?;
        let _upvalues = reader.byte()?;
        Some(Self {
            header,
            main: reader.function()?,
        })
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "Lua has at most 255 upvalues"
    )]
    pub(super) fn write(&self) -> Vec<u8> {
        let mut out = self.header.to_vec();
        out.push(self.main.upvalues.len() as u8);
        self.main.write(&mut out);
        out
    }
}

impl Prototype<'_> {
    /// The index of the constant `true`, which is added if necessary.
    pub(super) fn constant_true(&mut self) -> usize {
        self.constant(vec![TRUE])
    }

    /// The index of a short string constant, which is added if necessary.
    pub(super) fn constant_text(&mut self, text: &str) -> usize {
        let mut constant = vec![SHORT_STRING];
        write_text(&mut constant, text.as_bytes());
        self.constant(constant)
    }

    fn constant(&mut self, bytes: Vec<u8>) -> usize {
        if let Some(known) = self
            .constants
            .iter()
            .position(|constant| **constant == *bytes)
        {
            return known;
        }
        self.constants.push(Cow::Owned(bytes));
        self.constants.len() - 1
    }

    /// Adds an upvalue, which is upvalue `outer` of the enclosing function, and returns its index. None if there are too many.
    pub(super) fn add_upvalue(&mut self, name: &str, outer: u8) -> Option<u8> {
        let number = u8::try_from(self.upvalues.len())
            .ok()
            .filter(|&number| number < u8::MAX)?;
        self.upvalues.push([u8::from(self.line == 0), outer, 0]);
        let mut bytes = Vec::new();
        write_text(&mut bytes, name.as_bytes());
        self.upvalue_names.push(Cow::Owned(bytes));
        Some(number)
    }

    /// Whether it uses the variable in a register of the enclosing function.
    pub(super) fn captures(&self, register: u8) -> bool {
        self.upvalues
            .iter()
            .any(|&[is_local, index, _]| is_local != 0 && index == register)
    }

    /// Whether it, or a function inside it, has a local variable of that name.
    pub(super) fn has_local(&self, name: &[u8]) -> bool {
        self.locals
            .iter()
            .any(|local| text_of(local.name) == Some(name))
            || self.inner.iter().any(|inner| inner.has_local(name))
    }

    /// The name of an upvalue, as far as it is known.
    pub(super) fn upvalue_name(&self, number: usize) -> Option<&[u8]> {
        text_of(self.upvalue_names.get(number)?)
    }

    pub(super) fn constant_count(&self) -> usize {
        self.constants.len()
    }

    /// Makes the local variables that are live at instruction `place` live in these further instructions too, which come after all others.
    pub(super) fn repeat_locals(&mut self, place: usize, instructions: &Range<usize>) {
        let is_live = |local: &&Local<'_>| (local.begin..local.end).contains(&place);
        let repeated: Vec<_> = self
            .locals
            .iter()
            .filter(is_live)
            .map(|local| Local {
                name: local.name,
                begin: instructions.start,
                end: instructions.end,
            })
            .collect();
        self.locals.extend(repeated);
    }

    /// Updates the live ranges of locals after instructions moved to `place`.
    pub(super) fn move_locals(&mut self, place: impl Fn(usize) -> usize) {
        for local in &mut self.locals {
            (local.begin, local.end) = (place(local.begin), place(local.end));
        }
    }

    fn write(&self, out: &mut Vec<u8>) {
        out.extend(self.source);
        write_size(out, self.line);
        write_size(out, self.last_line);
        out.extend([self.parameters, u8::from(self.is_vararg), self.registers]);
        write_size(out, self.code.len());
        self.code
            .iter()
            .for_each(|instruction| out.extend(instruction.to_ne_bytes()));
        write_size(out, self.constants.len());
        self.constants
            .iter()
            .for_each(|constant| out.extend(&**constant));
        write_size(out, self.upvalues.len());
        self.upvalues.iter().for_each(|upvalue| out.extend(upvalue));
        write_size(out, self.inner.len());
        self.inner.iter().for_each(|inner| inner.write(out));
        self.write_lines(out);
        write_size(out, self.locals.len());
        for local in &self.locals {
            out.extend(local.name);
            write_size(out, local.begin);
            write_size(out, local.end);
        }
        write_size(out, self.upvalue_names.len());
        self.upvalue_names
            .iter()
            .for_each(|name| out.extend(&**name));
    }

    fn write_lines(&self, out: &mut Vec<u8>) {
        let (mut previous, mut since) = (numbers::count(self.line), 0);
        let (mut differences, mut absolute) = (Vec::new(), Vec::new());
        for (place, &line) in self.lines.iter().enumerate() {
            let difference = i8::try_from(i64::from(line) - previous)
                .ok()
                .filter(|&difference| difference != ABSOLUTE);
            match difference.filter(|_| since < MAX_DIFFERENCES) {
                Some(difference) => differences.push(difference.cast_unsigned()),
                None => {
                    differences.push(ABSOLUTE.cast_unsigned());
                    absolute.push((place, line));
                    since = 0;
                }
            }
            since += 1;
            previous = i64::from(line);
        }
        write_size(out, differences.len());
        out.extend(differences);
        write_size(out, absolute.len());
        for (place, line) in absolute {
            write_size(out, place);
            write_size(out, line as usize);
        }
    }
}

/// Whether an encoded constant is that text, which is short.
pub(super) fn is_short_string(constant: &[u8], text: &str) -> bool {
    constant.split_first().is_some_and(|(&kind, encoded)| {
        kind == SHORT_STRING && text_of(encoded) == Some(text.as_bytes())
    })
}

/// The text of an encoded string.
fn text_of(encoded: &[u8]) -> Option<&[u8]> {
    let mut reader = Reader(encoded);
    let size = reader.size()?;
    reader.take(size.checked_sub(1)?)
}

/// A number in bytes of seven bits, most significant first; the last byte has the high bit set.
#[expect(clippy::cast_possible_truncation, reason = "seven bits are taken")]
pub(super) fn write_size(out: &mut Vec<u8>, size: usize) {
    let groups = (usize::BITS - size.leading_zeros()).div_ceil(7).max(1);
    for group in (0..groups).rev() {
        let mark = if group == 0 { 0x80 } else { 0 };
        out.push((size >> (7 * group)) as u8 & 0x7f | mark);
    }
}

fn write_text(out: &mut Vec<u8>, text: &[u8]) {
    write_size(out, text.len() + 1);
    out.extend(text);
}

struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, size: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(size)?;
        self.0 = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|bytes| bytes[0])
    }

    /// A number in bytes of seven bits, most significant first; the last byte has the high bit set.
    fn size(&mut self) -> Option<usize> {
        let mut size = 0_usize;
        loop {
            let byte = self.byte()?;
            size = size.checked_mul(0x80)? | usize::from(byte & 0x7f);
            if byte & 0x80 != 0 {
                return Some(size);
            }
        }
    }

    /// A count and as many items.
    fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let count = self.size()?;
        (0..count).map(|_| item(self)).collect()
    }

    /// The bytes that `skip` reads.
    fn raw(&mut self, skip: impl FnOnce(&mut Self) -> Option<()>) -> Option<&'a [u8]> {
        let before = self.0;
        skip(self)?;
        Some(&before[..before.len() - self.0.len()])
    }

    fn text(&mut self) -> Option<&'a [u8]> {
        self.raw(Self::skip_text)
    }

    fn skip_text(&mut self) -> Option<()> {
        let size = self.size()?;
        self.take(size.saturating_sub(1)).map(drop)
    }

    fn constant(&mut self) -> Option<Cow<'a, [u8]>> {
        let raw = self.raw(|reader| match reader.byte()? {
            FLOAT | INTEGER => reader.take(8).map(drop),
            SHORT_STRING | LONG_STRING => reader.skip_text(),
            _ => Some(()),
        });
        raw.map(Cow::Borrowed)
    }

    /// Reads a function and the functions inside it.
    fn function(&mut self) -> Option<Prototype<'a>> {
        let before = self.0;
        let source = self.text()?;
        let (line, last_line) = (self.size()?, self.size()?);
        let (parameters, is_vararg, registers) = (self.byte()?, self.byte()? != 0, self.byte()?);
        let code =
            self.list(|reader| Some(u32::from_ne_bytes(reader.take(4)?.try_into().ok()?)))?;
        let constants = self.list(Self::constant)?;
        let upvalues = self.list(|reader| reader.take(3)?.try_into().ok())?;
        let inner = self.list(Self::function)?;
        let lines = self.lines(line)?;
        let locals = self.list(|reader| {
            Some(Local {
                name: reader.text()?,
                begin: reader.size()?,
                end: reader.size()?,
            })
        })?;
        let upvalue_names = self.list(|reader| reader.text().map(Cow::Borrowed))?;
        Some(Prototype {
            raw: &before[..before.len() - self.0.len()],
            source,
            line,
            last_line,
            parameters,
            is_vararg,
            registers,
            code,
            constants,
            upvalues,
            inner,
            lines,
            locals,
            upvalue_names,
        })
    }

    /// The line of each instruction.
    fn lines(&mut self, defined: usize) -> Option<Vec<u32>> {
        let count = self.size()?;
        let differences = self.take(count)?;
        let absolute = self.list(|reader| Some((reader.size()?, reader.size()?)))?;
        let mut absolute = absolute.into_iter();
        let mut line = numbers::count(defined);
        let mut lines = Vec::with_capacity(count);
        for &difference in differences {
            line = match difference.cast_signed() {
                ABSOLUTE => numbers::count(absolute.next()?.1),
                difference => line + i64::from(difference),
            };
            lines.push(u32::try_from(line).ok()?);
        }
        Some(lines)
    }
}

#[cfg(test)]
mod tests {
    use super::{Chunk, Reader, write_size};

    #[test]
    fn reading_and_writing_round_trip() {
        let text = "local a <const>, b = 1.5, 'x'\n".to_owned()
            + &"\n".repeat(500)
            + &"b = b .. 'y' for i = 1, 3 do b = b .. i end\n".repeat(30)
            + "return function(...) local t <close> = nil return b, a, nil, true, ... end\n";
        let bytes = super::super::Bytecode::compile(text.as_bytes(), "=text")
            .expect("it compiles")
            .0;
        assert_eq!(Chunk::read(&bytes).expect("it is read").write(), bytes);
        assert!((0..bytes.len()).all(|end| Chunk::read(&bytes[..end]).is_none()));
    }

    #[test]
    fn sizes_round_trip() {
        for size in [0, 1, 0x7f, 0x80, 0x3fff, 0x4000, usize::MAX >> 8] {
            let mut bytes = Vec::new();
            write_size(&mut bytes, size);
            assert_eq!(Reader(&bytes).size(), Some(size));
        }
    }
}
