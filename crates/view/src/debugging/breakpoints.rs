//! Breakpoints of pages: what they want, and where the debugger has put them.

use serde_json::{Value, json};

use super::Debugging;
use crate::request::Breakpoint;
use ::debugger::Incoming;

/// A breakpoint.
pub(super) struct Placed {
    wanted: Breakpoint,
    /// Its number for the debugger.
    id: Option<u64>,
    /// The line with code that it stops at; None as long as the text is not loaded.
    at: Option<u64>,
}

impl Placed {
    fn new(wanted: Breakpoint, answer: &Value) -> Self {
        let mut placed = Self {
            wanted,
            id: answer["id"].as_u64(),
            at: None,
        };
        placed.put(answer);
        placed
    }

    fn put(&mut self, answer: &Value) {
        let is_verified = answer["verified"] == true;
        self.at = answer["line"].as_u64().filter(|_| is_verified);
    }

    fn to_json(&self) -> Value {
        let Breakpoint { line, condition } = &self.wanted;
        json!({ "line": line, "condition": condition, "at": self.at })
    }
}

impl Debugging {
    /// The debugger has taken over the breakpoints of a script.
    pub(super) fn note_set(&self, script: i64, wanted: &[Breakpoint], body: &Value) {
        let answers = body["breakpoints"].as_array();
        let answers = answers.map_or(&[][..], Vec::as_slice);
        let placed: Vec<Placed> = wanted
            .iter()
            .zip(answers)
            .map(|(wanted, answer)| Placed::new(wanted.clone(), answer))
            .collect();
        let mut state = self.state.borrow_mut();
        if placed.is_empty() {
            state.breakpoints.remove(&script);
        } else {
            state.breakpoints.insert(script, placed);
        }
        drop(state);
        self.show_breakpoints();
    }

    /// One of them is at another place, since its text was loaded.
    pub(super) fn note_placed(&self, answer: &Value) {
        let id = answer["id"].as_u64();
        let mut state = self.state.borrow_mut();
        let mut all = state.breakpoints.values_mut().flatten();
        if let Some(found) = all.find(|placed| placed.id == id) {
            found.put(answer);
            drop(state);
            self.show_breakpoints();
        }
    }

    pub(super) fn show_breakpoints(&self) {
        let state = self.state.borrow();
        let scripts = state.breakpoints.iter().map(|(handle, all)| {
            let lines: Vec<Value> = all.iter().map(Placed::to_json).collect();
            json!({ "handle": handle, "lines": lines })
        });
        let list = scripts.collect::<Value>().to_string();
        self.shared.mirror().show_list("breakpoints", &list);
        self.shared.wake();
    }

    /// The memory of scripts is what it was before: the debugger has to look at it again.
    pub(crate) fn set_again(&self) {
        let state = self.state.borrow();
        let wanted: Vec<(i64, Vec<Breakpoint>)> = state
            .breakpoints
            .iter()
            .map(|(script, all)| (*script, all.iter().map(|one| one.wanted.clone()).collect()))
            .collect();
        drop(state);
        for (script, wanted) in wanted {
            let request = self.set(script, wanted, None);
            self.state.borrow_mut().next.push_back(request);
        }
    }

    /// Another scene has other scripts.
    pub(crate) fn forget(&self) {
        let mut state = self.state.borrow_mut();
        if state.breakpoints.is_empty() {
            return;
        }
        state.breakpoints.clear();
        let anew = [Incoming::Gone(None), Incoming::Connected];
        state.next.extend(anew);
        drop(state);
        self.show_breakpoints();
    }
}
