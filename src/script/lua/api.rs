//! Functions of Lua's that cannot go wrong: the types of their arguments are the proof.
//!
//! A [`Stack`] is a living coroutine, a [`Slot`] an index Lua can look at, and [`Room`] a place for one more value.

use std::ffi::{c_int, c_void};

use super::Stack;

/// The positive index of a slot; nothing may be there, which Lua reads as no value.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub(super) struct Slot(c_int);

/// A stack with a free place.
#[repr(transparent)]
pub(super) struct Room<'a>(Stack<'a>);

// SAFETY: declared as in lua.h, since `Stack` and `Room` are pointers to a `lua_State` and `Slot` is an int. With a living state the first ones
// read, and a positive index beyond the top is "no value" to them; the others push one value, for which there is room. Out of memory
// ends the process where Rust asks for it (`budget.rs`), so pushing does not raise.
unsafe extern "C-unwind" {
    pub(super) safe fn lua_gettop(stack: Stack<'_>) -> c_int;
    pub(super) safe fn lua_checkstack(stack: Stack<'_>, count: c_int) -> c_int;
    pub(super) safe fn lua_type(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_iscfunction(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_isinteger(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_tonumberx(stack: Stack<'_>, slot: Slot, is_number: Option<&mut c_int>) -> f64;
    pub(super) safe fn lua_tointegerx(stack: Stack<'_>, slot: Slot, is_integer: Option<&mut c_int>) -> i64;
    pub(super) safe fn lua_toboolean(stack: Stack<'_>, slot: Slot) -> c_int;
    pub(super) safe fn lua_topointer(stack: Stack<'_>, slot: Slot) -> *const c_void;
    pub(super) safe fn lua_rawlen(stack: Stack<'_>, slot: Slot) -> u64;
    pub(super) safe fn lua_rawequal(stack: Stack<'_>, a: Slot, b: Slot) -> c_int;

    pub(super) safe fn lua_pushnil(room: Room<'_>);
    pub(super) safe fn lua_pushboolean(room: Room<'_>, value: c_int);
    pub(super) safe fn lua_pushinteger(room: Room<'_>, value: i64);
    pub(super) safe fn lua_pushnumber(room: Room<'_>, value: f64);
    pub(super) safe fn lua_pushvalue(room: Room<'_>, slot: Slot);
    pub(super) safe fn lua_pushthread(room: Room<'_>) -> c_int;
    pub(super) safe fn luaL_where(room: Room<'_>, level: c_int);
}

impl<'a> Stack<'a> {
    /// The slot with Lua's index `index`; no value for one below the bottom.
    pub(super) fn slot(self, index: c_int) -> Slot {
        if index > 0 {
            return Slot(index);
        }
        let top = lua_gettop(self);
        Slot(if (-top..0).contains(&index) { top + index + 1 } else { top + 1 })
    }

    /// Room for one more value. Lua's stack is limited to a million.
    pub(super) fn room(self) -> Room<'a> {
        assert!(lua_checkstack(self, 1) != 0, "stack overflow");
        Room(self)
    }
}
