//! An owned Lua state and its memory.

use std::ffi::c_void;
use std::marker::PhantomData;
use std::ptr::NonNull;
use std::rc::Rc;

use mlua_sys as ffi;

use super::pool::{LARGEST, Pool, same_block};
use super::{Budget, Stack};
use crate::script::lifecycle::env::Env;

/// A Lua state with the standard libraries. Closed when dropped.
pub(crate) struct State {
    raw: NonNull<ffi::lua_State>,
    /// Where the state's small blocks are: it goes after the state is closed.
    pool: NonNull<Pool>,
    /// Neither `Send` nor `Sync`: a state belongs to the thread of its simulator.
    _thread: PhantomData<*mut ()>,
}

impl State {
    /// A new state whose memory comes out of `budget`. `owner` can be had back from every coroutine of the state through [`Stack::owner`]; it must outlive the state.
    pub(crate) fn new(owner: *const Env, budget: Rc<Budget>) -> Self {
        // SAFETY: `allocate` never returns null for the sizes asked for here and by pushes, so neither fails.
        // The extra space of a main thread is copied into each of its coroutines.
        unsafe {
            let pool = NonNull::from(Box::leak(Box::new(Pool::new(budget))));
            let raw = ffi::lua_newstate(allocate, pool.as_ptr().cast());
            let raw = NonNull::new(raw).expect("the allocator aborts rather than fail");
            *ffi::lua_getextraspace(raw.as_ptr()).cast::<*const Env>() = owner;
            ffi::luaL_openlibs(raw.as_ptr());
            Self { raw, pool, _thread: PhantomData }
        }
    }

    /// The stack of the main coroutine.
    pub(crate) fn stack(&self) -> Stack<'_> {
        // SAFETY: the state lives as long as the borrow.
        unsafe { Stack::from_raw(self.raw.as_ptr()) }
    }
}

impl Drop for State {
    fn drop(&mut self) {
        // SAFETY: created by `new`, closed only here. Finalizers that run now may call back; the owner outlives the state.
        // The pool was leaked by `new`; nothing of the state is left in it.
        unsafe {
            ffi::lua_close(self.raw.as_ptr());
            drop(Box::from_raw(self.pool.as_ptr()));
        }
    }
}

/// The largest block a state may ask for. Beyond it Lua raises `not enough memory`, which only Lua code can bring about: what Rust
/// pushes is smaller (see `Stack::push_bytes` and `Stack::new_table`).
pub(super) const MAX_BLOCK: usize = 1 << 30;

/// Lua's allocator: small blocks from the pool of the state, others from libc. Out of memory ends the process, as it does everywhere in
/// Rust.
unsafe extern "C" fn allocate(pool: *mut c_void, old: *mut c_void, old_size: usize, size: usize) -> *mut c_void {
    // SAFETY: `new` gave a pool that outlives the state, which is used from one thread; Lua tells the size it asked for.
    unsafe {
        let pool = &mut *pool.cast::<Pool>();
        // Without an old block, Lua tells what kind of value it makes in place of a size.
        let counted = if old.is_null() { 0 } else { old_size };
        if size > MAX_BLOCK || !pool.budget.resize(counted, size) {
            return std::ptr::null_mut();
        }
        let Some(block) = NonNull::new(old.cast::<u8>()) else { return new_block(pool, size) };
        match (old_size <= LARGEST, size) {
            (false, LARGE..) => resize_large(block, size),
            (true, 1..=LARGEST) if same_block(old_size, size) => old,
            (_, 0) => {
                free_block(pool, block, old_size);
                std::ptr::null_mut()
            }
            _ => {
                let new = new_block(pool, size);
                std::ptr::copy_nonoverlapping(old, new, old_size.min(size));
                free_block(pool, block, old_size);
                new
            }
        }
    }
}

const LARGE: usize = LARGEST + 1;

unsafe extern "C" {
    fn realloc(block: *mut c_void, size: usize) -> *mut c_void;
    fn free(block: *mut c_void);
}

/// A new block; null for none of no size.
unsafe fn new_block(pool: &mut Pool, size: usize) -> *mut c_void {
    match size {
        0 => std::ptr::null_mut(),
        1..=LARGEST => pool.take(size).as_ptr().cast(),
        // SAFETY: no block is resized.
        _ => unsafe { resize(std::ptr::null_mut(), size) },
    }
}

unsafe fn resize_large(block: NonNull<u8>, size: usize) -> *mut c_void {
    // SAFETY: large blocks come from libc.
    unsafe { resize(block.as_ptr().cast(), size) }
}

unsafe fn resize(block: *mut c_void, size: usize) -> *mut c_void {
    // SAFETY: null or a block of libc's.
    let block = unsafe { realloc(block, size) };
    if block.is_null() {
        std::process::abort();
    }
    block
}

unsafe fn free_block(pool: &mut Pool, block: NonNull<u8>, size: usize) {
    // SAFETY: small blocks come from the pool, large ones from libc.
    unsafe {
        match size {
            ..=LARGEST => pool.give(block, size),
            _ => free(block.as_ptr().cast()),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::c_void;
    use std::ptr::{NonNull, null_mut};
    use std::rc::Rc;

    use super::{LARGEST, MAX_BLOCK, Pool, allocate};

    /// Changes the size of a block as Lua does; what both sizes have keeps its bytes.
    fn resize(pool: &mut Pool, block: *mut c_void, old_size: usize, size: usize) -> *mut c_void {
        let pool = NonNull::from(pool);
        // SAFETY: the tests give a block of that size, or null, and forget it.
        let new = unsafe { allocate(pool.as_ptr().cast(), block, old_size, size) };
        assert_eq!(new as usize % 16, 0);
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

    #[test]
    fn blocks_keep_their_bytes_when_they_grow_and_shrink() {
        let mut pool = Pool::new(Rc::default());
        let sizes = [1, 16, 17, LARGEST, LARGEST + 1, 70_000, 1 << 20, 600, 513, LARGEST, 40, 33, 3];
        for (old_size, size) in sizes.iter().flat_map(|&a| sizes.map(|b| (a, b))) {
            let old = resize(&mut pool, null_mut(), 0, old_size);
            fill(old, old_size);
            let new = resize(&mut pool, old, old_size, size);
            fill(new, size);
            assert!(resize(&mut pool, new, size, 0).is_null());
        }
    }

    #[test]
    fn a_block_that_may_not_grow_stays_as_it_was() {
        let mut pool = Pool::new(Rc::default());
        for size in [8, 1000] {
            let block = resize(&mut pool, null_mut(), 0, size);
            fill(block, size);
            // SAFETY: a block of that size.
            let grown = unsafe { allocate(NonNull::from(&mut pool).as_ptr().cast(), block, size, MAX_BLOCK + 1) };
            assert!(grown.is_null());
            let block = resize(&mut pool, block, size, size);
            assert!(resize(&mut pool, block, size, 0).is_null());
        }
        assert!(
            resize(&mut pool, null_mut(), 0, MAX_BLOCK + 1).is_null() && resize(&mut pool, null_mut(), 0, 0).is_null()
        );
    }
}
