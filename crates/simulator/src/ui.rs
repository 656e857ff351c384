//! Windows of scripts, for pages that show them: what is in them, what has changed, and what persons do with them.

use serde_json::Value;

use super::Simulator;

impl Simulator {
    /// All windows of scripts with their widgets and values. The head of `crate::ui` (`crates/ui/src/lib.rs`) describes the JSON: `revision`, `windows`,
    /// `dialogs`, `banners`.
    pub fn ui_snapshot(&self) -> Value {
        self.copied(|sim| sim.app.borrow().ui.borrow().snapshot())
    }

    /// What has changed since a revision (of a snapshot or of earlier changes): the changed `windows`, each whole, and the ids of those that
    /// were `removed`. None when nothing has changed.
    pub fn ui_changes(&self, since: u64) -> Option<Value> {
        self.copied(|sim| sim.app.borrow().ui.borrow().changes_since(since))
    }

    /// What a person does: an object with `type`, `window`, `widget` and what belongs to the type. Handlers of scripts run at the end of the
    /// next iteration of the loop.
    ///
    /// # Errors
    /// What is wrong with the request, or why it is refused: a widget that is disabled, a window that is gone. Nothing has changed then.
    pub fn ui_input(&mut self, input: &Value) -> Result<(), String> {
        self.copied(|sim| {
            let ui = sim.app.borrow().ui.clone();
            ui.borrow_mut().input(input)
        })
    }
}
