//! Memory that the simulator makes for plugins, until they release it.

use std::collections::BTreeMap;

/// Large blocks that are kept for further use when they are released, and their least length in words. Pictures are asked for in each step,
/// and new memory of that size costs more than to fill it.
const SPARES: usize = 8;
const LARGE: usize = 4096;

/// The memory, by its address. It consists of words, so that numbers of all kinds can lie there.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    used: BTreeMap<usize, Vec<u64>>,
    spares: Vec<Vec<u64>>,
}

impl Buffers {
    /// Keeps bytes with a NUL behind them; returns their address.
    pub fn add(&mut self, bytes: &[u8]) -> i64 {
        let (whole, rest) = bytes.as_chunks();
        // What is left of the bytes, and the NUL.
        let mut last = [0; 8];
        last[..rest.len()].copy_from_slice(rest);
        let mut words = self.empty(whole.len() + 1);
        words.extend(whole.iter().map(|word| u64::from_ne_bytes(*word)));
        words.push(u64::from_ne_bytes(last));
        let address = words.as_mut_ptr().expose_provenance();
        self.used.insert(address, words);
        (address as u64).cast_signed()
    }

    /// A block without words, with room for `length` of them.
    fn empty(&mut self, length: usize) -> Vec<u64> {
        let fits = |spare: &Vec<u64>| (length..=2 * length).contains(&spare.capacity());
        let spare = self.spares.iter().position(fits);
        let mut words = spare.map_or_else(Vec::new, |at| self.spares.swap_remove(at));
        words.clear();
        words.reserve_exact(length);
        words
    }

    /// Keeps a list of addresses of texts, and behind it the texts; returns its address.
    pub fn add_texts(&mut self, texts: &[Vec<u8>]) -> i64 {
        let ends_with_nul = |text: &Vec<u8>| text.iter().copied().chain([0]).collect::<Vec<u8>>();
        let bytes: Vec<u8> = texts.iter().flat_map(ends_with_nul).collect();
        let start = self.add(&[vec![0; 8 * texts.len()], bytes].concat());
        let Some(words) = usize::try_from(start)
            .ok()
            .and_then(|start| self.used.get_mut(&start))
        else {
            return 0;
        };
        let mut address = start.cast_unsigned() + 8 * texts.len() as u64;
        for (word, text) in words.iter_mut().zip(texts) {
            *word = address;
            address += text.len() as u64 + 1;
        }
        start
    }

    /// Releases it; false where the simulator has made nothing there. What lies in a larger block is released with it.
    pub fn release(&mut self, address: usize) -> bool {
        if let Some(words) = self.used.remove(&address) {
            if words.len() >= LARGE && self.spares.len() < SPARES {
                self.spares.push(words);
            }
            return true;
        }
        let before = self.used.range(..address).next_back();
        before.is_some_and(|(start, words)| address < start + 8 * words.len())
    }
}

#[cfg(test)]
mod tests {
    use super::Buffers;

    #[test]
    fn blocks_that_are_used_again_have_the_new_bytes() {
        let mut buffers = Buffers::default();
        let address = |number: i64| usize::try_from(number).expect("an address");
        let long = buffers.add(&[7; 80_000]);
        assert!(buffers.release(address(long)));
        assert!(!buffers.release(address(long)));
        let again = buffers.add(&[9; 50_001]);
        let words = &buffers.used[&address(again)];
        assert_eq!(words.len(), 50_001 / 8 + 1);
        assert_eq!(words[6250].to_ne_bytes(), [9, 0, 0, 0, 0, 0, 0, 0]);
    }

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
