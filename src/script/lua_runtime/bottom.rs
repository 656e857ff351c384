//! Values that stay at the bottom of the stack of a state between calls, where a callback finds them at once: the message handler, the
//! globals, and the names of the callbacks called so far.

use std::cell::Cell;
use std::ffi::c_int;

use crate::script::calls::callback::SysCall;
use crate::script::lua::{Stack, Type};

/// Where the message handler is.
pub(super) const HANDLER: c_int = 1;
const GLOBALS: c_int = 2;

/// How far the bottom reaches.
#[derive(Default)]
pub(super) struct Bottom {
    count: Cell<c_int>,
    /// The callbacks whose names are there, as bits. The names are in the order of the bits.
    names: Cell<u64>,
}

impl Bottom {
    /// How many values stay.
    pub(super) fn count(&self) -> c_int {
        self.count.get()
    }

    /// Pushes the function of a callback, or what the script has in its place. None, and nothing pushed, while another call is in
    /// progress: its frame hides the bottom.
    pub(super) fn push_function(&self, stack: Stack<'_>, call: SysCall) -> Option<Type> {
        if stack.top() != self.count.get() || !stack.is_outermost() {
            return None;
        }
        if self.count.get() == 0 {
            stack.push_message_handler();
            stack.push_globals();
            self.count.set(GLOBALS);
        }
        let slot = self.slot_of_name(stack, call);
        stack.push_value(slot);
        Some(stack.raw_get(GLOBALS))
    }

    fn slot_of_name(&self, stack: Stack<'_>, call: SysCall) -> c_int {
        let names = self.names.get();
        let slot = GLOBALS + 1 + (names & (call.bit() - 1)).count_ones() as c_int;
        if names & call.bit() == 0 {
            stack.push_bytes(call.name().as_bytes());
            stack.insert(slot);
            self.names.set(names | call.bit());
            self.count.set(self.count.get() + 1);
        }
        slot
    }
}
