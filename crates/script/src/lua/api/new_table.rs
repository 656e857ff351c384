//! Tables that are filled as they are made: room for keys and values is checked once for each.

use std::ffi::c_int;

use super::{
    Pair, Room, Table, Top, lua_checkstack, lua_createtable, lua_gettop, lua_pushboolean,
    lua_pushinteger, lua_pushnil, lua_pushnumber, lua_rawset, lua_rawseti,
};
use crate::lua::Stack;
use crate::lua::stack::tables::MAX_HINT;

impl<'a> Room<'a> {
    /// Pushes a value that is no table, string or function.
    pub(crate) fn push(self, value: Scalar) {
        match value {
            Scalar::Nil => lua_pushnil(self),
            Scalar::Bool(value) => lua_pushboolean(self, c_int::from(value)),
            Scalar::Int(value) => lua_pushinteger(self, value),
            Scalar::Number(value) => lua_pushnumber(self, value),
        }
    }

    /// Pushes a new table, to be filled; gives the room back when Lua's stack is full. The numbers of list items and other entries are hints.
    pub(crate) fn new_table(self, items: usize, fields: usize) -> Result<NewTable<'a>, Self> {
        let stack = self.0;
        // For the table, a key, a value, and room in which nested values find that there is no more.
        if lua_checkstack(stack, 4) == 0 {
            return Err(self);
        }
        let hint = |count: usize| numbers::count_i32(count.min(MAX_HINT));
        lua_createtable(self, hint(items), hint(fields));
        Ok(NewTable {
            stack,
            index: lua_gettop(stack),
        })
    }
}

/// A value without memory of its own.
pub(crate) enum Scalar {
    Nil,
    Bool(bool),
    Int(i64),
    Number(f64),
}

/// A new table on top of the stack, with room for a key and a value.
pub(crate) struct NewTable<'a> {
    stack: Stack<'a>,
    index: c_int,
}

impl<'a> NewTable<'a> {
    /// Sets item `i` to the value that `push` pushes.
    pub(crate) fn set_item(&self, i: i64, push: impl FnOnce(Room<'a>)) {
        push(Room(self.stack));
        self.check(1);
        lua_rawseti(Top(self.stack), Table(self.index), i);
    }

    /// Sets item `i` to a number or the like.
    pub(crate) fn set_scalar(&self, i: i64, value: Scalar) {
        self.check(0);
        Room(self.stack).push(value);
        lua_rawseti(Top(self.stack), Table(self.index), i);
    }

    /// Sets a field to the value that `push` pushes.
    pub(crate) fn set_field(&self, name: &[u8], push: impl FnOnce(Room<'a>)) {
        Room(self.stack).push_bytes(name);
        self.set(push);
    }

    /// The same for a key of another type; nothing for one that no table can have.
    pub(crate) fn set_entry(&self, key: Scalar, push: impl FnOnce(Room<'a>)) {
        if matches!(key, Scalar::Nil) || matches!(key, Scalar::Number(number) if number.is_nan()) {
            return;
        }
        Room(self.stack).push(key);
        self.set(push);
    }

    /// The key is on top.
    fn set(&self, push: impl FnOnce(Room<'a>)) {
        push(Room(self.stack));
        self.check(2);
        lua_rawset(Pair(self.stack), Table(self.index));
    }

    /// Every entry begins and ends with the table on top, so that it is there, and room for a key and a value, as long as `push` pushes a
    /// value.
    fn check(&self, values: c_int) {
        assert_eq!(
            lua_gettop(self.stack),
            self.index + values,
            "each entry is a key and a value"
        );
    }
}
