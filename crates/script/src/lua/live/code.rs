//! Functions of Lua code in memory: their instructions, some of which are replaced to arm traps.
//!
//! The records are those of Lua 5.4 (lobject.h), which mlua builds. They are not part of Lua's interface, so nothing is written before the
//! instructions found in memory are those that were loaded; `crates/debugger/tests/transparent.rs` arms the traps of hundreds of texts.

use std::ffi::{c_int, c_void};
use std::ptr::NonNull;

use mlua::{WeakLua, ffi};

use crate::lua::Stack;
use crate::lua::bytecode::{FunctionTraps, Trap};

/// What a value of Lua code points to.
#[repr(C)]
struct Closure {
    next: *mut c_void,
    kind: u8,
    marked: u8,
    upvalue_count: u8,
    gray: *mut c_void,
    prototype: *mut Prototype,
}

/// The record of a function's code.
#[repr(C)]
struct Prototype {
    next: *mut c_void,
    kind: u8,
    marked: u8,
    parameter_count: u8,
    is_vararg: u8,
    register_count: u8,
    upvalue_count: c_int,
    constant_count: c_int,
    code_size: c_int,
    line_info_size: c_int,
    inner_count: c_int,
    local_count: c_int,
    absolute_line_count: c_int,
    line: c_int,
    last_line: c_int,
    constants: *mut c_void,
    code: *mut u32,
    inner: *mut *mut Prototype,
}

/// A function with traps. Its code stays where it is, since the function it was loaded with is kept.
struct LiveFunction {
    code: NonNull<u32>,
    traps: Vec<Trap>,
}

/// The functions of a text with traps, as long as their state is there.
pub(crate) struct LiveCode {
    functions: Vec<LiveFunction>,
    state: WeakLua,
}

impl LiveCode {
    /// Arms the traps of the lines that are wanted, and disarms the others.
    pub(crate) fn arm(&self, is_wanted: &dyn Fn(u32) -> bool) {
        if self.state.try_upgrade().is_some() {
            self.functions
                .iter()
                .for_each(|function| function.arm(is_wanted));
        }
    }
}

impl Stack<'_> {
    /// The code of the function on top, and of those inside it, which was loaded with these traps; None if it was not. The function stays
    /// alive as long as the state.
    pub(crate) fn keep_code(self, traps: FunctionTraps) -> Option<LiveCode> {
        let prototype = self.prototype_on_top()?;
        let mut functions = Vec::new();
        // SAFETY: it is the prototype of a living function.
        unsafe { collect(prototype, traps, &mut functions) }?;
        self.push_value(-1);
        // Never released.
        let _ = self.keep_function();
        let state = self.lua().weak();
        Some(LiveCode { functions, state })
    }

    fn prototype_on_top(self) -> Option<*mut Prototype> {
        // SAFETY: a function that is not written in C is a closure of Lua's, with a prototype.
        unsafe {
            if ffi::lua_isfunction(self.raw(), -1) == 0 || ffi::lua_iscfunction(self.raw(), -1) != 0
            {
                return None;
            }
            Some((*ffi::lua_topointer(self.raw(), -1).cast::<Closure>()).prototype)
        }
    }
}

/// Adds a function and those inside it, if their instructions are these.
///
/// # Safety
/// `prototype` must be null or that of a living function.
unsafe fn collect(
    prototype: *mut Prototype,
    traps: FunctionTraps,
    found: &mut Vec<LiveFunction>,
) -> Option<()> {
    // SAFETY: a prototype has as many instructions and inner prototypes as it says.
    unsafe {
        let function = prototype.as_ref()?;
        let code = NonNull::new(function.code)?;
        let is_alike = usize::try_from(function.code_size) == Ok(traps.code.len())
            && usize::try_from(function.line) == Ok(traps.line)
            && usize::try_from(function.inner_count) == Ok(traps.inner.len());
        let same =
            is_alike && std::slice::from_raw_parts(code.as_ptr(), traps.code.len()) == traps.code;
        if !same {
            return None;
        }
        if !traps.traps.is_empty() {
            found.push(LiveFunction {
                code,
                traps: traps.traps,
            });
        }
        for (i, inner) in traps.inner.into_iter().enumerate() {
            collect(*function.inner.add(i), inner, found)?;
        }
    }
    Some(())
}

impl LiveFunction {
    /// Arms and disarms traps; the state is there.
    fn arm(&self, is_wanted: &dyn Fn(u32) -> bool) {
        for trap in &self.traps {
            let instruction = if is_wanted(trap.line) {
                trap.armed
            } else {
                trap.original
            };
            // SAFETY: the instruction is there, as `collect` has seen, and the function is alive with its state. Lua reads each
            // instruction when it comes to it.
            unsafe {
                let place = self.code.add(trap.place);
                debug_assert!([trap.original, trap.armed].contains(&place.read()));
                place.write(instruction);
            }
        }
    }
}
