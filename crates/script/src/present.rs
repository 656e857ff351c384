//! Observers outside of scripts, such as the viewer and the recorder: they are shown the state after each step.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::rc::Rc;

use heap::Outer;

use super::log::RecentLine;
use crate::clock::SimulationState;
use crate::host::Sim;
use dynamics::Dynamics;
use scene::{Handle, Scene};

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
    /// The hash of the state after a step, for watchers.
    pub state_hash: Option<u64>,
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
struct Watching {
    watcher: RefCell<Option<Outer<Watcher>>>,
    /// Lines of the log that were shown.
    lines: Cell<u64>,
}

impl Sim {
    /// Shows the state after each step from now on; None ends that.
    pub fn watch(&self, watcher: Option<Watcher>) {
        self.log.keep_recent();
        self.app.borrow().broadcasts.want(watcher.is_some());
        self.watching().watcher.replace(watcher.map(Outer::new));
    }

    /// Whether nobody but scripts looks at the scene from now on, so that what scripts cannot read need not be computed: particles that only pages and recordings show.
    pub fn set_unseen(&self, is_unseen: bool) {
        if let Some(dynamics) = self.dynamics.borrow_mut().as_mut() {
            dynamics.set_unseen(is_unseen);
        }
    }

    /// Keeps lines and messages from now on, for [`with_present`](Self::with_present).
    pub fn keep_happenings(&self) {
        self.log.keep_recent();
        self.app.borrow().broadcasts.want(true);
    }

    fn watching(&self) -> Rc<Watching> {
        self.modules.states.get()
    }

    /// Calls `observe` with the present state and what has happened since the last call.
    pub fn with_present<T>(&self, observe: impl FnOnce(&Present<'_>) -> T) -> T {
        self.with_present_of(None, observe)
    }

    fn with_present_of<T>(
        &self,
        state_hash: Option<u64>,
        observe: impl FnOnce(&Present<'_>) -> T,
    ) -> T {
        let watching = self.watching();
        let mut shown = watching.lines.get();
        let lines = self.log.recent_since(&mut shown);
        watching.lines.set(shown);
        let broadcasts = self.app.borrow().broadcasts.take();
        let contacts = self.dynamics.borrow().as_ref().map(Dynamics::touching);
        let contacts = contacts.unwrap_or_default();
        let scene = self.scene.borrow();
        observe(&Present {
            now: Situation {
                state_hash,
                ..self.situation(&scene)
            },
            lines,
            signals: scene
                .signals
                .names()
                .chain(self.app.borrow().signals.names())
                .map(str::to_owned)
                .collect(),
            broadcasts,
            contacts,
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
            state_hash: None,
        }
    }

    /// Shows the state after a step to the watcher.
    pub(crate) fn show_to_watcher(self: &Rc<Self>) {
        // The end of a simulation restores what was before it: observers are to see its last step.
        if self.clock.is_stopped() {
            return;
        }
        let Some(watching) = self.modules.states.existing::<Watching>() else {
            return;
        };
        let watcher = watching.watcher.take();
        if let Some(mut watcher) = watcher {
            let hash = self.state_hash();
            self.with_present_of(Some(hash), |present| {
                watcher.with_mut(|watcher| watcher(present));
            });
            watching.watcher.replace(Some(watcher));
        }
    }
}
