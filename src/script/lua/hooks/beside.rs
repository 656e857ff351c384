//! `debug.sethook` in watched states: a script's hook runs beside the one that can stop the script, and never in its place.
//!
//! Lua has one hook for each coroutine. After `debug.sethook` it is one of ours, which asks whether the code may go on and then calls what
//! Lua's library had set; `debug.gethook` sees the latter.

use std::ffi::c_int;
use std::sync::OnceLock;

use mlua::ffi;

use super::coroutine::{HOOK_INTERVAL, Step, hook, next_step};
use super::guard::{Next, guarded, install};
use super::{Stack, Type};

/// The hook of Lua's library, which calls the function of the script.
static OF_LIBRARY: OnceLock<ffi::lua_Hook> = OnceLock::new();

/// Guards the functions of the table `debug`, which is on top.
pub(super) fn keep_watch(stack: Stack<'_>) {
    install::<{ guarded::SET_HOOK }, _>(stack, "sethook", |_| Next::OriginalThen(watch));
    install::<{ guarded::GET_HOOK }, _>(stack, "gethook", |stack| {
        unwatch(stack);
        Next::OriginalThen(watch)
    });
}

/// The coroutine that is meant: the first argument, or the running one.
fn coroutine(stack: Stack<'_>) -> *mut ffi::lua_State {
    if stack.kind(1) == Type::Thread {
        // SAFETY: a coroutine on the stack is alive.
        unsafe { ffi::lua_tothread(stack.raw(), 1) }
    } else {
        stack.raw()
    }
}

fn is(hook: ffi::lua_Hook, other: ffi::lua_Hook) -> bool {
    std::ptr::fn_addr_eq(hook, other)
}

/// Puts a hook of ours in the place of the one of the library, or of none.
fn watch(stack: Stack<'_>) {
    if !stack.owner().is_interruptible() {
        return;
    }
    let coroutine = coroutine(stack);
    // SAFETY: the coroutine is alive. Hooks are read and set.
    unsafe {
        let mask = ffi::lua_gethookmask(coroutine);
        match ffi::lua_gethook(coroutine) {
            None => ffi::lua_sethook(coroutine, Some(hook as ffi::lua_Hook), ffi::LUA_MASKCOUNT, HOOK_INTERVAL),
            Some(own) if [hook as ffi::lua_Hook, beside_hook, beside_counting_hook].iter().any(|&one| is(own, one)) => {
            }
            Some(of_library) => {
                OF_LIBRARY.get_or_init(|| of_library);
                let (ours, interval): (ffi::lua_Hook, c_int) = if mask & ffi::LUA_MASKCOUNT != 0 {
                    (beside_counting_hook, ffi::lua_gethookcount(coroutine))
                } else {
                    (beside_hook, HOOK_INTERVAL)
                };
                ffi::lua_sethook(coroutine, Some(ours), mask | ffi::LUA_MASKCOUNT, interval);
            }
        }
    }
}

/// Puts the hook of the library back.
fn unwatch(stack: Stack<'_>) {
    let coroutine = coroutine(stack);
    // SAFETY: the coroutine is alive. Hooks are read and set.
    unsafe {
        let (mask, interval) = (ffi::lua_gethookmask(coroutine), ffi::lua_gethookcount(coroutine));
        match ffi::lua_gethook(coroutine) {
            Some(own) if is(own, beside_counting_hook) => {
                ffi::lua_sethook(coroutine, OF_LIBRARY.get().copied(), mask, interval);
            }
            Some(own) if is(own, beside_hook) => {
                ffi::lua_sethook(coroutine, OF_LIBRARY.get().copied(), mask & !ffi::LUA_MASKCOUNT, 0);
            }
            _ => {}
        }
    }
}

/// Beside a hook that counts nothing.
unsafe extern "C-unwind" fn beside_hook(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug) {
    // SAFETY: Lua's call is passed on. Nothing is owned here.
    unsafe { if (*record).event == ffi::LUA_HOOKCOUNT { hook(raw, record) } else { call_library(raw, record) } }
}

/// Beside a hook that counts instructions as well.
unsafe extern "C-unwind" fn beside_counting_hook(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug) {
    // SAFETY: as above. The error leaves it by `longjmp`.
    unsafe {
        if (*record).event == ffi::LUA_HOOKCOUNT && next_step(Stack::from_raw(raw)) == Step::Raise {
            ffi::lua_error(raw);
        }
        call_library(raw, record);
    }
}

unsafe fn call_library(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug) {
    if let Some(of_library) = OF_LIBRARY.get() {
        // SAFETY: the caller's.
        unsafe { of_library(raw, record) };
    }
}
