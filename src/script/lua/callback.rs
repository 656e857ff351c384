//! Rust functions callable from Lua.

use std::ffi::{c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};

use mlua::ffi;

use super::Stack;

/// A Rust function Lua can call: gets the stack with its arguments and the pointer given to [`push_callback`], returns how many
/// results it pushed, or the text of the error to raise.
pub(crate) type Callback = fn(Stack<'_>, *const c_void) -> Result<c_int, String>;

/// Pushes `callback` as a Lua function. `data` is handed to each call.
pub(crate) fn push_callback(stack: Stack<'_>, callback: Callback, data: *const c_void) {
    // SAFETY: two light upvalues. A function pointer and a data pointer have the same size on every supported platform.
    unsafe {
        ffi::lua_pushlightuserdata(stack.raw(), data.cast_mut());
        ffi::lua_pushlightuserdata(stack.raw(), callback as *mut c_void);
        ffi::lua_pushcclosure(stack.raw(), trampoline, 2);
    }
}

/// Runs the callback, then raises if it failed. Raising leaves this frame by `longjmp`: by then it owns nothing.
unsafe extern "C-unwind" fn trampoline(raw: *mut ffi::lua_State) -> c_int {
    let results = run(raw);
    if results >= 0 {
        return results;
    }
    // SAFETY: `run` left the error text on top of the stack; no value with a destructor is alive here.
    unsafe { ffi::lua_error(raw) }
}

/// The number of results, or -1 with the error text on the stack.
fn run(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: `push_callback` made the upvalues; `raw` is alive during the call.
    let (stack, callback, data) = unsafe {
        let data = ffi::lua_touserdata(raw, ffi::lua_upvalueindex(1));
        let callback = ffi::lua_touserdata(raw, ffi::lua_upvalueindex(2));
        (Stack::from_raw(raw), std::mem::transmute::<*mut c_void, Callback>(callback), data)
    };
    let budget = stack.budget();
    let before = budget.enter(true);
    let results = match catch_unwind(AssertUnwindSafe(|| callback(stack, data))) {
        Ok(Ok(results)) => results,
        Ok(Err(text)) => fail(stack, &text),
        Err(panic) => fail(stack, &panic_message(&*panic)),
    };
    budget.leave(before);
    results
}

fn fail(stack: Stack<'_>, text: &str) -> c_int {
    stack.push_bytes(text.as_bytes());
    -1
}

/// The error a script gets for a mistake of ours.
pub(super) fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("internal error in Swanilda, please report it: {}", text.unwrap_or("panic"))
}
