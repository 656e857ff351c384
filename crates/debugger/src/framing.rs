//! Messages of the Debug Adapter Protocol as bytes: a header with the length, an empty line, and JSON.

use serde_json::Value;

/// Longer messages are refused.
const MAX_LENGTH: usize = 16 << 20;
/// Longer headers are refused.
const MAX_HEADER: usize = 4096;
/// Ends the header.
const END: &[u8] = b"\r\n\r\n";
/// The only field that matters.
const LENGTH: &str = "content-length";

/// Why bytes are no messages. Nothing can be read after that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Malformed(pub String);

/// Takes bytes apart into messages.
#[derive(Debug, Default)]
pub struct Framing {
    received: Vec<u8>,
}

impl Framing {
    /// Adds bytes as they come, in pieces of any size.
    pub fn push(&mut self, bytes: &[u8]) {
        self.received.extend_from_slice(bytes);
    }

    /// The next message that is there as a whole.
    ///
    /// # Errors
    /// When the bytes are no message.
    pub fn next_message(&mut self) -> Result<Option<Value>, Malformed> {
        let Some(end) = find(&self.received, END) else {
            if self.received.len() > MAX_HEADER {
                return Err(Malformed("a header has no end".into()));
            }
            return Ok(None);
        };
        let length = content_length(&self.received[..end])?;
        let (start, end) = (end + END.len(), end + END.len() + length);
        if self.received.len() < end {
            return Ok(None);
        }
        let message = serde_json::from_slice(&self.received[start..end])
            .map_err(|error| Malformed(format!("a message is no JSON: {error}")));
        self.received.drain(..end);
        message.map(Some)
    }
}

/// A message as bytes.
pub fn framed(message: &Value) -> Vec<u8> {
    let text = message.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len()).into_bytes()
}

fn find(bytes: &[u8], part: &[u8]) -> Option<usize> {
    let looked_at = &bytes[..bytes.len().min(MAX_HEADER)];
    looked_at
        .windows(part.len())
        .position(|window| window == part)
}

fn content_length(header: &[u8]) -> Result<usize, Malformed> {
    let header =
        std::str::from_utf8(header).map_err(|_| Malformed("a header is no text".into()))?;
    let fields = header.split("\r\n").filter_map(|line| line.split_once(':'));
    let lengths = fields.filter(|(name, _)| name.trim().eq_ignore_ascii_case(LENGTH));
    let length = lengths
        .last()
        .and_then(|(_, value)| value.trim().parse::<usize>().ok())
        .ok_or_else(|| Malformed("a header has no length".into()))?;
    if length > MAX_LENGTH {
        return Err(Malformed(format!(
            "a message of {length} bytes is too long"
        )));
    }
    Ok(length)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn read(bytes: &[u8]) -> Result<Vec<Value>, Malformed> {
        let mut framing = Framing::default();
        let mut messages = Vec::new();
        for byte in bytes.chunks(1) {
            framing.push(byte);
            while let Some(message) = framing.next_message()? {
                messages.push(message);
            }
        }
        Ok(messages)
    }

    #[test]
    fn messages_in_pieces_are_put_together() {
        let (a, b) = (json!({"seq": 1}), json!({"text": "\u{e4}\r\n\r\n"}));
        let bytes = [framed(&a), framed(&b)].concat();
        assert_eq!(read(&bytes), Ok(vec![a, b]));
        assert_eq!(read(&bytes[..bytes.len() - 1]).map(|all| all.len()), Ok(1));
    }

    #[test]
    fn other_fields_and_cases_of_letters_do_not_matter() {
        let bytes = b"content-type: x\r\ncontent-LENGTH:  2 \r\n\r\n[]";
        assert_eq!(read(bytes), Ok(vec![json!([])]));
    }

    #[test]
    fn malformed_messages_are_refused() {
        for bytes in [
            &b"GET / HTTP/1.1\r\n\r\n"[..],
            b"Content-Length: -1\r\n\r\n",
            b"Content-Length: x\r\n\r\n",
            b"Content-Length: 99999999999999999999999\r\n\r\n",
            b"Content-Length: 999999999\r\n\r\n",
            b"Content-Length: 2\r\n\r\n{]",
            b"\xff: 1\r\n\r\n",
            b"\r\n\r\n",
        ] {
            assert!(read(bytes).is_err(), "{}", String::from_utf8_lossy(bytes));
        }
        assert!(read(&[b'a'; MAX_HEADER + 1]).is_err());
    }

    #[test]
    fn nothing_is_allocated_for_what_has_not_come() {
        let mut framing = Framing::default();
        framing.push(b"Content-Length: 16000000\r\n\r\n");
        assert_eq!(framing.next_message(), Ok(None));
        assert!(framing.received.capacity() < 1000);
    }
}
