//! The names of the messages that scripts send to all others, while somebody wants to know them.

use std::cell::{Cell, RefCell};

use scene::Data;

/// What was sent since it was last taken.
#[derive(Default)]
pub(crate) struct Broadcasts {
    are_wanted: Cell<bool>,
    names: RefCell<Vec<String>>,
}

impl Broadcasts {
    /// Whether messages are noted from now on.
    pub(crate) fn want(&self, on: bool) {
        self.are_wanted.set(on);
    }

    /// A script sends a message to all others, by convention with an `id`.
    pub(crate) fn note(&self, id: Option<&Data>) {
        if self.are_wanted.get() {
            let name = match id {
                Some(Data::Text(name)) => String::from_utf8_lossy(name).into_owned(),
                _ => "message".to_owned(),
            };
            self.names.borrow_mut().push(name);
        }
    }

    /// Hands over the names.
    pub(crate) fn take(&self) -> Vec<String> {
        self.names.take()
    }
}
