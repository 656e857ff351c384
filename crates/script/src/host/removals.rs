//! Objects and scripts that are to go later.

use std::cell::RefCell;
use std::collections::HashSet;
use std::rc::Rc;

use super::Script;
use scene::{Handle, Object, Scene, Uid};

/// Objects that are to go later.
#[derive(Default)]
pub struct Removals {
    /// At the end of the loop iteration.
    delayed: RefCell<Vec<Handle>>,
    /// Scripts that are no objects, at the end of the loop iteration.
    pub(crate) delayed_scripts: RefCell<Vec<Rc<Script>>>,
    /// The objects there were at the start of the simulation; the others may go at its end.
    at_start: RefCell<Option<HashSet<Uid>>>,
}

impl Removals {
    /// Marks objects to be removed at the end of the loop iteration.
    pub(crate) fn delay(&self, handles: &[Handle]) {
        self.delayed.borrow_mut().extend(handles);
    }

    /// Hands over the marked objects, each once.
    pub(crate) fn take_delayed(&self) -> Vec<Handle> {
        let mut handles = self.delayed.take();
        handles.sort_unstable();
        handles.dedup();
        handles
    }

    pub(crate) fn note_start(&self, scene: &Scene) {
        self.at_start
            .replace(Some(scene.objects().map(Object::uid).collect()));
    }

    /// The objects that came since the start of the simulation.
    pub(crate) fn take_new(&self, scene: &Scene) -> Vec<Handle> {
        let Some(known) = self.at_start.take() else {
            return Vec::new();
        };
        scene
            .objects()
            .filter(|object| !known.contains(&object.uid()))
            .map(Object::handle)
            .collect()
    }
}
