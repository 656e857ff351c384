//! Memory for the small blocks of one Lua state.
//!
//! Lua tells the size of what it gives back, so that blocks need no headers: a free one waits in the list of its size class. Tables come
//! and go by the thousand, and a general allocator took most of the time of a message between scripts. The memory of the lists is given
//! back when the state is closed.

use std::alloc::{Layout, alloc, dealloc, handle_alloc_error};
use std::ptr::NonNull;
use std::rc::Rc;

use super::Budget;

/// Sizes are rounded up to a multiple of this, which is also the alignment.
const STEP: usize = 16;
const CLASSES: usize = 32;
/// Larger blocks are not for the pool.
pub(super) const LARGEST: usize = STEP * CLASSES;

const FIRST_CHUNK: usize = 8 << 10;
const LARGEST_CHUNK: usize = 256 << 10;

/// A free block: it holds the link to the next one of its class.
struct Free(Option<NonNull<Free>>);

pub(super) struct Pool {
    pub(super) budget: Rc<Budget>,
    free: [Option<NonNull<Free>>; CLASSES],
    chunks: Vec<(NonNull<u8>, Layout)>,
    /// What is left of the newest chunk.
    rest: NonNull<u8>,
    rest_len: usize,
}

impl Pool {
    pub(super) fn new(budget: Rc<Budget>) -> Self {
        Self { budget, free: [None; CLASSES], chunks: Vec::new(), rest: NonNull::dangling(), rest_len: 0 }
    }

    /// A block of at least `size` bytes, 1 to [`LARGEST`].
    pub(super) fn take(&mut self, size: usize) -> NonNull<u8> {
        let class = class_of(size);
        if let Some(block) = self.free[class] {
            // SAFETY: blocks in the lists were put there by `give` and are nobody else's.
            self.free[class] = unsafe { block.read().0 };
            return block.cast();
        }
        let size = (class + 1) * STEP;
        if self.rest_len < size {
            self.add_chunk();
        }
        let block = self.rest;
        // SAFETY: the rest of the chunk has at least `size` bytes.
        self.rest = unsafe { block.add(size) };
        self.rest_len -= size;
        block
    }

    /// Gives back a block.
    ///
    /// # Safety
    /// It came from `take` of this pool with a size of the same class, and is not used any more.
    pub(super) unsafe fn give(&mut self, block: NonNull<u8>, size: usize) {
        let class = class_of(size);
        let block = block.cast::<Free>();
        // SAFETY: every block has room for a link and is aligned for it.
        unsafe { block.write(Free(self.free[class])) };
        self.free[class] = Some(block);
    }

    fn add_chunk(&mut self) {
        let size = self.chunks.last().map_or(FIRST_CHUNK, |(_, last)| (last.size() * 2).min(LARGEST_CHUNK));
        let layout =
            Layout::from_size_align(size, STEP).expect("chunks are small and their alignment is a power of two");
        // SAFETY: the layout is not empty.
        let Some(chunk) = NonNull::new(unsafe { alloc(layout) }) else { handle_alloc_error(layout) };
        self.chunks.push((chunk, layout));
        (self.rest, self.rest_len) = (chunk, size);
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        for (chunk, layout) in self.chunks.drain(..) {
            // SAFETY: allocated by `add_chunk` with that layout.
            unsafe { dealloc(chunk.as_ptr(), layout) };
        }
    }
}

/// Whether two sizes have the same blocks.
pub(super) fn same_block(a: usize, b: usize) -> bool {
    class_of(a) == class_of(b)
}

fn class_of(size: usize) -> usize {
    debug_assert!((1..=LARGEST).contains(&size), "only small blocks are pooled");
    (size - 1) / STEP
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::{LARGEST, Pool};

    #[test]
    fn blocks_are_apart_aligned_and_used_again() {
        let mut pool = Pool::new(Rc::default());
        let blocks: Vec<_> = (1..=LARGEST).map(|size| (pool.take(size), size)).collect();
        for &(block, size) in &blocks {
            assert_eq!(block.as_ptr() as usize % 16, 0);
            // SAFETY: the block has that size and is ours.
            unsafe { block.as_ptr().write_bytes(size as u8, size) };
        }
        for &(block, size) in &blocks {
            // SAFETY: written above.
            assert!((0..size).all(|i| unsafe { block.as_ptr().add(i).read() } == size as u8));
        }
        let (block, size) = blocks[99];
        // SAFETY: taken above with that size.
        unsafe { pool.give(block, size) };
        assert_eq!(pool.take(size), block);
    }
}
