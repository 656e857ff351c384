//! Interfaces of scripts: windows, dialogs, banners.

use std::sync::Arc;

use serde_json::Value;

use super::button_interfaces::ButtonWindows;
use simulator::Simulator;

/// Lists that pages get whole whenever they change.
const LISTS: [&str; 3] = ["dialogs", "banners", "views"];

/// What changed. Windows are in the order of their identifiers.
#[derive(Default)]
pub(crate) struct ObservedWindows {
    /// Identifiers and windows, both JSON.
    pub windows: Vec<(String, Arc<str>)>,
    pub removed: Vec<String>,
    /// There are no others.
    pub is_complete: bool,
    /// Lists as JSON, by their names in messages.
    pub lists: Vec<(&'static str, Arc<str>)>,
}

/// Finds what changed since the last time.
#[derive(Default)]
pub(crate) struct WindowObserver {
    /// The state of the windows of scripts that was seen.
    seen: u64,
    buttons: ButtonWindows,
}

impl WindowObserver {
    /// All there are now.
    pub(crate) fn observe_all(&mut self, sim: &Simulator) -> Option<ObservedWindows> {
        // What is ahead gets everything.
        self.seen = u64::MAX;
        self.observe(sim)
    }

    /// None if nothing changed.
    pub(crate) fn observe(&mut self, sim: &Simulator) -> Option<ObservedWindows> {
        let changes = sim.ui_changes(self.seen);
        let mut seen = changes.as_ref().map(ObservedWindows::of);
        if let Some(changes) = &changes {
            self.seen = changes["revision"].as_u64().unwrap_or(0);
        }
        let all = seen.as_ref().is_some_and(|seen| seen.is_complete);
        if let Some(buttons) = self.buttons.changes(&sim.scene(), sim.scene_uid(), all) {
            let seen = seen.get_or_insert_default();
            seen.windows.extend(buttons.windows);
            seen.windows.sort();
            seen.removed.extend(buttons.removed);
        }
        seen
    }
}

impl ObservedWindows {
    /// From `Simulator::ui_changes`.
    pub(crate) fn of(changes: &Value) -> Self {
        let list = |name: &str| changes[name].as_array().into_iter().flatten();
        let mut windows: Vec<(String, Arc<str>)> = list("windows")
            .map(|window| (window["id"].to_string(), window.to_string().into()))
            .collect();
        windows.sort();
        let known = LISTS.into_iter().filter(|name| changes[*name].is_array());
        Self {
            windows,
            removed: list("removed").map(Value::to_string).collect(),
            is_complete: changes["complete"] == true,
            lists: known
                .map(|name| (name, changes[name].to_string().into()))
                .collect(),
        }
    }
}
