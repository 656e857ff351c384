//! Telling lines, calls and returns to what counts lines.
//!
//! A line takes tens of nanoseconds, so nothing is asked of Lua but the running function, and where that stands only when it is not known.

use std::ffi::c_int;

use mlua_sys as ffi;

use super::super::coverage::Coverage;
use super::Stack;

/// What the hook is called for while lines are told, and while they are not.
const LINES: c_int = ffi::LUA_MASKLINE;
const CALLS: c_int = ffi::LUA_MASKCALL | ffi::LUA_MASKRET;

/// What the hook of a new coroutine is called for, where lines are counted.
pub(super) fn mask(stack: Stack<'_>) -> c_int {
    if stack.owner().coverage.is_some() { LINES } else { 0 }
}

/// Takes note of an event that is not that of the count hook; true when the count hook, which began to count anew, should have come.
///
/// # Safety
/// To be called by a hook with what Lua gave it.
pub(super) unsafe fn note(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug) -> bool {
    // SAFETY: Lua keeps places on the stack for a hook, and takes away what the hook leaves there. None of the questions raises.
    unsafe {
        let Some(coverage) = &Stack::from_raw(raw).owner().coverage else { return false };
        match (*record).event {
            ffi::LUA_HOOKLINE => {
                if !line(raw, record, coverage) {
                    switch(raw, CALLS);
                }
                coverage.is_late()
            }
            ffi::LUA_HOOKRET => {
                let mut caller: ffi::lua_Debug = std::mem::zeroed();
                if ffi::lua_getstack(raw, 1, &raw mut caller) != 0 {
                    enter(raw, &raw mut caller, coverage);
                }
                false
            }
            _ => {
                enter(raw, record, coverage);
                false
            }
        }
    }
}

unsafe fn line(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug, coverage: &Coverage) -> bool {
    // SAFETY: as in `note`.
    unsafe {
        let place = place(raw, record, coverage);
        coverage.line(place, (*record).currentline)
    }
}

/// Has lines told again when the function of `record` may have new ones.
unsafe fn enter(raw: *mut ffi::lua_State, record: *mut ffi::lua_Debug, coverage: &Coverage) {
    // SAFETY: as in `note`.
    unsafe {
        if coverage.enter(place(raw, record, coverage)) {
            coverage.note_lost_count();
            switch(raw, LINES);
        }
    }
}

unsafe fn place(
    raw: *mut ffi::lua_State,
    record: *mut ffi::lua_Debug,
    coverage: &Coverage,
) -> Option<super::super::coverage::Place> {
    // SAFETY: as in `note`. `source` has `srclen` bytes and lives as long as the function, which is running.
    unsafe {
        ffi::lua_getinfo(raw, c"f".as_ptr(), record);
        let function = ffi::lua_topointer(raw, -1);
        ffi::lua_settop(raw, -2);
        coverage.functions.place(function, || {
            ffi::lua_getinfo(raw, c"S".as_ptr(), record);
            let source = std::slice::from_raw_parts((*record).source.cast(), (*record).srclen);
            coverage.place_of(source, (*record).linedefined)
        })
    }
}

/// Changes what the hook is called for, besides instructions.
unsafe fn switch(raw: *mut ffi::lua_State, events: c_int) {
    // SAFETY: `raw` is the coroutine whose hook is running.
    unsafe {
        let count = ffi::lua_gethookmask(raw) & ffi::LUA_MASKCOUNT;
        ffi::lua_sethook(raw, ffi::lua_gethook(raw), events | count, ffi::lua_gethookcount(raw));
    }
}
