//! The memory of one Lua state: small blocks from lists of free ones, all others from the allocator the state was made with.
//!
//! Lua passes the size of what it frees, so blocks need no headers: a free one is in the list of its size class. Tables come
//! and go by the thousand, and a general allocator took most of the time of a message between scripts. The memory of the lists is
//! freed when the state is closed.
//!
//! A state has small blocks already when it gets its pool. They stay with the allocator that made them, and an address says whose a
//! small block is: a pool's lie 8 bytes behind a multiple of 16, those of mlua's allocator on one.

use std::ffi::c_void;
use std::ptr::{NonNull, null_mut};
use std::rc::Rc;

use mlua::ffi;

use crate::budget::Budget;

/// Sizes are rounded up to a multiple of this.
const STEP: usize = 16;
const CLASSES: usize = 32;
/// Larger blocks are not for the pool.
pub(super) const LARGEST: usize = STEP * CLASSES;
const LARGE: usize = LARGEST + 1;
/// Blocks of the pool begin so far behind a multiple of `STEP`. Lua itself requires an alignment of 8.
const OFFSET: usize = 8;
const _: () = assert!(
    ffi::SYS_MIN_ALIGN == STEP,
    "blocks of mlua's allocator must be told apart by their alignment"
);

/// Smallest and largest chunk, in lines of `STEP` bytes. A chunk has a quarter of what there is already: most scripts are small, and there may be thousands.
const MIN_CHUNK: usize = (4 << 10) / STEP;
const MAX_CHUNK: usize = (256 << 10) / STEP;

/// A free block: it holds the link to the next one of its class.
struct Free(Option<NonNull<Free>>);

/// What chunks are made of, for its size and alignment.
type Line = u128;
const _: () = assert!(
    size_of::<Line>() == STEP && align_of::<Line>() == STEP,
    "blocks of the pool are aligned by it"
);

/// An allocator as Lua calls it, with the data it is called with.
#[derive(Clone, Copy)]
pub(super) struct Allocator {
    pub(super) function: ffi::lua_Alloc,
    pub(super) data: *mut c_void,
}

/// A block that Lua has returned: it is `size` bytes long, made by the pool or its base, and nobody else's.
struct Block {
    start: NonNull<u8>,
    size: usize,
}

pub(super) struct Pool {
    pub(super) budget: Rc<Budget>,
    /// The allocator of large blocks, and of the small ones from before the pool.
    base: Allocator,
    free: [Option<NonNull<Free>>; CLASSES],
    chunks: Vec<Vec<Line>>,
    /// The unused rest of the newest chunk.
    rest: NonNull<u8>,
    rest_len: usize,
}

impl Pool {
    /// # Safety
    /// `base` aborts the process rather than fail, aligns its blocks to `STEP`, and can be called as long as the pool is there.
    pub(super) unsafe fn new(budget: Rc<Budget>, base: Allocator) -> Self {
        Self {
            budget,
            base,
            free: [None; CLASSES],
            chunks: Vec::new(),
            rest: NonNull::dangling(),
            rest_len: 0,
        }
    }

    /// The allocator that Lua calls: makes a block, resizes or frees one. Returns null for size 0.
    ///
    /// # Safety
    /// A block is from this function, or from `base` before; it has `old_size` bytes, and is not used any more.
    #[inline]
    pub(super) unsafe fn allocate(
        &mut self,
        old: *mut c_void,
        old_size: usize,
        size: usize,
    ) -> *mut c_void {
        let Some(start) = NonNull::new(old.cast()) else {
            return self.new_block(size);
        };
        let block = Block {
            start,
            size: old_size,
        };
        if size == 0 {
            self.free_block(block);
            return null_mut();
        }
        self.resize(block, size)
    }

    fn resize(&mut self, block: Block, size: usize) -> *mut c_void {
        match size {
            1..=LARGEST if block.is_pooled() && class_of(size) == class_of(block.size) => {
                block.start.as_ptr().cast()
            }
            LARGE.. if !block.is_pooled() => self.call_base(Some(block), size),
            _ => {
                let new = self.new_block(size);
                // SAFETY: both blocks have the smaller of the sizes at least, and the new one is apart from the old one.
                unsafe {
                    block
                        .start
                        .as_ptr()
                        .copy_to_nonoverlapping(new.cast(), block.size.min(size));
                };
                self.free_block(block);
                new
            }
        }
    }

    #[inline]
    fn new_block(&mut self, size: usize) -> *mut c_void {
        match size {
            0 => null_mut(),
            1..=LARGEST => self.acquire(size).as_ptr().cast(),
            _ => self.call_base(None, size),
        }
    }

    #[inline]
    fn free_block(&mut self, block: Block) {
        if block.is_pooled() {
            self.release(block);
        } else {
            self.call_base(Some(block), 0);
        }
    }

    /// Resizes one of its blocks, frees it, or makes one.
    fn call_base(&self, block: Option<Block>, size: usize) -> *mut c_void {
        let (old, old_size) = block.map_or((null_mut(), 0), |block| {
            (block.start.as_ptr().cast(), block.size)
        });
        // SAFETY: `base` can be called, and the block is one of its own.
        heap::in_scripts(|| unsafe { (self.base.function)(self.base.data, old, old_size, size) })
    }

    /// A block of at least `size` bytes, 1 to [`LARGEST`].
    #[inline]
    fn acquire(&mut self, size: usize) -> NonNull<u8> {
        let class = class_of(size);
        if let Some(block) = self.free[class] {
            // SAFETY: blocks in the lists were put there by `release` and are nobody else's.
            self.free[class] = unsafe { block.read().0 };
            return block.cast();
        }
        self.cut_block(class)
    }

    /// A block from the rest of the newest chunk.
    fn cut_block(&mut self, class: usize) -> NonNull<u8> {
        let size = (class + 1) * STEP;
        if self.rest_len < size {
            self.add_chunk();
        }
        let block = self.rest;
        self.rest = advanced(block, size);
        self.rest_len -= size;
        block
    }

    /// Returns a block of the pool to its list.
    #[inline]
    fn release(&mut self, block: Block) {
        let class = class_of(block.size);
        let block = block.start.cast::<Free>();
        // SAFETY: every block of the pool has room for a link and is aligned for it.
        unsafe { block.write(Free(self.free[class])) };
        self.free[class] = Some(block);
    }

    fn add_chunk(&mut self) {
        let total: usize = self.chunks.iter().map(Vec::capacity).sum();
        let lines = (total / 4).clamp(MIN_CHUNK, MAX_CHUNK);
        let mut chunk = heap::in_scripts(|| Vec::<Line>::with_capacity(lines));
        let start = NonNull::from(chunk.spare_capacity_mut()).cast();
        self.chunks.push(chunk);
        self.rest = advanced(start, OFFSET);
        self.rest_len = (lines - 1) * STEP;
    }
}

impl Block {
    /// Whether the pool made it, not its base.
    fn is_pooled(&self) -> bool {
        self.size <= LARGEST && self.start.addr().get() % STEP == OFFSET
    }
}

fn advanced(block: NonNull<u8>, bytes: usize) -> NonNull<u8> {
    block.map_addr(|address| {
        address
            .checked_add(bytes)
            .expect("a chunk does not end at the end of memory")
    })
}

fn class_of(size: usize) -> usize {
    debug_assert!(
        (1..=LARGEST).contains(&size),
        "only small blocks are pooled"
    );
    (size - 1) / STEP
}

#[cfg(test)]
mod tests {
    use std::alloc::{Layout, alloc, dealloc, realloc};
    use std::ffi::c_void;
    use std::ptr::null_mut;
    use std::rc::Rc;

    use super::{Allocator, LARGEST, Pool};

    /// An allocator as mlua has one: it needs the right size of every block it resizes or frees.
    unsafe extern "C" fn base(
        _: *mut c_void,
        block: *mut c_void,
        old_size: usize,
        size: usize,
    ) -> *mut c_void {
        let layout =
            |size| Layout::from_size_align(size, 16).expect("the sizes of the tests are small");
        // SAFETY: the tests say the size of every block.
        unsafe {
            match (block.is_null(), size) {
                (true, 0) => null_mut(),
                (true, _) => alloc(layout(size)).cast(),
                (false, 0) => {
                    dealloc(block.cast(), layout(old_size));
                    null_mut()
                }
                (false, _) => realloc(block.cast(), layout(old_size), size).cast(),
            }
        }
    }

    fn pool() -> Pool {
        // SAFETY: `base` aligns to 16.
        unsafe {
            Pool::new(
                Rc::default(),
                Allocator {
                    function: base,
                    data: null_mut(),
                },
            )
        }
    }

    /// Changes the size of a block as Lua does; the common part keeps its bytes.
    fn resize(pool: &mut Pool, block: *mut c_void, old_size: usize, size: usize) -> *mut c_void {
        // SAFETY: the tests hand over a block of that size, or null, and forget it.
        let new = unsafe { pool.allocate(block, old_size, size) };
        assert_eq!(new as usize % 8, 0);
        for i in 0..old_size.min(size) {
            // SAFETY: both sizes are larger than `i`, and `fill` wrote the old one.
            assert_eq!(unsafe { new.cast::<u8>().add(i).read() }, i as u8);
        }
        new
    }

    fn fill(block: *mut c_void, size: usize) {
        // SAFETY: the block has that size.
        (0..size).for_each(|i| unsafe { block.cast::<u8>().add(i).write(i as u8) });
    }

    const SIZES: [usize; 13] = [
        1,
        16,
        17,
        LARGEST,
        LARGEST + 1,
        70_000,
        1 << 20,
        600,
        513,
        LARGEST,
        40,
        33,
        3,
    ];

    #[test]
    fn blocks_keep_their_bytes_when_they_grow_and_shrink() {
        let mut pool = pool();
        for (old_size, size) in SIZES.iter().flat_map(|&a| SIZES.map(|b| (a, b))) {
            let old = resize(&mut pool, null_mut(), 0, old_size);
            fill(old, old_size);
            let new = resize(&mut pool, old, old_size, size);
            fill(new, size);
            assert!(resize(&mut pool, new, size, 0).is_null());
        }
        assert!(resize(&mut pool, null_mut(), 0, 0).is_null());
    }

    #[test]
    fn blocks_of_the_time_before_the_pool_go_back_to_who_made_them() {
        let mut pool = pool();
        for (old_size, size) in SIZES.iter().flat_map(|&a| SIZES.map(|b| (a, b))) {
            // SAFETY: a new block.
            let old = unsafe { base(null_mut(), null_mut(), 0, old_size) };
            fill(old, old_size);
            let new = resize(&mut pool, old, old_size, size);
            assert!(resize(&mut pool, new, size, 0).is_null());
            assert!(
                pool.free
                    .iter()
                    .flatten()
                    .all(|free| free.as_ptr().addr() % 16 == 8),
                "{old_size} {size}"
            );
        }
    }

    #[test]
    fn blocks_are_apart_and_used_again() {
        let mut pool = pool();
        let blocks: Vec<_> = (1..=LARGEST)
            .map(|size| (resize(&mut pool, null_mut(), 0, size), size))
            .collect();
        for &(block, size) in &blocks {
            // SAFETY: the block has that size and is ours.
            unsafe { block.cast::<u8>().write_bytes(size as u8, size) };
        }
        for &(block, size) in &blocks {
            // SAFETY: written above.
            assert!((0..size).all(|i| unsafe { block.cast::<u8>().add(i).read() } == size as u8));
        }
        let (block, size) = blocks[99];
        // SAFETY: allocated above with that size.
        unsafe { pool.allocate(block, size, 0) };
        assert_eq!(resize(&mut pool, null_mut(), 0, size), block);
    }
}
