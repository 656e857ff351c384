//! Lua's `debug` library sees Lua functions, not native ones.
//!
//! Native functions trust their upvalues, their frames and the metatables of userdata: a script that changed them could have any address
//! called or freed. So natives have no upvalues and no locals for `debug`, userdata keep their metatables, a metatable that says `__metatable`
//! is hidden from `debug.getmetatable` too, and the registry is a copy of what is public in it.

use std::ffi::{CStr, c_int};

use mlua::{Lua, Table, ffi};

use super::Stack;
use super::guard::{Guarded, install, original};

/// Replaces the functions of `debug` that reach into native functions.
pub(crate) fn restrict_debug(stack: Stack<'_>, lua: &Lua) -> mlua::Result<()> {
    stack.push_global("debug");
    install(stack, "getlocal", Guarded::GetLocal, get_local);
    install(stack, "setlocal", Guarded::SetLocal, set_local);
    install(stack, "getmetatable", Guarded::GetMetatable, get_metatable);
    install(stack, "setmetatable", Guarded::SetMetatable, set_metatable);
    install(stack, "getupvalue", Guarded::GetUpvalue, get_upvalue);
    install(stack, "setupvalue", Guarded::SetUpvalue, set_upvalue);
    stack.pop(1);
    let registry = public_registry(lua)?;
    let get_registry = lua.create_function(move |_, ()| Ok(registry.clone()))?;
    lua.globals().get::<Table>("debug")?.raw_set("getregistry", get_registry)
}

/// What of the registry anybody may have: modules and their loaders.
fn public_registry(lua: &Lua) -> mlua::Result<Table> {
    let package: Table = lua.globals().get("package")?;
    let registry = lua.create_table()?;
    registry.raw_set(ffi::LUA_RIDX_GLOBALS, lua.globals())?;
    registry.raw_set("_LOADED", package.get::<Table>("loaded")?)?;
    registry.raw_set("_PRELOAD", package.get::<Table>("preload")?)?;
    Ok(registry)
}

// SAFETY of all guards: Lua calls them with a state that is alive and 20 free slots. They own nothing, so that Lua's functions may raise.

unsafe extern "C-unwind" fn get_upvalue(raw: *mut ffi::lua_State) -> c_int {
    unsafe { if ffi::lua_iscfunction(raw, 1) != 0 { 0 } else { original(raw, Guarded::GetUpvalue) } }
}

unsafe extern "C-unwind" fn set_upvalue(raw: *mut ffi::lua_State) -> c_int {
    unsafe { if ffi::lua_iscfunction(raw, 1) != 0 { 0 } else { original(raw, Guarded::SetUpvalue) } }
}

unsafe extern "C-unwind" fn get_metatable(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        let is_userdata = ffi::lua_type(raw, 1) == ffi::LUA_TUSERDATA;
        if is_userdata && ffi::luaL_getmetafield(raw, 1, c"__metatable".as_ptr()) != ffi::LUA_TNIL {
            return 1;
        }
        original(raw, Guarded::GetMetatable)
    }
}

unsafe extern "C-unwind" fn set_metatable(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        if ffi::lua_type(raw, 1) == ffi::LUA_TUSERDATA {
            return ffi::luaL_argerror(raw, 1, c"userdata keep their metatables".as_ptr());
        }
        original(raw, Guarded::SetMetatable)
    }
}

unsafe extern "C-unwind" fn get_local(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        match Local::asked_for(raw) {
            Some(local) if local.is_native => {
                ffi::lua_pushnil(raw);
                1
            }
            _ => original(raw, Guarded::GetLocal),
        }
    }
}

unsafe extern "C-unwind" fn set_local(raw: *mut ffi::lua_State) -> c_int {
    unsafe {
        match Local::asked_for(raw) {
            Some(local) if local.is_native || local.is_temporary => {
                ffi::lua_pushnil(raw);
                1
            }
            _ => original(raw, Guarded::SetLocal),
        }
    }
}

/// A local variable by level and number.
struct Local {
    /// It is a slot of a native function.
    is_native: bool,
    /// It has no name: the virtual machine relies on what is in there.
    is_temporary: bool,
}

impl Local {
    /// The one whose level and number are in the arguments; None where Lua's function finds none either.
    ///
    /// # Safety
    /// As for the guards.
    unsafe fn asked_for(raw: *mut ffi::lua_State) -> Option<Self> {
        unsafe {
            let thread = ffi::lua_tothread(raw, 1);
            let (of, first) = if thread.is_null() { (raw, 1) } else { (thread, 2) };
            let level = integer(raw, first)?;
            let number = integer(raw, first + 1)?;
            let mut record: ffi::lua_Debug = std::mem::zeroed();
            if ffi::lua_getstack(of, level, &raw mut record) == 0 || ffi::lua_checkstack(of, 1) == 0 {
                return None;
            }
            ffi::lua_getinfo(of, c"S".as_ptr(), &raw mut record);
            let is_native = CStr::from_ptr(record.what) == c"C";
            let name = ffi::lua_getlocal(of, &raw const record, number);
            if name.is_null() {
                return Some(Self { is_native, is_temporary: false });
            }
            ffi::lua_settop(of, -2);
            let is_temporary = number > 0 && CStr::from_ptr(name).to_bytes().starts_with(b"(");
            Some(Self { is_native, is_temporary })
        }
    }
}

/// The number at `index` as Lua's function reads it.
unsafe fn integer(raw: *mut ffi::lua_State, index: c_int) -> Option<c_int> {
    let mut is_integer = 0;
    let integer = unsafe { ffi::lua_tointegerx(raw, index, &raw mut is_integer) };
    (is_integer != 0).then_some(integer as c_int)
}
