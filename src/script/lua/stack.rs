//! A view of the stack of one coroutine.

use std::ffi::{CStr, c_int, c_void};
use std::marker::PhantomData;

use mlua_sys as ffi;

use super::state::MAX_BLOCK;

/// "All results", for [`Stack::protected_call`].
pub(crate) const MULTIPLE: c_int = ffi::LUA_MULTRET;

/// The stack of one coroutine of a living state. Indices are Lua's: 1 is the bottom, -1 the top.
#[derive(Clone, Copy)]
pub(crate) struct Stack<'a> {
    raw: *mut ffi::lua_State,
    _state: PhantomData<&'a ()>,
}

/// Size hints beyond this are not worth their memory: tables grow by themselves.
const MAX_HINT: usize = 1 << 16;

/// The type of a Lua value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    None,
    Nil,
    Boolean,
    Number,
    String,
    Table,
    Function,
    UserData,
    LightUserData,
    Thread,
}

/// A Lua function kept alive in the registry of its state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FunctionRef(c_int);

/// An error that ended a protected call.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LuaError {
    /// The error value as text with Lua's traceback, or `(error unknown)` when it was no string.
    pub text: String,
}

impl LuaError {
    /// The text without the traceback.
    pub(crate) fn message(&self) -> &str {
        self.text.split("\nstack traceback:").next().unwrap_or(&self.text)
    }
}

// Every method relies on `raw` being a coroutine of a living state, which `from_raw` asks of its caller.
impl<'a> Stack<'a> {
    /// # Safety
    /// `raw` must stay a coroutine of a living state for `'a`, used from this thread only.
    pub(super) unsafe fn from_raw(raw: *mut ffi::lua_State) -> Self {
        Self { raw, _state: PhantomData }
    }

    pub(super) fn raw(self) -> *mut ffi::lua_State {
        self.raw
    }

    /// What `State::new` was given.
    pub(crate) fn owner(self) -> &'a super::super::env::Env {
        // SAFETY: `State::new` wrote it, coroutines inherit it, and it outlives the state.
        unsafe { &**ffi::lua_getextraspace(self.raw).cast::<*const super::super::env::Env>() }
    }

    pub(crate) fn is_main_coroutine(self) -> bool {
        self.push_running_coroutine();
        // SAFETY: reads only.
        let main = unsafe {
            ffi::lua_rawgeti(self.raw, ffi::LUA_REGISTRYINDEX, ffi::LUA_RIDX_MAINTHREAD);
            ffi::lua_rawequal(self.raw, -1, -2) != 0
        };
        self.pop(2);
        main
    }

    /// Pushes the coroutine this stack belongs to.
    pub(crate) fn push_running_coroutine(self) {
        // SAFETY: pushes one value.
        unsafe { ffi::lua_pushthread(self.raw) };
    }

    /// Replaces the key on top by `table[key]`.
    pub(crate) fn raw_get(self, table: c_int) -> Type {
        let table = self.absolute(table);
        self.expect_table(table);
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawget(self.raw, table) };
        self.kind(-1)
    }

    pub(crate) fn top(self) -> c_int {
        // SAFETY: reads the stack pointer.
        unsafe { ffi::lua_gettop(self.raw) }
    }

    /// Cuts the stack to `top` values.
    pub(crate) fn set_top(self, top: c_int) {
        assert!((0..=self.top()).contains(&top), "a stack is only cut, never stretched");
        // SAFETY: shrinking only.
        unsafe { ffi::lua_settop(self.raw, top) }
    }

    pub(crate) fn pop(self, count: c_int) {
        self.set_top(self.top() - count);
    }

    /// Makes room for `count` more values; false when the stack would grow past Lua's limit.
    pub(crate) fn reserve(self, count: usize) -> bool {
        // SAFETY: `lua_checkstack` reports instead of raising.
        c_int::try_from(count).is_ok_and(|n| unsafe { ffi::lua_checkstack(self.raw, n) != 0 })
    }

    pub(crate) fn kind(self, index: c_int) -> Type {
        // SAFETY: `lua_type` accepts every index within the reserved stack.
        match unsafe { ffi::lua_type(self.raw, index) } {
            ffi::LUA_TNIL => Type::Nil,
            ffi::LUA_TBOOLEAN => Type::Boolean,
            ffi::LUA_TNUMBER => Type::Number,
            ffi::LUA_TSTRING => Type::String,
            ffi::LUA_TTABLE => Type::Table,
            ffi::LUA_TFUNCTION => Type::Function,
            ffi::LUA_TUSERDATA => Type::UserData,
            ffi::LUA_TLIGHTUSERDATA => Type::LightUserData,
            ffi::LUA_TTHREAD => Type::Thread,
            _ => Type::None,
        }
    }

    /// The number at `index`; numeric strings count.
    pub(crate) fn number(self, index: c_int) -> Option<f64> {
        let mut is_number = 0;
        // SAFETY: reads only.
        let number = unsafe { ffi::lua_tonumberx(self.raw, index, &raw mut is_number) };
        (is_number != 0).then_some(number)
    }

    /// The number at `index` if it is an integer; 2.0 and "2" are not.
    pub(crate) fn integer(self, index: c_int) -> Option<i64> {
        // SAFETY: reads only.
        unsafe {
            (ffi::lua_isinteger(self.raw, index) != 0)
                .then(|| ffi::lua_tointegerx(self.raw, index, std::ptr::null_mut()))
        }
    }

    pub(crate) fn truthy(self, index: c_int) -> bool {
        // SAFETY: reads only.
        unsafe { ffi::lua_toboolean(self.raw, index) != 0 }
    }

    /// The bytes of the string at `index`. Valid while the string stays on the stack.
    pub(crate) fn bytes(self, index: c_int) -> Option<&'a [u8]> {
        if self.kind(index) != Type::String {
            return None;
        }
        let mut length = 0;
        // SAFETY: the value is a string, so nothing is converted; Lua strings do not move.
        unsafe {
            let start = ffi::lua_tolstring(self.raw, index, &raw mut length);
            Some(std::slice::from_raw_parts(start.cast(), length))
        }
    }

    /// The string or number at `index` as text.
    pub(crate) fn text(self, index: c_int) -> Option<Vec<u8>> {
        match self.kind(index) {
            Type::String => self.bytes(index).map(<[u8]>::to_vec),
            Type::Number => {
                self.push_value(index);
                let mut length = 0;
                // SAFETY: converts the copy just pushed, then copies its bytes before it is popped.
                let text = unsafe {
                    let start = ffi::lua_tolstring(self.raw, -1, &raw mut length);
                    std::slice::from_raw_parts(start.cast::<u8>(), length).to_vec()
                };
                self.pop(1);
                Some(text)
            }
            _ => None,
        }
    }

    /// Length of the table at `index` as `#` tells without metamethods.
    pub(crate) fn raw_len(self, index: c_int) -> usize {
        // SAFETY: reads only; 0 for what has no length.
        unsafe { ffi::lua_rawlen(self.raw, index) as usize }
    }

    /// An address that identifies the table, function, thread or userdata at `index`.
    pub(crate) fn pointer(self, index: c_int) -> *const c_void {
        // SAFETY: reads only.
        unsafe { ffi::lua_topointer(self.raw, index) }
    }

    pub(crate) fn push_nil(self) {
        // SAFETY (this and the following pushes): callbacks have 20 free slots; more are reserved by `reserve`.
        unsafe { ffi::lua_pushnil(self.raw) }
    }

    pub(crate) fn push_bool(self, value: bool) {
        unsafe { ffi::lua_pushboolean(self.raw, c_int::from(value)) }
    }

    pub(crate) fn push_int(self, value: i64) {
        unsafe { ffi::lua_pushinteger(self.raw, value) }
    }

    pub(crate) fn push_number(self, value: f64) {
        unsafe { ffi::lua_pushnumber(self.raw, value) }
    }

    /// Pushes a string; one that is too long for Lua's allocator is cut.
    pub(crate) fn push_bytes(self, bytes: &[u8]) {
        let bytes = &bytes[..bytes.len().min(MAX_BLOCK / 2)];
        unsafe { ffi::lua_pushlstring(self.raw, bytes.as_ptr().cast(), bytes.len()) };
    }

    pub(crate) fn push_light(self, pointer: *const c_void) {
        unsafe { ffi::lua_pushlightuserdata(self.raw, pointer.cast_mut()) }
    }

    pub(crate) fn push_value(self, index: c_int) {
        assert!(self.kind(index) != Type::None, "only what is there can be copied");
        unsafe { ffi::lua_pushvalue(self.raw, index) }
    }

    pub(crate) fn new_table(self, array: usize, fields: usize) {
        let hint = |n: usize| n.min(MAX_HINT) as c_int;
        unsafe { ffi::lua_createtable(self.raw, hint(array), hint(fields)) }
    }

    /// Moves the top value to `index`.
    pub(crate) fn insert(self, index: c_int) {
        // SAFETY: rotates existing values.
        unsafe { ffi::lua_rotate(self.raw, index, 1) }
    }

    /// Removes the value at `index`.
    pub(crate) fn remove(self, index: c_int) {
        // SAFETY: rotates existing values.
        unsafe { ffi::lua_rotate(self.raw, index, -1) }
        self.pop(1);
    }

    /// The positive index of the same slot.
    pub(crate) fn absolute(self, index: c_int) -> c_int {
        if index < 0 { self.top() + index + 1 } else { index }
    }

    fn expect_table(self, index: c_int) {
        assert_eq!(self.kind(index), Type::Table, "raw access is for tables");
    }

    /// Pushes `table[i]`.
    pub(crate) fn raw_get_index(self, table: c_int, i: i64) -> Type {
        self.expect_table(table);
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawgeti(self.raw, table, i) };
        self.kind(-1)
    }

    /// `table[i]` as a number, without leaving it on the stack.
    pub(crate) fn number_at(self, table: c_int, i: i64) -> Option<f64> {
        self.raw_get_index(table, i);
        let number = self.number(-1);
        self.pop(1);
        number
    }

    /// Pops a value into `table[i]`.
    pub(crate) fn raw_set_index(self, table: c_int, i: i64) {
        self.expect_table(table);
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawseti(self.raw, table, i) }
    }

    /// Pushes `table[name]`.
    pub(crate) fn raw_get_field(self, table: c_int, name: &str) -> Type {
        let table = self.absolute(table);
        self.expect_table(table);
        self.push_bytes(name.as_bytes());
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawget(self.raw, table) };
        self.kind(-1)
    }

    /// Pops a value into `table[name]`.
    pub(crate) fn raw_set_field(self, table: c_int, name: &str) {
        let table = self.absolute(table);
        self.expect_table(table);
        self.push_bytes(name.as_bytes());
        self.insert(-2);
        // SAFETY: a table and a string key.
        unsafe { ffi::lua_rawset(self.raw, table) }
    }

    /// Pops key and value into the table; nil and NaN keys are dropped.
    pub(crate) fn raw_set(self, table: c_int) {
        let table = self.absolute(table);
        self.expect_table(table);
        if self.kind(-2) == Type::Nil || self.number(-2).is_some_and(f64::is_nan) {
            self.pop(2);
            return;
        }
        // SAFETY: a table and a valid key.
        unsafe { ffi::lua_rawset(self.raw, table) }
    }

    /// Pops a key, pushes the next key and value of the table; false at the end.
    ///
    /// The key must be nil or have come from this function, and the table must not have got new fields meanwhile.
    pub(crate) fn next(self, table: c_int) -> bool {
        self.expect_table(table);
        // SAFETY: with a key from the same unchanged table `lua_next` does not raise.
        unsafe { ffi::lua_next(self.raw, table) != 0 }
    }

    /// Pushes the global table.
    pub(crate) fn push_globals(self) {
        // SAFETY: the registry always holds the global table.
        unsafe { ffi::lua_rawgeti(self.raw, ffi::LUA_REGISTRYINDEX, ffi::LUA_RIDX_GLOBALS) };
    }

    /// Pushes the global `name`, without metamethods.
    pub(crate) fn push_global(self, name: &str) -> Type {
        self.push_globals();
        let kind = self.raw_get_field(-1, name);
        self.remove(-2);
        kind
    }

    /// Pops a value into the global `name`.
    pub(crate) fn set_global(self, name: &str) {
        self.push_globals();
        self.insert(-2);
        self.raw_set_field(-2, name);
        self.pop(1);
    }

    /// Pushes a value kept under `key` by [`set_registry`](Self::set_registry).
    pub(crate) fn push_registry(self, key: &'static CStr) -> Type {
        // SAFETY: raw access by the address of a static.
        unsafe { ffi::lua_rawgetp(self.raw, ffi::LUA_REGISTRYINDEX, key.as_ptr().cast()) };
        self.kind(-1)
    }

    /// Pops a value and keeps it under `key`.
    pub(crate) fn set_registry(self, key: &'static CStr) {
        // SAFETY: raw access by the address of a static.
        unsafe { ffi::lua_rawsetp(self.raw, ffi::LUA_REGISTRYINDEX, key.as_ptr().cast()) }
    }

    /// Pushes the metatable of the value at `index`, if it has one.
    pub(crate) fn push_metatable(self, index: c_int) -> bool {
        // SAFETY: reads only.
        unsafe { ffi::lua_getmetatable(self.raw, index) != 0 }
    }

    /// Pops a table and makes it the metatable of the table at `index`.
    pub(crate) fn set_metatable(self, index: c_int) {
        self.expect_table(-1);
        // SAFETY: both are tables.
        unsafe { ffi::lua_setmetatable(self.raw, index) };
    }

    pub(crate) fn same(self, a: c_int, b: c_int) -> bool {
        // SAFETY: raw comparison.
        unsafe { ffi::lua_rawequal(self.raw, a, b) != 0 }
    }

    /// Pops a function and keeps it.
    pub(crate) fn keep_function(self) -> FunctionRef {
        // SAFETY: pops the top into the registry.
        FunctionRef(unsafe { ffi::luaL_ref(self.raw, ffi::LUA_REGISTRYINDEX) })
    }

    pub(crate) fn push_function(self, function: FunctionRef) -> Type {
        // SAFETY: reads the registry.
        unsafe { ffi::lua_rawgeti(self.raw, ffi::LUA_REGISTRYINDEX, i64::from(function.0)) };
        self.kind(-1)
    }

    pub(crate) fn release_function(self, function: FunctionRef) {
        // SAFETY: a reference from `keep_function`, released once.
        unsafe { ffi::luaL_unref(self.raw, ffi::LUA_REGISTRYINDEX, function.0) }
    }

    /// Compiles `code` (text or bytecode made by this binary) and pushes the chunk. Lua shows positions as `[string "name"]:line:`
    /// unless the name starts with `=` or `@`.
    pub(crate) fn load(self, code: &[u8], name: &str, bytecode: bool) -> Result<(), LuaError> {
        let name = std::ffi::CString::new(name.replace('\0', " ")).unwrap_or_default();
        let mode = if bytecode { c"b" } else { c"t" };
        // SAFETY: `luaL_loadbufferx` reports errors as values.
        let status =
            unsafe { ffi::luaL_loadbufferx(self.raw, code.as_ptr().cast(), code.len(), name.as_ptr(), mode.as_ptr()) };
        if status == ffi::LUA_OK { Ok(()) } else { Err(self.pop_error()) }
    }

    /// Calls the function below its `arguments` on the stack, replacing them by `results` values.
    pub(crate) fn protected_call(self, arguments: c_int, results: c_int) -> Result<(), LuaError> {
        let handler = self.top() - arguments;
        // SAFETY: the handler goes below the function; `lua_pcall` catches every error.
        let status = unsafe {
            ffi::lua_pushcclosure(self.raw, message_handler, 0);
            ffi::lua_rotate(self.raw, handler, 1);
            ffi::lua_pcall(self.raw, arguments, results, handler)
        };
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
            if ffi::lua_getstack(self.raw, level, &raw mut record) == 0 {
                return -1;
            }
            ffi::lua_getinfo(self.raw, c"l".as_ptr(), &raw mut record);
            record.currentline
        }
    }

    /// Lua's traceback of this coroutine.
    pub(crate) fn traceback(self) -> String {
        // SAFETY: pushes one string.
        unsafe { ffi::luaL_traceback(self.raw, self.raw, std::ptr::null(), 1) };
        let text = self.text(-1).unwrap_or_default();
        self.pop(1);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// Kilobytes in use by the whole state.
    pub(crate) fn memory_kilobytes(self) -> i64 {
        // SAFETY: a query.
        i64::from(unsafe { ffi::lua_gc(self.raw, ffi::LUA_GCCOUNT) })
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
        unsafe { ffi::lua_dump(self.raw, write, (&raw mut out).cast(), 0) };
        self.pop(1);
        out
    }
}

/// Adds the traceback to string errors and leaves other values alone, as `debug.traceback` does.
unsafe extern "C-unwind" fn message_handler(raw: *mut ffi::lua_State) -> c_int {
    // SAFETY: called by Lua with the error value at index 1.
    unsafe {
        if ffi::lua_type(raw, 1) == ffi::LUA_TSTRING || ffi::lua_type(raw, 1) == ffi::LUA_TNUMBER {
            let message = ffi::lua_tolstring(raw, 1, std::ptr::null_mut());
            ffi::luaL_traceback(raw, raw, message, 1);
        }
        1
    }
}
