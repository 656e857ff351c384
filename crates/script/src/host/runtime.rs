//! The interface between the host and script languages.
//!
//! A [`Language`] makes an [`Interpreter`] for each script; the rest of the host only uses that trait. Values that pass it are plain
//! [`Data`], functions of scripts are numbers. `script::lua_runtime` is the implementation for Lua.

use std::rc::Rc;

use super::{Debuggee, Env, Hook, Sim};
use crate::coverage::LineCounts;
use crate::error::ApiError;
use crate::function_ref::FunctionRef;
use crate::sys_call::SysCall;
use scene::{Data, Key};

/// A language scripts can be written in.
pub trait Language {
    /// Its name in the property `language` of scripts.
    fn name(&self) -> &'static str;

    /// A new interpreter for the script that `env` belongs to.
    fn create(&self, env: Rc<Env>) -> Rc<Runtime>;
}

/// The interpreter of one script. It is closed by being dropped, when the script has ended and its last call has returned.
///
/// Calls nest: while one is in progress, the script may call API functions, and these may call the same interpreter again. The
/// simulator waits for each call, so an interpreter has to ask [`Env::interruption`] again and again while a script runs.
pub trait Interpreter {
    /// Prepares the interpreter for a text: library, globals, processes. Called once, first.
    ///
    /// # Errors
    /// When no script can run.
    fn start(&self) -> Result<(), ScriptError>;

    /// Runs the script's own text, which defines its functions.
    ///
    /// # Errors
    /// The script's.
    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError>;

    /// Whether the script has the function of a callback at this moment.
    fn defines(&self, call: SysCall) -> bool;

    /// Calls a callback, if the script defines it.
    ///
    /// # Errors
    /// The script's.
    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError>;

    /// Calls a callback with a table of integers, if the script defines it.
    ///
    /// # Errors
    /// The script's.
    fn call_with_integers(
        &self,
        call: SysCall,
        table: Integers<'_>,
    ) -> Result<CallbackResult, ScriptError> {
        self.call_callback(call, &[table.to_data()])
    }

    /// The state of the random numbers of the language's own library, as far as it can be known.
    fn random_state(&self) -> Option<[u64; 4]> {
        None
    }

    /// Begins the random numbers of the language's own library again. Where they are out of reach nothing happens: they begin with the script.
    ///
    /// # Errors
    /// When the language refuses.
    fn seed_random(&self, _seed: u32) -> Result<(), ScriptError> {
        Ok(())
    }

    /// How often code of the script has called functions of the host: without them it changes nothing but its own variables. None when
    /// they are not counted.
    fn host_calls(&self) -> Option<u64> {
        None
    }

    /// Whether a callback that was just called does nothing, with the thread of the script, until code of the script runs again. It is not
    /// defined then, or its function is empty.
    fn is_idle(&self, _call: SysCall, _is_defined: bool) -> bool {
        false
    }

    /// Calls a hook of the script; false when there is no such function.
    ///
    /// # Errors
    /// The script's.
    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError>;

    /// Resumes the thread of the script: before actuation, and in each loop iteration outside of the simulation. An interpreter whose
    /// library does that in hooks has nothing to do here.
    ///
    /// # Errors
    /// The script's.
    fn resume_thread(&self) -> Result<(), ScriptError> {
        Ok(())
    }

    /// Calls a function of the script.
    ///
    /// # Errors
    /// When there is no such function, or the script's.
    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError>;

    /// Runs another text in the script, such as a file in the sandbox.
    ///
    /// # Errors
    /// The script's.
    fn run(&self, text: &[u8], chunk_name: &str) -> Result<(), ScriptError>;

    /// The values of an expression, or what a text returns.
    ///
    /// # Errors
    /// The script's.
    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, ScriptError>;

    /// Calls a function of the library that is written in Lua. An interpreter of another language passes this to one of Lua, which it
    /// makes for the same script ([`Sim::create_runtime`]).
    ///
    /// # Errors
    /// The function's.
    fn call_library(
        &self,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError>;

    /// Releases a function that was passed to the host.
    fn release(&self, function: FunctionRef);

    /// The calls in progress, as the language shows them.
    fn traceback(&self) -> String;

    /// The script, to look into while everything stands still; None where the language has no such thing.
    fn debuggee(&self) -> Option<&dyn Debuggee> {
        None
    }

    /// Returns the counts of lines that ran since the last time. Only called where lines are counted.
    fn take_line_counts(&self, _sim: &Sim) -> LineCounts {
        LineCounts::default()
    }
}

/// A running script: its interpreter, and what the host knows about it.
pub struct Runtime<I: Interpreter + ?Sized = dyn Interpreter> {
    /// Its environment in the host.
    pub env: Rc<Env>,
    /// The interpreter of its language.
    pub interpreter: I,
}

impl Runtime {
    /// Joins an interpreter and its script's environment, which must not belong to another one.
    pub fn new<I: Interpreter + 'static>(env: Rc<Env>, interpreter: I) -> Rc<Self> {
        let runtime: Rc<Self> = Rc::new(Runtime { env, interpreter });
        // An environment is made for one interpreter.
        let _ = runtime.env.runtime.set(Rc::downgrade(&runtime));
        runtime
    }
}

impl<I: Interpreter + ?Sized> Drop for Runtime<I> {
    fn drop(&mut self) {
        if let Some(sim) = self.env.sim.upgrade() {
            sim.collect_line_counts(&self.interpreter);
        }
    }
}

/// A script's own text.
pub struct SourceText<'a> {
    /// The text, with bytes as in the file.
    pub text: &'a [u8],
    /// Its name in error positions; a file after `@`.
    pub chunk_name: &'a str,
    /// Its name in coverage reports, if its lines are counted.
    pub counted_as: Option<String>,
}

/// Function that a script is to call.
#[derive(Debug, Clone, Copy)]
pub enum Callee<'a> {
    /// The global function of that name; dots walk through tables. The script's `sysCall_ext`, if there is one, replaces all of them.
    Named(&'a str),
    /// A function the script has passed to the host.
    Function(FunctionRef),
}

/// The argument of a callback that is called very often: a table of integers.
#[derive(Debug, Clone, Copy)]
pub struct Integers<'a> {
    /// The names of the fields.
    pub names: &'static [&'static str],
    /// As many as names.
    pub values: &'a [i64],
}

impl Integers<'_> {
    pub(crate) fn to_data(self) -> Data {
        let fields = self.names.iter().zip(self.values);
        Data::Map(
            fields
                .map(|(name, &value)| (Key::Text(name.as_bytes().to_vec()), Data::Int(value)))
                .collect(),
        )
    }
}

/// The outcome of a callback.
#[derive(Debug, PartialEq)]
pub enum CallbackResult {
    /// The script has no such function.
    NotDefined,
    /// The last value it returned; None when it returned nothing.
    Returned(Option<Data>),
}

/// An error of a script.
#[derive(Debug, Clone, PartialEq)]
pub struct ScriptError {
    /// The message, and the traceback where there is one.
    pub text: String,
    /// The error ends the script without a line in the log, as some do in the original.
    pub is_silent: bool,
}

impl ScriptError {
    /// The text without the traceback.
    pub fn message(&self) -> &str {
        let end = self.text.find("\nstack traceback:");
        &self.text[..end.unwrap_or(self.text.len())]
    }

    /// An error that is logged.
    pub fn new(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            is_silent: false,
        }
    }

    /// Several errors of one callback as one; None when there are none.
    pub(crate) fn joined(errors: &[Self]) -> Option<Self> {
        if errors.is_empty() {
            return None;
        }
        let texts: Vec<&str> = errors.iter().map(|error| error.text.as_str()).collect();
        let is_silent = errors.iter().any(|error| error.is_silent);
        Some(Self {
            text: texts.join("\n\n"),
            is_silent,
        })
    }
}

/// Why a call of a function failed.
#[derive(Debug, PartialEq)]
pub enum CallError {
    /// The script has no such function.
    NoSuchFunction,
    /// The function raised an error.
    Script(ScriptError),
}

impl From<ApiError> for ScriptError {
    fn from(error: ApiError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<ScriptError> for CallError {
    fn from(error: ScriptError) -> Self {
        Self::Script(error)
    }
}

/// The languages of a simulator. The first one is for scripts of an unknown language.
#[derive(Default)]
pub struct Languages(Vec<Box<dyn Language>>);

impl Languages {
    /// Languages by which a simulator runs scripts; the first one is for scripts of an unknown language.
    pub fn new(languages: Vec<Box<dyn Language>>) -> Self {
        Self(languages)
    }

    pub(crate) fn contains(&self, name: &str) -> bool {
        self.0.iter().any(|language| language.name() == name)
    }

    /// The language with that name.
    fn find(&self, name: &str) -> Result<&dyn Language, ScriptError> {
        let named = self.0.iter().find(|language| language.name() == name);
        if named.is_none() && name == "python" {
            return Err(ScriptError::new(
                "scripts in Python are not implemented in Swanilda.",
            ));
        }
        let none = || {
            ScriptError::new(format!(
                "scripts in {name} are not implemented in Swanilda."
            ))
        };
        named.or(self.0.first()).map(Box::as_ref).ok_or_else(none)
    }

    /// A new interpreter of that language.
    ///
    /// # Errors
    /// When there is no such language.
    pub(crate) fn create(&self, name: &str, env: Rc<Env>) -> Result<Rc<Runtime>, ScriptError> {
        Ok(self.find(name)?.create(env))
    }
}
