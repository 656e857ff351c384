//! The plugins of a simulator: loaded, called, sent messages, unloaded.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::{Mutex, PoisonError};

use heap::resource::Resource;
use scene::{Data, numbers};

use super::current::{Frame, Shared, within};
use super::ffi::{Callback, Caller, Library, Message};
use super::{Host, own_library};

/// A plugin of a simulator, or the program that has loaded the simulator as a library.
pub struct Plugin {
    /// The name under which scripts have its functions.
    pub name: String,
    /// None of a program.
    library: Option<Library>,
    version: Cell<i32>,
    pub(super) functions: RefCell<Vec<Registered>>,
    pub(super) variables: RefCell<Vec<(String, Variable)>>,
    pub(super) infos: RefCell<BTreeMap<i64, Data>>,
    /// Calls in progress.
    calls: Cell<usize>,
    _claim: Option<Claim>,
    _resource: Resource,
}

/// A function for scripts.
#[derive(Clone)]
pub(super) struct Registered {
    pub name: String,
    pub callback: Callback,
}

/// A value for scripts.
#[derive(Debug, Clone, PartialEq)]
pub enum Variable {
    /// In Lua.
    Expression(String),
    /// By its value.
    Value(Data),
}

/// The plugins of one simulator.
#[derive(Default)]
pub struct Plugins {
    shared: Rc<Shared>,
    loaded: RefCell<Vec<Rc<Plugin>>>,
    /// The program that has loaded the simulator, once it has functions for scripts.
    program: RefCell<Option<Rc<Plugin>>>,
    note: Note,
}

/// A file with the plugin and the function that is running, for whoever looks at it after a crash.
#[derive(Default)]
struct Note {
    file: RefCell<Option<PathBuf>>,
    running: RefCell<Vec<String>>,
}

impl Note {
    fn begin(&self, plugin: &str, function: &str) {
        if self.file.borrow().is_some() {
            self.running
                .borrow_mut()
                .push(format!("{plugin}\n{function}"));
            self.write();
        }
    }

    fn end(&self) {
        if self.running.borrow_mut().pop().is_some() {
            self.write();
        }
    }

    fn write(&self) {
        if let Some(file) = &*self.file.borrow() {
            // If writing fails, a report of a crash lacks the names of plugin and function.
            let _ = std::fs::write(
                file,
                self.running.borrow().last().map_or("", String::as_str),
            );
        }
    }
}

/// Moments of which plugins are told. The numbers are those of the interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moment {
    /// A scene was saved.
    SceneSaved = 260,
    /// A model was saved.
    ModelSaved = 261,
    /// A pass of the main loop, also while nothing is simulated.
    Pass = 269,
    /// A simulation is about to start.
    SimulationAboutToStart = 285,
    /// A simulation has ended, and the scene is as it was before.
    SimulationEnded = 286,
    /// A scene was loaded.
    SceneLoaded = 294,
    /// A model was loaded.
    ModelLoaded = 295,
    /// A simulation is about to end.
    SimulationAboutToEnd = 334,
    /// The Lua state of a script is about to be closed.
    ScriptStateAboutToBeDestroyed = 338,
    /// The main script initialises a simulation.
    SimulationInit = 340,
    /// The actuation phase of a step.
    SimulationActuation = 341,
    /// The sensing phase of a step.
    SimulationSensing = 342,
    /// The main script cleans up after a simulation.
    SimulationCleanup = 343,
}

/// What the log calls a program.
const PROGRAM: &str = "library";

impl Plugin {
    fn new(name: &str, library: Option<Library>, claim: Option<Claim>, resource: Resource) -> Self {
        Self {
            name: name.to_owned(),
            library,
            version: Cell::new(0),
            functions: RefCell::default(),
            variables: RefCell::default(),
            infos: RefCell::default(),
            calls: Cell::new(0),
            _claim: claim,
            _resource: resource,
        }
    }

    /// A function for scripts, in place of one with that name. Whether it is new.
    pub(super) fn register(&self, name: String, callback: Callback) -> bool {
        let mut functions = self.functions.borrow_mut();
        let known = functions.iter().position(|function| function.name == name);
        match known {
            Some(place) => functions[place].callback = callback,
            None => functions.push(Registered { name, callback }),
        }
        known.is_none()
    }

    /// What its `simInit` has returned.
    pub fn version(&self) -> i32 {
        self.version.get()
    }

    /// Names of its functions, in the order of their registration.
    pub fn functions(&self) -> Vec<String> {
        self.functions
            .borrow()
            .iter()
            .map(|function| function.name.clone())
            .collect()
    }

    /// Names and values of its variables.
    pub fn variables(&self) -> Vec<(String, Variable)> {
        self.variables.borrow().clone()
    }

    /// Whether code of it is running.
    pub fn is_running(&self) -> bool {
        self.calls.get() > 0
    }
}

impl Plugins {
    /// The plugin with that name, if it is loaded.
    pub fn get(&self, name: &str) -> Option<Rc<Plugin>> {
        self.loaded
            .borrow()
            .iter()
            .find(|plugin| plugin.name == name)
            .cloned()
    }

    /// All of them, in the order in which they were loaded.
    pub fn all(&self) -> Vec<Rc<Plugin>> {
        self.loaded.borrow().clone()
    }

    /// The program that has loaded the simulator, if it has functions for scripts.
    pub fn program(&self) -> Option<Rc<Plugin>> {
        self.program.borrow().clone()
    }

    /// A function of that program for scripts. Whether it is new.
    pub fn register_of_program(&self, name: String, callback: Callback) -> bool {
        let mut program = self.program.borrow_mut();
        let program = program.get_or_insert_with(|| {
            let resource = Resource::new(|| "the functions of the program".to_owned());
            Rc::new(Plugin::new(PROGRAM, None, None, resource))
        });
        program.register(name, callback)
    }

    /// From now on the function that is running is noted in a file.
    pub fn note_calls(&self, file: Option<PathBuf>) {
        self.note.file.replace(file);
    }

    /// Loads and starts a plugin.
    ///
    /// # Errors
    /// Why it cannot run, in a sentence.
    pub fn load(&self, host: Rc<dyn Host>, name: &str, path: &Path) -> Result<Rc<Plugin>, String> {
        let own_library = own_library::connected()?;
        let claim = Claim::of(path)?;
        let library = Library::open(path)?;
        let resource = Resource::new(|| format!("the memory of the plugin {name}"));
        let plugin = Rc::new(Plugin::new(name, Some(library), Some(claim), resource));
        let version = self.run(host, &plugin, "simInit", |plugin| {
            library.start(&plugin.name, own_library)
        });
        if version == 0 {
            let reason = self
                .shared
                .last_error
                .take()
                .map(|error| format!(" (the last error: {error})"));
            return Err(format!(
                "could not properly initialize plugin{}",
                reason.unwrap_or_default()
            ));
        }
        plugin.version.set(version);
        self.loaded.borrow_mut().push(Rc::clone(&plugin));
        Ok(plugin)
    }

    /// Calls a function of a plugin, by its place in the list of functions, for a script that is attached to `object`, or to none: -1.
    ///
    /// # Errors
    /// The error that the plugin has set.
    pub fn call(
        &self,
        host: Rc<dyn Host>,
        plugin: &Rc<Plugin>,
        function: usize,
        (script, object): (i64, i64),
        args: Vec<Data>,
    ) -> Result<Vec<Data>, String> {
        let function = plugin
            .functions
            .borrow()
            .get(function)
            .cloned()
            .ok_or("the plugin has no such function")?;
        let stack = self.shared.stacks.borrow_mut().add(args);
        let before = self.shared.raised.take();
        let (script, object) = (numbers::low_i32(script), numbers::low_i32(object));
        let older_error = self.run(host, plugin, &function.name, |_| {
            function.callback.call(Caller {
                object,
                script,
                stack,
            })
        });
        // Nothing is left of a stack that the plugin has released.
        let results = self
            .shared
            .stacks
            .borrow_mut()
            .remove(stack.into())
            .unwrap_or_default();
        match self.shared.raised.replace(before).or(older_error) {
            Some(error) => Err(error),
            None => Ok(results),
        }
    }

    /// Sends a message to all plugins.
    pub fn send(&self, host: Rc<dyn Host>, moment: Moment, values: [i32; 4]) {
        for plugin in self.all() {
            let message = Message {
                id: moment as i32,
                values,
            };
            self.run(Rc::clone(&host), &plugin, "simMsg", |plugin| {
                plugin
                    .library
                    .iter()
                    .for_each(|library| library.receive(message));
            });
        }
    }

    /// Ends a plugin. Its library stays in memory.
    pub fn unload(&self, host: Rc<dyn Host>, plugin: &Rc<Plugin>) {
        self.loaded
            .borrow_mut()
            .retain(|loaded| !Rc::ptr_eq(loaded, plugin));
        self.run(host, plugin, "simCleanup", |plugin| {
            plugin.library.iter().for_each(Library::clean_up);
        });
    }

    fn run<T>(
        &self,
        host: Rc<dyn Host>,
        plugin: &Rc<Plugin>,
        function: &str,
        code: impl FnOnce(&Plugin) -> T,
    ) -> T {
        self.note.begin(&plugin.name, function);
        let exception = UncaughtException {
            plugin: &plugin.name,
            function,
        };
        let frame = Frame {
            shared: Rc::clone(&self.shared),
            plugin: Some(Rc::clone(plugin)),
            host,
        };
        let result = within(frame, || {
            plugin.calls.set(plugin.calls.get() + 1);
            let _end = End(plugin);
            code(plugin)
        });
        std::mem::forget(exception);
        self.note.end();
        result
    }
}

/// The end of a call.
struct End<'a>(&'a Plugin);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.calls.set(self.0.calls.get() - 1);
    }
}

/// Dropped while an exception leaves a plugin's function: Rust cannot catch it, so this ends the process and says where it came from.
struct UncaughtException<'a> {
    plugin: &'a str,
    function: &'a str,
}

impl Drop for UncaughtException<'_> {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let Self { plugin, function } = self;
            eprintln!(
                "swanilda: {function} of the plugin {plugin} let an exception out. It must catch it and call simSetLastError."
            );
            std::process::abort();
        }
    }
}

/// A library that a simulator of this process uses. Its variables exist once, so two simulators cannot use it at the same time.
struct Claim(PathBuf);

static CLAIMED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

impl Claim {
    fn of(path: &Path) -> Result<Self, String> {
        let path = path.canonicalize().map_err(|error| error.to_string())?;
        let is_free = CLAIMED
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .insert(path.clone());
        let used = "another simulator of this process uses it, and a library has its variables only once: run them one after the other, \
                    or in processes of their own (swanilda test --isolate)";
        if is_free {
            Ok(Self(path))
        } else {
            Err(used.to_owned())
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        CLAIMED
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .remove(&self.0);
    }
}
