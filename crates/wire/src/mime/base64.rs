//! Base64 in chunks.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// Encodes all whole groups of three bytes; the rest comes back.
pub fn encode_base64(bytes: &[u8]) -> (String, &[u8]) {
    let (whole, rest) = bytes.split_at(bytes.len() - bytes.len() % 3);
    (STANDARD.encode(whole), rest)
}

/// Encodes the last bytes, with padding.
pub fn finish_base64(rest: &[u8]) -> String {
    STANDARD.encode(rest)
}

/// Decodes all whole groups of four letters; the letters left over come back. What is no letter of the alphabet is skipped.
pub fn decode_base64(text: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let mut out = Vec::with_capacity(text.len() / 4 * 3);
    let mut group = Vec::with_capacity(4);
    for &letter in text
        .iter()
        .filter(|&&letter| value_of(letter).is_some() || letter == b'=')
    {
        group.push(letter);
        if group.len() == 4 {
            decode_group(&group, &mut out);
            group.clear();
        }
    }
    (out, group)
}

fn value_of(letter: u8) -> Option<u32> {
    Some(
        match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        }
        .into(),
    )
}

/// One byte less for each `=` at the end of the group.
fn decode_group(group: &[u8], out: &mut Vec<u8>) {
    let bits = group.iter().fold(0, |bits, &letter| {
        bits << 6 | value_of(letter).unwrap_or_default()
    });
    let padding = group
        .iter()
        .rev()
        .take_while(|&&letter| letter == b'=')
        .count();
    out.extend_from_slice(&bits.to_be_bytes()[1..4 - padding.min(2)]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_fit_together() {
        assert_eq!(encode_base64(b"hello"), ("aGVs".to_owned(), &b"lo"[..]));
        assert_eq!(finish_base64(b"lo"), "bG8=");
        assert_eq!(
            decode_base64(b"aG Vs\nbG8="),
            (b"hello".to_vec(), Vec::new())
        );
        assert_eq!(decode_base64(b"aGVsb"), (b"hel".to_vec(), b"b".to_vec()));
        assert_eq!(decode_base64(b"===="), (vec![0], Vec::new()));
    }
}
