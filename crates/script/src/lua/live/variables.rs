//! Variables of running functions.

use std::ffi::{CStr, c_int};
use std::mem::MaybeUninit;

use mlua::ffi;

use crate::lua::{Stack, Type};

/// Most values that Lua gives a function in `...` here.
const MAX_FURTHER: c_int = 1000;

impl Stack<'_> {
    /// The record of the function with `below` others below it in this coroutine.
    fn record(self, below: c_int) -> Option<ffi::lua_Debug> {
        let level = self.depth() - 1 - below;
        let mut record = MaybeUninit::<ffi::lua_Debug>::zeroed();
        // SAFETY: a record of zeros is valid, and Lua fills in what it needs to find the function.
        unsafe {
            let found = ffi::lua_getstack(self.raw(), level.max(0), record.as_mut_ptr()) != 0;
            (found && level >= 0).then(|| record.assume_init())
        }
    }

    /// The names and numbers of the local variables of a running function, inner ones last, then those of `...`.
    pub(crate) fn local_variables(self, below: c_int) -> Vec<(String, c_int)> {
        let Some(record) = self.record(below) else {
            return Vec::new();
        };
        let name_of = |number: c_int| {
            let _room = self.room();
            // SAFETY: the function runs, and there is room for the value that comes with the name.
            let name = unsafe { ffi::lua_getlocal(self.raw(), &raw const record, number) };
            if name.is_null() {
                return None;
            }
            self.pop(1);
            // SAFETY: the name of a variable ends with NUL and lasts as long as the function runs.
            let name = unsafe { CStr::from_ptr(name) };
            Some(name.to_string_lossy().into_owned())
        };
        let own = (1..).map_while(|number| Some((name_of(number)?, number)));
        let own = own.filter(|(name, _)| !name.starts_with('('));
        let further = (1..=MAX_FURTHER)
            .map_while(|number| name_of(-number).map(|_| (format!("...{number}"), -number)));
        own.chain(further).collect()
    }

    /// Pushes a local variable of a running function of `coroutine`.
    pub(crate) fn push_local(self, coroutine: Self, below: c_int, number: c_int) -> bool {
        let Some(record) = coroutine.record(below) else {
            return false;
        };
        let (_room, _more) = (coroutine.room(), self.room());
        // SAFETY: the function runs; both stacks are of one state and have room.
        unsafe {
            if ffi::lua_getlocal(coroutine.raw(), &raw const record, number).is_null() {
                return false;
            }
            if coroutine.raw() != self.raw() {
                ffi::lua_xmove(coroutine.raw(), self.raw(), 1);
            }
        }
        true
    }

    /// Pops a value into a local variable of a running function of `coroutine`.
    pub(crate) fn set_local_of(self, coroutine: Self, below: c_int, number: c_int) {
        let Some(record) = coroutine.record(below) else {
            return self.pop(1);
        };
        let _room = coroutine.room();
        // SAFETY: the value is on top, and moved to a stack of the same state that has room. `lua_setlocal` pops it in any case.
        unsafe {
            if coroutine.raw() != self.raw() {
                ffi::lua_xmove(self.raw(), coroutine.raw(), 1);
            }
            ffi::lua_setlocal(coroutine.raw(), &raw const record, number);
        }
    }

    /// Pushes a running function of `coroutine`.
    pub(crate) fn push_running_function(self, coroutine: Self, below: c_int) -> bool {
        let Some(mut record) = coroutine.record(below) else {
            return false;
        };
        let (_room, _more) = (coroutine.room(), self.room());
        // SAFETY: the function runs; both stacks are of one state and have room.
        unsafe {
            if ffi::lua_getinfo(coroutine.raw(), c"f".as_ptr(), &raw mut record) == 0 {
                return false;
            }
            if coroutine.raw() != self.raw() {
                ffi::lua_xmove(coroutine.raw(), self.raw(), 1);
            }
        }
        true
    }

    /// The names of the upvalues of the function at `index`; those of the simulator's own functions stay hidden.
    pub(crate) fn upvalue_names(self, index: c_int) -> Vec<(String, c_int)> {
        let index = self.absolute(index);
        if self.kind(index) != Type::Function || self.is_native_function(index) {
            return Vec::new();
        }
        let name_of = |number: c_int| {
            let _room = self.room();
            // SAFETY: there is a function, and room for the value; the name ends with NUL and lives as long as the function.
            unsafe {
                let name = ffi::lua_getupvalue(self.raw(), index, number);
                if name.is_null() {
                    return None;
                }
                self.pop(1);
                Some(CStr::from_ptr(name).to_string_lossy().into_owned())
            }
        };
        (1..)
            .map_while(|number| Some((name_of(number)?, number)))
            .filter(|(name, _)| !name.starts_with('('))
            .collect()
    }

    /// Pushes an upvalue of the function of Lua code at `index`.
    pub(crate) fn push_upvalue_of(self, index: c_int, number: c_int) -> bool {
        !self.is_native_function(index) && self.push_upvalue(index, number)
    }

    /// Pops a value into an upvalue of the function of Lua code at `index`.
    pub(crate) fn set_upvalue_of(self, index: c_int, number: c_int) {
        let index = self.absolute(index);
        let is_code = self.kind(index) == Type::Function && !self.is_native_function(index);
        // SAFETY: there is a function, and the value is on top; it is popped unless there is no such upvalue.
        if !is_code || unsafe { ffi::lua_setupvalue(self.raw(), index, number) }.is_null() {
            self.pop(1);
        }
    }

    /// Whether the value at `index` is a function written in C.
    pub(crate) fn is_native_function(self, index: c_int) -> bool {
        super::api::lua_iscfunction(self, self.slot(index)) != 0
    }
}
