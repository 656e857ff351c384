//! The compression of files: one static Huffman tree over bytes, then the codes without alignment, high bits first.
//!
//! The tree stands in pre-order: a 1 and eight bits are a leaf, a 0 is an inner node before its two subtrees.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::error::{FileError, FileResult};

const MAX_NODES: usize = 511;

/// Codes longer than this are not known to be read by every program.
const MAX_CODE: u8 = 32;

/// `size` bytes out of compressed data.
///
/// # Errors
///
/// A tree that is none, or data that end too early. No more is allocated than the data can hold: a code has a bit at least.
pub fn inflate(data: &[u8], size: usize) -> FileResult<Vec<u8>> {
    if size == 0 {
        return Ok(Vec::new());
    }
    let mut bits = Bits { data, at: 0 };
    let tree = Tree::read(&mut bits)?;
    if size > data.len().saturating_mul(8) {
        return Err(FileError::Inflate(
            "they are shorter than their announced size",
        ));
    }
    if let Node::Leaf(symbol) = tree.nodes[0] {
        return Ok(vec![symbol; size]);
    }
    tree.decode(bits, size)
}

struct Bits<'a> {
    data: &'a [u8],
    at: usize,
}

impl Bits<'_> {
    fn next(&mut self) -> FileResult<bool> {
        let byte = self
            .data
            .get(self.at / 8)
            .ok_or(FileError::Inflate("they end too early"))?;
        let bit = byte >> (7 - self.at % 8) & 1 == 1;
        self.at += 1;
        Ok(bit)
    }

    fn byte(&mut self) -> FileResult<u8> {
        (0..8).try_fold(0, |byte, _| Ok(byte << 1 | u8::from(self.next()?)))
    }

    /// The next bits, 57 at least, high ones first; zeros beyond the end.
    fn peek(&self) -> u64 {
        let rest = self.data.get(self.at / 8..).unwrap_or(&[]);
        let word = match rest.first_chunk::<8>() {
            Some(bytes) => u64::from_be_bytes(*bytes),
            None => rest
                .iter()
                .rev()
                .fold(0, |word, byte| word >> 8 | u64::from(*byte) << 56),
        };
        word << (self.at % 8)
    }
}

#[derive(Clone, Copy)]
enum Node {
    Leaf(u8),
    Inner([u16; 2]),
}

struct Tree {
    nodes: Vec<Node>,
}

/// How many bits are decoded by one look into the table. Longer codes are walked bit by bit.
const PEEK: usize = 11;
/// Looks that one word of 57 bits is good for.
const LOOKS: usize = 5;

/// Table entry for [`PEEK`] bits: the symbols whose codes are complete in them, and how many bits these take.
#[derive(Clone, Copy, Default)]
struct Entry {
    symbols: [u8; 4],
    count: u8,
    bits: u8,
}

impl Tree {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a tree has at most as many nodes as 16 bits count"
    )]
    fn read(bits: &mut Bits<'_>) -> FileResult<Self> {
        let mut nodes = Vec::new();
        // Where the number of the next node is to be written: the branches that are still open.
        let mut open: Vec<(usize, usize)> = Vec::new();
        loop {
            let here = nodes.len();
            if here == MAX_NODES {
                return Err(FileError::Inflate("their tree is too large"));
            }
            if let Some((parent, branch)) = open.pop()
                && let Node::Inner(children) = &mut nodes[parent]
            {
                children[branch] = here as u16;
            }
            if bits.next()? {
                nodes.push(Node::Leaf(bits.byte()?));
            } else {
                nodes.push(Node::Inner([0; 2]));
                open.extend([(here, 1), (here, 0)]);
            }
            if open.is_empty() {
                return Ok(Self { nodes });
            }
        }
    }

    fn decode(&self, mut bits: Bits<'_>, size: usize) -> FileResult<Vec<u8>> {
        let table: Vec<Entry> = (0..1 << PEEK).map(|peeked| self.entry(peeked)).collect();
        let mut out = vec![0; size];
        let mut done = 0;
        while done + 4 * LOOKS <= size {
            let mut word = bits.peek();
            for _ in 0..LOOKS {
                let entry = table[(word >> (64 - PEEK)) as usize];
                if entry.count == 0 {
                    out[done] = self.symbol(|| bits.next())?;
                    done += 1;
                    break;
                }
                out[done..done + 4].copy_from_slice(&entry.symbols);
                done += usize::from(entry.count);
                word <<= entry.bits;
                bits.at += usize::from(entry.bits);
            }
        }
        // The last ones one by one: codes beyond them do not count.
        for symbol in &mut out[done..] {
            *symbol = self.symbol(|| bits.next())?;
        }
        if bits.at > 8 * bits.data.len() {
            return Err(FileError::Inflate("they end too early"));
        }
        Ok(out)
    }

    /// The symbol that the next bits lead to.
    fn symbol(&self, mut next: impl FnMut() -> FileResult<bool>) -> FileResult<u8> {
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Leaf(symbol) => return Ok(symbol),
                Node::Inner(children) => node = usize::from(children[usize::from(next()?)]),
            }
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "a handful of bits are looked at"
    )]
    fn entry(&self, peeked: usize) -> Entry {
        let mut entry = Entry::default();
        let mut node = 0;
        for used in 1..=PEEK {
            let Node::Inner(children) = self.nodes[node] else {
                break;
            };
            node = usize::from(children[peeked >> (PEEK - used) & 1]);
            if let Node::Leaf(symbol) = self.nodes[node] {
                entry.symbols[usize::from(entry.count)] = symbol;
                (entry.count, entry.bits) = (entry.count + 1, used as u8);
                node = 0;
            }
            if usize::from(entry.count) == entry.symbols.len() {
                break;
            }
        }
        entry
    }
}

/// The data compressed.
pub fn deflate(data: &[u8]) -> Vec<u8> {
    let mut counts = [0u64; 256];
    data.iter().for_each(|byte| counts[usize::from(*byte)] += 1);
    let (mut out, mut codes) = (BitWriter::default(), vec![(0, 0); 256]);
    loop {
        let Some(tree) = Branch::of_counts(&counts) else {
            return Vec::new();
        };
        if tree.depth() <= MAX_CODE {
            tree.write(&mut out, 0, 0, &mut codes);
            break;
        }
        // Flatter counts give a flatter tree, at the price of a few bits.
        counts
            .iter_mut()
            .for_each(|count| *count = count.div_ceil(2));
    }
    for byte in data {
        let (code, length) = codes[usize::from(*byte)];
        out.push(code, length);
    }
    out.finish()
}

#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum Branch {
    Leaf(u8),
    Inner(Box<[Branch; 2]>),
}

impl Branch {
    fn of_counts(counts: &[u64; 256]) -> Option<Self> {
        let used = (0..=255).filter(|byte| counts[usize::from(*byte)] > 0);
        // The number breaks ties, so that the same data give the same file.
        let mut heap: BinaryHeap<_> = used
            .map(|byte| {
                Reverse((
                    counts[usize::from(byte)],
                    usize::from(byte),
                    Self::Leaf(byte),
                ))
            })
            .collect();
        let mut number = 256;
        loop {
            let Reverse((count, _, rarest)) = heap.pop()?;
            let Some(Reverse((other_count, _, other))) = heap.pop() else {
                return Some(rarest);
            };
            heap.push(Reverse((
                count + other_count,
                number,
                Self::Inner(Box::new([rarest, other])),
            )));
            number += 1;
        }
    }

    fn depth(&self) -> u8 {
        match self {
            Self::Leaf(_) => 0,
            Self::Inner(branches) => 1 + branches.iter().map(Self::depth).max().unwrap_or(0),
        }
    }

    fn write(&self, out: &mut BitWriter, code: u32, length: u8, codes: &mut [(u32, u8)]) {
        match self {
            Self::Leaf(byte) => {
                out.push(0x100 | u32::from(*byte), 9);
                // A file of one symbol has a bit per symbol all the same.
                codes[usize::from(*byte)] = (code, length.max(1));
            }
            Self::Inner(branches) => {
                out.push(0, 1);
                branches[0].write(out, code << 1, length + 1, codes);
                branches[1].write(out, code << 1 | 1, length + 1, codes);
            }
        }
    }
}

#[derive(Default)]
struct BitWriter {
    bytes: Vec<u8>,
    pending: u64,
    count: u8,
}

impl BitWriter {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the byte is the lowest eight bits"
    )]
    fn push(&mut self, code: u32, length: u8) {
        self.pending = self.pending << length | u64::from(code);
        self.count += length;
        while self.count >= 8 {
            self.count -= 8;
            self.bytes.push((self.pending >> self.count) as u8);
        }
    }

    fn finish(mut self) -> Vec<u8> {
        if self.count > 0 {
            self.push(0, 8 - self.count);
        }
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_compressed_comes_back() {
        let many: Vec<u8> = (0..5000u32)
            .map(|n| (n * n % 251 / (1 + n % 7)) as u8)
            .collect();
        for data in [
            &b"abracadabra"[..],
            b"",
            b"x",
            b"xxxxxxxxxxxxxxxxx",
            b"ab",
            &many,
        ] {
            assert_eq!(inflate(&deflate(data), data.len()).unwrap(), data);
        }
    }

    #[test]
    fn deep_trees_are_flattened() {
        let mut counts = [0; 256];
        let mut fibonacci = (1, 1);
        for count in &mut counts[..60] {
            *count = fibonacci.0;
            fibonacci = (fibonacci.1, fibonacci.0 + fibonacci.1);
        }
        assert!(Branch::of_counts(&counts).unwrap().depth() > MAX_CODE);
        let data: Vec<u8> = (0..24)
            .flat_map(|n| vec![n as u8; counts[n] as usize])
            .collect();
        assert_eq!(inflate(&deflate(&data), data.len()).unwrap(), data);
    }

    #[test]
    fn damaged_data_are_errors() {
        let good = deflate(b"the quick brown fox jumps over the lazy dog");
        for end in 0..good.len() {
            assert!(inflate(&good[..end], 43).is_err());
        }
        assert!(inflate(&[0; 200], 10).is_err(), "a tree without leaves");
        assert!(inflate(&good, usize::MAX).is_err());
    }
}
