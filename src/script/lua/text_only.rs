//! Loading text only: bytecode that somebody changed makes Lua write where it should not.

use std::ffi::c_int;

use mlua::ffi;

use super::Stack;
use super::guard::{Guarded, install, original};

/// Makes `load`, `loadfile` and `dofile` refuse bytecode.
pub(crate) fn refuse_bytecode(stack: Stack<'_>) {
    stack.push_globals();
    install(stack, "load", Guarded::Load, load);
    install(stack, "loadfile", Guarded::LoadFile, load_file);
    // SAFETY: pushes a function without upvalues.
    unsafe { ffi::lua_pushcclosure(stack.raw(), do_file, 0) };
    stack.raw_set_field(-2, "dofile");
    stack.pop(1);
}

// SAFETY of all: Lua calls them with a state that is alive and 20 free slots. They own nothing, so that Lua's functions may raise.

unsafe extern "C-unwind" fn load(raw: *mut ffi::lua_State) -> c_int {
    unsafe { load_as_text(raw, 3, Guarded::Load) }
}

unsafe extern "C-unwind" fn load_file(raw: *mut ffi::lua_State) -> c_int {
    unsafe { load_as_text(raw, 2, Guarded::LoadFile) }
}

/// Continues in Lua's function with the mode for text, which is argument `mode`.
unsafe fn load_as_text(raw: *mut ffi::lua_State, mode: c_int, function: Guarded) -> c_int {
    unsafe {
        if ffi::lua_gettop(raw) < mode {
            ffi::lua_settop(raw, mode);
        }
        match ffi::lua_type(raw, mode) {
            ffi::LUA_TNIL => {}
            ffi::LUA_TSTRING if takes_text(raw, mode) => {}
            ffi::LUA_TSTRING => {
                ffi::lua_pushnil(raw);
                ffi::lua_pushstring(raw, c"bytecode is switched off (--no-unsafe).".as_ptr());
                return 2;
            }
            // Lua's function says what is wrong with it.
            _ => return original(raw, function),
        }
        ffi::lua_pushstring(raw, c"t".as_ptr());
        ffi::lua_copy(raw, -1, mode);
        ffi::lua_settop(raw, -2);
        original(raw, function)
    }
}

unsafe fn takes_text(raw: *mut ffi::lua_State, mode: c_int) -> bool {
    unsafe { std::ffi::CStr::from_ptr(ffi::lua_tolstring(raw, mode, std::ptr::null_mut())) }.to_bytes().contains(&b't')
}

/// `dofile` as Lua has it, but for text.
unsafe extern "C-unwind" fn do_file(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        let name = ffi::luaL_optlstring(raw, 1, std::ptr::null(), std::ptr::null_mut());
        ffi::lua_settop(raw, 1);
        if ffi::luaL_loadfilex(raw, name, c"t".as_ptr()) != ffi::LUA_OK {
            ffi::lua_error(raw);
        }
        ffi::lua_callk(raw, 0, ffi::LUA_MULTRET, 0, Some(results_of_file));
        results_of_file(raw, ffi::LUA_OK, 0)
    }
}

unsafe extern "C-unwind" fn results_of_file(raw: *mut ffi::lua_State, _: c_int, _: ffi::lua_KContext) -> c_int {
    unsafe { ffi::lua_gettop(raw) - 1 }
}
