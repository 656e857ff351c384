//! An owned Lua state.

use std::ffi::c_void;
use std::marker::PhantomData;
use std::ptr::NonNull;

use mlua_sys as ffi;

use super::super::env::Env;
use super::Stack;

/// A Lua state with the standard libraries. Closed when dropped.
pub(crate) struct State {
    raw: NonNull<ffi::lua_State>,
    /// Neither `Send` nor `Sync`: a state belongs to the thread of its simulator.
    _thread: PhantomData<*mut ()>,
}

impl State {
    /// A new state. `owner` can be had back from every coroutine of the state through [`Stack::owner`]; it must outlive the state.
    pub(crate) fn new(owner: *const Env) -> Self {
        // SAFETY: `allocate` never returns null for the sizes asked for here and by pushes, so neither fails.
        // The extra space of a main thread is copied into each of its coroutines.
        unsafe {
            let raw = ffi::lua_newstate(allocate, std::ptr::null_mut());
            let raw = NonNull::new(raw).expect("the allocator aborts rather than fail");
            *ffi::lua_getextraspace(raw.as_ptr()).cast::<*const Env>() = owner;
            ffi::luaL_openlibs(raw.as_ptr());
            Self { raw, _thread: PhantomData }
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
        unsafe { ffi::lua_close(self.raw.as_ptr()) }
    }
}

/// The largest block a state may ask for. Beyond it Lua raises `not enough memory`, which only Lua code can bring about: what Rust
/// pushes is smaller (see `Stack::push_bytes` and `Stack::new_table`).
pub(super) const MAX_BLOCK: usize = 1 << 30;

/// Lua's allocator on top of libc's. Out of memory ends the process, as it does everywhere in Rust.
unsafe extern "C" fn allocate(_: *mut c_void, old: *mut c_void, _: usize, size: usize) -> *mut c_void {
    unsafe extern "C" {
        fn realloc(block: *mut c_void, size: usize) -> *mut c_void;
        fn free(block: *mut c_void);
    }
    // SAFETY: `old` is null or came from this function; that is Lua's contract for allocators.
    unsafe {
        if size == 0 {
            free(old);
            return std::ptr::null_mut();
        }
        if size > MAX_BLOCK {
            return std::ptr::null_mut();
        }
        let block = realloc(old, size);
        if block.is_null() {
            std::process::abort();
        }
        block
    }
}
