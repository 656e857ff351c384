//! What a result depends on, as a digest.

use std::fmt;

use ring::digest::{Context, SHA256};

/// Bytes of a key.
pub(crate) const LENGTH: usize = 32;

/// The SHA-256 of all that a result depends on: what it is computed from, how, and by which version of the algorithm. Shown in hexadecimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key([u8; LENGTH]);

impl Key {
    /// The key of a result that depends on these texts, in this order.
    pub fn of(parts: &[&[u8]]) -> Self {
        let mut digest = Context::new(&SHA256);
        for part in parts {
            // With their lengths, so that no others read the same one after the other.
            digest.update(&(part.len() as u64).to_le_bytes());
            digest.update(part);
        }
        let mut key = [0; LENGTH];
        key.copy_from_slice(digest.finish().as_ref());
        Self(key)
    }

    pub(crate) fn bytes(&self) -> &[u8; LENGTH] {
        &self.0
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}
