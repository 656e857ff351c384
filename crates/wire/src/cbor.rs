//! CBOR (RFC 8949) for [`Data`].
//!
//! Tables are written with indefinite length, as CoppeliaSim does. A Lua string is written as text even when it is not UTF-8, and a
//! buffer as bytes, so that both come back as they were.

use ciborium_io::Read;
use ciborium_ll::{Decoder, Header, simple};

use super::Unreadable;
use super::cbor_head::{
    BREAK, FALSE, INDEFINITE, NULL, TRUE, major, push_float, push_head, push_int,
};
use scene::{Data, Key};

/// How deep arrays and maps may be nested.
const MAX_DEPTH: usize = 100;

/// `data` as CBOR.
pub fn encode(data: &Data) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes, data);
    bytes
}

fn write(out: &mut Vec<u8>, data: &Data) {
    match data {
        Data::Nil => out.push(NULL),
        Data::Bool(b) => write_bool(out, *b),
        Data::Int(i) => push_int(out, *i),
        Data::Float(f) => push_float(out, *f),
        Data::Text(text) => write_bytes(out, major::TEXT, text),
        Data::Buffer(bytes) => write_bytes(out, major::BYTES, bytes),
        Data::Array(items) => {
            out.push(major::ARRAY | INDEFINITE);
            items.iter().for_each(|item| write(out, item));
            out.push(BREAK);
        }
        Data::Map(entries) => {
            out.push(major::MAP | INDEFINITE);
            for (key, value) in entries {
                write_key(out, key);
                write(out, value);
            }
            out.push(BREAK);
        }
    }
}

fn write_key(out: &mut Vec<u8>, key: &Key) {
    match key {
        Key::Bool(b) => write_bool(out, *b),
        Key::Int(i) => push_int(out, *i),
        Key::Float(f) => push_float(out, *f),
        Key::Text(text) => write_bytes(out, major::TEXT, text),
    }
}

fn write_bool(out: &mut Vec<u8>, value: bool) {
    out.push(if value { TRUE } else { FALSE });
}

fn write_bytes(out: &mut Vec<u8>, major: u8, bytes: &[u8]) {
    push_head(out, major, bytes.len() as u64);
    out.extend_from_slice(bytes);
}

/// The value `bytes` begin with; what follows it is ignored.
///
/// # Errors
/// When they are not CBOR, nested too deeply, or of more than [`Data::MAX_ITEMS`] elements.
pub fn decode(bytes: &[u8]) -> Result<Data, Unreadable> {
    let mut input = Input {
        decoder: Decoder::from(bytes),
        size: bytes.len(),
        items: 0,
    };
    let header = input.pull()?;
    input.value(header, 0)
}

struct Input<'a> {
    decoder: Decoder<&'a [u8]>,
    /// No string is longer than all input.
    size: usize,
    /// Values read, of all depths.
    items: usize,
}

impl Input<'_> {
    fn pull(&mut self) -> Result<Header, Unreadable> {
        self.decoder.pull().map_err(|_| Unreadable::Malformed)
    }

    fn value(&mut self, header: Header, depth: usize) -> Result<Data, Unreadable> {
        if depth > MAX_DEPTH {
            return Err(Unreadable::Malformed);
        }
        if self.items == Data::MAX_ITEMS {
            return Err(Unreadable::TooMany);
        }
        self.items += 1;
        Ok(match header {
            Header::Positive(n) => i64::try_from(n).map_or(Data::Float(n as f64), Data::Int),
            Header::Negative(n) => {
                i64::try_from(n).map_or(Data::Float(-1.0 - n as f64), |n| Data::Int(!n))
            }
            Header::Float(f) => Data::Float(f),
            Header::Simple(simple::TRUE) => Data::Bool(true),
            Header::Simple(simple::FALSE) => Data::Bool(false),
            Header::Simple(_) => Data::Nil,
            Header::Text(len) => Data::Text(self.string(len)?),
            Header::Bytes(len) => Data::Buffer(self.string(len)?),
            Header::Array(len) => Data::Array(self.array(len, depth)?),
            Header::Map(len) => Data::Map(self.map(len, depth)?),
            Header::Tag(_) => {
                let tagged = self.pull()?;
                self.value(tagged, depth + 1)?
            }
            Header::Break => return Err(Unreadable::Malformed),
        })
    }

    /// The bytes of a string: in one piece, or in several up to a break.
    fn string(&mut self, len: Option<usize>) -> Result<Vec<u8>, Unreadable> {
        if let Some(len) = len {
            return self.piece(len);
        }
        let mut bytes = Vec::new();
        loop {
            match self.pull()? {
                Header::Break => return Ok(bytes),
                Header::Text(Some(len)) | Header::Bytes(Some(len)) => {
                    bytes.extend(self.piece(len)?);
                }
                _ => return Err(Unreadable::Malformed),
            }
        }
    }

    fn piece(&mut self, len: usize) -> Result<Vec<u8>, Unreadable> {
        if len > self.size {
            return Err(Unreadable::Malformed);
        }
        let mut bytes = vec![0; len];
        self.decoder
            .read_exact(&mut bytes)
            .map_err(|_| Unreadable::Malformed)?;
        Ok(bytes)
    }

    /// The next header of a list of known or open length; None at its end.
    fn next(&mut self, len: Option<usize>, read: usize) -> Result<Option<Header>, Unreadable> {
        if len == Some(read) {
            return Ok(None);
        }
        match self.pull()? {
            Header::Break if len.is_none() => Ok(None),
            header => Ok(Some(header)),
        }
    }

    fn array(&mut self, len: Option<usize>, depth: usize) -> Result<Vec<Data>, Unreadable> {
        let mut items = Vec::new();
        while let Some(header) = self.next(len, items.len())? {
            items.push(self.value(header, depth + 1)?);
        }
        Ok(items)
    }

    fn map(&mut self, len: Option<usize>, depth: usize) -> Result<Vec<(Key, Data)>, Unreadable> {
        let mut entries = Vec::new();
        while let Some(header) = self.next(len, entries.len())? {
            let key = match self.value(header, depth + 1)? {
                Data::Bool(b) => Key::Bool(b),
                Data::Int(i) => Key::Int(i),
                Data::Float(f) if !f.is_nan() => Key::Float(f),
                Data::Text(text) | Data::Buffer(text) => Key::Text(text),
                _ => return Err(Unreadable::Malformed),
            };
            let header = self.pull()?;
            entries.push((key, self.value(header, depth + 1)?));
        }
        Ok(entries)
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, Key, Unreadable, decode, encode};

    #[test]
    fn tables_are_written_open_ended() {
        assert_eq!(
            encode(&Data::Array(vec![1.into(), 2.into(), Data::text("a")])),
            b"\x9f\x01\x02\x61a\xff"
        );
        assert_eq!(
            encode(&Data::map([("k", true.into())])),
            b"\xbf\x61k\xf5\xff"
        );
    }

    #[test]
    fn values_come_back_as_they_were() {
        let entries = vec![
            (Key::Int(-3), Data::Float(0.1)),
            (Key::Text(b"s".to_vec()), Data::Text(vec![0xff, 0])),
            (Key::Bool(true), Data::Buffer(vec![0, 1])),
            (
                Key::Text(b"list".to_vec()),
                Data::Array(vec![Data::Int(i64::MIN), Data::Array(Vec::new())]),
            ),
        ];
        let data = Data::Map(entries);
        assert_eq!(decode(&encode(&data)), Ok(data));
    }

    #[test]
    fn nonsense_is_refused() {
        assert_eq!(decode(b""), Err(Unreadable::Malformed));
        assert_eq!(
            decode(b"\x7b\xff\xff\xff\xff\xff\xff\xff\xff"),
            Err(Unreadable::Malformed)
        );
        assert_eq!(decode(&[0x81; 5000]), Err(Unreadable::Malformed));
    }

    #[test]
    fn elements_are_bounded_at_all_depths() {
        let lists = [&[0x9f][..], &vec![0x80; Data::MAX_ITEMS], &[0xff]].concat();
        assert_eq!(decode(&lists), Err(Unreadable::TooMany));
    }
}
