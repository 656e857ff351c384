//! Auxiliary consoles of scripts (`sim.auxiliaryConsoleOpen`).

use std::collections::BTreeMap;

/// An open console.
#[derive(Debug, Clone, PartialEq)]
pub struct AuxiliaryConsole {
    /// The title of the window.
    pub title: String,
    /// It is open until the end of the simulation only.
    pub closes_at_end: bool,
    /// The lines it keeps.
    pub lines: usize,
    /// The handle of its window.
    pub window: String,
}

/// The open ones, by handle.
#[derive(Default)]
pub struct AuxiliaryConsoles {
    open: BTreeMap<i64, AuxiliaryConsole>,
    opened: i64,
}

impl AuxiliaryConsoles {
    /// Adds a console and returns its handle.
    pub fn open(&mut self, console: AuxiliaryConsole) -> i64 {
        self.opened += 1;
        let handle = self.opened;
        self.open.insert(handle, console);
        handle
    }

    /// An open console.
    pub fn get(&self, handle: i64) -> Option<&AuxiliaryConsole> {
        self.open.get(&handle)
    }

    /// The console that was open until now.
    pub fn close(&mut self, handle: i64) -> Option<AuxiliaryConsole> {
        self.open.remove(&handle)
    }

    /// Closes those that last as long as the simulation; the handles of their windows.
    pub(crate) fn end_simulation(&mut self) -> Vec<String> {
        let windows = self
            .open
            .values()
            .filter(|console| console.closes_at_end)
            .map(|console| console.window.clone());
        let windows = windows.collect();
        self.open.retain(|_, console| !console.closes_at_end);
        windows
    }
}
