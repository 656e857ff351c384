//! Tables, globals and the registry: raw access, which runs no Lua code.

use std::ffi::{CStr, c_int};

use mlua::ffi;

use super::{Stack, Type};
use crate::function_ref::FunctionRef;
use crate::lua::api::{self, Table};

/// Size hints beyond this are not worth their memory: tables grow by themselves.
pub(in crate::lua) const MAX_HINT: usize = 1 << 16;

/// Most items of a list that Rust pushes. Items take 16 bytes each; where they do not fit one block, Lua raises an error.
pub(crate) const MAX_LIST_LENGTH: usize = 1 << 26;

impl Stack<'_> {
    /// Replaces the key on top by `table[key]`.
    pub(crate) fn raw_get(self, table: c_int) -> Type {
        let (table, key) = self.table_and_value(table);
        Type::from_raw(api::lua_rawget(key, table))
    }

    /// Raw length of the table at `index`.
    #[expect(clippy::cast_possible_truncation, reason = "a table is in memory")]
    pub fn raw_len(self, index: c_int) -> usize {
        api::lua_rawlen(self, self.slot(index)) as usize
    }

    /// Pushes a new table with room for `array` items of a list and `fields` other entries.
    pub fn new_table(self, array: usize, fields: usize) {
        let hint = |n: usize| numbers::count_i32(n.min(MAX_HINT));
        api::lua_createtable(self.room(), hint(array), hint(fields));
    }

    /// Pushes `table[i]`.
    pub fn raw_get_index(self, table: c_int, i: i64) -> Type {
        let table = self.table(table);
        Type::from_raw(api::lua_rawgeti(self.room(), table, i))
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
        let table = self.table(-1);
        let mut room = self.room();
        for (i, &number) in (1..).zip(numbers) {
            room = room.push_number(number).set_index(table, i);
        }
    }

    /// Pops a value into `table[i]`.
    pub fn raw_set_index(self, table: c_int, i: i64) {
        let (table, value) = self.table_and_value(table);
        api::lua_rawseti(value, table, i);
    }

    /// Pushes `table[name]`.
    pub(crate) fn raw_get_field(self, table: c_int, name: &str) -> Type {
        let (table, key) = self.table_and_value(table);
        self.push_bytes(name.as_bytes());
        Type::from_raw(api::lua_rawget(key, table))
    }

    /// Pops a value into `table[name]`.
    pub(crate) fn raw_set_field(self, table: c_int, name: &str) {
        let (table, value) = self.table_and_value(table);
        api::lua_rawset(value.with_name(name), table);
    }

    /// Pops key and value into the table; nil and NaN keys are dropped.
    pub fn raw_set(self, table: c_int) {
        let table = self.table(table);
        match self.pair() {
            Some(pair) => api::lua_rawset(pair, table),
            None => self.pop(2),
        }
    }

    /// Pushes the global table.
    pub(crate) fn push_globals(self) {
        api::lua_rawgeti(self.room(), Table::REGISTRY, ffi::LUA_RIDX_GLOBALS);
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

    /// Pushes the value that [`set_registry`](Self::set_registry) stored under `key`.
    pub(crate) fn push_registry(self, key: &'static CStr) -> Type {
        Type::from_raw(api::lua_rawgetp(
            self.room(),
            Table::REGISTRY,
            key.as_ptr().cast(),
        ))
    }

    /// Pops a value and stores it under the address of `key`.
    pub(crate) fn set_registry(self, key: &'static CStr) {
        api::lua_rawsetp(self.value(), Table::REGISTRY, key.as_ptr().cast());
    }

    /// Pushes the value that is stored under a name, as Lua's own libraries do.
    pub(in crate::lua) fn push_named_registry(self, name: &'static str) {
        self.push_bytes(name.as_bytes());
        api::lua_rawget(self.value(), Table::REGISTRY);
    }

    /// Pops a value and stores it under a name, where mlua finds it.
    pub(crate) fn set_named_registry(self, name: &'static str) {
        api::lua_rawset(self.value().with_name(name), Table::REGISTRY);
    }

    /// Pushes the metatable of the value at `index`, if it has one.
    pub fn push_metatable(self, index: c_int) -> bool {
        let slot = self.slot(index);
        api::lua_getmetatable(self.room(), slot) != 0
    }

    /// Pushes upvalue `number` of the function at `index`, if it has that many.
    pub(in crate::lua) fn push_upvalue(self, index: c_int, number: c_int) -> bool {
        let slot = self.slot(index);
        !api::lua_getupvalue(self.room(), slot, number).is_null()
    }

    /// Pops a function and returns a reference to it.
    pub(crate) fn keep_function(self) -> FunctionRef {
        FunctionRef::new(api::luaL_ref(self.value(), Table::REGISTRY))
    }

    pub(crate) fn push_function(self, function: FunctionRef) -> Type {
        Type::from_raw(api::lua_rawgeti(
            self.room(),
            Table::REGISTRY,
            i64::from(function.number()),
        ))
    }

    pub(crate) fn release_function(self, function: FunctionRef) {
        // Anything else in the registry is not ours to release.
        if self.push_function(function) == Type::Function {
            api::luaL_unref(self, Table::REGISTRY, function.number());
        }
        self.pop(1);
    }
}
