//! From CBOR to a Lua value, without calling Lua.

use std::ffi::c_int;

use super::low_level::position;
use super::{MAX_DEPTH, TOO_DEEP};
use scene::Data;
use scene::numbers;
use script::{ApiError, ApiResult, Args, LuaType, Stack, push_buffer};
use wire::cbor_head::{Head, INDEFINITE, major};

/// Room made for elements before they are read: a head may promise more than follows.
const MAX_HINT: usize = 1 << 10;

/// Names that the library uses for the major types with one kind of value, in their order.
const TYPES: [&str; 6] = ["UINT", "NINT", "BIN", "TEXT", "ARRAY", "MAP"];

/// Why there is no value.
enum Stop {
    /// A tag has a decoder in Lua.
    NeedsLua,
    Bad {
        message: String,
        at: usize,
    },
}

/// Kind of the value in CBOR.
#[derive(Clone, Copy)]
enum Kind {
    Name(&'static str),
    Tag(u64),
}

type Read<T> = Result<T, Stop>;

pub(super) fn decode(args: &mut Args<'_>) -> ApiResult<c_int> {
    let stack = args.stack();
    let at = position(stack)?;
    // It stays where it is for the whole decoding, whatever happens on the stack.
    let packet = stack.string(1).ok_or(ApiError::NotA {
        position: 1,
        expected: "string",
    })?;
    let bytes = &*packet.bytes();
    let at = at.min(bytes.len());
    if stack.kind(3) != LuaType::Table {
        return Err(ApiError::NotA {
            position: 3,
            expected: "table",
        });
    }
    let mut reader = Reader {
        stack,
        bytes,
        at,
        rich: stack.truthy(4),
        items: 0,
    };
    Ok(match reader.any(0, false) {
        Ok(kind) => reader.push_results(kind),
        Err(Stop::NeedsLua) => 0,
        Err(Stop::Bad { message, at }) => {
            stack.push_nil();
            stack.push_bytes(message.as_bytes());
            stack.push_int(numbers::count(at) + 1);
            3
        }
    })
}

struct Reader<'a> {
    stack: Stack<'a>,
    bytes: &'a [u8],
    at: usize,
    /// Byte strings become buffers, typed arrays tables.
    rich: bool,
    /// Values read, of all depths.
    items: usize,
}

impl<'a> Reader<'a> {
    /// Type, next position and value, from the value on top.
    fn push_results(&self, kind: Kind) -> c_int {
        let value = self.stack.top();
        match kind {
            Kind::Name(name) => self.stack.push_bytes(name.as_bytes()),
            Kind::Tag(number) => self.stack.push_bytes(format!("TAG_{number}").as_bytes()),
        }
        self.stack.push_int(numbers::count(self.at) + 1);
        self.stack.push_value(value);
        3
    }

    fn bad<T>(&self, message: impl Into<String>) -> Read<T> {
        Err(Stop::Bad {
            message: message.into(),
            at: self.at,
        })
    }

    fn head(&mut self) -> Read<Head> {
        let (head, end) =
            Head::read(self.bytes, self.at).or_else(|error| self.bad(error.to_string()))?;
        self.at = end;
        Ok(head)
    }

    /// The next item, which may be a lone break.
    fn any(&mut self, depth: usize, is_key: bool) -> Read<Kind> {
        let head = self.head()?;
        if head.is_break() {
            self.stack.push_bool(false);
            return Ok(Kind::Name("__break"));
        }
        self.item(head, depth, is_key)
    }

    /// The next item of a container that is not at its end.
    fn inner(&mut self, depth: usize, is_key: bool) -> Read<Kind> {
        let head = self.head()?;
        self.item(head, depth, is_key)
    }

    fn count(&mut self, items: usize) -> Read<()> {
        self.items += items;
        if self.items > Data::MAX_ITEMS {
            self.bad(format!("more than {} elements", Data::MAX_ITEMS))
        } else {
            Ok(())
        }
    }

    /// Pushes the item that began with `head`.
    fn item(&mut self, head: Head, depth: usize, is_key: bool) -> Read<Kind> {
        if depth > MAX_DEPTH || !self.stack.reserve(8) {
            return self.bad(TOO_DEEP);
        }
        self.count(1)?;
        match head.major {
            major::UNSIGNED => self.stack.push_int(head.argument.cast_signed()),
            major::NEGATIVE => self.stack.push_int(!head.argument.cast_signed()),
            major::BYTES => self.bytes_item(head, is_key)?,
            major::TEXT => self.string(head, push_text)?,
            major::ARRAY => self.array(head, depth)?,
            major::MAP => self.map(head, depth)?,
            major::TAG => return self.tagged(head.argument, depth, is_key),
            _ => return self.simple(head),
        }
        Ok(Kind::Name(TYPES[usize::from(head.major >> 5)]))
    }

    fn bytes_item(&mut self, head: Head, is_key: bool) -> Read<()> {
        if self.rich && !is_key {
            self.string(head, push_buffer)
        } else {
            self.string(head, push_text)
        }
    }

    /// Hands the bytes of a string, in one piece or in several up to a break, to `push`.
    fn string(&mut self, head: Head, push: fn(Stack<'_>, &[u8])) -> Read<()> {
        if head.info != INDEFINITE {
            let piece = self.piece(head.argument)?;
            push(self.stack, piece);
            return Ok(());
        }
        let mut whole = Vec::new();
        loop {
            let part = self.head()?;
            if part.is_break() {
                break;
            }
            if part.major != head.major || part.info == INDEFINITE {
                return self.bad("a string of unknown length consists of strings of its type");
            }
            whole.extend_from_slice(self.piece(part.argument)?);
        }
        push(self.stack, &whole);
        Ok(())
    }

    fn piece(&mut self, len: u64) -> Read<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let Some(piece) = usize::try_from(len).ok().and_then(|len| rest.get(..len)) else {
            return self.bad("no more input");
        };
        self.at += piece.len();
        Ok(piece)
    }

    /// Elements a container promises, `bytes` each at least; None when it ends with a break.
    fn promised(&self, head: Head, bytes: u64) -> Read<Option<usize>> {
        if head.info == INDEFINITE {
            return Ok(None);
        }
        let rest = (self.bytes.len() - self.at) as u64;
        match usize::try_from(head.argument) {
            Ok(promised) if head.argument <= rest / bytes => Ok(Some(promised)),
            _ => self.bad("no more input"),
        }
    }

    /// The head of the next element; None at the end of the container.
    fn next(&mut self, promised: Option<usize>, read: i64) -> Read<Option<Head>> {
        if promised.is_some_and(|promised| numbers::count(promised) == read) {
            return Ok(None);
        }
        let head = self.head()?;
        Ok(if promised.is_none() && head.is_break() {
            None
        } else {
            Some(head)
        })
    }

    fn array(&mut self, head: Head, depth: usize) -> Read<()> {
        let promised = self.promised(head, 1)?;
        self.stack.new_table(promised.unwrap_or(4).min(MAX_HINT), 0);
        let table = self.stack.top();
        let mut read = 0;
        while let Some(head) = self.next(promised, read)? {
            self.item(head, depth + 1, false)?;
            read += 1;
            self.stack.raw_set_index(table, read);
        }
        Ok(())
    }

    fn map(&mut self, head: Head, depth: usize) -> Read<()> {
        let promised = self.promised(head, 2)?;
        self.stack.new_table(0, promised.unwrap_or(4).min(MAX_HINT));
        let table = self.stack.top();
        let mut read = 0;
        while let Some(head) = self.next(promised, read)? {
            self.item(head, depth + 1, true)?;
            match self.stack.kind(-1) {
                LuaType::Nil => return self.bad("table index is nil"),
                LuaType::Number if self.stack.number(-1).is_some_and(f64::is_nan) => {
                    return self.bad("table index is NaN");
                }
                _ => {}
            }
            self.inner(depth + 1, false)?;
            self.stack.raw_set(table);
            read += 1;
        }
        Ok(())
    }

    fn tagged(&mut self, number: u64, depth: usize, is_key: bool) -> Read<Kind> {
        let known = self.stack.raw_get_index(3, number.cast_signed()) != LuaType::Nil;
        self.stack.pop(1);
        if known {
            return Err(Stop::NeedsLua);
        }
        if !self.rich || !self.typed_array(number)? {
            self.inner(depth + 1, is_key)?;
        }
        Ok(Kind::Tag(number))
    }

    /// Pushes the numbers of a typed array (RFC 8746, the kinds CoppeliaSim writes); false when it is none.
    fn typed_array(&mut self, tag: u64) -> Read<bool> {
        match Head::read(self.bytes, self.at) {
            Ok((head, end))
                if head.major == major::BYTES && head.info != INDEFINITE && is_typed(tag) =>
            {
                self.at = end;
                let bytes = self.piece(head.argument)?;
                self.count(bytes.len())?;
                push_typed(self.stack, tag, bytes);
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    fn simple(&mut self, head: Head) -> Read<Kind> {
        if head.is_break() {
            return self.bad("unexpected break");
        }
        if let Some(float) = head.float() {
            self.stack.push_number(float);
            return Ok(Kind::Name(
                ["half", "single", "double"][usize::from(head.info - 25)],
            ));
        }
        Ok(Kind::Name(match head.argument {
            20 | 21 => {
                self.stack.push_bool(head.argument == 21);
                if head.argument == 21 { "true" } else { "false" }
            }
            22 | 23 => {
                self.stack.push_nil();
                if head.argument == 22 {
                    "null"
                } else {
                    "undefined"
                }
            }
            number => {
                self.stack.push_int(number.cast_signed());
                "SIMPLE"
            }
        }))
    }
}

fn push_text(stack: Stack<'_>, bytes: &[u8]) {
    stack.push_bytes(bytes);
}

fn is_typed(tag: u64) -> bool {
    matches!(tag, 64 | 69 | 70 | 78 | 79 | 85 | 86)
}

/// A table of the little-endian numbers in `bytes`; an incomplete last one is dropped.
fn push_typed(stack: Stack<'_>, tag: u64, bytes: &[u8]) {
    match tag {
        64 => push_numbers(stack, bytes, |[b]: &[u8; 1]| stack.push_int(i64::from(*b))),
        69 => push_numbers(stack, bytes, |b| {
            stack.push_int(i64::from(u16::from_le_bytes(*b)));
        }),
        70 => push_numbers(stack, bytes, |b| {
            stack.push_int(i64::from(u32::from_le_bytes(*b)));
        }),
        78 => push_numbers(stack, bytes, |b| {
            stack.push_int(i64::from(i32::from_le_bytes(*b)));
        }),
        79 => push_numbers(stack, bytes, |b| stack.push_int(i64::from_le_bytes(*b))),
        85 => push_numbers(stack, bytes, |b| {
            stack.push_number(f64::from(f32::from_le_bytes(*b)));
        }),
        _ => push_numbers(stack, bytes, |b| stack.push_number(f64::from_le_bytes(*b))),
    }
}

fn push_numbers<const N: usize>(stack: Stack<'_>, bytes: &[u8], push: impl Fn(&[u8; N])) {
    let (numbers, _) = bytes.as_chunks::<N>();
    stack.new_table(numbers.len(), 0);
    for (i, number) in numbers.iter().enumerate() {
        push(number);
        stack.raw_set_index(-2, numbers::count(i) + 1);
    }
}
