//! Errors of the Rust functions that an embedding program has added, as scripts catch them: strings with the caller's line.
//!
//! mlua raises userdata, on which `..` and `:find` fail. They become strings where scripts catch errors: in `pcall`, `xpcall`,
//! `coroutine.resume` and `coroutine.close`, and in the host's own calls. So a call that succeeds costs nothing more.

use std::ffi::{CStr, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};

use mlua::{Error, Value, ffi};

use super::callback::panic_text;
use super::guard::{Guarded, install, original};
use super::{Budget, Stack, Type};

/// Where an error is for mlua to look at.
const FAILURE: &CStr = c"swanilda.failure";

/// Makes everything that catches errors hand strings to scripts.
pub(crate) fn seal(stack: Stack<'_>) {
    stack.push_globals();
    for (name, function) in [("pcall", pcall as ffi::lua_CFunction), ("xpcall", xpcall)] {
        // SAFETY: pushes a function without upvalues.
        unsafe { ffi::lua_pushcclosure(stack.raw(), function, 0) };
        stack.raw_set_field(-2, name);
    }
    stack.pop(1);
    stack.push_global("coroutine");
    install(stack, "resume", Guarded::CoroutineResume, resume);
    install(stack, "close", Guarded::CoroutineClose, close);
    stack.pop(1);
}

/// Replaces the value on top by a string, if it is an error of a Rust function.
pub(super) fn seal_top(stack: Stack<'_>) {
    if stack.kind(-1) != Type::UserData {
        return;
    }
    let budget = stack.budget();
    let before = budget.enter(true);
    if let Some(text) = failure(stack) {
        stack.pop(1);
        stack.push_bytes(text.as_bytes());
    }
    budget.leave(before);
}

fn failure(stack: Stack<'_>) -> Option<String> {
    stack.push_value(-1);
    // SAFETY: raw access in effect, since the registry has no metatable.
    unsafe { ffi::lua_setfield(stack.raw(), ffi::LUA_REGISTRYINDEX, FAILURE.as_ptr()) };
    let name = FAILURE.to_str().expect("ASCII");
    let lua = stack.lua();
    // A panic that mlua caught goes on when its userdata is looked at.
    let value = catch_unwind(AssertUnwindSafe(|| lua.named_registry_value::<Value>(name)));
    // Nobody reads the value there; a failure to remove it keeps one error alive.
    let _ = lua.unset_named_registry_value(name);
    match value {
        Ok(Ok(Value::Error(error))) => Some(text_of(&error, stack.budget())),
        Ok(_) => None,
        Err(panic) => Some(format!("a Rust function panicked: {}", panic_text(&*panic))),
    }
}

/// The line of the call, the function and the reason, as all functions of the simulator say it.
fn text_of(error: &Error, budget: &Budget) -> String {
    let Error::CallbackError { traceback, .. } = error else { return reason(error) };
    let mut entries = traceback.lines().filter_map(|line| line.trim_start().split_once(": in "));
    // Where memory may be refused, mlua begins with the caller.
    let function = if budget.is_limited() { None } else { entries.next() };
    let line: Option<i64> = entries.next().and_then(|(place, _)| place.rsplit_once(':')?.1.parse().ok());
    let line = line.unwrap_or(-1);
    match function.and_then(|(_, name)| name.split('\'').nth(1)) {
        Some(name) => format!("{line}: in {name}: {}", reason(error)),
        None => format!("{line}: {}", reason(error)),
    }
}

/// What a Rust function said, without who called it.
fn reason(error: &Error) -> String {
    match error {
        Error::CallbackError { cause, .. } => reason(cause),
        // The error of a Lua function comes with its traceback.
        Error::RuntimeError(text) => text.split("\nstack traceback:").next().unwrap_or_default().to_owned(),
        other => other.to_string(),
    }
}

// SAFETY of all: Lua calls them with a state that is alive and 20 free slots. They own nothing, so that Lua's functions may raise.

unsafe extern "C-unwind" fn pcall(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        ffi::luaL_checkany(raw, 1);
        ffi::lua_pushboolean(raw, 1);
        ffi::lua_rotate(raw, 1, 1);
        let status = ffi::lua_pcallk(raw, ffi::lua_gettop(raw) - 2, ffi::LUA_MULTRET, 0, 0, Some(caught));
        caught(raw, status, 0)
    }
}

/// `xpcall` with a handler that sees strings.
unsafe extern "C-unwind" fn xpcall(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        let arguments = ffi::lua_gettop(raw) - 2;
        ffi::luaL_checktype(raw, 2, ffi::LUA_TFUNCTION);
        ffi::lua_pushvalue(raw, 2);
        ffi::lua_pushcclosure(raw, handle, 1);
        ffi::lua_copy(raw, -1, 2);
        ffi::lua_settop(raw, -2);
        ffi::lua_pushboolean(raw, 1);
        ffi::lua_pushvalue(raw, 1);
        ffi::lua_rotate(raw, 3, 2);
        let status = ffi::lua_pcallk(raw, arguments, ffi::LUA_MULTRET, 2, 2, Some(caught));
        caught(raw, status, 2)
    }
}

/// Calls the handler in the upvalue with a string in place of an error of Rust.
unsafe extern "C-unwind" fn handle(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        ffi::lua_settop(raw, 1);
        seal_top(Stack::from_raw(raw));
        ffi::lua_pushvalue(raw, ffi::lua_upvalueindex(1));
        ffi::lua_rotate(raw, 1, 1);
        ffi::lua_callk(raw, 1, ffi::LUA_MULTRET, 0, None);
        ffi::lua_gettop(raw)
    }
}

/// The results of a protected call, after the `below` lowest slots.
unsafe extern "C-unwind" fn caught(raw: *mut ffi::lua_State, status: c_int, below: ffi::lua_KContext) -> c_int {
    unsafe {
        if status == ffi::LUA_OK || status == ffi::LUA_YIELD {
            return ffi::lua_gettop(raw) - below as c_int;
        }
        seal_top(Stack::from_raw(raw));
        ffi::lua_pushboolean(raw, 0);
        ffi::lua_rotate(raw, -2, 1);
        2
    }
}

unsafe extern "C-unwind" fn resume(raw: *mut ffi::lua_State) -> c_int {
    unsafe { seal_second(raw, original(raw, Guarded::CoroutineResume)) }
}

unsafe extern "C-unwind" fn close(raw: *mut ffi::lua_State) -> c_int {
    unsafe { seal_second(raw, original(raw, Guarded::CoroutineClose)) }
}

/// Seals the error of the results `false, error`.
unsafe fn seal_second(raw: *mut ffi::lua_State, results: c_int) -> c_int {
    unsafe {
        if results == 2 && ffi::lua_toboolean(raw, -2) == 0 {
            seal_top(Stack::from_raw(raw));
        }
    }
    results
}
