//! The memory of one Lua state: small blocks from lists of free ones, all others from the allocator the state was made with.
//!
//! Lua passes the size of what it frees, so blocks need no headers: a free one is in the list of its size class. Tables come
//! and go by the thousand, and a general allocator took most of the time of a message between scripts. The memory of the lists is
//! freed when the state is closed.
//!
//! A state has small blocks already when it gets its pool. They stay with the allocator that made them, and an address says whose a
//! small block is: a pool's lie 8 bytes behind a multiple of 16, those of mlua's allocator on one.

use std::alloc::{Layout, alloc, dealloc, handle_alloc_error};
use std::ffi::c_void;
use std::ptr::{NonNull, null_mut};
use std::rc::Rc;

use mlua::ffi;

use super::Budget;

/// Sizes are rounded up to a multiple of this.
const STEP: usize = 16;
const CLASSES: usize = 32;
/// Larger blocks are not for the pool.
pub(super) const LARGEST: usize = STEP * CLASSES;
const LARGE: usize = LARGEST + 1;
/// Blocks of the pool begin so far behind a multiple of `STEP`. Lua itself requires an alignment of 8.
const OFFSET: usize = 8;
const _: () = assert!(ffi::SYS_MIN_ALIGN == STEP, "blocks of mlua's allocator must be told apart by their alignment");

const FIRST_CHUNK: usize = 8 << 10;
const LARGEST_CHUNK: usize = 256 << 10;

/// A free block: it holds the link to the next one of its class.
struct Free(Option<NonNull<Free>>);

/// An allocator as Lua calls it, with the data it is called with.
#[derive(Clone, Copy)]
pub(super) struct Allocator {
    pub(super) function: ffi::lua_Alloc,
    pub(super) data: *mut c_void,
}

pub(super) struct Pool {
    pub(super) budget: Rc<Budget>,
    /// The allocator of large blocks, and of the small ones from before the pool.
    base: Allocator,
    free: [Option<NonNull<Free>>; CLASSES],
    chunks: Vec<(NonNull<u8>, Layout)>,
    /// The unused rest of the newest chunk.
    rest: NonNull<u8>,
    rest_len: usize,
}

impl Pool {
    /// # Safety
    /// `base` aborts the process rather than fail, aligns its blocks to `STEP`, and can be called as long as the pool is there.
    pub(super) unsafe fn new(budget: Rc<Budget>, base: Allocator) -> Self {
        Self { budget, base, free: [None; CLASSES], chunks: Vec::new(), rest: NonNull::dangling(), rest_len: 0 }
    }

    /// The allocator that Lua calls: makes a block, resizes or frees one. Returns null for size 0.
    ///
    /// # Safety
    /// A block is from this function, or from `base` before; it has `old_size` bytes, and is not used any more.
    #[inline]
    pub(super) unsafe fn allocate(&mut self, old: *mut c_void, old_size: usize, size: usize) -> *mut c_void {
        let Some(block) = NonNull::new(old.cast::<u8>()) else { return self.new_block(size) };
        let pooled = is_pooled(block, old_size);
        if size == 0 && pooled {
            // SAFETY: as promised by the caller.
            unsafe { self.release(block, old_size) };
            return null_mut();
        }
        // SAFETY: as promised by the caller.
        unsafe { self.resize(block, old_size, size, pooled) }
    }

    /// # Safety
    /// As for `allocate`; `pooled` is true for a block of this pool.
    unsafe fn resize(&mut self, block: NonNull<u8>, old_size: usize, size: usize, pooled: bool) -> *mut c_void {
        let old = block.as_ptr().cast();
        // SAFETY: as promised by the caller. `pooled` says who made the block, which alone resizes and frees it; a new block has the smaller
        // of both sizes at least, and is apart from the old one.
        unsafe {
            match size {
                1..=LARGEST if pooled && class_of(size) == class_of(old_size) => old,
                LARGE.. if !pooled => (self.base.function)(self.base.data, old, old_size, size),
                0 => {
                    self.free_block(block, old_size, pooled);
                    null_mut()
                }
                _ => {
                    let new = self.new_block(size);
                    std::ptr::copy_nonoverlapping(old, new, old_size.min(size));
                    self.free_block(block, old_size, pooled);
                    new
                }
            }
        }
    }

    #[inline]
    fn new_block(&mut self, size: usize) -> *mut c_void {
        match size {
            0 => null_mut(),
            1..=LARGEST => self.acquire(size).as_ptr().cast(),
            // SAFETY: `base` can be called, and no block is resized.
            _ => unsafe { (self.base.function)(self.base.data, null_mut(), 0, size) },
        }
    }

    /// # Safety
    /// As for `allocate`; `pooled` is true for a block of this pool.
    unsafe fn free_block(&mut self, block: NonNull<u8>, size: usize, pooled: bool) {
        // SAFETY: the block goes back to the one that made it.
        unsafe {
            if pooled {
                self.release(block, size);
            } else {
                (self.base.function)(self.base.data, block.as_ptr().cast(), size, 0);
            }
        }
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
        // SAFETY: the rest of the chunk has at least `size` bytes.
        self.rest = unsafe { block.add(size) };
        self.rest_len -= size;
        block
    }

    /// Returns a block to its list.
    ///
    /// # Safety
    /// It came from `acquire` of this pool with a size of the same class, and is not used any more.
    #[inline]
    unsafe fn release(&mut self, block: NonNull<u8>, size: usize) {
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
        // SAFETY: the chunk is larger than the offset.
        self.rest = unsafe { chunk.add(OFFSET) };
        self.rest_len = size - STEP;
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

/// Whether a block of the state is from its pool.
fn is_pooled(block: NonNull<u8>, size: usize) -> bool {
    size <= LARGEST && block.as_ptr().addr() % STEP == OFFSET
}

fn class_of(size: usize) -> usize {
    debug_assert!((1..=LARGEST).contains(&size), "only small blocks are pooled");
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
    unsafe extern "C" fn base(_: *mut c_void, block: *mut c_void, old_size: usize, size: usize) -> *mut c_void {
        let layout = |size| Layout::from_size_align(size, 16).expect("the sizes of the tests are small");
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
        unsafe { Pool::new(Rc::default(), Allocator { function: base, data: null_mut() }) }
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

    const SIZES: [usize; 13] = [1, 16, 17, LARGEST, LARGEST + 1, 70_000, 1 << 20, 600, 513, LARGEST, 40, 33, 3];

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
            assert!(pool.free.iter().flatten().all(|free| free.as_ptr().addr() % 16 == 8), "{old_size} {size}");
        }
    }

    #[test]
    fn blocks_are_apart_and_used_again() {
        let mut pool = pool();
        let blocks: Vec<_> = (1..=LARGEST).map(|size| (resize(&mut pool, null_mut(), 0, size), size)).collect();
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
