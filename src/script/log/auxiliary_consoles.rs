//! Auxiliary consoles of scripts (`sim.auxiliaryConsoleOpen`), without windows.

use std::collections::BTreeMap;

/// The parts of a console that matter without a window.
pub(crate) struct AuxiliaryConsole {
    pub title: String,
    /// It is open until the end of the simulation only.
    pub closes_at_end: bool,
}

/// The open ones, by handle.
#[derive(Default)]
pub(crate) struct AuxiliaryConsoles {
    open: BTreeMap<i64, AuxiliaryConsole>,
    opened: i64,
}

impl AuxiliaryConsoles {
    pub(crate) fn open(&mut self, console: AuxiliaryConsole) -> i64 {
        let handle = self.opened;
        self.opened += 1;
        self.open.insert(handle, console);
        handle
    }

    /// Title of an open console.
    pub(crate) fn title(&self, handle: i64) -> Option<String> {
        self.open.get(&handle).map(|console| console.title.clone())
    }

    /// Returns whether it was open.
    pub(crate) fn close(&mut self, handle: i64) -> bool {
        self.open.remove(&handle).is_some()
    }

    pub(crate) fn end_simulation(&mut self) {
        self.open.retain(|_, console| !console.closes_at_end);
    }
}
