//! Compiling and calling Lua code, and inspecting the call stack.

use std::ffi::{c_int, c_void};

use mlua::chunk::ChunkMode;
use mlua::{Error, Lua, LuaOptions, StdLib, ffi};

use super::api;
use super::seal::seal_top;
use super::stack::Stack;

/// "All results", for [`Stack::protected_call`].
pub(crate) const MULTIPLE: c_int = ffi::LUA_MULTRET;

/// An error that ended a protected call.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LuaError {
    /// The error value as text with Lua's traceback, or `(error unknown)` when it was no string.
    pub text: String,
}

impl From<Error> for LuaError {
    fn from(error: Error) -> Self {
        Self { text: error.to_string() }
    }
}

/// Compiles Lua text to bytecode, in a state of its own.
pub(crate) fn compile(code: &[u8], chunk_name: &str) -> Result<Vec<u8>, String> {
    let lua = Lua::new_with(StdLib::NONE, LuaOptions::default()).map_err(|error| error.to_string())?;
    let chunk = lua.load(code).set_name(chunk_name.replace('\0', " ")).set_mode(ChunkMode::Text);
    match chunk.into_function() {
        Ok(function) => Ok(function.dump(false)),
        Err(Error::SyntaxError { message, .. }) => Err(message),
        Err(other) => Err(other.to_string()),
    }
}

impl Stack<'_> {
    /// Compiles `code` (text or bytecode made by this binary) and pushes the chunk. Lua shows positions as `[string "name"]:line:`
    /// unless the name starts with `=` or `@`.
    pub(crate) fn load(self, code: &[u8], name: &str, bytecode: bool) -> Result<(), LuaError> {
        let name = std::ffi::CString::new(name.replace('\0', " ")).unwrap_or_default();
        let mode = if bytecode { c"b" } else { c"t" };
        // SAFETY: `luaL_loadbufferx` reports errors as values.
        let status = unsafe {
            ffi::luaL_loadbufferx(self.raw(), code.as_ptr().cast(), code.len(), name.as_ptr(), mode.as_ptr())
        };
        if status == ffi::LUA_OK { Ok(()) } else { Err(self.pop_error()) }
    }

    /// Calls the function below its `arguments` on the stack, replacing them by `results` values.
    pub(crate) fn protected_call(self, arguments: c_int, results: c_int) -> Result<(), LuaError> {
        let handler = self.top() - arguments;
        let budget = self.budget();
        let before = budget.enter(false);
        // SAFETY: the handler goes below the function; `lua_pcall` catches every error.
        let status = unsafe {
            ffi::lua_pushcclosure(self.raw(), message_handler, 0);
            ffi::lua_rotate(self.raw(), handler, 1);
            ffi::lua_pcall(self.raw(), arguments, results, handler)
        };
        budget.leave(before);
        let outcome = if status == ffi::LUA_OK { Ok(()) } else { Err(self.pop_error()) };
        self.remove(handler);
        outcome
    }

    fn pop_error(self) -> LuaError {
        let text = self.text(-1).map_or_else(|| "(error unknown)".into(), |t| String::from_utf8_lossy(&t).into_owned());
        self.pop(1);
        LuaError { text }
    }

    /// The line being executed by the function `level` calls up; -1 when that is not a Lua function.
    pub(crate) fn current_line(self, level: c_int) -> c_int {
        // SAFETY: `lua_Debug` is plain data that `lua_getstack` fills.
        unsafe {
            let mut record: ffi::lua_Debug = std::mem::zeroed();
            if ffi::lua_getstack(self.raw(), level, &raw mut record) == 0 {
                return -1;
            }
            ffi::lua_getinfo(self.raw(), c"l".as_ptr(), &raw mut record);
            record.currentline
        }
    }

    /// The text of Lua's own functions for an argument they do not take, told by the running callback.
    pub(crate) fn argument_error(self, position: i32, reason: &str) -> String {
        let (name, is_method) = self.called_as();
        let place = self.place_of_call();
        match (position, is_method) {
            (1, true) => format!("{place}calling '{name}' on bad self ({reason})"),
            (_, true) => format!("{place}bad argument #{} to '{name}' ({reason})", position - 1),
            (_, false) => format!("{place}bad argument #{position} to '{name}' ({reason})"),
        }
    }

    /// The name the running function was called by, and whether as a method.
    fn called_as(self) -> (String, bool) {
        // SAFETY: `lua_Debug` is plain data that `lua_getstack` fills; the names it points to are copied at once.
        unsafe {
            let mut record: ffi::lua_Debug = std::mem::zeroed();
            if ffi::lua_getstack(self.raw(), 0, &raw mut record) == 0 {
                return ("?".into(), false);
            }
            ffi::lua_getinfo(self.raw(), c"n".as_ptr(), &raw mut record);
            if record.name.is_null() {
                return ("?".into(), false);
            }
            let text = |start| std::ffi::CStr::from_ptr(start).to_string_lossy().into_owned();
            (text(record.name), text(record.namewhat) == "method")
        }
    }

    /// `chunk:line: ` of the Lua function that called; nothing when that is none.
    fn place_of_call(self) -> String {
        api::luaL_where(self.room(), 1);
        let place = self.text(-1).unwrap_or_default();
        self.pop(1);
        String::from_utf8_lossy(&place).into_owned()
    }

    /// Lua's traceback of this coroutine, without the running function, which is a callback.
    pub(crate) fn traceback(self) -> String {
        self.traceback_from(1)
    }

    /// The same from a level on: 0 is the running function.
    pub(crate) fn traceback_from(self, level: c_int) -> String {
        // SAFETY: pushes one string.
        unsafe { ffi::luaL_traceback(self.raw(), self.raw(), std::ptr::null(), level) };
        let text = self.text(-1).unwrap_or_default();
        self.pop(1);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// Compiled form of the Lua function on top, which is popped.
    pub(crate) fn dump(self) -> Vec<u8> {
        unsafe extern "C-unwind" fn write(
            _: *mut ffi::lua_State,
            block: *const c_void,
            size: usize,
            out: *mut c_void,
        ) -> c_int {
            // SAFETY: `out` is the vector below; `block` has `size` bytes.
            unsafe { (*out.cast::<Vec<u8>>()).extend_from_slice(std::slice::from_raw_parts(block.cast(), size)) };
            0
        }
        let mut out = Vec::new();
        // SAFETY: `write` gets the vector it expects.
        unsafe { ffi::lua_dump(self.raw(), write, (&raw mut out).cast(), 0) };
        self.pop(1);
        out
    }

    pub(crate) fn is_main_coroutine(self) -> bool {
        self.push_running_coroutine();
        // SAFETY: reads only.
        let main = unsafe {
            ffi::lua_rawgeti(self.raw(), ffi::LUA_REGISTRYINDEX, ffi::LUA_RIDX_MAINTHREAD);
            ffi::lua_rawequal(self.raw(), -1, -2) != 0
        };
        self.pop(2);
        main
    }

    /// Pushes the coroutine this stack belongs to.
    pub(crate) fn push_running_coroutine(self) {
        api::lua_pushthread(self.room());
    }
}

/// Adds the traceback to string errors, and to those of Rust functions, and leaves other values alone, as `debug.traceback` does.
unsafe extern "C-unwind" fn message_handler(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: called by Lua with the error value at index 1.
    unsafe {
        seal_top(Stack::from_raw(raw));
        if ffi::lua_type(raw, 1) == ffi::LUA_TSTRING || ffi::lua_type(raw, 1) == ffi::LUA_TNUMBER {
            let message = ffi::lua_tolstring(raw, 1, std::ptr::null_mut());
            ffi::luaL_traceback(raw, raw, message, 1);
        }
        1
    }
}
