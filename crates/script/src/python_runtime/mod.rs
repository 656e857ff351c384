//! Scripts in Python: a process beside a Lua state, or the Python of the program around the simulator (`embedding`).
//!
//! The process runs the script's text (`child`); the Lua state is what the script's `#luaExec` lines, hooks and library functions live in,
//! as in the original. Both share the environment of the script. One side has the turn: the simulator calls a function of the script and
//! serves its calls until it answers (`conversation`). Native functions are called with plain values, others through Lua.

mod conversation;
mod embedding;
mod launch;
mod line_counts;
mod link;
pub(crate) mod message;
mod source;
mod thread;

use std::cell::{Cell, RefCell};
use std::path::Path;
use std::rc::Rc;
use std::time::Duration;

use super::coverage::LineCounts;
use super::lua_runtime::{LuaInterpreter, LuaLanguage};
use crate::function_ref::FunctionRef;
use crate::host::{
    CallError, CallbackResult, Callee, Env, Hook, Interpreter, Language, Runtime, Script,
    ScriptError, Sim, SourceText,
};
use crate::sys_call::SysCall;
use conversation::{Conversation, LIBRARY};
pub use embedding::is_short;
pub use embedding::{EmbeddedScript, PythonHost, ScriptCalls};
pub use launch::{LaunchError, python_command, start_python};
use line_counts::Own;
use link::{Link, Peer};
use scene::Data;

/// How long the start of a script may take, seconds.
const INIT_TIMEOUT: f64 = 10.0;
/// How long a process may take to report which lines have run.
const COUNT_TIMEOUT: Duration = Duration::from_secs(10);
/// What `sysCall_ext` returns in place of results, as in the original.
const NOT_FOUND: &[u8] = b"_*funcNotFound*_";
const FAILED: &[u8] = b"_*runtimeError*_";
/// The names of settings that a script makes in its Lua lines, in the order in which they are read.
const SETTINGS: &[u8] =
    b"pythonExecutable, initTimeout, additionalPaths, additionalIncludePaths, contactCallback, dynCallback, eventCallback, pythonFile";

/// The language Python.
pub struct PythonLanguage {
    lua: LuaLanguage,
    host: Option<Rc<dyn PythonHost>>,
}

impl PythonLanguage {
    /// With the Lua that its library functions are written in, and the Python of the program, if it has one.
    pub fn new(lua: LuaLanguage, host: Option<Rc<dyn PythonHost>>) -> Self {
        Self { lua, host }
    }
}

/// The Lua lines at the head of a Python text, and what is left of it, with the same lines.
pub fn python_parts(text: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let parts = source::split(text);
    (parts.lua, parts.python)
}

/// The Python interpreter that scripts in this folder get unless they choose another one.
pub fn python_interpreter(folder: Option<&Path>) -> String {
    launch::default_interpreter(&folder.map(Path::to_owned).into_iter().collect::<Vec<_>>())
}

impl Language for PythonLanguage {
    fn name(&self) -> &'static str {
        "python"
    }

    fn create(&self, env: Rc<Env>) -> Rc<Runtime> {
        let (lua, link) = (self.lua.interpreter(&env), Conversation::link_of(&env));
        Runtime::new(
            Rc::clone(&env),
            PythonInterpreter {
                env,
                link,
                lua,
                host: self.host.clone(),
                callbacks: Cell::new(0),
                own: RefCell::default(),
            },
        )
    }
}

/// A running script: its process and its Lua state.
struct PythonInterpreter {
    env: Rc<Env>,
    link: Rc<Link>,
    lua: LuaInterpreter,
    /// The Python of the program.
    host: Option<Rc<dyn PythonHost>>,
    /// The callbacks that the text defines, as bits.
    callbacks: Cell<u64>,
    /// The text as reports of lines show it, where they are counted.
    own: RefCell<Option<Own>>,
}

/// What a script has set in its Lua lines.
#[derive(Default)]
struct Settings {
    executable: Option<String>,
    init_limit: Duration,
    paths: Vec<String>,
    include_paths: Vec<String>,
    /// Callbacks that are called even though they are frequent, as bits.
    frequent: u64,
    file: Option<String>,
}

impl PythonInterpreter {
    fn conversation(&self) -> Conversation<'_> {
        Conversation {
            env: &self.env,
            link: &self.link,
        }
    }

    fn sim(&self) -> Result<Rc<Sim>, ScriptError> {
        self.env
            .sim
            .upgrade()
            .ok_or_else(|| ScriptError::new("the simulator is gone."))
    }

    /// Whether the text has this callback, and it is wanted.
    fn has(&self, call: SysCall) -> bool {
        self.callbacks.get() & call.bit() != 0
    }

    fn settings(&self) -> Result<Settings, ScriptError> {
        let values = self.lua.evaluate(SETTINGS)?;
        let value = |place: usize| values.get(place).unwrap_or(&Data::Nil);
        let seconds = value(1).as_f64().unwrap_or(INIT_TIMEOUT);
        let flag = |place: usize, calls: &[SysCall]| {
            let bits = calls.iter().fold(0, |bits, call| bits | call.bit());
            if value(place).truthy() { bits } else { 0 }
        };
        let frequent = flag(4, &[SysCall::Contact, SysCall::ContactCallback])
            | flag(5, &[SysCall::Dyn, SysCall::DynCallback])
            | flag(6, &[SysCall::Event]);
        Ok(Settings {
            executable: text_of(value(0)),
            init_limit: Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX),
            paths: texts_of(value(2)),
            include_paths: texts_of(value(3)),
            frequent,
            file: text_of(value(7)),
        })
    }

    /// The texts of the process, each with its name: the file that the script includes, then its own.
    fn texts(
        &self,
        sim: &Sim,
        settings: &Settings,
        python: &[u8],
        name: &str,
    ) -> Result<Data, ScriptError> {
        let mut texts = Vec::new();
        if let Some(file) = &settings.file {
            let scene = launch::scene_folders(sim, &self.env.script);
            let folders = settings
                .include_paths
                .iter()
                .map(Path::new)
                .chain(scene.iter().map(AsRef::as_ref));
            let path = folders
                .map(|folder| folder.join(file))
                .find(|path| sim.options.permissions.is_file(path));
            let path = path.ok_or_else(|| {
                ScriptError::new(format!("the included file '{file}' was not found."))
            })?;
            sim.options
                .permissions
                .check_read(&path)
                .map_err(|denied| ScriptError::new(denied.to_string()))?;
            let text = sim
                .options
                .permissions
                .read_checked(&path)
                .map_err(|error| ScriptError::new(format!("{}: {error}", path.display())))?;
            texts.push(Data::Array(vec![
                Data::text(&path.to_string_lossy()),
                lossy(&text),
            ]));
        }
        texts.push(Data::Array(vec![Data::text(name), lossy(python)]));
        Ok(Data::Array(texts))
    }

    /// Starts the process and runs the script's text in it.
    fn begin(
        &self,
        text: &[u8],
        chunk_name: &str,
        counted_as: Option<&String>,
    ) -> Result<(), ScriptError> {
        let sim = self.sim()?;
        let parts = source::split(text);
        if !parts.lua.is_empty() {
            self.lua.run(&parts.lua, chunk_name)?;
        }
        let mut settings = self.settings()?;
        settings.file = parts.include.or(settings.file.take());
        let file = self.env.script.file.borrow().clone();
        let name = file
            .as_deref()
            .or(chunk_name.strip_prefix('@'))
            .unwrap_or("script");
        let texts = self.texts(&sim, &settings, &parts.python, name)?;
        let peer = self.peer(&sim, settings.executable.take(), counted_as.is_some());
        self.link
            .open(peer.map_err(ScriptError::new)?, self.env.tape());
        self.own.replace(counted_as.map(|path| Own {
            name: name.to_owned(),
            path: path.clone(),
            text: text.into(),
        }));
        let fields = [
            texts,
            folders(&sim, &self.env.script, &settings),
            Data::Bool(counted_as.is_some()),
        ];
        let functions = self
            .conversation()
            .request("l", &fields, Some(settings.init_limit))?;
        self.note_functions(&functions, settings.frequent)
    }

    /// What is to run the script: the program's Python, unless another one was chosen or lines are counted, which is for a process alone.
    fn peer(
        &self,
        sim: &Sim,
        executable: Option<String>,
        is_counted: bool,
    ) -> Result<Peer, String> {
        let chosen = launch::chosen_interpreter(sim, executable);
        if let (Some(host), None, false) = (&self.host, &chosen, is_counted) {
            self.env.tape().lacks("scripts in the program's own Python");
            let embedded = launch::embed(sim, &**host, &self.env).map(Peer::Embedded);
            return embedded.map_err(|error| error.to_string());
        }
        let folders = launch::scene_folders(sim, &self.env.script);
        let mut process = None;
        let started = self.env.tape().input("starting Python", || {
            let chosen = chosen.unwrap_or_else(|| launch::default_interpreter(&folders));
            let started = launch::start(sim, &chosen).map_err(|error| error.to_string())?;
            process = Some(started);
            Ok(())
        });
        started.unwrap_or_else(|lost| Err(lost.to_string()))?;
        Ok(process.map_or(Peer::Captured, Peer::Process))
    }

    fn note_functions(&self, functions: &[Data], frequent: u64) -> Result<(), ScriptError> {
        let names = functions.iter().filter_map(text_of);
        let bits = names
            .filter_map(|name| SysCall::from_name(&name))
            .fold(0, |bits, call| bits | call.bit());
        let usually_unwanted = [
            SysCall::Contact,
            SysCall::ContactCallback,
            SysCall::Dyn,
            SysCall::DynCallback,
            SysCall::Event,
        ];
        let unwanted = usually_unwanted
            .iter()
            .fold(0, |bits, call| bits | call.bit())
            & !frequent;
        self.callbacks.set(bits & !unwanted);
        if !self.has(SysCall::Init) && !self.has(SysCall::Thread) {
            return Err(ScriptError::new(
                "can't find sysCall_init nor sysCall_thread functions",
            ));
        }
        if self.has(SysCall::Thread) {
            self.lua.call_library(LIBRARY, "defineThread", &[])?;
        }
        Ok(())
    }

    /// The error of the thread, if a hook has resumed it.
    fn take_failure(&self) -> Result<(), ScriptError> {
        self.link.failure.take().map_or(Ok(()), Err)
    }

    /// Calls a function by its name, which may end in `@python` or `@lua`.
    fn call_named(&self, name: &str, args: &[Data]) -> Result<Vec<Data>, CallError> {
        if let Some(name) = name.strip_suffix("@lua") {
            return self.lua.call(Callee::Named(name), args);
        }
        let plain = name.strip_suffix("@python").unwrap_or(name);
        let results = if self.has(SysCall::Ext) {
            self.call_extension(plain, args)
        } else {
            self.conversation().call(plain, args)
        };
        match results? {
            Some(results) => Ok(results),
            None if plain == name => self.lua.call(Callee::Named(name), args),
            None => Err(CallError::NoSuchFunction),
        }
    }

    /// Calls the function that gets all calls of others; None when it says that the script has no such function.
    fn call_extension(&self, name: &str, args: &[Data]) -> Result<Option<Vec<Data>>, ScriptError> {
        let args: Vec<Data> = std::iter::once(Data::text(name))
            .chain(args.iter().cloned())
            .collect();
        let results = self.conversation().call(SysCall::Ext.name(), &args)?;
        match results.as_deref() {
            Some([Data::Text(text)]) if &**text == NOT_FOUND => Ok(None),
            Some([Data::Text(text)]) if &**text == FAILED => {
                Err(ScriptError::new("sysCall_ext says that it has failed."))
            }
            _ => Ok(results),
        }
    }
}

impl Interpreter for PythonInterpreter {
    fn start(&self) -> Result<(), ScriptError> {
        self.lua.start()?;
        self.lua
            .set_global(conversation::NATIVES, thread::push_natives);
        Ok(())
    }

    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError> {
        self.begin(source.text, source.chunk_name, source.counted_as.as_ref())
    }

    fn defines(&self, call: SysCall) -> bool {
        self.has(call) || self.lua.defines(call)
    }

    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError> {
        if !self.has(call) {
            return self.lua.call_callback(call, args);
        }
        let mut results = self.conversation().call_callback(call, args)?;
        Ok(CallbackResult::Returned(results.pop()))
    }

    fn random_state(&self) -> Option<[u64; 4]> {
        self.lua.random_state()
    }

    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError> {
        let ran = match hook.function {
            Some(_) => self.lua.call_hook(hook, args),
            None => match self.conversation().call(&hook.name, args)? {
                Some(_) => Ok(true),
                None => self.lua.call_hook(hook, args),
            },
        };
        self.take_failure()?;
        ran
    }

    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError> {
        match function {
            Callee::Named(name) => self.call_named(name, args),
            Callee::Function(_) => self.lua.call(function, args),
        }
    }

    fn run(&self, text: &[u8], chunk_name: &str) -> Result<(), ScriptError> {
        if !self.link.is_open() {
            return self.begin(text, chunk_name, None);
        }
        let name = chunk_name.strip_prefix('@').unwrap_or(chunk_name);
        self.conversation()
            .request("x", &[lossy(text), Data::text(name)], None)
            .map(drop)
    }

    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, ScriptError> {
        self.conversation().request("v", &[lossy(text)], None)
    }

    fn call_library(
        &self,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError> {
        self.lua.call_library(module, function, args)
    }

    fn release(&self, function: FunctionRef) {
        self.lua.release(function);
    }

    fn traceback(&self) -> String {
        self.lua.traceback()
    }

    fn take_line_counts(&self, sim: &Sim) -> LineCounts {
        let mut all = self.lua.take_line_counts(sim);
        if let Some(own) = &*self.own.borrow()
            && self.link.is_open()
            && let Ok(counts) = self.conversation().request("k", &[], Some(COUNT_TIMEOUT))
        {
            all.merge(line_counts::read(
                counts.first().unwrap_or(&Data::Nil),
                own,
                sim,
            ));
        }
        all
    }
}

impl Drop for PythonInterpreter {
    fn drop(&mut self) {
        self.link.close();
    }
}

/// Folders in which the script's imports are found.
fn folders(sim: &Sim, script: &Script, settings: &Settings) -> Data {
    let scene = launch::scene_folders(sim, script);
    let scene = scene.iter();
    let folders = settings
        .paths
        .iter()
        .cloned()
        .chain(scene.map(|folder| folder.to_string_lossy().into_owned()));
    Data::Array(folders.map(|folder| Data::text(&folder)).collect())
}

/// Texts of Python are UTF-8.
fn lossy(text: &[u8]) -> Data {
    Data::text(&String::from_utf8_lossy(text))
}

fn text_of(value: &Data) -> Option<String> {
    let Data::Text(text) = value else { return None };
    Some(String::from_utf8_lossy(text).into_owned())
}

/// A text, or a list of them.
fn texts_of(value: &Data) -> Vec<String> {
    match value {
        Data::Array(items) => items.iter().filter_map(text_of).collect(),
        _ => text_of(value).into_iter().collect(),
    }
}
