//! TCPROS: the heads of connections and the frames of messages.

mod server;

use std::collections::BTreeMap;
use std::io::{Read, Write};

pub(crate) use server::{Connection, Server};

use crate::{Error, Result, limits};

/// What a side says about itself when a connection begins.
pub(crate) type Head = BTreeMap<String, String>;

/// Sends a head.
pub(crate) fn write_head(stream: &mut impl Write, fields: &[(&str, &str)]) -> Result<()> {
    let mut bytes = Vec::new();
    for (name, value) in fields {
        let field = format!("{name}={value}");
        bytes.extend_from_slice(&(field.len() as u32).to_le_bytes());
        bytes.extend_from_slice(field.as_bytes());
    }
    write_frame(stream, &bytes)
}

/// Reads a head.
pub(crate) fn read_head(stream: &mut impl Read) -> Result<Head> {
    let bytes = read_frame(stream, limits::HEAD)?.ok_or_else(|| Error::protocol("no head"))?;
    let mut rest = bytes.as_slice();
    let mut head = Head::new();
    while let Some((length, after)) = rest.split_first_chunk() {
        let length = u32::from_le_bytes(*length) as usize;
        let (field, after) = after
            .split_at_checked(length)
            .ok_or_else(|| Error::protocol("a field of a head"))?;
        let field = String::from_utf8_lossy(field);
        let (name, value) = field
            .split_once('=')
            .ok_or_else(|| Error::protocol("a field of a head"))?;
        head.insert(name.to_string(), value.to_string());
        rest = after;
    }
    if rest.is_empty() {
        Ok(head)
    } else {
        Err(Error::protocol("the end of a head"))
    }
}

/// A field of a head; empty if it is not there.
pub(crate) fn field<'a>(head: &'a Head, name: &str) -> &'a str {
    head.get(name).map_or("", String::as_str)
}

/// Sends bytes with their length.
pub(crate) fn write_frame(stream: &mut impl Write, bytes: &[u8]) -> Result<()> {
    let length =
        u32::try_from(bytes.len()).map_err(|_| Error::protocol("a message of more than 4 GB"))?;
    // One packet for a short message.
    if bytes.len() < 1 << 14 {
        stream.write_all(&[&length.to_le_bytes(), bytes].concat())?;
    } else {
        stream.write_all(&length.to_le_bytes())?;
        stream.write_all(bytes)?;
    }
    Ok(())
}

/// Reads bytes with their length. None if the connection has ended before them.
pub(crate) fn read_frame(stream: &mut impl Read, limit: usize) -> Result<Option<Vec<u8>>> {
    let mut length = [0; 4];
    if let Err(error) = stream.read_exact(&mut length) {
        return match error.kind() {
            std::io::ErrorKind::UnexpectedEof => Ok(None),
            _ => Err(error.into()),
        };
    }
    let length = u32::from_le_bytes(length) as usize;
    if length > limit {
        return Err(Error::protocol(format!(
            "a message of {length} bytes, more than {limit}"
        )));
    }
    // Memory is taken as bytes arrive.
    let mut bytes = Vec::with_capacity(length.min(64 << 10));
    stream.take(length as u64).read_to_end(&mut bytes)?;
    if bytes.len() == length {
        Ok(Some(bytes))
    } else {
        Err(Error::protocol("half a message"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_read_as_they_are_written() {
        let mut bytes = Vec::new();
        write_head(
            &mut bytes,
            &[("topic", "/a"), ("message_definition", "int8 x=1\n")],
        )
        .expect("memory");
        let head = read_head(&mut bytes.as_slice()).expect("a head");
        assert_eq!(
            (
                field(&head, "topic"),
                field(&head, "message_definition"),
                field(&head, "x")
            ),
            ("/a", "int8 x=1\n", "")
        );
    }

    #[test]
    fn wrong_heads_and_frames_are_refused() {
        let huge = u32::MAX.to_le_bytes();
        let wrong: [&[u8]; 6] = [
            &[],
            &huge,
            &[1, 0, 0, 0, 5],
            &[4, 0, 0, 0, 9, 0, 0, 0],
            &[5, 0, 0, 0, 1, 0, 0, 0, b'x'],
            &[8, 0, 0, 0, 1],
        ];
        for mut bytes in wrong {
            assert!(read_head(&mut bytes).is_err(), "{bytes:?}");
        }
        assert!(matches!(read_frame(&mut [].as_slice(), 10), Ok(None)));
        assert!(read_frame(&mut [3, 0, 0, 0, 1].as_slice(), 10).is_err());
    }
}
