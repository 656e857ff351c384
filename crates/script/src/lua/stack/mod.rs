//! A view of the stack of one coroutine.

pub(super) mod frame;
pub(super) mod tables;

use std::ffi::{c_int, c_void};
use std::marker::PhantomData;
use std::ops::Deref;

use mlua::{Lua, ffi};

use super::api::Slot;
use super::{Owner, api};
use crate::budget::Budget;

/// The stack of one coroutine of a living state. Indices are Lua's: 1 is the bottom, -1 the top.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Stack<'a> {
    raw: *mut ffi::lua_State,
    _state: PhantomData<&'a ()>,
}

/// A string of a state, which Lua does not collect before this is dropped.
pub struct SharedString(mlua::LuaString);

impl SharedString {
    /// The bytes of the string.
    pub fn bytes(&self) -> impl Deref<Target = [u8]> + '_ {
        self.0.as_bytes()
    }
}

/// The type of a Lua value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    /// No value: an index above the top.
    None,
    /// `nil`.
    Nil,
    /// `true` or `false`.
    Boolean,
    /// An integer or a float.
    Number,
    /// A string of bytes.
    String,
    /// A table.
    Table,
    /// A function of Lua or of the host.
    Function,
    /// A block of memory with a metatable.
    UserData,
    /// A pointer.
    LightUserData,
    /// A coroutine.
    Thread,
}

// Every method relies on `raw` being a coroutine of a living state, which `from_raw` requires of its caller.
impl<'a> Stack<'a> {
    /// # Safety
    /// `raw` must stay a coroutine of a living state for `'a`, used from this thread only.
    pub(super) unsafe fn from_raw(raw: *mut ffi::lua_State) -> Self {
        Self {
            raw,
            _state: PhantomData,
        }
    }

    pub(super) fn raw(self) -> *mut ffi::lua_State {
        self.raw
    }

    /// Who the state belongs to.
    pub(crate) fn owner(self) -> &'a Owner {
        // SAFETY: `State::new` wrote it, coroutines inherit it, and it outlives the state.
        unsafe { &**ffi::lua_getextraspace(self.raw).cast::<*const Owner>() }
    }

    /// The virtual machine, for what is not hot.
    pub(crate) fn lua(self) -> &'a Lua {
        // SAFETY: mlua made the state and stores this in it.
        unsafe { Lua::get_or_init_from_ptr(self.raw) }
    }

    /// The coroutine in a slot.
    pub(super) fn coroutine(self, slot: Slot) -> Option<Self> {
        // SAFETY: null for what is no coroutine; one in a slot is of this state, and alive.
        let raw = unsafe { ffi::lua_tothread(self.raw, slot.index()) };
        (!raw.is_null()).then_some(Self { raw, ..self })
    }

    /// The memory budget of the state.
    pub(super) fn budget(self) -> &'a Budget {
        &self.owner().budget
    }

    /// The number of values on the stack, which is the index of the top.
    pub fn top(self) -> c_int {
        api::lua_gettop(self)
    }

    /// Makes room for `count` more values; false when the stack would grow past Lua's limit.
    pub fn reserve(self, count: usize) -> bool {
        c_int::try_from(count).is_ok_and(|n| api::lua_checkstack(self, n) != 0)
    }

    /// The type of the value at `index`.
    pub fn kind(self, index: c_int) -> Type {
        Type::from_raw(api::lua_type(self, self.slot(index)))
    }

    /// The number at `index`; numeric strings count.
    pub fn number(self, index: c_int) -> Option<f64> {
        let mut is_number = 0;
        let number = api::lua_tonumberx(self, self.slot(index), Some(&mut is_number));
        (is_number != 0).then_some(number)
    }

    /// The number at `index` if it is an integer; 2.0 and "2" are not.
    pub fn integer(self, index: c_int) -> Option<i64> {
        let slot = self.slot(index);
        (api::lua_isinteger(self, slot) != 0).then(|| api::lua_tointegerx(self, slot, None))
    }

    /// Whether the value at `index` is neither nil nor false.
    pub fn truthy(self, index: c_int) -> bool {
        api::lua_toboolean(self, self.slot(index)) != 0
    }

    /// Reads the bytes of the string at `index`. What reads them can be sent to another thread, so it has no access to any state, and the
    /// string stays where it is meanwhile.
    pub fn with_bytes<T>(self, index: c_int, read: impl FnOnce(&[u8]) -> T + Send) -> Option<T> {
        if self.kind(index) != Type::String {
            return None;
        }
        let mut length = 0;
        let start = api::lua_tolstring(self, self.slot(index), Some(&mut length));
        // SAFETY: the bytes of a string on the stack, which was not converted. They do not move, and are freed only by Lua: `read` cannot call
        // it, since it holds nothing that leads to a state (`Stack`, `Lua`, and what a state belongs to are not `Send`).
        Some(read(unsafe {
            std::slice::from_raw_parts(start.cast(), length)
        }))
    }

    /// The string at `index`, which stays alive while it is looked at, wherever else it is.
    pub fn string(self, index: c_int) -> Option<SharedString> {
        if self.kind(index) == Type::String {
            self.to_mlua(index).ok().map(SharedString)
        } else {
            None
        }
    }

    /// A copy of the bytes of the string at `index`.
    pub(crate) fn bytes(self, index: c_int) -> Option<Vec<u8>> {
        self.with_bytes(index, <[u8]>::to_vec)
    }

    /// The string or number at `index` as text.
    pub(crate) fn text(self, index: c_int) -> Option<Vec<u8>> {
        match self.kind(index) {
            Type::String => self.bytes(index),
            Type::Number => {
                // A copy, since Lua converts numbers in their place.
                self.push_value(index);
                api::lua_tolstring(self, self.slot(-1), None);
                let text = self.bytes(-1);
                self.pop(1);
                text
            }
            _ => None,
        }
    }

    /// The number of the running function, which it got from `push_function`.
    pub(super) fn number_of_function(self) -> i64 {
        api::lua_tointegerx(self, Slot::NUMBER, None)
    }

    /// An address that identifies the table, function, thread or userdata at `index`.
    pub(crate) fn pointer(self, index: c_int) -> *const c_void {
        api::lua_topointer(self, self.slot(index))
    }

    /// Pushes nil.
    pub fn push_nil(self) {
        api::lua_pushnil(self.room());
    }

    /// Pushes a boolean.
    pub fn push_bool(self, value: bool) {
        api::lua_pushboolean(self.room(), c_int::from(value));
    }

    /// Pushes an integer.
    pub fn push_int(self, value: i64) {
        api::lua_pushinteger(self.room(), value);
    }

    /// Pushes a float.
    pub fn push_number(self, value: f64) {
        api::lua_pushnumber(self.room(), value);
    }

    /// Pushes a string; one that is too long for Lua's allocator is cut.
    pub fn push_bytes(self, bytes: &[u8]) {
        self.room().push_bytes(bytes);
    }

    /// Pushes a copy of the value at `index`.
    pub fn push_value(self, index: c_int) {
        assert!(
            self.kind(index) != Type::None,
            "only what is there can be copied"
        );
        let slot = self.slot(index);
        api::lua_pushvalue(self.room(), slot);
    }

    /// Moves the top value to `index`.
    pub(crate) fn insert(self, index: c_int) {
        self.rotate(index, true);
    }

    /// Removes the value at `index`.
    pub(crate) fn remove(self, index: c_int) {
        self.rotate(index, false);
        self.pop(1);
    }

    /// The positive index of the same slot.
    pub fn absolute(self, index: c_int) -> c_int {
        if index < 0 {
            self.top() + index + 1
        } else {
            index
        }
    }

    pub(crate) fn same(self, a: c_int, b: c_int) -> bool {
        api::lua_rawequal(self, self.slot(a), self.slot(b)) != 0
    }
}

impl Type {
    pub(super) fn from_raw(kind: c_int) -> Self {
        match kind {
            ffi::LUA_TNIL => Self::Nil,
            ffi::LUA_TBOOLEAN => Self::Boolean,
            ffi::LUA_TNUMBER => Self::Number,
            ffi::LUA_TSTRING => Self::String,
            ffi::LUA_TTABLE => Self::Table,
            ffi::LUA_TFUNCTION => Self::Function,
            ffi::LUA_TUSERDATA => Self::UserData,
            ffi::LUA_TLIGHTUSERDATA => Self::LightUserData,
            ffi::LUA_TTHREAD => Self::Thread,
            _ => Self::None,
        }
    }
}
