//! Functions of ours in front of functions of Lua's own libraries.
//!
//! They run in the frame of the call and continue in Lua's function, so that levels, arguments and messages are those scripts know. Where
//! Lua's function is, is nothing a script can change.

use std::ffi::{CStr, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::NonNull;
use std::sync::OnceLock;

use mlua::ffi;

use super::Stack;

/// Functions of Lua's with a guard.
pub(super) mod guarded {
    pub const COROUTINE_CREATE: usize = 0;
    pub const COROUTINE_WRAP: usize = 1;
    pub const GET_LOCAL: usize = 2;
    pub const SET_LOCAL: usize = 3;
    pub const GET_METATABLE: usize = 4;
    pub const SET_METATABLE: usize = 5;
    pub const GET_UPVALUE: usize = 6;
    pub const SET_UPVALUE: usize = 7;
    pub const LOAD: usize = 8;
    pub const LOAD_FILE: usize = 9;
    pub const COUNT: usize = 10;
}

/// What a guard wants.
pub(super) enum Next {
    /// Lua's function goes on.
    Original,
    /// So many values on top are the results.
    Return(c_int),
    /// Argument 1 is bad for this reason.
    Refuse(&'static CStr),
}

/// A function that looks at the arguments of a call before Lua's function does; not a closure with values.
pub(super) trait Guard: Fn(Stack<'_>) -> Next + Copy + 'static {}

impl<F: Fn(Stack<'_>) -> Next + Copy + 'static> Guard for F {}

/// Lua's functions, the same ones in every state of the process.
static ORIGINALS: [OnceLock<ffi::lua_CFunction>; guarded::COUNT] = [const { OnceLock::new() }; _];

/// Puts a guard in front of the function `name` of the table on top.
pub(super) fn install<const FUNCTION: usize, F: Guard>(stack: Stack<'_>, name: &str, _guard: F) {
    const { assert!(size_of::<F>() == 0, "Lua keeps the type of a guard, and no values") };
    install_raw(stack, name, FUNCTION, call_guard::<FUNCTION, F>);
}

/// The same for a guard that calls [`original`] itself.
pub(super) fn install_raw(stack: Stack<'_>, name: &str, function: usize, guard: ffi::lua_CFunction) {
    stack.raw_get_field(-1, name);
    // SAFETY: reads the value on top, then pushes a function without upvalues into its slot.
    unsafe {
        if let Some(original) = ffi::lua_tocfunction(stack.raw(), -1) {
            ORIGINALS[function].get_or_init(|| original);
        }
        stack.pop(1);
        ffi::lua_pushcclosure(stack.raw(), guard, 0);
    }
    stack.raw_set_field(-2, name);
}

unsafe extern "C-unwind" fn call_guard<const FUNCTION: usize, F: Guard>(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: Lua calls with a living state. `install` had a value of the type, which can be copied and has no bytes. Lua's functions may raise:
    // nothing is owned here by then.
    unsafe {
        let (stack, guard) = (Stack::from_raw(raw), NonNull::<F>::dangling().read());
        // A guard panics only where Lua's stack is full.
        match catch_unwind(AssertUnwindSafe(|| guard(stack))).unwrap_or(Next::Return(0)) {
            Next::Original => original(raw, FUNCTION),
            Next::Return(results) => results,
            Next::Refuse(reason) => ffi::luaL_argerror(raw, 1, reason.as_ptr()),
        }
    }
}

/// Continues in Lua's own function.
///
/// # Safety
/// As for a function that Lua calls: nothing in the frames of the caller may need to be dropped.
pub(super) unsafe fn original(raw: *mut ffi::lua_State, function: usize) -> c_int {
    match ORIGINALS[function].get() {
        // SAFETY: a function of Lua's libraries without upvalues, called as Lua would.
        Some(original) => unsafe { original(raw) },
        None => 0,
    }
}
