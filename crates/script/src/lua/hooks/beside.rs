//! `debug.sethook` in watched states: a script's hook runs beside the one that can stop the script, and never in its place.
//!
//! Lua has one hook for each coroutine. After `debug.sethook` it is one of ours, which asks whether the code may go on and then calls what
//! Lua's library had set; `debug.gethook` sees the latter.

use std::sync::OnceLock;

use mlua::ffi;

use super::count::{HOOK_INTERVAL, Step, hook, next_step};
use crate::lua::Stack;
use crate::lua::api::{self, Hook, Slot};
use crate::lua::calls::guard::{Next, guarded, install};

/// The hook of Lua's library, which calls the function of the script.
static OF_LIBRARY: OnceLock<Hook> = OnceLock::new();

/// Guards the functions of the table `debug`, which is on top.
pub(super) fn keep_watch(stack: Stack<'_>) {
    install::<{ guarded::SET_HOOK }, _>(stack, "sethook", |_| Next::OriginalThen(watch));
    install::<{ guarded::GET_HOOK }, _>(stack, "gethook", |stack| {
        unwatch(stack);
        Next::OriginalThen(watch)
    });
}

/// The coroutine that is meant: the first argument, or the running one.
fn coroutine(stack: Stack<'_>) -> Stack<'_> {
    stack.coroutine(Slot::FIRST).unwrap_or(stack)
}

/// Puts a hook of ours in the place of the one of the library, or of none.
fn watch(stack: Stack<'_>) {
    if !stack.owner().is_watched {
        return;
    }
    let coroutine = coroutine(stack);
    let mask = api::lua_gethookmask(coroutine);
    match api::lua_gethook(coroutine) {
        None => api::lua_sethook(
            coroutine,
            Some(Hook::COUNT),
            ffi::LUA_MASKCOUNT,
            HOOK_INTERVAL,
        ),
        Some(own) if [Hook::COUNT, Hook::BESIDE, Hook::BESIDE_COUNTING].contains(&own) => {}
        Some(of_library) => {
            OF_LIBRARY.get_or_init(|| of_library);
            let (ours, interval) = if mask & ffi::LUA_MASKCOUNT != 0 {
                (Hook::BESIDE_COUNTING, api::lua_gethookcount(coroutine))
            } else {
                (Hook::BESIDE, HOOK_INTERVAL)
            };
            api::lua_sethook(coroutine, Some(ours), mask | ffi::LUA_MASKCOUNT, interval);
        }
    }
}

/// Puts the hook of the library back.
fn unwatch(stack: Stack<'_>) {
    let coroutine = coroutine(stack);
    let (mask, interval) = (
        api::lua_gethookmask(coroutine),
        api::lua_gethookcount(coroutine),
    );
    let of_library = OF_LIBRARY.get().copied();
    match api::lua_gethook(coroutine) {
        Some(own) if own == Hook::BESIDE_COUNTING => {
            api::lua_sethook(coroutine, of_library, mask, interval);
        }
        Some(own) if own == Hook::BESIDE => {
            api::lua_sethook(coroutine, of_library, mask & !ffi::LUA_MASKCOUNT, 0);
        }
        _ => {}
    }
}

/// Beside a hook that counts nothing.
pub(in crate::lua) unsafe extern "C-unwind" fn beside_hook(
    raw: *mut ffi::lua_State,
    record: *mut ffi::lua_Debug,
) {
    // SAFETY: Lua's call is passed on. Nothing is owned here.
    unsafe {
        if (*record).event == ffi::LUA_HOOKCOUNT {
            hook(raw, record);
        } else if let Some(of_library) = OF_LIBRARY.get() {
            of_library.function()(raw, record);
        }
    }
}

/// Beside a hook that counts instructions as well.
pub(in crate::lua) unsafe extern "C-unwind" fn beside_counting_hook(
    raw: *mut ffi::lua_State,
    record: *mut ffi::lua_Debug,
) {
    // SAFETY: as above. The error leaves it by `longjmp`.
    unsafe {
        if (*record).event == ffi::LUA_HOOKCOUNT && next_step(Stack::from_raw(raw)) == Step::Raise {
            ffi::lua_error(raw);
        }
        if let Some(of_library) = OF_LIBRARY.get() {
            of_library.function()(raw, record);
        }
    }
}
