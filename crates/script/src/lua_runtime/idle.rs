//! Whether callbacks of a script do nothing, so that they need not be called.

use std::cell::Cell;

use crate::lua::{Stack, Type};
use crate::sys_call::SysCall;

/// Largest number of checks of the functions of a script: one that needs more has other things to do.
const MAX_CHECKS: u32 = 16;

/// What is known of the functions of the callbacks.
#[derive(Default)]
pub(super) struct IdleFunctions {
    /// Callbacks whose function had something to do, as bits.
    busy: Cell<u64>,
    checks: Cell<u32>,
}

impl IdleFunctions {
    /// Whether the function of a callback has nothing to do. What it pushes stays on the stack.
    pub(super) fn is_idle(&self, stack: Stack<'_>, call: SysCall) -> bool {
        if self.busy.get() & call.bit() != 0 {
            return false;
        }
        self.checks.set(self.checks.get() + 1);
        let is_idle = self.checks.get() <= MAX_CHECKS
            && stack.push_global(call.name()) == Type::Function
            && stack.does_nothing();
        if !is_idle {
            self.busy.set(self.busy.get() | call.bit());
        }
        is_idle
    }
}
