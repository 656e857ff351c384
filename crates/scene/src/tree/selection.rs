//! Which objects are selected.

use std::collections::BTreeSet;

use crate::{Change, Handle, Scene};

/// Selected objects, the last selected one last.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Selection(Vec<Handle>);

impl Selection {
    /// Takes objects out; tells whether any was in it.
    pub(crate) fn forget(&mut self, removed: &BTreeSet<Handle>) -> bool {
        let before = self.0.len();
        self.0.retain(|handle| !removed.contains(handle));
        self.0.len() < before
    }
}

impl Scene {
    /// Selected objects, the last selected one last.
    pub fn selection(&self) -> &[Handle] {
        &self.selection.0
    }

    /// Selects exactly these objects; unknown ones and repetitions are left out.
    pub fn select(&mut self, handles: &[Handle]) {
        let mut seen = BTreeSet::new();
        let known = handles
            .iter()
            .copied()
            .filter(|&handle| self.exists(handle) && seen.insert(handle));
        let selection = Selection(known.collect());
        if self.selection != selection {
            self.selection = selection;
            self.note(Change::Selection);
        }
    }
}
