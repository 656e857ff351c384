//! Interfaces of scripts and their dialogs.

use std::sync::Arc;

use serde_json::Value;

/// What changed. Windows are in the order of their identifiers.
pub(crate) struct ObservedWindows {
    /// Identifiers and windows, both JSON.
    pub windows: Vec<(String, Arc<str>)>,
    pub removed: Vec<String>,
    /// There are no others.
    pub is_complete: bool,
    /// JSON: the last dialogs and their answers.
    pub dialogs: Arc<str>,
}

impl ObservedWindows {
    /// From `Simulator::ui_changes`.
    pub(crate) fn of(changes: &Value) -> Self {
        let list = |name: &str| changes[name].as_array().into_iter().flatten();
        let mut windows: Vec<(String, Arc<str>)> =
            list("windows").map(|window| (window["id"].to_string(), window.to_string().into())).collect();
        windows.sort();
        Self {
            windows,
            removed: list("removed").map(Value::to_string).collect(),
            is_complete: changes["complete"] == true,
            dialogs: changes["dialogs"].to_string().into(),
        }
    }
}
