//! The embedding API: a simulator as a value.

mod builder;
mod c_host;
mod caller;
pub mod hash_file;
mod memory;
mod native_script;
mod picture;
mod playback;
mod prepared;
mod run;
mod scene;
mod servers;
#[cfg(test)]
mod tests;
mod ui;
mod viewing;

use std::cell::Ref;
use std::collections::BTreeSet;
use std::path::Path;
use std::rc::Rc;

use ::scene::object::script_object::{ScriptObject, ScriptType};
use ::scene::{Data, Handle, Kind, Scene};
pub use capture::Tape;
use format::scene_file::SceneFile;
use format::script_file;
use heap::Contained;
use permissions::Permissions;
use script::coverage::LineCounts;
use script::{ApiError, Detached, SceneSource, Script, SysCall, TestBench};

pub use builder::Builder;
use caller::Link;
pub use caller::{ApiFunction, Caller, ModuleMember, Progress};
use memory::Parts;
pub use memory::{SceneMut, Snapshot};
use native_script::{NativeLanguage, NativeScripts};
pub use native_script::{NativeScript, NativeScriptFactory};
pub use perception::vision::{Channels, Picture};
pub use playback::{Loop, Moment, Playback};
pub use prepared::PreparedCall;
pub use run::{Run, RunLimits, RunObserver, RunTotals};
pub use script::{
    CacheFolder, ChangedValue, Console, EmbeddedScript, Limits, LogLine, Options, PythonHost,
    RosOptions, ScriptCalls, Silent, SimulationState, VideoFailure, VideoOptions, VideoView,
};
pub use viewing::{Happenings, PropertyRow, property_getter, property_rows, property_setter};

/// Why a request to a [`Simulator`] failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A function for scripts refused the call.
    #[error(transparent)]
    Api(#[from] ApiError),
    /// A script's own error; it has been logged.
    #[error("{0}")]
    Script(String),
    /// A file cannot be read.
    #[error("{0}")]
    Unreadable(String),
    /// There is no snapshot, or it cannot be brought back.
    #[error("{0}")]
    NoSnapshot(String),
}

/// Type of script made from a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScriptKind {
    /// A script object that lives before, during and after a run.
    Customization,
    /// A script object that lives during a run.
    Simulation,
    /// Lives as long as the simulator.
    AddOn,
    /// Runs once as a chunk in the sandbox.
    Sandbox,
    /// Replaces the built-in main script.
    Main,
}

/// A script of a simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScriptRef(i64);

impl ScriptRef {
    /// The handle scripts know it by.
    pub fn handle(&self) -> i64 {
        self.0
    }
}

/// A simulator: one scene with its scripts and its physics. Belongs to the thread that made it; several may live in one process.
///
/// Deep recursion in scripts takes native stack: run a simulator on a thread with [`Simulator::STACK_SIZE`] bytes of it.
pub struct Simulator {
    /// Dropped before the memory that it leads to.
    link: Link,
    parts: Contained<Parts>,
    /// What the options of the parts share with the program is dropped outside of their memory.
    _options: Options,
}

impl Simulator {
    /// Recommended stack size of a thread that runs scripts, bytes.
    pub const STACK_SIZE: usize = 256 << 20;

    /// A simulator with an empty scene that says nothing.
    pub fn new(options: Options) -> Self {
        Self::builder().options(options).build()
    }

    /// A simulator with an empty scene whose prints and log lines go to `console`.
    pub fn with_console(options: Options, console: Box<dyn Console>) -> Self {
        Self::builder().options(options).console(console).build()
    }

    /// A simulator in the making: with options, a console, and Lua modules written in Rust.
    pub fn builder() -> Builder {
        Builder::default()
    }

    /// The simulator of these parts; main script and sandbox are added.
    fn with_main_and_sandbox(parts: Contained<Parts>, options: Options) -> Self {
        let link = Link::new(Rc::downgrade(&parts.sim));
        parts.native_scripts.link_to(&link);
        let simulator = Self {
            link,
            parts,
            _options: options,
        };
        let sim = simulator.inside();
        let main_text = sim.modules.registry.main_script();
        sim.scripts.add_detached(
            ScriptType::Main,
            Detached::of_text("mainScript", main_text.as_bytes()),
        );
        let sandbox = sim.scripts.add_detached(
            ScriptType::Sandbox,
            Detached::of_text("sandboxScript", b"sim = require 'sim'"),
        );
        sim.deliver(&sandbox, SysCall::Init, &[]);
        drop((sandbox, sim));
        simulator
    }

    /// A simulator with the default scene that runs tests: what they see of it and leave behind is on `bench`. They are chunks of the sandbox.
    pub fn for_test(options: Options, bench: &Rc<TestBench>) -> Self {
        let mut sim = Self::with_console(options, bench.console());
        // Nothing else can be on the bench of a simulator that was just made, and an empty scene has room.
        let _ = sim.parts.sim.test_bench.set(Rc::clone(bench));
        let _ = sim.scene_mut().add_default_objects();
        sim
    }

    /// Adds a script in Lua, or in Python if its first line is `#python`. Customization scripts, add-ons and the sandbox start at once; a simulation script starts with the simulation.
    ///
    /// `name` is shown for add-ons and for the sandbox chunk; script objects are called `Script`.
    ///
    /// # Errors
    /// When the scene is full, or the sandbox chunk fails.
    pub fn add_script(
        &mut self,
        kind: ScriptKind,
        name: &str,
        code: &[u8],
    ) -> Result<ScriptRef, Error> {
        self.add_script_of_file(kind, name, code, None)
    }

    /// The same for the text of a file: the log names it in errors. One whose name ends in `.py` is in Python.
    ///
    /// # Errors
    /// As `add_script`.
    pub fn add_script_of_file(
        &mut self,
        kind: ScriptKind,
        name: &str,
        code: &[u8],
        file: Option<&Path>,
    ) -> Result<ScriptRef, Error> {
        let language = script_file::language(file, code);
        let file = file.map(|file| file.display().to_string());
        match kind {
            ScriptKind::Customization => {
                self.add_object_script(ScriptType::Customization, language, code, file)
            }
            ScriptKind::Simulation => {
                self.add_object_script(ScriptType::Simulation, language, code, file)
            }
            ScriptKind::AddOn => {
                let sim = self.inside();
                let detached = Detached::of_text(&format!("{name}@addOnScript"), code);
                let detached = Detached {
                    language: language.into(),
                    ..detached
                };
                let script = sim.scripts.add_detached(ScriptType::AddOn, detached);
                script.file.replace(file.clone());
                sim.start_detached(&script);
                Ok(ScriptRef(script.id))
            }
            ScriptKind::Sandbox if language != "lua" => {
                let sim = self.inside();
                let sandbox = self.detached(ScriptType::Sandbox);
                sim.reset(&sandbox);
                sandbox.set_text(language, code, file.clone());
                sim.deliver(&sandbox, SysCall::Init, &[]);
                Ok(ScriptRef(sandbox.id))
            }
            ScriptKind::Sandbox => {
                let sandbox = self.detached(ScriptType::Sandbox);
                self.copied(|sim| sim.run_in(&sandbox, code, name, file.as_deref()))
                    .map_err(Error::Script)?;
                Ok(ScriptRef(sandbox.id))
            }
            ScriptKind::Main => {
                let _inside = self.inside();
                let main = self.detached(ScriptType::Main);
                main.set_text(language, code, file.clone());
                Ok(ScriptRef(main.id))
            }
        }
    }

    fn add_object_script(
        &mut self,
        script_type: ScriptType,
        language: &str,
        code: &[u8],
        file: Option<String>,
    ) -> Result<ScriptRef, Error> {
        let sim = self.inside();
        let object = ScriptObject::new(script_type, code.to_vec(), language, false);
        let object = Kind::Script(Box::new(object));
        let added = sim.scene.borrow_mut().add("Script", object);
        let handle = added.map_err(ApiError::from)?;
        let script = sim.script(handle.raw()).ok_or(ApiError::NoSuchScript)?;
        script.file.replace(file.clone());
        if script_type == ScriptType::Customization {
            sim.init_script(&script);
        }
        Ok(ScriptRef(script.id))
    }

    fn detached(&self, script_type: ScriptType) -> Rc<Script> {
        let script = self.parts.sim.scripts.detached(script_type);
        script.expect("main and sandbox are made with the simulator")
    }

    fn the(&self, script_type: ScriptType) -> ScriptRef {
        ScriptRef(self.detached(script_type).id)
    }

    /// The script object `handle`.
    ///
    /// # Errors
    /// When it is no script.
    pub fn script(&self, handle: Handle) -> Result<ScriptRef, Error> {
        Ok(ScriptRef(self.found(handle.raw())?.id))
    }

    fn found(&self, script: i64) -> Result<Rc<Script>, ApiError> {
        self.inside().script(script).ok_or(ApiError::NoSuchScript)
    }

    /// Path and text of the script whose errors read `[string "name"]:line:`.
    pub fn source_shown_as(&self, name: &str) -> Option<(String, Vec<u8>)> {
        self.copied(|sim| sim.code_shown_as(name))
    }

    /// Starts the simulation, or resumes a paused one. Its first step runs with the next [`iterate`](Self::iterate).
    pub fn start(&mut self) {
        self.inside().start();
    }

    /// Asks for a pause.
    pub fn pause(&mut self) {
        self.inside().pause();
    }

    /// Asks for the end of the run: as in CoppeliaSim, three more steps follow.
    pub fn request_stop(&mut self) {
        self.inside().stop();
    }

    /// One iteration of the loop: a simulation step when running, an idle iteration when stopped or paused.
    pub fn iterate(&mut self) {
        self.inside().loop_iteration();
    }

    /// Brings a scene of CoppeliaSim into the empty scene, or adds a model to the present one.
    ///
    /// # Errors
    /// When there is no room for all objects.
    pub fn load(&mut self, file: SceneFile) -> Result<(), Error> {
        self.copied(|sim| {
            // Copied into the memory of the simulator.
            let copied = file.copied();
            let file = copied.map_err(|error| ApiError::Other(error.to_string()))?;
            if file.is_model() {
                sim.load_model_file(file).map(drop)
            } else {
                sim.fill_scene(SceneSource::File(Box::new(file)))
            }
        })?;
        Ok(())
    }

    /// Removes every object.
    pub fn clear_scene(&mut self) {
        let all: Vec<Handle> = self
            .scene()
            .objects()
            .map(::scene::Object::handle)
            .collect();
        // The handles were just read, so none is unknown or given twice.
        let _ = self.inside().remove_objects(&all);
    }

    /// Starts if necessary and runs `count` simulation steps, fewer when a script ends the run.
    pub fn step(&mut self, count: u64) {
        if self.state() == SimulationState::Stopped {
            self.start();
        }
        for _ in 0..count {
            if !self.state().is_advancing() {
                return;
            }
            self.iterate();
        }
    }

    /// Ends the run, with all its clean-up, also one that is about to pause.
    pub fn stop(&mut self) {
        self.stop_in_place_of_pause();
        while self.state() != SimulationState::Stopped {
            self.iterate();
        }
    }

    /// Whether the simulation is stopped, runs or is paused.
    pub fn state(&self) -> SimulationState {
        self.parts.sim.clock.state()
    }

    /// What scripts may do.
    pub fn permissions(&self) -> &Permissions {
        &self.parts.sim.options.permissions
    }

    /// The tape on which everything comes from outside: off, unless the permissions of the options have another.
    pub fn tape(&self) -> &Tape {
        self.parts.sim.options.permissions.tape()
    }

    /// Simulated time, seconds.
    pub fn time(&self) -> f64 {
        self.parts.sim.clock.time()
    }

    /// Steps since the start.
    pub fn steps(&self) -> u64 {
        self.parts.sim.clock.steps()
    }

    /// Number of uncaught script errors.
    pub fn errors(&self) -> u64 {
        self.parts.sim.log.errors()
    }

    /// How often lines of scripts ran since the last time, where `Options::count_lines` asks for that.
    pub fn take_line_counts(&mut self) -> LineCounts {
        self.copied(|sim| sim.take_line_counts())
    }

    /// Whether a debugger goes to another moment, and what happens does not count.
    pub fn is_abandoned(&self) -> bool {
        self.parts.sim.is_abandoned()
    }

    /// Whether a script asked to end the program.
    pub fn quit_requested(&self) -> bool {
        self.parts.sim.clock.quit_is_requested()
    }

    /// A hash (xxh3, 64 bits) of what scripts can observe: poses, velocities, joints, readings, properties, custom data, signals, the
    /// tree, time and state of the simulation, random numbers. Simulators that are in the same state have the same hash, on every
    /// processor.
    ///
    /// The first call reads everything; from then on changes are followed, and a call costs as much as there are changes.
    pub fn state_hash(&self) -> u64 {
        self.inside().state_hash()
    }

    /// The same; `sink` gets each value that changed since the last call of this function, all of them at the first one.
    pub fn state_hash_with(&self, mut sink: impl FnMut(ChangedValue<'_>)) -> u64 {
        self.inside()
            .state_hash_with(|value| heap::outside(|| sink(value)))
    }

    /// The named parameters, as text.
    pub fn named_params(&self) -> Vec<(String, String)> {
        let app = self.parts.sim.app.borrow();
        let text = |value: &Vec<u8>| String::from_utf8_lossy(value).into_owned();
        app.named_params
            .iter()
            .map(|(name, value)| (name.clone(), text(value)))
            .collect()
    }

    /// Sets a named parameter, as `sim.setNamedStringParam` does.
    pub fn set_named_param(&mut self, name: &str, value: &str) {
        let sim = self.inside();
        let mut app = sim.app.borrow_mut();
        app.named_params.insert(name.into(), value.into());
    }

    /// The names of the parameters that scripts have read since the last time.
    pub fn take_params_read(&mut self) -> BTreeSet<String> {
        self.copied(|sim| sim.app.borrow().params_read.take())
    }

    /// The scene, to read. Do not hold it across other calls.
    pub fn scene(&self) -> Ref<'_, Scene> {
        self.parts.sim.scene.borrow()
    }

    /// Calls a global function of a script.
    ///
    /// # Errors
    /// When there is no such function or it fails.
    pub fn call(
        &mut self,
        script: &ScriptRef,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, Error> {
        let script = self.found(script.0)?;
        Ok(self.copied(|sim| sim.call_function(&script, function, args))?)
    }

    /// Calls a function that scripts have, such as `sim.getObjectPosition` or `simConvex.qhull`, as the sandbox would. Native functions are called
    /// without Lua. Those that deal with Lua's functions or coroutines are an error.
    ///
    /// # Errors
    /// The error of the function, with the text that scripts receive; or when there is no such function.
    pub fn call_api(&mut self, name: &str, args: &[Data]) -> Result<Vec<Data>, Error> {
        let sandbox = self.detached(ScriptType::Sandbox);
        Ok(self.copied(|sim| sim.call_api(&sandbox, name, args))?)
    }
}

impl Drop for Simulator {
    /// The end of the application: add-ons and the sandbox clean up.
    fn drop(&mut self) {
        self.parts.end();
        let sim = self.inside();
        sim.end_detached();
        sim.end_video_of_scripts();
        sim.unload_plugins();
        sim.scripts.close_all();
        sim.save_app_storage();
    }
}
