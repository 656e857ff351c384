//! Values that stay at the bottom of the stack of a state between calls, where a callback finds them at once: the message handler, the
//! globals, the argument of frequent callbacks, and the names of the callbacks called so far.

use std::cell::Cell;
use std::ffi::c_int;

use super::reused::{self, ReusedArgument};
use crate::host::Integers;
use crate::lua::{Stack, Type};
use crate::sys_call::SysCall;

/// Where the message handler is.
pub(super) const HANDLER: c_int = 1;
const GLOBALS: c_int = 2;

/// How far the bottom reaches.
pub(super) struct Bottom {
    /// Without what the argument has.
    fixed: Cell<c_int>,
    /// The callbacks whose names are there, as bits. The names are in the order of the bits.
    names: Cell<u64>,
    argument: ReusedArgument,
}

impl Default for Bottom {
    fn default() -> Self {
        Self {
            fixed: Cell::new(0),
            names: Cell::new(0),
            argument: ReusedArgument::at(GLOBALS + 1),
        }
    }
}

impl Bottom {
    /// How many values stay.
    pub(super) fn count(&self) -> c_int {
        self.fixed.get() + self.argument.slots()
    }

    /// Pushes the function of a callback, or what the script has in its place. None, and nothing pushed, while another call is in
    /// progress: its frame hides the bottom.
    pub(super) fn push_function(&self, stack: Stack<'_>, call: SysCall) -> Option<Type> {
        if stack.top() != self.count() || !stack.is_outermost() {
            return None;
        }
        if self.fixed.get() == 0 {
            stack.push_message_handler();
            stack.push_globals();
            self.fixed.set(GLOBALS);
        }
        let name = self.slot_of_name(stack, call);
        Some(stack.push_entry(GLOBALS, name))
    }

    /// Pushes a table for the function that [`push_function`](Self::push_function) has pushed.
    pub(super) fn push_integers(&self, stack: Stack<'_>, table: Integers<'_>) {
        if !self.argument.push(stack, table) {
            reused::push_new(stack, table);
        }
    }

    fn slot_of_name(&self, stack: Stack<'_>, call: SysCall) -> c_int {
        let names = self.names.get();
        let slot = GLOBALS
            + self.argument.slots()
            + 1
            + (names & (call.bit() - 1)).count_ones().cast_signed();
        if names & call.bit() == 0 {
            stack.push_bytes(call.name().as_bytes());
            stack.insert(slot);
            self.names.set(names | call.bit());
            self.fixed.set(self.fixed.get() + 1);
        }
        slot
    }
}
