//! The binary container, and the buffers: in it, in the JSON as base64, or in files of their own.

use std::borrow::Cow;

use base64::Engine;
use serde_json::Value;

use super::{integer, item, list, refused, string};
use crate::Resolve;
use crate::bytes::Bytes;
use crate::error::{Location, ReadError, Result};
use crate::text::percent_decoded;

const JSON: u32 = 0x4e4f_534a;
const BINARY: u32 = 0x004e_4942;

/// The JSON of a file, and the binary part of a binary one.
pub(super) fn container(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>)> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let mut reader = Bytes::new(&bytes[4..], 4);
    let version = reader.u32("version")?;
    if version != 2 {
        return Err(ReadError::new(
            Location::Byte(4),
            "version",
            format!("{version} instead of 2"),
        ));
    }
    let length = numbers::place(reader.u32("length")?);
    if length > bytes.len() {
        return Err(ReadError::new(
            Location::Byte(8),
            "length",
            format!("{length} bytes are announced, the file has {}", bytes.len()),
        ));
    }
    let (mut json, mut binary) = (None, None);
    while reader.len() >= 8 {
        let (length, kind) = (numbers::place(reader.u32("chunk")?), reader.u32("chunk")?);
        let content = reader.take(length, "chunk")?;
        match kind {
            JSON if json.is_none() => json = Some(content),
            BINARY if binary.is_none() => binary = Some(content),
            _ => {}
        }
    }
    let json = json.ok_or_else(|| ReadError::new(Location::Byte(12), "chunk", "no JSON"))?;
    Ok((json, binary))
}

/// The bytes of each buffer.
pub(super) struct Buffers<'a> {
    buffers: Vec<Cow<'a, [u8]>>,
}

/// More buffers than this are not looked up: each may be a file that is opened.
const MAX_BUFFERS: usize = 1000;

impl<'a> Buffers<'a> {
    pub(super) fn load(root: &Value, binary: Option<&'a [u8]>, resolve: Resolve) -> Result<Self> {
        let list = list(root, "buffers");
        if list.len() > MAX_BUFFERS {
            return Err(refused(
                "buffers",
                format!("{} are more than {MAX_BUFFERS}", list.len()),
            ));
        }
        let mut buffers = Vec::new();
        for (number, buffer) in list.iter().enumerate() {
            let element = format!("buffer {number}");
            let bytes: Cow<[u8]> = match string(buffer, "uri") {
                Some(uri) => uri_bytes(uri, resolve)
                    .map_err(|why| refused(&element, why))?
                    .into(),
                None => binary
                    .ok_or_else(|| refused(&element, "neither a uri nor a binary part"))?
                    .into(),
            };
            let length = integer(buffer, "byteLength", &element)?.unwrap_or(0);
            if bytes.len() < length {
                return Err(refused(
                    &element,
                    format!("{length} bytes are announced, there are {}", bytes.len()),
                ));
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers })
    }

    /// The bytes of a buffer view, and its stride if it has one.
    pub(super) fn view(&self, root: &Value, index: usize) -> Result<(&[u8], Option<usize>)> {
        let view = item(root, "bufferViews", index)?;
        let element = format!("bufferView {index}");
        let need = |name: &str| {
            integer(view, name, &element)?.ok_or_else(|| refused(&element, format!("no {name}")))
        };
        let (buffer, length) = (need("buffer")?, need("byteLength")?);
        let start = integer(view, "byteOffset", &element)?.unwrap_or(0);
        let bytes = self
            .buffers
            .get(buffer)
            .ok_or_else(|| refused(&element, format!("no buffer {buffer}")))?;
        let range = start
            .checked_add(length)
            .and_then(|end| bytes.get(start..end));
        let range = range.ok_or_else(|| {
            refused(
                &element,
                format!("{length} bytes at {start} of a buffer of {}", bytes.len()),
            )
        })?;
        Ok((range, integer(view, "byteStride", &element)?))
    }
}

/// The bytes of a URI: base64 in it, or a file beside this one.
pub(super) fn uri_bytes(uri: &str, resolve: Resolve) -> std::result::Result<Vec<u8>, String> {
    let Some(data) = uri.strip_prefix("data:") else {
        return resolve(&percent_decoded(uri));
    };
    let Some((_, text)) = data.split_once(";base64,") else {
        return Err("a data URI without base64".into());
    };
    base64::engine::general_purpose::STANDARD
        .decode(text.trim_ascii())
        .map_err(|error| error.to_string())
}
