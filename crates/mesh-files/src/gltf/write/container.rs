//! What holds the JSON and its buffer: the binary container, or the JSON itself.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::error::WriteError;

/// Header, JSON and buffer, each padded to four bytes.
pub(super) fn binary(json: &str, mut buffer: Vec<u8>) -> Result<Vec<u8>, WriteError> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = |bytes: usize| {
        u32::try_from(bytes)
            .map_err(|_| WriteError::TooLarge)
            .map(u32::to_le_bytes)
    };
    let binary_head = if buffer.is_empty() { 0 } else { 8 };
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(length(12 + 8 + json.len() + binary_head + buffer.len())?);
    file.extend(length(json.len())?);
    file.extend(b"JSON");
    file.extend(json);
    if !buffer.is_empty() {
        file.extend(length(buffer.len())?);
        file.extend(b"BIN\0");
        file.extend(buffer);
    }
    Ok(file)
}

/// Bytes as a URI.
pub(super) fn data_uri(bytes: &[u8]) -> String {
    format!(
        "data:application/octet-stream;base64,{}",
        STANDARD.encode(bytes)
    )
}
