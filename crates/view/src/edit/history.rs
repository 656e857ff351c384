//! What can be undone and redone: the simulator as it was before and after each change.

use serde_json::{Value, json};

use simulator::{Simulator, Snapshot};

/// Steps that are kept.
const MAX_STEPS: usize = 200;
/// Bytes of the snapshots that are kept.
const MAX_BYTES: usize = 1 << 30;

/// A change, with the simulator on its other side.
struct Step {
    label: String,
    /// The page that has made it, if it has said who it is.
    author: Option<u64>,
    /// Of what is to be brought back: before the change for undo, after it for redo.
    snapshot: Snapshot,
}

#[derive(Default)]
pub(super) struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// Of the last change, which others may continue.
    gesture: Option<u64>,
    /// Why there are no snapshots, if there are none.
    refusal: Option<String>,
    /// How many changes there were since the scene was loaded or saved.
    changes: u64,
}

impl History {
    pub(super) fn undo_label(&self) -> Option<&str> {
        self.undo.last().map(|step| step.label.as_str())
    }

    pub(super) fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    pub(super) fn undo_author(&self) -> Option<u64> {
        self.undo.last()?.author
    }

    pub(super) fn redo_author(&self) -> Option<u64> {
        self.redo.last()?.author
    }

    pub(super) fn refusal(&self) -> Option<&str> {
        self.refusal.as_deref()
    }

    pub(super) fn changes(&self) -> u64 {
        self.changes
    }

    /// Whether a change of that gesture belongs to the last step.
    pub(super) fn continues(&self, gesture: Option<u64>) -> bool {
        gesture.is_some() && gesture == self.gesture && !self.undo.is_empty()
    }

    /// The simulator before a change; None where there are no snapshots, which is said to pages.
    pub(super) fn snapshot(&mut self, sim: &mut Simulator) -> Option<Snapshot> {
        match sim.snapshot() {
            Ok(snapshot) => {
                self.refusal = None;
                Some(snapshot)
            }
            Err(error) => {
                self.refusal = Some(error.to_string());
                None
            }
        }
    }

    /// A change was made; `before` is None where it continues the last one, or cannot be undone.
    pub(super) fn note(
        &mut self,
        before: Option<Snapshot>,
        label: &str,
        gesture: Option<u64>,
        author: Option<u64>,
    ) {
        self.changes += 1;
        self.redo.clear();
        self.gesture = gesture;
        let label = label.to_owned();
        match (before, self.refusal.is_some()) {
            (Some(snapshot), _) => self.undo.push(Step {
                label,
                author,
                snapshot,
            }),
            // What was before a change that has no snapshot cannot be reached any more.
            (None, true) => self.undo.clear(),
            (None, false) => {
                if let Some(last) = self.undo.last_mut() {
                    last.label = label;
                }
            }
        }
        self.drop_oldest();
    }

    fn drop_oldest(&mut self) {
        let mut bytes = 0;
        let mut kept = 0;
        for step in self.undo.iter().rev().take(MAX_STEPS) {
            bytes += step.snapshot.own_bytes();
            if bytes > MAX_BYTES && kept > 0 {
                break;
            }
            kept += 1;
        }
        self.undo.drain(..self.undo.len() - kept);
    }

    /// The scene was saved.
    pub(super) fn saved(&mut self) {
        self.changes = 0;
    }

    /// Takes back the last change, if there is no `only` page or that has made it; else the answer says that it is another page's.
    pub(super) fn undo(&mut self, sim: &mut Simulator, only: Option<u64>) -> Result<Value, String> {
        if let Some(refusal) = anothers(&self.undo, only) {
            return Ok(refusal);
        }
        let outcome = exchange(sim, &mut self.undo, &mut self.redo, "undo")?;
        self.changed();
        Ok(outcome)
    }

    pub(super) fn redo(&mut self, sim: &mut Simulator, only: Option<u64>) -> Result<Value, String> {
        if let Some(refusal) = anothers(&self.redo, only) {
            return Ok(refusal);
        }
        let outcome = exchange(sim, &mut self.redo, &mut self.undo, "redo")?;
        self.changed();
        Ok(outcome)
    }

    fn changed(&mut self) {
        self.changes += 1;
        self.gesture = None;
    }
}

/// The answer where the last step is not of the page that alone is meant.
fn anothers(steps: &[Step], only: Option<u64>) -> Option<Value> {
    let last = steps.last()?;
    let is_anothers = only.is_some() && last.author != only;
    is_anothers.then(|| json!({ "label": last.label, "isAnothers": true }))
}

/// Brings back the last step of `from`; what is now goes to `to`.
fn exchange(
    sim: &mut Simulator,
    from: &mut Vec<Step>,
    to: &mut Vec<Step>,
    what: &str,
) -> Result<Value, String> {
    let Some(step) = from.last() else {
        return Err(format!("there is nothing to {what}"));
    };
    let now = sim.snapshot().map_err(|error| error.to_string())?;
    bring_back(sim, &step.snapshot)?;
    let step = from.pop().ok_or("there was a step")?;
    let Step { label, author, .. } = step;
    let result = json!({ "label": label });
    to.push(Step {
        label,
        author,
        snapshot: now,
    });
    Ok(result)
}

pub(super) fn bring_back(sim: &mut Simulator, snapshot: &Snapshot) -> Result<(), String> {
    sim.restore(snapshot).map_err(|error| error.to_string())
}
