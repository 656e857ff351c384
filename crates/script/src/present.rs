//! Observers outside of scripts, such as the viewer and the recorder: they are shown the state after each step.

use std::collections::BTreeSet;

use super::log::RecentLine;
use super::sim::Sim;
use super::step::clock::SimulationState;
use scene::{Data, Handle, Scene};

/// The state of a simulator at one moment.
#[derive(Clone, Copy)]
pub struct Situation<'a> {
    /// The scene, with the poses of the moment.
    pub scene: &'a Scene,
    /// Identifies the scene: it changes when another scene is loaded.
    pub scene_uid: i64,
    /// Whether the simulation runs.
    pub state: SimulationState,
    /// Simulated time, seconds.
    pub time: f64,
    /// Simulation steps since the start of the run.
    pub steps: u64,
    /// Uncaught errors of scripts.
    pub errors: u64,
}

/// What happened up to the end of a step.
pub struct Present<'a> {
    /// State and scene after the step.
    pub now: Situation<'a>,
    /// Lines of the log since the last time.
    pub lines: Vec<RecentLine>,
    /// The names of all signals.
    pub signals: BTreeSet<String>,
    /// Names of the messages that scripts sent to all others since the last time.
    pub broadcasts: Vec<String>,
    /// Shapes that touched each other in the last sub-step of the physics, the smaller handle first.
    pub contacts: BTreeSet<[Handle; 2]>,
}

/// Called after each step.
pub type Watcher = Box<dyn FnMut(&Present<'_>)>;

/// The watcher of a simulator.
#[derive(Default)]
pub struct Watching {
    watcher: Option<Watcher>,
    /// Lines of the log that were shown.
    lines: u64,
    broadcasts: Vec<String>,
}

impl Sim {
    /// Shows the state after each step from now on; None ends that.
    pub fn watch(&self, watcher: Option<Watcher>) {
        self.log.keep_recent();
        self.app.borrow_mut().watching.watcher = watcher;
    }

    /// Calls `observe` with the present state and what has happened since the last call.
    pub fn with_present<T>(&self, observe: impl FnOnce(&Present<'_>) -> T) -> T {
        let (lines, broadcasts) = {
            let watching = &mut self.app.borrow_mut().watching;
            (
                self.log.recent_since(&mut watching.lines),
                std::mem::take(&mut watching.broadcasts),
            )
        };
        let scene = self.scene.borrow();
        observe(&Present {
            now: self.situation(&scene),
            lines,
            signals: scene
                .signals
                .names()
                .chain(self.app.borrow().signals.names())
                .map(str::to_owned)
                .collect(),
            broadcasts,
            contacts: self.touching(),
        })
    }

    /// The simulator with its scene as it is now.
    pub fn situation<'a>(&self, scene: &'a Scene) -> Situation<'a> {
        Situation {
            scene,
            scene_uid: self.scene_uid(),
            state: self.clock.state(),
            time: self.clock.time(),
            steps: self.clock.steps(),
            errors: self.log.errors(),
        }
    }

    fn touching(&self) -> BTreeSet<[Handle; 2]> {
        let dynamics = self.dynamics.borrow();
        let contacts: Vec<_> = dynamics
            .iter()
            .flat_map(|dynamics| dynamics.contacts())
            .collect();
        let last = contacts.last().map(|contact| contact.sub_step);
        let of_last = contacts
            .iter()
            .filter(|contact| Some(contact.sub_step) == last);
        of_last
            .map(|contact| contact.shapes)
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect()
    }

    /// Shows the state after a step to the watcher.
    pub(super) fn show_to_watcher(&self) {
        // The end of a simulation restores what was before it: observers are to see its last step.
        if self.clock.is_stopped() {
            return;
        }
        let watcher = self.app.borrow_mut().watching.watcher.take();
        if let Some(mut watcher) = watcher {
            self.with_present(|present| watcher(present));
            self.app.borrow_mut().watching.watcher = Some(watcher);
        }
    }

    /// A script sends a message to all others, by convention with an `id`.
    pub(super) fn note_broadcast(&self, id: Option<&Data>) {
        let watching = &mut self.app.borrow_mut().watching;
        if watching.watcher.is_some() {
            let name = match id {
                Some(Data::Text(name)) => String::from_utf8_lossy(name).into_owned(),
                _ => "message".to_owned(),
            };
            watching.broadcasts.push(name);
        }
    }
}
