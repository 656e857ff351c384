//! Tables, globals and the registry: raw access, which runs no Lua code.

use std::ffi::{CStr, c_int};

use mlua::ffi;

use super::api;
use super::stack::{Stack, Type};
use crate::script::runtime::FunctionRef;

/// Size hints beyond this are not worth their memory: tables grow by themselves.
const MAX_HINT: usize = 1 << 16;

/// Items of the longest list Rust pushes; where the items, of 16 bytes each, do not fit one block, Lua raises.
pub(crate) const LONGEST_LIST: usize = 1 << 26;

impl Stack<'_> {
    /// Replaces the key on top by `table[key]`.
    pub(crate) fn raw_get(self, table: c_int) -> Type {
        let table = self.absolute(table);
        self.expect_table(table);
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawget(self.raw(), table) };
        self.kind(-1)
    }

    /// Raw length of the table at `index`.
    pub(crate) fn raw_len(self, index: c_int) -> usize {
        api::lua_rawlen(self, self.slot(index)) as usize
    }

    pub(crate) fn new_table(self, array: usize, fields: usize) {
        let hint = |n: usize| n.min(MAX_HINT) as c_int;
        let _room = self.room();
        // SAFETY: there is room for one value, and the hints are small.
        unsafe { ffi::lua_createtable(self.raw(), hint(array), hint(fields)) }
    }

    fn expect_table(self, index: c_int) {
        assert_eq!(self.kind(index), Type::Table, "raw access is for tables");
    }

    /// Pushes `table[i]`.
    pub(crate) fn raw_get_index(self, table: c_int, i: i64) -> Type {
        self.expect_table(table);
        let _room = self.room();
        // SAFETY: a table, and room for one value; raw access runs no code.
        Type::from_raw(unsafe { ffi::lua_rawgeti(self.raw(), table, i) })
    }

    /// `table[i]` as a number, without leaving it on the stack.
    pub(crate) fn number_at(self, table: c_int, i: i64) -> Option<f64> {
        self.raw_get_index(table, i);
        let number = self.number(-1);
        self.pop(1);
        number
    }

    /// `table[i]` if it is an integer, without leaving it on the stack.
    pub(crate) fn integer_at(self, table: c_int, i: i64) -> Option<i64> {
        self.raw_get_index(table, i);
        let integer = self.integer(-1);
        self.pop(1);
        integer
    }

    /// Pushes a list of numbers.
    pub(crate) fn push_numbers(self, numbers: &[f64]) {
        self.new_table(numbers.len(), 0);
        let _room = self.room();
        for (i, &number) in (1..).zip(numbers) {
            // SAFETY: the new table is on top, and there is room for one value, which goes into the table.
            unsafe {
                ffi::lua_pushnumber(self.raw(), number);
                ffi::lua_rawseti(self.raw(), -2, i);
            }
        }
    }

    /// Pops a value into `table[i]`.
    pub(crate) fn raw_set_index(self, table: c_int, i: i64) {
        self.expect_table(table);
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawseti(self.raw(), table, i) }
    }

    /// Pushes `table[name]`.
    pub(crate) fn raw_get_field(self, table: c_int, name: &str) -> Type {
        let table = self.absolute(table);
        self.expect_table(table);
        self.push_bytes(name.as_bytes());
        // SAFETY: a table; raw access runs no code.
        unsafe { ffi::lua_rawget(self.raw(), table) };
        self.kind(-1)
    }

    /// Pops a value into `table[name]`.
    pub(crate) fn raw_set_field(self, table: c_int, name: &str) {
        let table = self.absolute(table);
        self.expect_table(table);
        self.push_bytes(name.as_bytes());
        self.insert(-2);
        // SAFETY: a table and a string key.
        unsafe { ffi::lua_rawset(self.raw(), table) }
    }

    /// Pops key and value into the table; nil and NaN keys are dropped.
    pub(crate) fn raw_set(self, table: c_int) {
        let table = self.absolute(table);
        self.expect_table(table);
        // Only of numbers: asking a string for its number would parse it.
        let is_key = match self.kind(-2) {
            Type::Nil => false,
            Type::Number => !self.number(-2).is_some_and(f64::is_nan),
            _ => true,
        };
        if !is_key {
            return self.pop(2);
        }
        // SAFETY: a table and a valid key.
        unsafe { ffi::lua_rawset(self.raw(), table) }
    }

    /// Pops a key, pushes the next key and value of the table; false at the end.
    ///
    /// The key must be nil or have come from this function, and the table must not have got new fields meanwhile:
    /// between two calls nothing may be allocated in the state, or a finalizer might run.
    pub(crate) fn next(self, table: c_int) -> bool {
        self.expect_table(table);
        // SAFETY: with a key from the same unchanged table `lua_next` does not raise.
        unsafe { ffi::lua_next(self.raw(), table) != 0 }
    }

    /// Pushes the global table.
    pub(crate) fn push_globals(self) {
        // SAFETY: the registry always holds the global table.
        unsafe { ffi::lua_rawgeti(self.raw(), ffi::LUA_REGISTRYINDEX, ffi::LUA_RIDX_GLOBALS) };
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
        unsafe { ffi::lua_rawgetp(self.raw(), ffi::LUA_REGISTRYINDEX, key.as_ptr().cast()) };
        self.kind(-1)
    }

    /// Pops a value and keeps it under `key`.
    pub(crate) fn set_registry(self, key: &'static CStr) {
        // SAFETY: raw access by the address of a static.
        unsafe { ffi::lua_rawsetp(self.raw(), ffi::LUA_REGISTRYINDEX, key.as_ptr().cast()) }
    }

    /// Pops a value and keeps it under a name, where mlua finds it.
    pub(crate) fn set_named_registry(self, name: &'static CStr) {
        // SAFETY: raw access in effect, since the registry has no metatable.
        unsafe { ffi::lua_setfield(self.raw(), ffi::LUA_REGISTRYINDEX, name.as_ptr()) }
    }

    /// Pushes the metatable of the value at `index`, if it has one.
    pub(crate) fn push_metatable(self, index: c_int) -> bool {
        // SAFETY: reads only.
        unsafe { ffi::lua_getmetatable(self.raw(), index) != 0 }
    }

    /// Pops a table and makes it the metatable of the table or userdata at `index`.
    pub(crate) fn set_metatable(self, index: c_int) {
        self.expect_table(-1);
        // SAFETY: a metatable, and something that has one of its own.
        unsafe { ffi::lua_setmetatable(self.raw(), index) };
    }

    /// Pops a function and keeps it.
    pub(crate) fn keep_function(self) -> FunctionRef {
        // SAFETY: pops the top into the registry.
        FunctionRef::new(unsafe { ffi::luaL_ref(self.raw(), ffi::LUA_REGISTRYINDEX) })
    }

    pub(crate) fn push_function(self, function: FunctionRef) -> Type {
        // SAFETY: reads the registry.
        unsafe { ffi::lua_rawgeti(self.raw(), ffi::LUA_REGISTRYINDEX, i64::from(function.number())) };
        self.kind(-1)
    }

    pub(crate) fn release_function(self, function: FunctionRef) {
        // SAFETY: a reference from `keep_function`, released once.
        unsafe { ffi::luaL_unref(self.raw(), ffi::LUA_REGISTRYINDEX, function.number()) }
    }
}
