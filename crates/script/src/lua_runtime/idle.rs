//! Whether callbacks of a script do nothing, so that they need not be called.

use std::cell::Cell;

use crate::lua::{Stack, Type};
use crate::sys_call::SysCall;

/// So often functions are looked at, at most: a script that goes on after that has other things to do.
const MAX_LOOKS: u32 = 16;

/// What is known of the functions of the callbacks.
#[derive(Default)]
pub(super) struct IdleFunctions {
    /// Callbacks whose function had something to do, as bits.
    busy: Cell<u64>,
    looks: Cell<u32>,
}

impl IdleFunctions {
    /// Whether the function of a callback has nothing to do. What it pushes stays on the stack.
    pub(super) fn is_idle(&self, stack: Stack<'_>, call: SysCall) -> bool {
        if self.busy.get() & call.bit() != 0 {
            return false;
        }
        self.looks.set(self.looks.get() + 1);
        let is_idle = self.looks.get() <= MAX_LOOKS
            && stack.push_global(call.name()) == Type::Function
            && stack.does_nothing();
        if !is_idle {
            self.busy.set(self.busy.get() | call.bit());
        }
        is_idle
    }
}
