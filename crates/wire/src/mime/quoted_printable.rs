//! Quoted-printable in chunks.

/// The encoder. What cannot be decided before more comes (a space that may end a line, a CR) waits in `pending`.
pub struct QuotedPrintable<'a> {
    /// The representation of a line end.
    pub marker: &'a [u8],
    /// Bytes that are not encoded yet, because what follows decides how.
    pub pending: Vec<u8>,
}

impl QuotedPrintable<'_> {
    /// Encodes a chunk.
    pub fn encode(&mut self, chunk: &[u8], out: &mut Vec<u8>) {
        for &byte in chunk {
            self.pending.push(byte);
            self.end_line(out);
        }
    }

    /// Decides what can be decided: at most a space, a CR, or a space and a CR wait.
    fn end_line(&mut self, out: &mut Vec<u8>) {
        loop {
            match self.pending[..] {
                [] | [b' ' | b'\t' | b'\r'] | [b' ' | b'\t', b'\r'] => return,
                [b'\r', b'\n', ..] => {
                    out.extend_from_slice(self.marker);
                    self.pending.drain(..2);
                }
                [blank @ (b' ' | b'\t'), b'\r', b'\n', ..] => {
                    quote(blank, out);
                    self.pending.remove(0);
                }
                [byte, ..] => {
                    encode_byte(byte, out);
                    self.pending.remove(0);
                }
            }
        }
    }

    /// Encodes what waits: nothing follows. A soft line break keeps a blank from the end of the text.
    pub fn finish(&mut self, out: &mut Vec<u8>) {
        if self.pending.is_empty() {
            return;
        }
        for byte in self.pending.drain(..) {
            match byte {
                b' ' | b'\t' => quote(byte, out),
                _ => encode_byte(byte, out),
            }
        }
        out.extend_from_slice(b"=\r\n");
    }
}

fn encode_byte(byte: u8, out: &mut Vec<u8>) {
    match byte {
        b'=' => quote(byte, out),
        b'\t' | b' '..=b'~' => out.push(byte),
        _ => quote(byte, out),
    }
}

fn quote(byte: u8, out: &mut Vec<u8>) {
    const DIGITS: &[u8; 16] = b"0123456789ABCDEF";
    out.extend([
        b'=',
        DIGITS[usize::from(byte >> 4)],
        DIGITS[usize::from(byte & 15)],
    ]);
}

/// Decodes; an escape that is not complete comes back. What is no escape stays as it is.
pub fn decode_quoted_printable(mut text: &[u8]) -> (Vec<u8>, &[u8]) {
    let mut out = Vec::with_capacity(text.len());
    loop {
        let at = memchr::memchr(b'=', text).unwrap_or(text.len());
        out.extend_from_slice(&text[..at]);
        text = &text[at..];
        match *text {
            [] | [_] | [_, _] => return (out, text),
            [_, b'\r', b'\n', ..] => {}
            [_, high, low, ..] => match (digit(high), digit(low)) {
                (Some(high), Some(low)) => out.push(high << 4 | low),
                _ => out.extend_from_slice(&text[..3]),
            },
        }
        text = &text[3..];
    }
}

fn digit(letter: u8) -> Option<u8> {
    char::from(letter)
        .to_digit(16)
        .and_then(|value| value.try_into().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encode(chunks: &[&str]) -> String {
        let mut encoder = QuotedPrintable {
            marker: b"\r\n",
            pending: Vec::new(),
        };
        let mut out = Vec::new();
        chunks
            .iter()
            .for_each(|chunk| encoder.encode(chunk.as_bytes(), &mut out));
        encoder.finish(&mut out);
        String::from_utf8(out).expect("quoted-printable is ASCII")
    }

    #[test]
    fn blanks_at_line_ends_are_quoted() {
        assert_eq!(encode(&["é=\n"]), "=C3=A9=3D=0A");
        assert_eq!(encode(&["a b", " \r", "\nc"]), "a b=20\r\nc");
        assert_eq!(encode(&["a \t\r\nb"]), "a =09\r\nb");
        assert_eq!(encode(&["a\r", "b"]), "a=0Db");
        assert_eq!(encode(&["end "]), "end=20=\r\n");
    }

    #[test]
    fn decoding_takes_escapes_apart() {
        assert_eq!(
            decode_quoted_printable(b"=C3=a9 x=\r\ny=zz"),
            ("é xy=zz".as_bytes().to_vec(), &b""[..])
        );
        assert_eq!(
            decode_quoted_printable(b"ab=C"),
            (b"ab".to_vec(), &b"=C"[..])
        );
    }
}
