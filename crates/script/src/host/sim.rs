//! One simulator: its options, and the parts it consists of.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr};
use std::num::NonZero;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::binding::registry::{Modules, Registry};
use super::binding::states::States;
use super::coverage::LineCounts;
use super::event_loop::SharedEventLoop;
use super::events::EventStream;
use super::lifecycle::instance::Script;
use super::lifecycle::random::Random;
use super::lifecycle::removal::Removals;
use super::lifecycle::script_set::ScriptSet;
use super::log::Log;
use super::log::console::{Console, LogLine};
use super::log::suggestion::nearest;
use super::log::verbosity;
use super::property::{AppData, SignalOwners};
use super::ros_options::RosOptions;
use super::runtime::Languages;
use super::step::clock::Clock;
use super::test_bench::TestBench;
use dynamics::Dynamics;
use perception::Perception;
use permissions::Permissions;
use scene::{Handle, Scene, SceneError};

/// The options of a simulator.
#[derive(Debug, Clone)]
pub struct Options {
    /// Seed of every script's random numbers.
    pub seed: u32,
    /// Log lines above this level are not shown.
    pub verbosity: i64,
    /// Named parameters scripts read.
    pub named_params: BTreeMap<String, String>,
    /// Folder of the data scripts keep beyond the life of the program; None: where the system keeps the user's.
    pub data_dir: Option<std::path::PathBuf>,
    /// Folder of an installation of CoppeliaSim, with its `models` and `lua`. Scripts read it where they may read the scene's folder.
    pub resources: Option<std::path::PathBuf>,
    /// Folders `require` looks into first.
    pub package_dirs: Vec<std::path::PathBuf>,
    /// Folders with native plugins, besides the scene's.
    pub plugin_dirs: Vec<std::path::PathBuf>,
    /// A file that names the function of a plugin that is running, for whoever looks at it after a crash.
    pub plugin_note: Option<std::path::PathBuf>,
    /// Lua instructions a thread may run per millisecond of its time slice.
    pub instructions_per_ms: u64,
    /// Permissions of scripts: files, programs, the network.
    pub permissions: Permissions,
    /// Set it to end calls that wait for the world outside: they raise an error.
    pub stop: Arc<AtomicBool>,
    /// Limits of resources that scripts may use; None: no limit.
    pub limits: Option<Limits>,
    /// Whether to count the lines of scripts that run. Scripts are slower meanwhile.
    pub count_lines: bool,
    /// Whether the error for a missing module has CoppeliaSim's text, with every place that was searched.
    pub original_errors: bool,
    /// Threads that draw pictures; None for as many as there are processor cores. Pictures do not depend on it.
    pub render_threads: Option<NonZero<usize>>,
    /// Threads that compute mechanisms that are apart, such as robots. Results do not depend on it.
    pub threads: NonZero<usize>,
    /// The address on which servers of scripts listen.
    pub listen_address: IpAddr,
    /// Origins of web pages that may use the remote API, besides those of this machine; `*` for all.
    pub web_origins: Vec<String>,
    /// How scripts take part in networks of ROS.
    pub ros: RosOptions,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: Random::DEFAULT_SEED,
            verbosity: verbosity::SCRIPT_INFOS,
            named_params: BTreeMap::new(),
            data_dir: None,
            resources: None,
            package_dirs: Vec::new(),
            plugin_dirs: Vec::new(),
            plugin_note: None,
            instructions_per_ms: 100_000,
            permissions: Permissions::all(),
            stop: Arc::default(),
            limits: None,
            count_lines: false,
            original_errors: false,
            render_threads: None,
            threads: NonZero::<usize>::MIN,
            listen_address: Ipv4Addr::LOCALHOST.into(),
            web_origins: Vec::new(),
            ros: RosOptions::default(),
        }
    }
}

/// Limits for scripts that may not end. Lua code runs slower under them, since it is checked every thousand instructions:
/// by then `Options::stop` ends it too, wherever it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes all scripts together may have.
    pub memory: usize,
}

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

impl Sim {
    /// A simulator with an empty scene and without main script and sandbox.
    pub fn new(
        options: Options,
        registry: Arc<Registry>,
        console: Box<dyn Console>,
        languages: Languages,
    ) -> Rc<Self> {
        let perception = RefCell::new(Perception::new(options.seed, options.render_threads));
        let dynamics = RefCell::new(Some(Dynamics::new(options.threads)));
        Rc::new(Self {
            perception,
            log: Log::new(console, options.verbosity),
            app: RefCell::new(AppData::new(&options)),
            scripts: ScriptSet::new(
                languages,
                options.limits.map_or(usize::MAX, |limits| limits.memory),
            ),
            options,
            modules: Modules {
                registry,
                states: States::default(),
            },
            scene: RefCell::new(Scene::new()),
            clock: Clock::new(),
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

    pub(crate) fn log_from(&self, script: &Script, level: i64, text: &str) {
        let origin = script.log_name(&self.scene.borrow());
        let line = LogLine {
            origin: &origin,
            level,
            text,
            located: None,
            time: self.clock.time(),
            status: false,
        };
        self.log_line(&line, Some(script.id));
    }

    /// Logs an error of a script, for people with its file and what else helps.
    pub(crate) fn log_error(&self, script: &Script, text: &str) {
        let origin = script.log_name(&self.scene.borrow());
        let is_library = |name: &str| self.modules.registry.files.contains_key(name);
        let located = self
            .log
            .files
            .borrow()
            .locate(text, &self.hint(text), is_library);
        let (level, time) = (verbosity::SCRIPT_ERRORS, self.clock.time());
        let line = LogLine {
            origin: &origin,
            level,
            text,
            located: Some(&located),
            time,
            status: false,
        };
        self.log_line(&line, Some(script.id));
    }

    /// Suggestion where an error is about an object that does not exist; else empty.
    fn hint(&self, error: &str) -> String {
        let Some(path) = self
            .log
            .take_missing_path()
            .filter(|_| error.contains(&SceneError::NoSuchPath.to_string()))
        else {
            return String::new();
        };
        let (scene, is_relative) = (self.scene.borrow(), !path.starts_with('/'));
        let paths = scene
            .objects()
            .filter_map(|object| scene.short_path(object.handle()).ok());
        // Relative paths have the name at their end in common with that of the object.
        let compared = |path: &str| match path.strip_prefix('/') {
            Some(rest) if !is_relative => rest.to_owned(),
            _ => path.rsplit('/').next().unwrap_or_default().to_owned(),
        };
        match nearest(
            &compared(&path),
            paths.map(|known| (compared(&known), known)),
        ) {
            Some(near) => format!("no object '{path}'; did you mean '{near}'?"),
            None => format!("no object '{path}'"),
        }
    }

    /// Logs in the name of the simulator itself: the one it has in the logs that existing tools read.
    pub(crate) fn log(&self, level: i64, text: &str) {
        let time = self.clock.time();
        self.log_line(
            &LogLine {
                origin: "CoppeliaSim",
                level,
                text,
                located: None,
                time,
                status: false,
            },
            None,
        );
    }

    /// Logs in the name of a plugin.
    pub(crate) fn log_as(&self, origin: &str, level: i64, text: &str) {
        let time = self.clock.time();
        self.log_line(
            &LogLine {
                origin,
                level,
                text,
                located: None,
                time,
                status: false,
            },
            None,
        );
    }

    /// Logs what the simulation does, in the sandbox's name as the original does.
    pub(crate) fn log_status(&self, text: &str) {
        let (level, time) = (verbosity::SCRIPT_INFOS, self.clock.time());
        self.log_line(
            &LogLine {
                origin: "sandboxScript",
                level,
                text,
                located: None,
                time,
                status: true,
            },
            None,
        );
    }

    fn log_line(&self, line: &LogLine<'_>, script: Option<i64>) {
        let LogLine {
            origin,
            level,
            text,
            ..
        } = *line;
        if level & verbosity::ONCE != 0 && !self.log.is_first(origin, level, text) {
            return;
        }
        // Listeners to events get the lines of scripts even where the console shows fewer.
        if verbosity::plain(level) <= self.log.verbosity().max(verbosity::SCRIPT_INFOS) {
            self.events.push_log_event(origin, level, text);
        }
        self.log.show(line, script);
    }
}
