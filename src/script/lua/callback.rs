//! Rust functions callable from Lua.

use std::any::Any;
use std::ffi::c_int;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::{NonNull, null_mut};

use mlua::ffi;

use super::Stack;

/// A Rust function Lua can call: gets the stack with its arguments and the number given to [`push_callback`], returns how many
/// results it pushed, or the text of the error to raise. It is a function, not a closure with values.
pub(crate) trait Callback: Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static {}

impl<F: Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static> Callback for F {}

/// Pushes `callback` as a Lua function. `number` is handed to each call, which looks up what it stands for.
pub(crate) fn push_callback<F: Callback>(stack: Stack<'_>, _callback: F, number: usize) {
    const { assert!(size_of::<F>() == 0, "Lua keeps the type of a callback, and no values") };
    stack.push_int(number as i64);
    // SAFETY: pops the upvalue.
    unsafe { ffi::lua_pushcclosure(stack.raw(), trampoline::<F>, 1) };
}

/// Runs the callback, then raises if it failed. Raising leaves this frame by `longjmp`: by then it owns nothing.
unsafe extern "C-unwind" fn trampoline<F: Callback>(raw: *mut ffi::lua_State) -> c_int {
    let results = run::<F>(raw);
    if results >= 0 {
        return results;
    }
    // SAFETY: `run` left the error text on top of the stack; no value with a destructor is alive here.
    unsafe { ffi::lua_error(raw) }
}

/// The number of results, or -1 with the error text on the stack.
fn run<F: Callback>(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: `raw` is alive during the call. `push_callback` had a value of the type, which can be copied and has no bytes.
    let (stack, callback) = unsafe { (Stack::from_raw(raw), NonNull::<F>::dangling().read()) };
    // SAFETY: reads the upvalue; 0 for what is no number.
    let number = unsafe { ffi::lua_tointegerx(raw, ffi::lua_upvalueindex(1), null_mut()) } as usize;
    let budget = stack.budget();
    let before = budget.enter(true);
    let results = match catch_unwind(AssertUnwindSafe(|| callback(stack, number))) {
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
pub(super) fn panic_message(panic: &(dyn Any + Send)) -> String {
    format!("internal error in Swanilda, please report it: {}", panic_text(panic))
}

/// What a panic said.
pub(super) fn panic_text(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("panic")
}
