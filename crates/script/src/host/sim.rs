//! One simulator, and the parts it consists of.

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use super::{AppData, Languages, Removals, Script, ScriptSet, SignalOwners};
use crate::binding::registry::{Modules, Registry};
use crate::binding::states::States;
use crate::clock::Clock;
use crate::coverage::LineCounts;
use crate::event_loop::SharedEventLoop;
use crate::event_stream::EventStream;
use crate::log::Log;
use crate::log::console::Console;
use crate::options::Options;
use crate::test_bench::TestBench;
use dynamics::Dynamics;
use perception::Perception;
use scene::{Handle, Scene, Settings};

/// Everything a running simulator consists of. Borrows of the parts never outlive a statement that calls a script.
pub struct Sim {
    /// The options it was made with.
    pub options: Options,
    /// The modules scripts can use, with their state.
    pub modules: Modules,
    /// The scene: objects, meshes, settings.
    pub scene: RefCell<Scene>,
    /// State and time of the simulation.
    pub clock: Clock,
    /// The scripts and what is known about their states.
    pub scripts: ScriptSet,
    /// Taken out while it steps.
    pub dynamics: RefCell<Option<Dynamics>>,
    /// Proximity and vision sensors.
    pub perception: RefCell<Perception>,
    /// The log, and what the console shows of it.
    pub log: Log,
    pub(crate) removals: Removals,
    /// Data that scripts store in the application.
    pub app: RefCell<AppData>,
    pub(crate) signal_owners: RefCell<SignalOwners>,
    /// The event loop of sockets; made at the first use.
    pub event_loop: SharedEventLoop,
    pub(crate) events: EventStream,
    /// The connection to the test runner.
    pub test_bench: OnceCell<Rc<TestBench>>,
    /// Line counts of states that are closed.
    pub line_counts: RefCell<LineCounts>,
}

/// The log, with a hash of its lines where runs are compared.
fn log_of(console: Box<dyn Console>, options: &Options) -> Log {
    let log = Log::new(console, options.verbosity);
    if options.permissions.tape().is_on() {
        log.keep_hash();
    }
    log
}

impl Sim {
    /// A simulator with an empty scene and without main script and sandbox.
    pub fn new(
        options: Options,
        registry: Arc<Registry>,
        console: Box<dyn Console>,
        languages: Languages,
    ) -> Rc<Self> {
        let perception = RefCell::new(Perception::new(options.seed, options.render_threads));
        let clock = Clock::new(options.permissions.tape());
        let dynamics = Dynamics::new(options.threads, options.form_maker());
        let dynamics = RefCell::new(Some(dynamics));
        Rc::new(Self {
            perception,
            log: log_of(console, &options),
            app: RefCell::new(AppData::new(&options)),
            scripts: ScriptSet::new(
                languages,
                options.limits.map_or(usize::MAX, |limits| limits.memory),
                options.seed,
            ),
            options,
            modules: Modules {
                registry: Rc::new(registry),
                states: States::default(),
            },
            scene: RefCell::new(Scene::new()),
            clock,
            dynamics,
            removals: Removals::default(),
            signal_owners: RefCell::default(),
            event_loop: SharedEventLoop::default(),
            events: EventStream::new(),
            test_bench: OnceCell::new(),
            line_counts: RefCell::default(),
        })
    }

    /// The script with that handle.
    pub fn script(&self, id: i64) -> Option<Rc<Script>> {
        if let Some(script) = self.scripts.get(id) {
            return Some(script);
        }
        let handle = Handle::from_raw(id)?;
        let script_type = self
            .scene
            .borrow()
            .object(handle)
            .ok()?
            .script()
            .ok()?
            .script_type;
        let script = Rc::new(Script::of_object(handle, script_type));
        self.scripts.add(&script);
        Some(script)
    }

    /// Changes settings that are fixed as long as the simulation runs or is paused: without effect then, as in CoppeliaSim.
    pub(crate) fn change_while_stopped(&self, change: impl FnOnce(&mut Settings)) {
        if self.clock.is_stopped() {
            self.scene.borrow_mut().modify_settings(change);
        }
    }
}
