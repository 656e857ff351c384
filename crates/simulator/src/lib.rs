//! The embedding API: a simulator as a value.

mod builder;
mod caller;
pub mod hash_file;
#[cfg(test)]
mod journal_tests;
#[cfg(test)]
mod language_tests;
mod native_script;
#[cfg(test)]
mod native_tests;
mod picture;
mod run;
mod scene;
mod servers;
#[cfg(test)]
mod state_hash_tests;
mod ui;
mod viewing;

use std::cell::{Ref, RefMut};
use std::collections::BTreeSet;
use std::path::Path;
use std::rc::Rc;

use ::scene::object::script_object::{ScriptObject, ScriptType};
use ::scene::{Data, Handle, Kind, Scene};
pub use capture::Tape;
use format::scene_file::SceneFile;
use format::script_file;
use script::coverage::LineCounts;
use script::{ApiError, Detached, SceneSource, Script, Sim, SysCall, TestBench};

pub use builder::Builder;
pub use caller::{ApiFunction, Caller, ModuleMember, Progress};
use native_script::{NativeLanguage, NativeScripts};
pub use native_script::{NativeScript, NativeScriptFactory};
pub use perception::vision::{Channels, Picture};
pub use run::{RunLimits, RunObserver, RunTotals};
pub use script::{
    CacheFolder, ChangedValue, Console, EmbeddedScript, Limits, LogLine, Options, PythonHost,
    RosOptions, ScriptCalls, Silent, SimulationState, VideoFailure, VideoOptions, VideoView,
};
pub use viewing::{PropertyRow, property_rows, property_setter};

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
#[derive(Clone)]
pub struct ScriptRef(Rc<Script>);

impl ScriptRef {
    /// The handle scripts know it by.
    pub fn handle(&self) -> i64 {
        self.0.id
    }
}

/// A simulator: one scene with its scripts and its physics. Belongs to the thread that made it; several may live in one process.
///
/// Deep recursion in scripts takes native stack: run a simulator on a thread with [`Simulator::STACK_SIZE`] bytes of it.
pub struct Simulator {
    sim: Rc<Sim>,
    native_scripts: Rc<NativeScripts>,
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

    fn with_main_and_sandbox(sim: Rc<Sim>, native_scripts: Rc<NativeScripts>) -> Self {
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
        Self {
            sim,
            native_scripts,
        }
    }

    /// A simulator with the default scene that runs tests: what they see of it and leave behind is on `bench`. They are chunks of the sandbox.
    pub fn for_test(options: Options, bench: &Rc<TestBench>) -> Self {
        let mut sim = Self::with_console(options, bench.console());
        // Nothing else can be on the bench of a simulator that was just made, and an empty scene has room.
        let _ = sim.sim.test_bench.set(Rc::clone(bench));
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
                let detached = Detached::of_text(&format!("{name}@addOnScript"), code);
                let detached = Detached {
                    language: language.into(),
                    ..detached
                };
                let script = self.sim.scripts.add_detached(ScriptType::AddOn, detached);
                script.file.replace(file);
                self.sim.start_detached(&script);
                Ok(ScriptRef(script))
            }
            ScriptKind::Sandbox if language != "lua" => {
                let sandbox = self.the(ScriptType::Sandbox);
                self.sim.reset(&sandbox.0);
                sandbox.0.detached.borrow_mut().language = language.into();
                sandbox.0.detached.borrow_mut().code = code.to_vec();
                sandbox.0.file.replace(file);
                self.sim.deliver(&sandbox.0, SysCall::Init, &[]);
                Ok(sandbox)
            }
            ScriptKind::Sandbox => {
                let sandbox = self.the(ScriptType::Sandbox);
                self.sim
                    .run_in(&sandbox.0, code, name, file.as_deref())
                    .map_err(Error::Script)?;
                Ok(sandbox)
            }
            ScriptKind::Main => {
                let main = self.the(ScriptType::Main);
                main.0.detached.borrow_mut().language = language.into();
                main.0.detached.borrow_mut().code = code.to_vec();
                main.0.file.replace(file);
                Ok(main)
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
        let object = ScriptObject::new(script_type, code.to_vec(), language, false);
        let handle = self
            .sim
            .scene
            .borrow_mut()
            .add("Script", Kind::Script(Box::new(object)))
            .map_err(ApiError::from)?;
        let script = self
            .sim
            .script(handle.raw())
            .ok_or(ApiError::NoSuchScript)?;
        script.file.replace(file);
        if script_type == ScriptType::Customization {
            self.sim.init_script(&script);
        }
        Ok(ScriptRef(script))
    }

    fn the(&self, script_type: ScriptType) -> ScriptRef {
        ScriptRef(
            self.sim
                .scripts
                .detached(script_type)
                .expect("main and sandbox are made with the simulator"),
        )
    }

    /// The script object `handle`.
    ///
    /// # Errors
    /// When it is no script.
    pub fn script(&self, handle: Handle) -> Result<ScriptRef, Error> {
        Ok(ScriptRef(
            self.sim
                .script(handle.raw())
                .ok_or(ApiError::NoSuchScript)?,
        ))
    }

    /// Path and text of the script whose errors read `[string "name"]:line:`.
    pub fn source_shown_as(&self, name: &str) -> Option<(String, Vec<u8>)> {
        self.sim.code_shown_as(name)
    }

    /// Starts the simulation, or resumes a paused one. Its first step runs with the next [`iterate`](Self::iterate).
    pub fn start(&mut self) {
        self.sim.start();
    }

    /// Asks for a pause.
    pub fn pause(&mut self) {
        self.sim.pause();
    }

    /// Asks for the end of the run: as in CoppeliaSim, three more steps follow.
    pub fn request_stop(&mut self) {
        self.sim.stop();
    }

    /// One iteration of the loop: a simulation step when running, an idle iteration when stopped or paused.
    pub fn iterate(&mut self) {
        self.sim.loop_iteration();
    }

    /// Brings a scene of CoppeliaSim into the empty scene, or adds a model to the present one.
    ///
    /// # Errors
    /// When there is no room for all objects.
    pub fn load(&mut self, file: SceneFile) -> Result<(), Error> {
        if file.is_model() {
            self.sim.load_model_file(file)?;
        } else {
            self.sim.fill_scene(SceneSource::File(Box::new(file)))?;
        }
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
        let _ = self.sim.remove_objects(&all);
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
        self.sim.clock.state()
    }

    /// The tape on which everything comes from outside: off, unless the permissions of the options have another.
    pub fn tape(&self) -> &Tape {
        self.sim.options.permissions.tape()
    }

    /// Simulated time, seconds.
    pub fn time(&self) -> f64 {
        self.sim.clock.time()
    }

    /// Steps since the start.
    pub fn steps(&self) -> u64 {
        self.sim.clock.steps()
    }

    /// Number of uncaught script errors.
    pub fn errors(&self) -> u64 {
        self.sim.log.errors()
    }

    /// How often lines of scripts ran since the last time, where `Options::count_lines` asks for that.
    pub fn take_line_counts(&mut self) -> LineCounts {
        self.sim.take_line_counts()
    }

    /// Whether a script asked to end the program.
    pub fn quit_requested(&self) -> bool {
        self.sim.clock.quit_is_requested()
    }

    /// A hash (xxh3, 64 bits) of what scripts can observe: poses, velocities, joints, readings, properties, custom data, signals, the
    /// tree, time and state of the simulation, random numbers. Simulators that are in the same state have the same hash, on every
    /// processor.
    ///
    /// The first call looks at everything; from then on changes are followed, and a call costs as much as there are changes.
    pub fn state_hash(&self) -> u64 {
        self.sim.state_hash()
    }

    /// The same; `sink` gets each value that changed since the last call of this function, all of them at the first one.
    pub fn state_hash_with(&self, sink: impl FnMut(ChangedValue<'_>)) -> u64 {
        self.sim.state_hash_with(sink)
    }

    /// The named parameters, as text.
    pub fn named_params(&self) -> Vec<(String, String)> {
        let app = self.sim.app.borrow();
        let text = |value: &Vec<u8>| String::from_utf8_lossy(value).into_owned();
        app.named_params
            .iter()
            .map(|(name, value)| (name.clone(), text(value)))
            .collect()
    }

    /// The names of the parameters that scripts have read.
    pub fn params_read(&self) -> BTreeSet<String> {
        self.sim.app.borrow().params_read.borrow().clone()
    }

    /// The scene, to read. Do not hold it across other calls.
    pub fn scene(&self) -> Ref<'_, Scene> {
        self.sim.scene.borrow()
    }

    /// The scene, to write. Do not hold it across other calls.
    pub fn scene_mut(&mut self) -> RefMut<'_, Scene> {
        self.sim.scene.borrow_mut()
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
        Ok(self.sim.call_function(&script.0, function, args)?)
    }

    /// Calls a function that scripts have, such as `sim.getObjectPosition` or `simConvex.qhull`, as the sandbox would. Native functions are called
    /// without Lua. Those that deal with Lua's functions or coroutines are an error.
    ///
    /// # Errors
    /// The error of the function, with the text that scripts receive; or when there is no such function.
    pub fn call_api(&mut self, name: &str, args: &[Data]) -> Result<Vec<Data>, Error> {
        let sandbox = self.the(ScriptType::Sandbox);
        Ok(self.sim.call_api(&sandbox.0, name, args)?)
    }
}

impl Drop for Simulator {
    /// The end of the application: add-ons and the sandbox clean up.
    fn drop(&mut self) {
        self.sim.end_detached();
        self.sim.end_video_of_scripts();
        self.sim.unload_plugins();
        self.sim.scripts.close_all();
        self.sim.save_app_storage();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_is_about_to_pause_ends() {
        for steps in 0..6 {
            let mut sim = Simulator::new(Options::default());
            sim.step(2);
            sim.pause();
            (0..steps).for_each(|_| sim.iterate());
            sim.stop();
            assert_eq!(sim.state(), SimulationState::Stopped);
        }
    }

    #[test]
    fn a_simulator_goes_with_all_its_states() {
        let mut sim = Simulator::new(Options::default());
        let code = b"function sysCall_init() self = 1 end";
        let script = sim
            .add_script(ScriptKind::Customization, "script", code)
            .expect("the script loads");
        let gone = Rc::downgrade(&script.0);
        drop(script);
        drop(sim);
        assert!(gone.upgrade().is_none());
    }
}
