//! Functions that Lua calls: the way from Lua into Rust and back.
//!
//! Lua raises errors by `longjmp`, which runs no destructors. So a function of ours only returns how it ends ([`Exit`]). It is carried
//! out when the function has returned and everything it owned is dropped.

use std::ffi::{CStr, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::NonNull;

use mlua::ffi;

use super::callback::panic_message;
use crate::lua::{Stack, api};

/// How a function ends.
pub(in crate::lua) enum Exit {
    /// This number of values on top are its results.
    Results(c_int),
    /// The value on top is raised.
    Raise,
    /// Argument 1 is bad for this reason.
    Refuse(&'static CStr),
    /// The lowest value on the stack is called with those above it, and may yield; its results are those of this function.
    Call,
    /// Lua's function continues in the same frame, then the other one, if any, sees its results.
    Original(Original, Option<fn(Stack<'_>)>),
}

/// A function that Lua can call. It has no values of its own, since Lua stores its type only.
pub(in crate::lua) trait Function: Fn(Stack<'_>) -> Exit + Copy + 'static {}

impl<F: Fn(Stack<'_>) -> Exit + Copy + 'static> Function for F {}

/// A function of Lua's own libraries.
#[derive(Clone, Copy)]
pub(in crate::lua) struct Original(ffi::lua_CFunction);

impl Original {
    /// The function at `index`; None for one of Lua code, and for one with upvalues, which only works in its own frame.
    pub(in crate::lua) fn at(stack: Stack<'_>, index: c_int) -> Option<Self> {
        if stack.push_upvalue(index, 1) {
            stack.pop(1);
            return None;
        }
        api::lua_tocfunction(stack, stack.slot(index)).map(Self)
    }
}

/// Pushes a function. It finds the number, if it has one, with [`Stack::number_of_function`].
pub(in crate::lua) fn push_function<F: Function>(
    stack: Stack<'_>,
    number: Option<i64>,
    _function: F,
) {
    const {
        assert!(
            size_of::<F>() == 0,
            "Lua stores the type of a function, and no values"
        );
    };
    let _room = stack.room();
    if let Some(number) = number {
        stack.push_int(number);
    }
    // SAFETY: pops the number, or needs the room for one value.
    unsafe { ffi::lua_pushcclosure(stack.raw(), enter::<F>, c_int::from(number.is_some())) };
}

unsafe extern "C-unwind" fn enter<F: Function>(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: Lua calls with a living coroutine. `push_function` had a value of the type, which can be copied and has no bytes. What raises
    // runs last: nothing in this frame has a destructor, and the frames below are Lua's. An original function has no
    // upvalues, so it can be called from this frame as well.
    unsafe {
        let stack = Stack::from_raw(raw);
        match run(stack, NonNull::<F>::dangling().read()).unwrap_or(Exit::Raise) {
            Exit::Results(count) => count,
            Exit::Raise => ffi::lua_error(raw),
            Exit::Refuse(reason) => ffi::luaL_argerror(raw, 1, reason.as_ptr()),
            Exit::Call => call_lowest(raw),
            Exit::Original(original, then) => {
                let count = original.0(raw);
                let Some(then) = then else { return count };
                match run(stack, then) {
                    Some(()) => count,
                    None => ffi::lua_error(raw),
                }
            }
        }
    }
}

/// Calls the lowest value on the stack with all others as arguments; returns the number of results.
///
/// # Safety
/// `raw` is the living coroutine of the running function. May raise.
unsafe fn call_lowest(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: what is called is there, and nothing here or in the caller's frame has a destructor.
    unsafe {
        let arguments = ffi::lua_gettop(raw) - 1;
        if arguments < 0 {
            return 0;
        }
        ffi::lua_callk(raw, arguments, ffi::LUA_MULTRET, 0, Some(after_yield));
        ffi::lua_gettop(raw)
    }
}

/// Where [`call_lowest`] goes on after what it called has yielded: all that is on the stack are results.
unsafe extern "C-unwind" fn after_yield(
    raw: *mut ffi::lua_State,
    _: c_int,
    _: ffi::lua_KContext,
) -> c_int {
    // SAFETY: Lua calls with a living coroutine.
    unsafe { ffi::lua_gettop(raw) }
}

/// Runs host code. After a panic, which is an error of the script, its text is on top.
fn run<T>(stack: Stack<'_>, code: impl FnOnce(Stack<'_>) -> T) -> Option<T> {
    let host_calls = &stack.owner().host_calls;
    host_calls.set(host_calls.get() + 1);
    let budget = stack.budget();
    let before = budget.enter(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| code(stack))).map_err(|panic| {
        // Without its arguments a function always has room for the error.
        stack.set_top(0);
        stack.push_bytes(panic_message(&*panic).as_bytes());
    });
    budget.leave(before);
    outcome.ok()
}
