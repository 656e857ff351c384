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
        return Err(FileError::Inflate("they are shorter than their announced size"));
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
        let byte = self.data.get(self.at / 8).ok_or(FileError::Inflate("they end too early"))?;
        let bit = byte >> (7 - self.at % 8) & 1 == 1;
        self.at += 1;
        Ok(bit)
    }

    fn byte(&mut self) -> FileResult<u8> {
        (0..8).try_fold(0, |byte, _| Ok(byte << 1 | u8::from(self.next()?)))
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

/// What a byte of codes makes of a state: the symbols it completes, and the node it ends at.
#[derive(Clone, Copy, Default)]
struct Move {
    symbols: [u8; 8],
    count: u8,
    next: u8,
}

impl Tree {
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

    /// Whole bytes by table: one look for eight bits of code.
    fn decode(&self, mut bits: Bits<'_>, size: usize) -> FileResult<Vec<u8>> {
        let inner: Vec<usize> = (0..self.nodes.len()).filter(|n| matches!(self.nodes[*n], Node::Inner(_))).collect();
        let table: Vec<Move> =
            inner.iter().flat_map(|node| (0..=255).map(|byte| self.walk(*node, byte, &inner))).collect();
        // Room for what the last byte writes beyond the end.
        let mut out = vec![0; size + 8];
        let (mut node, mut done) = (0, 0);
        while !bits.at.is_multiple_of(8) && done < size {
            node = self.step(node, bits.next()?, |symbol| {
                out[done] = symbol;
                done += 1;
            });
        }
        let mut state = inner.binary_search(&node).expect("a step ends at an inner node");
        for byte in &bits.data[bits.at / 8..] {
            if done >= size {
                break;
            }
            let entry = &table[state << 8 | usize::from(*byte)];
            out[done..done + 8].copy_from_slice(&entry.symbols);
            done += usize::from(entry.count);
            state = usize::from(entry.next);
        }
        if done < size {
            return Err(FileError::Inflate("they end too early"));
        }
        out.truncate(size);
        Ok(out)
    }

    fn step(&self, node: usize, bit: bool, mut emit: impl FnMut(u8)) -> usize {
        let Node::Inner(children) = self.nodes[node] else { return 0 };
        let next = usize::from(children[usize::from(bit)]);
        match self.nodes[next] {
            Node::Leaf(symbol) => {
                emit(symbol);
                0
            }
            Node::Inner(_) => next,
        }
    }

    fn walk(&self, from: usize, byte: u8, inner: &[usize]) -> Move {
        let mut entry = Move::default();
        let mut node = from;
        for bit in (0..8).rev() {
            node = self.step(node, byte >> bit & 1 == 1, |symbol| {
                entry.symbols[usize::from(entry.count)] = symbol;
                entry.count += 1;
            });
        }
        entry.next = inner.binary_search(&node).expect("a step ends at an inner node") as u8;
        entry
    }
}

/// The data compressed.
pub fn deflate(data: &[u8]) -> Vec<u8> {
    let mut counts = [0u64; 256];
    data.iter().for_each(|byte| counts[usize::from(*byte)] += 1);
    let (mut out, mut codes) = (BitWriter::default(), vec![(0, 0); 256]);
    loop {
        let Some(tree) = Branch::of_counts(&counts) else { return Vec::new() };
        if tree.depth() <= MAX_CODE {
            tree.write(&mut out, 0, 0, &mut codes);
            break;
        }
        // Flatter counts give a flatter tree, at the price of a few bits.
        counts.iter_mut().for_each(|count| *count = count.div_ceil(2));
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
        let mut heap: BinaryHeap<_> =
            used.map(|byte| Reverse((counts[usize::from(byte)], usize::from(byte), Self::Leaf(byte)))).collect();
        let mut number = 256;
        loop {
            let Reverse((count, _, rarest)) = heap.pop()?;
            let Some(Reverse((other_count, _, other))) = heap.pop() else { return Some(rarest) };
            heap.push(Reverse((count + other_count, number, Self::Inner(Box::new([rarest, other])))));
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
        let many: Vec<u8> = (0..5000u32).map(|n| (n * n % 251 / (1 + n % 7)) as u8).collect();
        for data in [&b"abracadabra"[..], b"", b"x", b"xxxxxxxxxxxxxxxxx", b"ab", &many] {
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
        let data: Vec<u8> = (0..24).flat_map(|n| vec![n as u8; counts[n] as usize]).collect();
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
