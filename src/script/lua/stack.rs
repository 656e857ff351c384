//! A view of the stack of one coroutine.

use std::ffi::{c_int, c_void};
use std::marker::PhantomData;

use mlua::{Lua, ffi};

use super::Budget;
use crate::script::lifecycle::env::Env;

/// Longer strings are cut: Lua would raise where it cannot have the memory.
const LONGEST_STRING: usize = 1 << 29;

/// The stack of one coroutine of a living state. Indices are Lua's: 1 is the bottom, -1 the top.
#[derive(Clone, Copy)]
pub struct Stack<'a> {
    raw: *mut ffi::lua_State,
    _state: PhantomData<&'a ()>,
}

/// The type of a Lua value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
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

    /// The host's side of the state.
    pub(crate) fn owner(self) -> &'a Env {
        // SAFETY: `State::new` wrote it, coroutines inherit it, and it outlives the state.
        unsafe { &**ffi::lua_getextraspace(self.raw).cast::<*const Env>() }
    }

    /// The virtual machine, for what is not hot.
    pub(crate) fn lua(self) -> &'a Lua {
        // SAFETY: mlua made the state and keeps this with it.
        unsafe { Lua::get_or_init_from_ptr(self.raw) }
    }

    /// The memory the state belongs to.
    pub(super) fn budget(self) -> &'a Budget {
        &self.owner().budget
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
        let bytes = &bytes[..bytes.len().min(LONGEST_STRING)];
        unsafe { ffi::lua_pushlstring(self.raw, bytes.as_ptr().cast(), bytes.len()) };
    }

    pub(crate) fn push_value(self, index: c_int) {
        assert!(self.kind(index) != Type::None, "only what is there can be copied");
        unsafe { ffi::lua_pushvalue(self.raw, index) }
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

    pub(crate) fn same(self, a: c_int, b: c_int) -> bool {
        // SAFETY: raw comparison.
        unsafe { ffi::lua_rawequal(self.raw, a, b) != 0 }
    }
}
