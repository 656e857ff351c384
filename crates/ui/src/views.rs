//! Views of the scene above the main one (`sim.floatingViewAdd`): what they show and where. Pages draw them.

use std::collections::BTreeMap;

use serde_json::{Value, json};

/// A view.
#[derive(Debug, Clone, PartialEq)]
pub struct FloatingView {
    /// Its centre as part of the main view, 0 to 1, from the left lower corner.
    pub position: [f64; 2],
    /// Width and height as part of the main view.
    pub size: [f64; 2],
    /// The handle of a camera, vision sensor or graph; -1: nothing yet.
    pub object: i64,
    /// Its title; that of the object if it is empty.
    pub label: String,
}

/// All views by their handles, which count from 1.
#[derive(Debug, Default)]
pub struct FloatingViews {
    last: i64,
    by_handle: BTreeMap<i64, FloatingView>,
}

impl FloatingViews {
    /// Adds one; its handle. Numbers that are none, or beyond the main view, become the nearest place in it.
    pub fn add(&mut self, position: [f64; 2], size: [f64; 2]) -> i64 {
        let part = |number: f64| {
            if number.is_finite() {
                number.clamp(0.0, 1.0)
            } else {
                0.5
            }
        };
        let view = FloatingView {
            position: position.map(part),
            size: size.map(part),
            object: -1,
            label: String::new(),
        };
        self.last += 1;
        self.by_handle.insert(self.last, view);
        self.last
    }

    /// The view with that handle.
    pub fn get_mut(&mut self, handle: i64) -> Option<&mut FloatingView> {
        self.by_handle.get_mut(&handle)
    }

    /// Whether there is a view with that handle.
    pub fn contains(&self, handle: i64) -> bool {
        self.by_handle.contains_key(&handle)
    }

    /// Removes a view; whether there was one with that handle.
    pub fn remove(&mut self, handle: i64) -> bool {
        self.by_handle.remove(&handle).is_some()
    }

    pub(super) fn json(&self) -> Value {
        let shown = |(handle, view): (&i64, &FloatingView)| json!({"id": handle, "position": view.position, "size": view.size, "object": view.object, "label": view.label});
        self.by_handle.iter().map(shown).collect()
    }
}
