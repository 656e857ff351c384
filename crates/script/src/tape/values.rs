//! Plain values as bytes of a capture: everything comes back as it was, floats to the bit and tables in the order of their entries.

use capture::{Input, Recorded};
use scene::{Data, Key};

/// Tables may be nested that deeply: as deep as scripts can pass them on.
const MAX_DEPTH: usize = 128;

/// A value that can be captured.
#[derive(Debug, Clone, PartialEq)]
pub struct Taped(pub Data);

const NIL: u8 = 0;
const FALSE: u8 = 1;
const TRUE: u8 = 2;
const INT: u8 = 3;
const FLOAT: u8 = 4;
const TEXT: u8 = 5;
const BUFFER: u8 = 6;
const ARRAY: u8 = 7;
const MAP: u8 = 8;

impl Recorded for Taped {
    fn write(&self, out: &mut Vec<u8>) {
        write(&self.0, out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        read(input, 0).map(Self)
    }
}

/// Appends a value.
pub(super) fn write(data: &Data, out: &mut Vec<u8>) {
    match data {
        Data::Nil => out.push(NIL),
        Data::Bool(value) => out.push(if *value { TRUE } else { FALSE }),
        Data::Int(number) => {
            out.push(INT);
            number.write(out);
        }
        Data::Float(number) => {
            out.push(FLOAT);
            number.write(out);
        }
        Data::Text(bytes) => {
            out.push(TEXT);
            bytes.write(out);
        }
        Data::Buffer(bytes) => {
            out.push(BUFFER);
            bytes.write(out);
        }
        Data::Array(items) => {
            out.push(ARRAY);
            items.len().write(out);
            items.iter().for_each(|item| write(item, out));
        }
        Data::Map(entries) => {
            out.push(MAP);
            entries.len().write(out);
            for (key, value) in entries {
                write_key(key, out);
                write(value, out);
            }
        }
    }
}

fn write_key(key: &Key, out: &mut Vec<u8>) {
    write(
        &match key {
            Key::Bool(value) => Data::Bool(*value),
            Key::Int(number) => Data::Int(*number),
            Key::Float(number) => Data::Float(*number),
            Key::Text(text) => Data::Text(text.clone()),
        },
        out,
    );
}

/// Reads a value within `depth` tables.
pub(super) fn read(input: &mut Input<'_>, depth: usize) -> Option<Data> {
    let tag = input.byte()?;
    if tag >= ARRAY && depth >= MAX_DEPTH {
        return None;
    }
    Some(match tag {
        NIL => Data::Nil,
        FALSE => Data::Bool(false),
        TRUE => Data::Bool(true),
        INT => Data::Int(Recorded::read(input)?),
        FLOAT => Data::Float(Recorded::read(input)?),
        TEXT => Data::Text(input.bytes()?.to_vec()),
        BUFFER => Data::Buffer(input.bytes()?.to_vec()),
        ARRAY => {
            let items = (0..count(input)?).map(|_| read(input, depth + 1));
            Data::Array(items.collect::<Option<_>>()?)
        }
        MAP => {
            let entries = (0..count(input)?).map(|_| {
                let key = read_key(input, depth + 1)?;
                Some((key, read(input, depth + 1)?))
            });
            Data::Map(entries.collect::<Option<_>>()?)
        }
        _ => return None,
    })
}

/// How many items follow: each has a byte at least.
fn count(input: &mut Input<'_>) -> Option<usize> {
    usize::read(input).filter(|&count| count <= input.left())
}

fn read_key(input: &mut Input<'_>, depth: usize) -> Option<Key> {
    Some(match read(input, depth)? {
        Data::Bool(value) => Key::Bool(value),
        Data::Int(number) => Key::Int(number),
        Data::Float(number) => Key::Float(number),
        Data::Text(text) => Key::Text(text),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round(data: &Data) -> Option<Data> {
        let mut bytes = Vec::new();
        write(data, &mut bytes);
        let mut input = Input::new(&bytes);
        read(&mut input, 0).filter(|_| input.is_empty())
    }

    #[test]
    fn values_come_back_as_they_were() {
        let entries = vec![
            (Key::Text(b"b\xff".to_vec()), Data::Nil),
            (
                Key::Int(-3),
                Data::Array(vec![Data::Bool(true), Data::Float(0.1)]),
            ),
            (Key::Float(0.5), Data::Buffer(vec![0, 1])),
            (Key::Bool(false), Data::Text(b"\0".to_vec())),
        ];
        let map = Data::Map(entries);
        assert_eq!(round(&map), Some(map), "in the order of the entries");
        let nan = round(&Data::Float(f64::from_bits(0x7ff8_0000_0000_0007)));
        assert!(
            matches!(nan, Some(Data::Float(number)) if number.to_bits() == 0x7ff8_0000_0000_0007)
        );
    }

    #[test]
    fn what_is_no_value_is_refused() {
        let nested = [[ARRAY, 1].repeat(MAX_DEPTH + 1), vec![NIL]].concat();
        assert!(read(&mut Input::new(&nested), 0).is_none());
        for bad in [
            &[][..],
            &[99],
            &[FLOAT, 0],
            &[TEXT, 5, 1],
            &[ARRAY, 0xff, 0xff, 0xff, 0x7f],
            &[MAP, 1, NIL, NIL],
            &[MAP, 1, ARRAY, 0, NIL],
        ] {
            assert!(read(&mut Input::new(bad), 0).is_none(), "{bad:?}");
        }
    }
}
