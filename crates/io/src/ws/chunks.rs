//! Chunked bodies of HTTP requests (RFC 9112, section 7.1).

use httparse::Status;
use tokio_tungstenite::tungstenite::http::StatusCode;

use super::MAX_MESSAGE;
use super::http::MAX_HEAD;

/// Separator after the bytes of a chunk.
const LINE_END: &[u8] = b"\r\n";

/// A body that is put together from its chunks.
#[derive(Default)]
pub(super) struct Chunks {
    body: Vec<u8>,
    has_ended: bool,
}

impl Chunks {
    /// Takes complete chunks from the front of what was received; whether the body is complete.
    ///
    /// # Errors
    /// The status to answer with.
    pub(super) fn take(&mut self, received: &mut Vec<u8>) -> Result<bool, StatusCode> {
        let mut taken = 0;
        let is_complete = loop {
            let rest = &received[taken..];
            let step = if self.has_ended {
                trailer(rest)?
            } else {
                self.chunk(rest)?
            };
            match step {
                Some(length) => taken += length,
                None => break false,
            }
            if self.has_ended
                && received[..taken].ends_with(LINE_END)
                && step == Some(LINE_END.len())
            {
                break true;
            }
        };
        received.drain(..taken);
        Ok(is_complete)
    }

    pub(super) fn into_body(self) -> Vec<u8> {
        self.body
    }

    /// Length of the chunk at the front, with its head; nothing when more is to come.
    fn chunk(&mut self, bytes: &[u8]) -> Result<Option<usize>, StatusCode> {
        let (head, size) = match httparse::parse_chunk_size(bytes) {
            Ok(Status::Complete(parsed)) => parsed,
            Ok(Status::Partial) if bytes.len() < MAX_HEAD => return Ok(None),
            _ => return Err(StatusCode::BAD_REQUEST),
        };
        if size == 0 {
            self.has_ended = true;
            return Ok(Some(head));
        }
        let room = (MAX_MESSAGE - self.body.len()) as u64;
        let size = usize::try_from(size)
            .ok()
            .filter(|&size| size as u64 <= room);
        let end = head + size.ok_or(StatusCode::PAYLOAD_TOO_LARGE)?;
        let Some(behind) = bytes.get(end..end + LINE_END.len()) else {
            return Ok(None);
        };
        if behind != LINE_END {
            return Err(StatusCode::BAD_REQUEST);
        }
        self.body.extend_from_slice(&bytes[head..end]);
        Ok(Some(end + LINE_END.len()))
    }
}

/// Length of the line at the front, of those behind the last chunk: headers that are ignored, and an empty one at the end.
fn trailer(bytes: &[u8]) -> Result<Option<usize>, StatusCode> {
    let end = bytes
        .windows(LINE_END.len())
        .position(|pair| pair == LINE_END);
    match end {
        Some(end) => Ok(Some(end + LINE_END.len())),
        None if bytes.len() < MAX_HEAD => Ok(None),
        None => Err(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The body and what follows it, from pieces of so many bytes.
    fn read(text: &str, piece: usize) -> Result<Option<(String, String)>, u16> {
        let (mut chunks, mut received) = (Chunks::default(), Vec::new());
        let mut pieces = text.as_bytes().chunks(piece);
        while let Some(bytes) = pieces.next() {
            received.extend_from_slice(bytes);
            if chunks
                .take(&mut received)
                .map_err(|status| status.as_u16())?
            {
                received.extend(pieces.flatten());
                let text = |bytes| String::from_utf8(bytes).expect("it is text");
                return Ok(Some((text(chunks.into_body()), text(received))));
            }
        }
        Ok(None)
    }

    #[test]
    fn chunks_make_a_body_however_they_arrive() {
        for (text, body) in [
            ("0\r\n\r\n", ""),
            ("5\r\nhello\r\n0\r\n\r\n", "hello"),
            (
                "2;name=value\r\n\r\n\r\n00A\r\n0123456789\r\n0\r\nTrailer: x\r\n\r\n",
                "\r\n0123456789",
            ),
        ] {
            for piece in 1..=text.len() {
                assert_eq!(
                    read(text, piece),
                    Ok(Some((body.to_owned(), String::new()))),
                    "{text:?} by {piece}"
                );
            }
            let more = format!("{text}GET");
            assert_eq!(
                read(&more, more.len()),
                Ok(Some((body.to_owned(), "GET".to_owned())))
            );
            assert_eq!(read(&text[..text.len() - 1], 1), Ok(None), "{text:?}");
        }
    }

    #[test]
    fn what_is_no_chunk() {
        for (text, status) in [
            ("x\r\n", 400),
            ("-1\r\n", 400),
            ("1\r\nab\r\n", 400),
            ("FFFFFFFFFFFFFFFFF\r\n", 400),
            ("FFFFFFFFFFFFFFFF\r\n", 413),
            ("1E84801\r\n", 413),
        ] {
            assert_eq!(read(text, text.len()), Err(status), "{text:?}");
        }
        let endless = format!("1;{}", "x".repeat(MAX_HEAD));
        assert_eq!(read(&endless, endless.len()), Err(400));
        let endless = format!("0\r\n{}", "x".repeat(MAX_HEAD));
        assert_eq!(read(&endless, endless.len()), Err(431));
    }
}
