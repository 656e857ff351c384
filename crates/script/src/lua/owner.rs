//! Who a state belongs to, as far as this room has to know.

use std::any::TypeId;
use std::cell::Cell;
use std::rc::Rc;

use super::{Budget, Stack};
use capture::Tape;
use permissions::Permissions;

/// The owner of a state: what its code may do and use, what it has done, and the host's side of it, of which only the type is known.
pub(crate) struct Owner {
    /// The type of what is at `host`.
    host_type: TypeId,
    host: *const (),
    /// How often code of the state has called functions of the host.
    pub(crate) host_calls: Cell<u64>,
    /// The memory of the state.
    pub(crate) budget: Rc<Budget>,
    /// Whether code of the state may be ended from outside at any time.
    pub(crate) is_watched: bool,
    /// How often code of the state has looked into local variables of functions.
    pub(crate) looks_at_locals: Cell<u64>,
    /// What code of the state may do to the system.
    pub(crate) permissions: Permissions,
    /// Keeps what is at `host`.
    _host: Rc<dyn std::any::Any>,
}

impl Owner {
    /// The owner with that host's side.
    pub(crate) fn new<T: 'static>(
        host: Rc<T>,
        budget: Rc<Budget>,
        permissions: Permissions,
        is_watched: bool,
    ) -> Self {
        Self {
            host_type: TypeId::of::<T>(),
            host: Rc::as_ptr(&host).cast(),
            host_calls: Cell::new(0),
            budget,
            is_watched,
            looks_at_locals: Cell::new(0),
            permissions,
            _host: host,
        }
    }
}

impl<'a> Stack<'a> {
    /// The tape on which everything comes from outside.
    pub(crate) fn tape(self) -> &'a Tape {
        self.owner().permissions.tape()
    }

    /// The host's side of the state.
    ///
    /// # Panics
    /// When the state was made with another type.
    pub(crate) fn host<T: 'static>(self) -> &'a T {
        let owner = self.owner();
        assert!(
            owner.host_type == TypeId::of::<T>(),
            "the host's side is what the state was made with"
        );
        // SAFETY: `new` has both from a `T`, which the owner keeps; the owner lives as long as the state.
        unsafe { &*owner.host.cast::<T>() }
    }
}
