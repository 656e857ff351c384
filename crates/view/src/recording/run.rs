//! Records a simulator while it runs.

use serde_json::Value;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::Write;
use std::rc::Rc;

use super::{MarkKind, Recorded, Recorder};
use crate::observe::{RECORDING, Source};
use scene::{Handle, Scene};
use script::Present;
use simulator::Simulator;

/// Records every step of a simulator until it is finished.
pub struct RunRecorder<W: Write>(Rc<RefCell<State<W>>>);

struct State<W: Write> {
    /// None after a failure.
    recorder: Option<Recorder<W>>,
    failure: Option<std::io::Error>,
    signals: BTreeSet<String>,
    contacts: BTreeSet<[Handle; 2]>,
}

impl<W: Write + 'static> RunRecorder<W> {
    /// Begins with the present state.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn start(sim: &Simulator, file: W, recorded: Recorded) -> std::io::Result<Self> {
        let recorder = sim.with_present(|present| {
            Recorder::new(file, &source(present), &present.lines, recorded)
        })?;
        let (signals, contacts) = Default::default();
        let state = Rc::new(RefCell::new(State {
            recorder: Some(recorder),
            failure: None,
            signals,
            contacts,
        }));
        let watching = Rc::clone(&state);
        sim.watch(Some(Box::new(move |present| {
            watching.borrow_mut().add(present);
        })));
        Ok(Self(state))
    }

    /// Marks the present time as that of a failure.
    pub fn mark_failure(&self, text: &str) {
        self.0.borrow_mut().mark(MarkKind::Failure, text, None);
    }

    /// Completes the file.
    ///
    /// # Errors
    /// When it could not be written, at any time.
    pub fn finish(self, sim: &Simulator) -> std::io::Result<W> {
        sim.watch(None);
        let state = &mut *self.0.borrow_mut();
        if let Some(error) = state.failure.take() {
            return Err(error);
        }
        let recorder = state.recorder.take().expect("it goes with a failure only");
        // Where there are snapshots, the closure that holds this state stays.
        (state.signals, state.contacts) = Default::default();
        sim.with_present(|present| recorder.finish(present.now.scene, &present.lines))
    }
}

impl<W: Write> State<W> {
    fn add(&mut self, present: &Present<'_>) {
        let Some(recorder) = &mut self.recorder else {
            return;
        };
        if let Err(error) = recorder.record(&source(present), &present.lines) {
            (self.recorder, self.failure) = (None, Some(error));
        }
        self.mark_changes(present);
    }

    /// Marks signals that come and go, messages, and shapes that touch each other now.
    fn mark_changes(&mut self, present: &Present<'_>) {
        let signals = std::mem::replace(&mut self.signals, present.signals.clone());
        let (set, cleared) = (
            present.signals.difference(&signals),
            signals.difference(&present.signals),
        );
        set.for_each(|name| self.mark(MarkKind::Signal, name, None));
        cleared.for_each(|name| self.mark(MarkKind::Signal, &format!("{name} is cleared"), None));
        present
            .broadcasts
            .iter()
            .for_each(|name| self.mark(MarkKind::Broadcast, name, None));
        let contacts = std::mem::replace(&mut self.contacts, present.contacts.clone());
        for [first, second] in present.contacts.difference(&contacts) {
            let text = format!(
                "{} and {}",
                path(present.now.scene, *first),
                path(present.now.scene, *second)
            );
            self.mark(MarkKind::Contact, &text, Some(first.raw()));
        }
    }

    fn mark(&mut self, kind: MarkKind, text: &str, handle: Option<i64>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.mark(kind, text, handle);
        }
    }
}

fn source<'a>(present: &Present<'a>) -> Source<'a> {
    Source {
        now: present.now,
        is_read_only: true,
        mode: RECORDING,
        played: None,
        edits: Value::Null,
        has_debugger: false,
    }
}

/// The path of an object, or its handle.
pub(crate) fn path(scene: &Scene, handle: Handle) -> String {
    scene
        .short_path(handle)
        .unwrap_or_else(|_| handle.raw().to_string())
}
