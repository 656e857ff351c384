//! Memory that the simulator makes for plugins, until they release it.

use std::collections::BTreeMap;

/// The memory, by its address. It consists of words, so that numbers of all kinds can lie there.
#[derive(Debug, Default)]
pub(super) struct Buffers(BTreeMap<usize, Box<[u64]>>);

impl Buffers {
    /// Keeps bytes with a NUL behind them; returns their address.
    pub fn add(&mut self, bytes: &[u8]) -> i64 {
        let word = |bytes: &[u8]| {
            let mut word = [0; 8];
            word[..bytes.len()].copy_from_slice(bytes);
            u64::from_ne_bytes(word)
        };
        // One word more than needed, for the NUL.
        let mut words: Box<[u64]> = bytes.chunks(8).map(word).chain([0]).collect();
        let address = words.as_mut_ptr().expose_provenance();
        self.0.insert(address, words);
        (address as u64).cast_signed()
    }

    /// Releases it; false where the simulator has made nothing there.
    pub fn release(&mut self, address: usize) -> bool {
        self.0.remove(&address).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::Buffers;

    #[test]
    fn only_what_was_made_is_released_and_once() {
        let mut buffers = Buffers::default();
        let (one, other) = (buffers.add(b"12345678"), buffers.add(b""));
        assert_ne!(one, other);
        let address = |number: i64| usize::try_from(number).expect("an address");
        assert!(buffers.release(address(one)) && !buffers.release(address(one)));
        assert!(!buffers.release(1) && buffers.release(address(other)));
    }
}
