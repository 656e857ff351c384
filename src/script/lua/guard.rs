//! Functions of ours in front of functions of Lua's own libraries.
//!
//! They run in the frame of the call and continue in Lua's function, so that levels, arguments and messages are those scripts know. Where
//! Lua's function is, is nothing a script can change.

use std::ffi::c_int;
use std::sync::OnceLock;

use mlua::ffi;

use super::Stack;

/// A function of Lua's with a guard.
#[derive(Debug, Clone, Copy)]
pub(super) enum Guarded {
    CoroutineClose,
    CoroutineCreate,
    CoroutineResume,
    CoroutineWrap,
    GetLocal,
    SetLocal,
    GetMetatable,
    SetMetatable,
    GetUpvalue,
    SetUpvalue,
    Load,
    LoadFile,
}

/// Lua's functions, by `Guarded`: the same ones in every state of the process.
static ORIGINALS: [OnceLock<ffi::lua_CFunction>; Guarded::LoadFile as usize + 1] = [const { OnceLock::new() }; _];

/// Continues in Lua's own function.
///
/// # Safety
/// As for a function that Lua calls: nothing in the frames of the caller may need to be dropped.
pub(super) unsafe fn original(raw: *mut ffi::lua_State, function: Guarded) -> c_int {
    match ORIGINALS[function as usize].get() {
        // SAFETY: a function of Lua's libraries without upvalues, called as Lua would.
        Some(original) => unsafe { original(raw) },
        None => 0,
    }
}

/// Puts `guard` in front of the function `name` of the table on top.
pub(super) fn install(stack: Stack<'_>, name: &str, function: Guarded, guard: ffi::lua_CFunction) {
    stack.raw_get_field(-1, name);
    // SAFETY: reads a value, then pushes a function without upvalues.
    unsafe {
        if let Some(original) = ffi::lua_tocfunction(stack.raw(), -1) {
            ORIGINALS[function as usize].get_or_init(|| original);
        }
        stack.pop(1);
        ffi::lua_pushcclosure(stack.raw(), guard, 0);
    }
    stack.raw_set_field(-2, name);
}
