//! CoppeliaSim's own encoding of tables, scheme 0 of `sim.packTable`.
//!
//! ```text
//! packed  = version, table, [strings]      version: byte 5; 0 is what releases up to 4.4 wrote
//! table   = kind, count, item * count      kind: byte, 1 list, 0 map; count: i32 of items, so twice the entries of a map
//! item    = type, value                    type: byte, the number of sim.stackitem_*
//!           0 nil, 1 double, 2 bool (byte), 3 string (i32 length, bytes), 4 table, 9 i64; little-endian
//! strings = flag * number of strings, 255  in the order of the strings; bit 0: buffer, bit 1: key. Version 5 only
//! ```
//! The layout was read off table data inside scenes saved by releases 3.5 to 4.9. Those hold neither nil nor buffers nor empty tables:
//! their encoding, and a number other than a string as a key, follow from the numbers of the types but have not been seen.

use std::cmp::Ordering;

use super::Unreadable;
use scene::{Data, Key};

const VERSION: u8 = 5;
/// Numbers are doubles and nothing follows the table.
const OLD_VERSION: u8 = 0;

const LIST: u8 = 1;
const MAP: u8 = 0;

const NIL: u8 = 0;
const DOUBLE: u8 = 1;
const BOOL: u8 = 2;
const STRING: u8 = 3;
const TABLE: u8 = 4;
const INTEGER: u8 = 9;

const BUFFER_FLAG: u8 = 1;
const KEY_FLAG: u8 = 2;
const END_OF_FLAGS: u8 = 255;

/// Bytes that most tables do not exceed.
const INITIAL_CAPACITY: usize = 256;
/// How deep tables may be nested.
const MAX_DEPTH: usize = 100;

/// Whether `bytes` may be such a table, as opposed to a table in CBOR.
pub fn is_packed(bytes: &[u8]) -> bool {
    matches!(bytes.first(), Some(&(VERSION | OLD_VERSION)))
}

/// `table` packed. None if a string or table in it is longer than the format allows.
pub fn encode(table: &Data) -> Option<Vec<u8>> {
    let mut out = Writer {
        bytes: Vec::with_capacity(INITIAL_CAPACITY),
        flags: Vec::new(),
    };
    out.bytes.push(VERSION);
    out.table(table)?;
    let Writer { mut bytes, flags } = out;
    bytes.extend(flags);
    bytes.push(END_OF_FLAGS);
    Some(bytes)
}

struct Writer {
    bytes: Vec<u8>,
    flags: Vec<u8>,
}

impl Writer {
    fn table(&mut self, table: &Data) -> Option<()> {
        match table {
            Data::Map(entries) => {
                self.bytes.push(MAP);
                self.length(entries.len().checked_mul(2)?)?;
                sorted(entries).into_iter().try_for_each(|(key, value)| {
                    self.key(key)?;
                    self.item(value)
                })
            }
            Data::Array(items) => {
                self.bytes.push(LIST);
                self.length(items.len())?;
                items.iter().try_for_each(|item| self.item(item))
            }
            _ => None,
        }
    }

    fn item(&mut self, item: &Data) -> Option<()> {
        match item {
            Data::Nil => self.bytes.push(NIL),
            Data::Bool(b) => self.bytes.extend([BOOL, u8::from(*b)]),
            Data::Int(i) => self.number(INTEGER, i.to_le_bytes()),
            Data::Float(f) => self.number(DOUBLE, f.to_le_bytes()),
            Data::Text(text) => self.string(text, 0)?,
            Data::Buffer(bytes) => self.string(bytes, BUFFER_FLAG)?,
            Data::Array(_) | Data::Map(_) => {
                self.bytes.push(TABLE);
                self.table(item)?;
            }
        }
        Some(())
    }

    fn key(&mut self, key: &Key) -> Option<()> {
        match key {
            Key::Bool(b) => self.bytes.extend([BOOL, u8::from(*b)]),
            Key::Int(i) => self.number(INTEGER, i.to_le_bytes()),
            Key::Float(f) => self.number(DOUBLE, f.to_le_bytes()),
            Key::Text(text) => self.string(text, KEY_FLAG)?,
        }
        Some(())
    }

    fn number(&mut self, ty: u8, bytes: [u8; 8]) {
        self.bytes.push(ty);
        self.bytes.extend(bytes);
    }

    fn string(&mut self, bytes: &[u8], flag: u8) -> Option<()> {
        self.bytes.push(STRING);
        self.length(bytes.len())?;
        self.bytes.extend(bytes);
        self.flags.push(flag);
        Some(())
    }

    fn length(&mut self, length: usize) -> Option<()> {
        self.bytes.extend(i32::try_from(length).ok()?.to_le_bytes());
        Some(())
    }
}

/// Entries in the order CoppeliaSim writes them, seen for text keys only: alphabetical. Others come first, by value.
fn sorted(entries: &[(Key, Data)]) -> Vec<&(Key, Data)> {
    let number = |key: &Key| match *key {
        Key::Int(i) => i as f64,
        Key::Float(f) => f,
        Key::Bool(b) => f64::from(u8::from(b)),
        Key::Text(_) => f64::NAN,
    };
    let mut list: Vec<_> = entries.iter().collect();
    list.sort_by(|(a, _), (b, _)| match (a, b) {
        (Key::Text(a), Key::Text(b)) => a.cmp(b),
        (Key::Text(_), _) => Ordering::Greater,
        (_, Key::Text(_)) => Ordering::Less,
        _ => number(a).total_cmp(&number(b)),
    });
    list
}

/// The table `bytes` are.
///
/// # Errors
/// When they are none, or one that is nested too deeply or has more than [`Data::MAX_ITEMS`]. What follows the table is not looked at
/// beyond the flags of its strings.
pub fn decode(bytes: &[u8]) -> Result<Data, Unreadable> {
    let (&version, rest) = bytes.split_first().ok_or(Unreadable::Malformed)?;
    if !is_packed(bytes) {
        return Err(Unreadable::Malformed);
    }
    let mut input = Input {
        bytes: rest,
        items: 0,
    };
    let mut table = input.table(0)?;
    if version != OLD_VERSION {
        mark_buffers(&mut table, &mut input.bytes.iter());
    }
    Ok(table)
}

/// Unread input.
struct Input<'a> {
    bytes: &'a [u8],
    /// Values read, of all depths.
    items: usize,
}

impl Input<'_> {
    fn table(&mut self, depth: usize) -> Result<Data, Unreadable> {
        if depth > MAX_DEPTH {
            return Err(Unreadable::Malformed);
        }
        let kind = self.byte()?;
        let count = self.length()?;
        match kind {
            LIST => (0..count)
                .map(|_| self.item(depth))
                .collect::<Result<_, _>>()
                .map(Data::Array),
            MAP if count % 2 == 0 => (0..count / 2)
                .map(|_| self.entry(depth))
                .collect::<Result<_, _>>()
                .map(Data::Map),
            _ => Err(Unreadable::Malformed),
        }
    }

    fn entry(&mut self, depth: usize) -> Result<(Key, Data), Unreadable> {
        let key = match self.item(depth)? {
            Data::Bool(b) => Key::Bool(b),
            Data::Int(i) => Key::Int(i),
            Data::Float(f) if !f.is_nan() => Key::Float(f),
            Data::Text(text) => Key::Text(text),
            _ => return Err(Unreadable::Malformed),
        };
        Ok((key, self.item(depth)?))
    }

    fn item(&mut self, depth: usize) -> Result<Data, Unreadable> {
        if self.items == Data::MAX_ITEMS {
            return Err(Unreadable::TooMany);
        }
        self.items += 1;
        Ok(match self.byte()? {
            NIL => Data::Nil,
            BOOL => Data::Bool(self.byte()? != 0),
            DOUBLE => Data::Float(f64::from_le_bytes(self.array()?)),
            INTEGER => Data::Int(i64::from_le_bytes(self.array()?)),
            STRING => {
                let length = self.length()?;
                Data::Text(self.take(length)?.to_vec())
            }
            TABLE => self.table(depth + 1)?,
            _ => return Err(Unreadable::Malformed),
        })
    }

    fn byte(&mut self) -> Result<u8, Unreadable> {
        self.array::<1>().map(|[byte]| byte)
    }

    /// A length; what it is the length of has at least as many bytes.
    fn length(&mut self) -> Result<usize, Unreadable> {
        let length = usize::try_from(i32::from_le_bytes(self.array()?))
            .map_err(|_| Unreadable::Malformed)?;
        if length <= self.bytes.len() {
            Ok(length)
        } else {
            Err(Unreadable::Malformed)
        }
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Unreadable> {
        let (array, rest) = self
            .bytes
            .split_first_chunk()
            .ok_or(Unreadable::Malformed)?;
        self.bytes = rest;
        Ok(*array)
    }

    fn take(&mut self, length: usize) -> Result<&[u8], Unreadable> {
        let (taken, rest) = self
            .bytes
            .split_at_checked(length)
            .ok_or(Unreadable::Malformed)?;
        self.bytes = rest;
        Ok(taken)
    }
}

/// Makes buffers of the strings whose flag says so. Missing flags leave strings.
fn mark_buffers<'a>(data: &mut Data, flags: &mut impl Iterator<Item = &'a u8>) {
    match data {
        Data::Text(text)
            if flags
                .next()
                .is_some_and(|&flag| flag != END_OF_FLAGS && flag & BUFFER_FLAG != 0) =>
        {
            *data = Data::Buffer(std::mem::take(text));
        }
        Data::Array(items) => items.iter_mut().for_each(|item| mark_buffers(item, flags)),
        Data::Map(entries) => {
            for (key, value) in entries {
                if matches!(key, Key::Text(_)) {
                    flags.next();
                }
                mark_buffers(value, flags);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, Key, MAX_DEPTH, Unreadable, decode, encode};

    /// Custom data of scenes that CoppeliaSim saved: `sizes` of a floor (3.6), a state (4.7), part of a schema (4.9).
    const SAVED: [(&[u8], bool); 3] = [
        (
            b"\0\0\x04\0\0\0\x03\x05\0\0\0sizes\x04\x01\x02\0\0\0\x01\0\0\0\0\0\0\x39@\x01\0\0\0\0\0\0\x39@\
              \x03\x07\0\0\0version\x01\0\0\0\0\0\0\0\0",
            false,
        ),
        (b"\x05\x01\x03\0\0\0\x09\x01\0\0\0\0\0\0\0\x09\x01\0\0\0\0\0\0\0\x09\x02\0\0\0\0\0\0\0\xff", true),
        (
            b"\x05\0\x06\0\0\0\x03\x08\0\0\0bitCoded\x09\x0d\0\0\0\0\0\0\0\x03\x08\0\0\0graphPos\x09\0\0\0\0\0\0\0\0\
              \x03\x0a\0\0\0updateFreq\x09\x02\0\0\0\0\0\0\0\x02\x02\x02\xff",
            true,
        ),
    ];

    #[test]
    fn what_coppeliasim_saved_is_read_and_written_the_same() {
        for (bytes, current) in SAVED {
            let table = decode(bytes).expect("it was saved by CoppeliaSim");
            if current {
                assert_eq!(encode(&table).as_deref(), Some(bytes));
            }
        }
        assert_eq!(
            decode(SAVED[0].0),
            Ok(Data::map([
                ("sizes", [25.0, 25.0].into()),
                ("version", 0.0.into())
            ]))
        );
        assert_eq!(decode(SAVED[1].0), Ok([1, 1, 2].into()));
    }

    #[test]
    fn flags_follow_the_order_of_the_strings() {
        let table = Data::map([
            ("type", Data::text("color")),
            ("name", Data::Buffer(b"Color".to_vec())),
        ]);
        let bytes = encode(&table).expect("it is short");
        assert_eq!(bytes[bytes.len() - 5..], [2, 1, 2, 0, 255]);
        assert_eq!(
            decode(&bytes).map(|data| data.field("name").cloned()),
            Ok(table.field("name").cloned())
        );
    }

    #[test]
    fn values_come_back_as_they_were() {
        let entries = vec![
            (Key::Bool(true), Data::Array(Vec::new())),
            (Key::Int(-3), Data::Float(0.1)),
            (Key::Float(2.5), Data::Bool(false)),
            (
                Key::Text(b"list".to_vec()),
                Data::Array(vec![
                    Data::Int(i64::MIN),
                    Data::Nil,
                    Data::Text(vec![0xff, 0]),
                ]),
            ),
        ];
        let table = Data::Map(entries);
        let Some(Ok(Data::Map(read))) = encode(&table).map(|bytes| decode(&bytes)) else {
            panic!("a map was packed")
        };
        let Data::Map(entries) = table else { return };
        assert!(read.len() == entries.len() && entries.iter().all(|entry| read.contains(entry)));
    }

    #[test]
    fn nonsense_is_refused() {
        let nested = [&[5][..], &[1, 1, 0, 0, 0, 4].repeat(MAX_DEPTH + 2)].concat();
        let huge_count = [5, 1, 0xff, 0xff, 0xff, 0x7f, 0];
        for bytes in [
            &b""[..],
            b"\x05",
            b"\x05\0\x01\0\0\0\0\0",
            b"\x05\x02\0\0\0\0",
            &nested,
            &huge_count,
        ] {
            assert_eq!(decode(bytes), Err(Unreadable::Malformed), "{bytes:?}");
        }
        assert_eq!(encode(&Data::Int(1)), None);
    }
}
