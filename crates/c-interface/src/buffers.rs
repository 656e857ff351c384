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

    /// Keeps a list of addresses of texts, and behind it the texts; returns its address.
    pub fn add_texts(&mut self, texts: &[Vec<u8>]) -> i64 {
        let ends_with_nul = |text: &Vec<u8>| text.iter().copied().chain([0]).collect::<Vec<u8>>();
        let bytes: Vec<u8> = texts.iter().flat_map(ends_with_nul).collect();
        let start = self.add(&[vec![0; 8 * texts.len()], bytes].concat());
        let Some(words) = usize::try_from(start)
            .ok()
            .and_then(|start| self.0.get_mut(&start))
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
        if self.0.remove(&address).is_some() {
            return true;
        }
        let before = self.0.range(..address).next_back();
        before.is_some_and(|(start, words)| address < start + 8 * words.len())
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
