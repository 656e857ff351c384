//! Chunks: messages with their times, one after the other, compressed.

use std::io::Read;

use ruzstd::decoding::StreamingDecoder;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use super::RecordingError;

/// Bytes before a message: time, kind, length.
const MESSAGE_HEAD: usize = 8 + 1 + 4;
/// Bytes of the hash before a blob.
const HASH: usize = 16;

/// What a message contains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content<'a> {
    /// JSON.
    Text(&'a str),
    /// Begins with its kind.
    Binary(&'a [u8]),
    /// A mesh, a texture or points, which other messages name by its hash.
    Blob {
        /// The first bytes of the SHA-256 of `bytes`.
        hash: [u8; 16],
        /// The content; its layout depends on its use.
        bytes: &'a [u8],
    },
}

/// A message of a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedMessage<'a> {
    /// Seconds.
    pub time: f64,
    /// What it contains.
    pub content: Content<'a>,
}

/// Appends a message to a chunk.
pub(super) fn push(
    chunk: &mut Vec<u8>,
    time: f64,
    content: Content<'_>,
) -> Result<(), std::io::Error> {
    let (kind, hash, bytes) = match content {
        Content::Text(text) => (0, &[][..], text.as_bytes()),
        Content::Binary(bytes) => (1, &[][..], bytes),
        Content::Blob { ref hash, bytes } => (2, &hash[..], bytes),
    };
    let too_long = |_| std::io::Error::other("a message of a recording has 4 GB at most");
    let length = u32::try_from(hash.len() + bytes.len()).map_err(too_long)?;
    chunk.extend(time.to_le_bytes());
    chunk.push(kind);
    chunk.extend(length.to_le_bytes());
    chunk.extend_from_slice(hash);
    chunk.extend_from_slice(bytes);
    Ok(())
}

/// The messages of a chunk; an error ends them.
pub fn messages(chunk: &[u8]) -> impl Iterator<Item = Result<TimedMessage<'_>, RecordingError>> {
    let mut rest = chunk;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let message = first(&mut rest);
        if message.is_err() {
            rest = &[];
        }
        Some(message)
    })
}

fn first<'a>(rest: &mut &'a [u8]) -> Result<TimedMessage<'a>, RecordingError> {
    let cut = RecordingError::Damaged("a message is cut off");
    let Some((head, after)) = rest.split_first_chunk::<MESSAGE_HEAD>() else {
        return Err(cut);
    };
    let [a, b, c, d, e, f, g, h, kind, length @ ..] = *head;
    let length = u32::from_le_bytes(length) as usize;
    let Some((bytes, after)) = after.split_at_checked(length) else {
        return Err(cut);
    };
    *rest = after;
    let time = f64::from_le_bytes([a, b, c, d, e, f, g, h]);
    if !time.is_finite() {
        return Err(RecordingError::Damaged("a message has no time"));
    }
    let content = match kind {
        0 => Content::Text(
            std::str::from_utf8(bytes)
                .map_err(|_| RecordingError::Damaged("a text is no UTF-8"))?,
        ),
        1 => Content::Binary(bytes),
        2 => {
            let (hash, bytes) = bytes.split_first_chunk::<HASH>().ok_or(cut)?;
            Content::Blob { hash: *hash, bytes }
        }
        _ => return Err(RecordingError::Damaged("a message is of an unknown kind")),
    };
    Ok(TimedMessage { time, content })
}

/// The bytes as a zstd frame.
pub(super) fn compress(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec(bytes, CompressionLevel::Fastest)
}

/// What a zstd frame contains, at most so many bytes.
pub(super) fn decompress(frame: &[u8], limit: u64) -> Result<Vec<u8>, RecordingError> {
    let damaged = |_| RecordingError::Damaged("it cannot be decompressed");
    let decoder = StreamingDecoder::new(frame)
        .map_err(|_| RecordingError::Damaged("it is not compressed by zstd"))?;
    let mut bytes = Vec::new();
    decoder
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(damaged)?;
    if bytes.len() as u64 > limit {
        return Err(RecordingError::Damaged(
            "it is too large when it is decompressed",
        ));
    }
    Ok(bytes)
}
