//! The records of running functions. Reading them changes nothing, so that signal handlers may do it.

use std::ffi::{CStr, c_char, c_int};
use std::mem::MaybeUninit;

use mlua::ffi;

use super::Stack;

/// A running function, and what was asked about it. Its texts are read while it runs.
pub(in crate::lua) struct Frame<'a> {
    stack: Stack<'a>,
    record: ffi::lua_Debug,
}

/// Facts that Lua reports about a running function. None of them pushes a value.
#[derive(Clone, Copy)]
pub(in crate::lua) struct Facts(&'static CStr);

impl Facts {
    pub(in crate::lua) const LINE_AND_SOURCE: Self = Self(c"lS");
    pub(in crate::lua) const NAME: Self = Self(c"n");
    pub(in crate::lua) const SOURCE: Self = Self(c"S");
    pub(in crate::lua) const ALL: Self = Self(c"nSl");
    pub(in crate::lua) const EVERYTHING: Self = Self(c"nSlt");
}

impl<'a> Stack<'a> {
    /// The function `level` calls up; 0 is the running one.
    pub(in crate::lua) fn frame(self, level: c_int, facts: Facts) -> Option<Frame<'a>> {
        let mut record = MaybeUninit::<ffi::lua_Debug>::zeroed();
        // SAFETY: a record of zeros is valid; Lua fills in the requested fields.
        let record = unsafe {
            if ffi::lua_getstack(self.raw(), level, record.as_mut_ptr()) == 0 {
                return None;
            }
            ffi::lua_getinfo(self.raw(), facts.0.as_ptr(), record.as_mut_ptr());
            record.assume_init()
        };
        Some(Frame {
            stack: self,
            record,
        })
    }
}

impl Stack<'_> {
    /// Pushes the Lua function that called the running one, and returns the line it is at; None, and nothing is pushed, where there is none.
    pub(in crate::lua) fn push_caller(self) -> Option<u32> {
        let line = u32::try_from(self.frame(1, Facts::LINE_AND_SOURCE)?.line()).ok()?;
        let _room = self.room();
        let mut record = MaybeUninit::<ffi::lua_Debug>::zeroed();
        // SAFETY: a record of zeros is valid. The frame is there, and its function is pushed, for which there is room.
        unsafe {
            ffi::lua_getstack(self.raw(), 1, record.as_mut_ptr());
            ffi::lua_getinfo(self.raw(), c"f".as_ptr(), record.as_mut_ptr());
        }
        Some(line)
    }
}

impl Frame<'_> {
    /// The line being executed; -1 for a function written in C.
    pub(in crate::lua) fn line(&self) -> c_int {
        self.record.currentline
    }

    /// The first line of its text; 0 for the main function of a text.
    pub(in crate::lua) fn defined_at(&self) -> c_int {
        self.record.linedefined
    }

    /// Whether it took the place of the function that called it.
    pub(in crate::lua) fn is_tail_call(&self) -> bool {
        self.record.istailcall != 0
    }

    /// The name it was called by.
    pub(in crate::lua) fn name(&self) -> Option<&CStr> {
        self.text(self.record.name)
    }

    /// Whether it was called as a method.
    pub(in crate::lua) fn is_method(&self) -> bool {
        self.text(self.record.namewhat) == Some(c"method")
    }

    /// Whether it is written in C.
    pub(in crate::lua) fn is_native(&self) -> bool {
        self.text(self.record.what) == Some(c"C")
    }

    /// Its chunk, as errors name it.
    pub(in crate::lua) fn chunk(&self) -> &CStr {
        self.text(self.record.short_src.as_ptr())
            .unwrap_or_default()
    }

    /// The name its chunk was loaded by.
    pub(in crate::lua) fn source(&self) -> &CStr {
        self.text(self.record.source).unwrap_or_default()
    }

    /// The name of a local variable or temporary value; None where there is none.
    pub(in crate::lua) fn local_name(&self, number: c_int) -> Option<&CStr> {
        let _room = self.stack.room();
        // SAFETY: the function runs, and there is room for the value that is pushed with the name.
        let name = unsafe { ffi::lua_getlocal(self.stack.raw(), &raw const self.record, number) };
        if !name.is_null() {
            self.stack.pop(1);
        }
        self.text(name)
    }

    fn text(&self, text: *const c_char) -> Option<&CStr> {
        // SAFETY: the texts of a record, and the names of variables, end with NUL and last as long as the function runs.
        (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) })
    }
}
