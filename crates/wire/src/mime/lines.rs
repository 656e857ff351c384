//! Lines: length, line ends, leading dots.

/// Breaks text into lines of at most `length` bytes. `left` is what still fits the current line.
pub fn wrap_text(text: &[u8], length: i64, mut left: i64, out: &mut Vec<u8>) -> i64 {
    for &byte in text {
        match byte {
            b'\r' => {}
            b'\n' => {
                out.extend_from_slice(b"\r\n");
                left = length;
            }
            _ => {
                if left <= 0 {
                    out.extend_from_slice(b"\r\n");
                    left = length;
                }
                out.push(byte);
                left -= 1;
            }
        }
    }
    left
}

/// The same for quoted-printable text: lines are broken softly, and no escape is torn apart.
pub fn wrap_quoted_printable(text: &[u8], length: i64, mut left: i64, out: &mut Vec<u8>) -> i64 {
    for &byte in text {
        let needed = match byte {
            b'\r' => continue,
            b'\n' => {
                out.extend_from_slice(b"\r\n");
                left = length;
                continue;
            }
            // The escape, and the mark of a soft line break.
            b'=' => 4,
            _ => 2,
        };
        if left < needed {
            out.extend_from_slice(b"=\r\n");
            left = length;
        }
        out.push(byte);
        left -= 1;
    }
    left
}

/// Replaces CR, LF, CR LF and LF CR by `marker`. `last` is half a line end seen before, or 0.
pub fn unify_line_ends(text: &[u8], mut last: u8, marker: &[u8], out: &mut Vec<u8>) -> u8 {
    for &byte in text {
        last = match (byte, last) {
            (b'\r' | b'\n', b'\r' | b'\n') => {
                if byte == last {
                    out.extend_from_slice(marker);
                }
                0
            }
            (b'\r' | b'\n', _) => {
                out.extend_from_slice(marker);
                byte
            }
            _ => {
                out.push(byte);
                0
            }
        };
    }
    last
}

/// Doubles the dots at the beginnings of lines. `seen` of the bytes of a CR LF went before.
pub fn stuff_dots(text: &[u8], mut seen: usize, out: &mut Vec<u8>) -> usize {
    for &byte in text {
        out.push(byte);
        seen = match (byte, seen) {
            (b'\r', _) => 1,
            (b'\n', 1) => 2,
            (b'.', 2) => {
                out.push(b'.');
                0
            }
            _ => 0,
        };
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(out: Vec<u8>) -> String {
        String::from_utf8(out).expect("the tests use ASCII")
    }

    #[test]
    fn lines_are_broken_where_they_are_full() {
        let mut out = Vec::new();
        assert_eq!(wrap_text(b"abcdef", 3, 3, &mut out), 0);
        assert_eq!(text(out), "abc\r\ndef");
        let mut out = Vec::new();
        wrap_quoted_printable(b"ab=3Dcd", 4, 4, &mut out);
        assert_eq!(text(out), "ab=\r\n=3D=\r\ncd");
    }

    #[test]
    fn all_line_ends_become_one() {
        let mut out = Vec::new();
        assert_eq!(
            unify_line_ends(b"a\rb\nc\r\nd\n\re\n\nf\r", 0, b"|", &mut out),
            b'\r'
        );
        assert_eq!(text(out), "a|b|c|d|e||f|");
    }

    #[test]
    fn only_leading_dots_are_doubled() {
        let mut out = Vec::new();
        assert_eq!(stuff_dots(b".a.\r\n.\r", 2, &mut out), 1);
        assert_eq!(text(out), "..a.\r\n..\r");
    }
}
