//! The table that a callback gets again and again. The dynamics ask about hundreds of contacts in a sub-step; making a table for each, and
//! collecting it, would take longer than the calls.
//!
//! A table is used again only for a function that cannot have kept it, nor changed it: its code says so. A script cannot tell the
//! difference then, unless functions that it calls look into its variables (`debug.getlocal`): it gets a new table after that.

use std::cell::{Cell, RefCell};
use std::ffi::{c_int, c_void};

use crate::host::Integers;
use crate::lua::Stack;

/// The argument that was used last. What it needs lies on the stack: the function, the table, and the names of its fields.
pub(super) struct ReusedArgument {
    /// The first of its slots.
    first: c_int,
    slots: Cell<c_int>,
    used: RefCell<Option<Reused>>,
}

struct Reused {
    /// The function it is for, which is in the first slot once it was called twice.
    function: *const c_void,
    names: &'static [&'static str],
    state: Use,
    /// The table's, if it is used again.
    values: Vec<i64>,
    /// How often code had looked into variables when the table was made.
    looks: u64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    /// The function was called once.
    New,
    MayKeep,
    Forgets,
}

impl ReusedArgument {
    /// With its slots from `first` on.
    pub(super) fn at(first: c_int) -> Self {
        Self {
            first,
            slots: Cell::new(0),
            used: RefCell::default(),
        }
    }

    /// How many slots it has.
    pub(super) fn slots(&self) -> c_int {
        self.slots.get()
    }

    /// Pushes the argument for the function on top; false, and nothing pushed, when it has to be made.
    pub(super) fn push(&self, stack: Stack<'_>, table: Integers<'_>) -> bool {
        let mut slot = self.used.borrow_mut();
        let function = stack.pointer(-1);
        let is_same =
            |used: &&mut Reused| used.function == function && std::ptr::eq(used.names, table.names);
        let Some(used) = slot.as_mut().filter(is_same) else {
            *slot = Some(Reused {
                function,
                names: table.names,
                state: Use::New,
                values: Vec::new(),
                looks: 0,
            });
            return false;
        };
        if used.state == Use::New || used.looks != stack.owner().looks_at_locals.get() {
            self.prepare(used, stack, table);
        }
        if used.state != Use::Forgets {
            return false;
        }
        let changed = (self.first + 2..)
            .zip(used.values.iter_mut().zip(table.values))
            .filter_map(|(name, (old, new))| {
                let is_changed = std::mem::replace(old, *new) != *new;
                is_changed.then_some((name, *new))
            });
        stack.push_with_fields(self.first + 1, changed);
        true
    }

    /// Finds out whether the function on top may get the same table again, and makes it.
    fn prepare(&self, used: &mut Reused, stack: Stack<'_>, table: Integers<'_>) {
        used.looks = stack.owner().looks_at_locals.get();
        if used.state == Use::New {
            used.state = if stack.forgets_its_argument() {
                Use::Forgets
            } else {
                Use::MayKeep
            };
        }
        if used.state == Use::MayKeep {
            return;
        }
        used.values = table.values.to_vec();
        stack.push_value(-1);
        self.keep(stack, 0);
        push_new(stack, table);
        self.keep(stack, 1);
        for (slot, name) in (2..).zip(table.names) {
            stack.push_bytes(name.as_bytes());
            self.keep(stack, slot);
        }
    }

    /// Moves what is on top into a slot, or makes the slot of it.
    fn keep(&self, stack: Stack<'_>, slot: c_int) {
        stack.insert(self.first + slot);
        if slot < self.slots.get() {
            stack.remove(self.first + slot + 1);
        } else {
            self.slots.set(slot + 1);
        }
    }
}

/// Pushes a new table.
pub(super) fn push_new(stack: Stack<'_>, table: Integers<'_>) {
    stack.new_table(0, table.names.len());
    for (name, &value) in table.names.iter().zip(table.values) {
        stack.push_int(value);
        stack.raw_set_field(-2, name);
    }
}
