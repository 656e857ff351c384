//! The bytes of a file: a head that says what follows, and the result.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `SWCACHE1` |
//! | 32 | the key, so that a file under a wrong name is noticed |
//! | 8 | length of the result, little-endian |
//! | 32 | SHA-256 of the result |
//! | | the result |

use ring::digest::{SHA256, digest};

use crate::key::{Key, LENGTH};

const MAGIC: &[u8; 8] = b"SWCACHE1";
const HEAD: usize = MAGIC.len() + LENGTH + 8 + LENGTH;

/// The file of a result.
pub(crate) fn seal(key: &Key, result: &[u8]) -> Vec<u8> {
    [&head(key, result), result].concat()
}

/// The result in a file; None where the file is not exactly what [`seal`] made of it.
pub(crate) fn open(key: &Key, mut file: Vec<u8>) -> Option<Vec<u8>> {
    let (found, result) = file.split_at_checked(HEAD)?;
    if found != head(key, result) {
        return None;
    }
    file.drain(..HEAD);
    Some(file)
}

fn head(key: &Key, result: &[u8]) -> Vec<u8> {
    let length = (result.len() as u64).to_le_bytes();
    [
        MAGIC,
        key.bytes().as_slice(),
        &length,
        digest(&SHA256, result).as_ref(),
    ]
    .concat()
}
