//! What runs now: the innermost call into Lua on this thread, and for other threads its number and the callback.

use std::cell::Cell;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use mlua::ffi;

use super::interrupt::forget_request;
use crate::lua::Stack;

thread_local! {
    /// Where the innermost call into Lua on this thread was made; null while there is none.
    static RUNNING: Cell<*mut ffi::lua_State> = const { Cell::new(null_mut()) };
    /// The coroutine that runs there, as far as `coroutine.resume` notes it; null while there is none.
    static CURRENT: Cell<*mut ffi::lua_State> = const { Cell::new(null_mut()) };
    /// Whether a call that needs no Lua state is in progress on this thread.
    static IS_NATIVE: Cell<bool> = const { Cell::new(false) };
}

/// Rises when a call from outside begins, and when it ends: it is odd while one runs. Calls inside of others are not counted.
static BOUNDARIES: AtomicU64 = AtomicU64::new(0);
/// The number of the callback that runs, and one more; 0 for none.
static CALLBACK: AtomicUsize = AtomicUsize::new(0);

/// The state of the innermost call on this thread; null while there is none. For signal handlers too.
pub(super) fn innermost() -> *mut ffi::lua_State {
    RUNNING.get()
}

/// The coroutine that runs on this thread, or one that has resumed it; null while there is none. For signal handlers too.
pub(super) fn current_coroutine() -> *mut ffi::lua_State {
    CURRENT.get()
}

/// The coroutine that runs from now on, inside of the innermost call.
pub(super) fn enter_coroutine(coroutine: Stack<'_>) {
    if !CURRENT.get().is_null() {
        CURRENT.set(coroutine.raw());
    }
}

/// Numbers the calls into Lua of the process that have begun or ended, those inside of others not counted. While the number stays, the same call
/// runs, or none.
pub fn calls_begun() -> u64 {
    BOUNDARIES.load(Ordering::Relaxed)
}

/// Whether a call is in progress at that number.
pub fn is_call(number: u64) -> bool {
    number % 2 == 1
}

/// The number of the callback that runs now, innermost; None for other calls.
pub(crate) fn running_callback_number() -> Option<usize> {
    CALLBACK.load(Ordering::Relaxed).checked_sub(1)
}

/// A call into Lua from outside. Nested ones end in reverse order.
pub(in crate::lua) struct Running {
    outer: *mut ffi::lua_State,
    outer_coroutine: *mut ffi::lua_State,
}

impl Running {
    pub(in crate::lua) fn begin(stack: Stack<'_>) -> Self {
        let outer = RUNNING.replace(stack.raw());
        let outer_coroutine = CURRENT.replace(stack.raw());
        if is_outermost(outer) {
            forget_request();
            pass_boundary();
        }
        Self {
            outer,
            outer_coroutine,
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        RUNNING.set(self.outer);
        CURRENT.set(self.outer_coroutine);
        if is_outermost(self.outer) {
            pass_boundary();
        }
        // The interrupted function has ended; its caller may clean up.
        forget_request();
    }
}

/// Whether a call into Lua is inside of no other one, where `outer` is the one around it.
fn is_outermost(outer: *mut ffi::lua_State) -> bool {
    outer.is_null() && !IS_NATIVE.get()
}

/// A call of a script from outside that needs no Lua state. Nested ones end in reverse order.
pub(crate) struct NativeCall {
    is_outermost: bool,
}

impl NativeCall {
    pub(crate) fn begin() -> Self {
        let is_outermost = is_outermost(RUNNING.get());
        if is_outermost {
            forget_request();
            pass_boundary();
            IS_NATIVE.set(true);
        }
        Self { is_outermost }
    }
}

impl Drop for NativeCall {
    fn drop(&mut self) {
        if self.is_outermost {
            IS_NATIVE.set(false);
            pass_boundary();
        }
        forget_request();
    }
}

/// One thread runs scripts where the number matters: no need for it to be counted in one step.
fn pass_boundary() {
    let number = BOUNDARIES.load(Ordering::Relaxed);
    BOUNDARIES.store(number.wrapping_add(1), Ordering::Relaxed);
}

/// A callback that runs.
pub(crate) struct RunningCallback {
    outer: usize,
}

impl RunningCallback {
    pub(crate) fn begin(number: usize) -> Self {
        let outer = CALLBACK.load(Ordering::Relaxed);
        CALLBACK.store(number + 1, Ordering::Relaxed);
        Self { outer }
    }
}

impl Drop for RunningCallback {
    fn drop(&mut self) {
        CALLBACK.store(self.outer, Ordering::Relaxed);
    }
}
