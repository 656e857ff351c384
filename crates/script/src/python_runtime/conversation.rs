//! Calls in both directions between a script's process and the simulator.

use std::rc::Rc;
use std::time::Duration;

use super::link::Link;
use super::message::{self, Message};
use crate::binding::registry::{Bound, Member};
use crate::error::ApiError;
use crate::host::{Env, Level, ScriptError};
use crate::sys_call::SysCall;
use scene::Data;
use wire::marshal::Declared;

/// The module of the library that calls what is written in Lua.
pub(super) const LIBRARY: &str = "swanilda.python";
/// The global under which that module finds its native functions.
pub(super) const NATIVES: &str = "_swanilda_python";
/// How long `sysCall_cleanup` waits for a thread of the script that is busy.
const CLEANUP_TIMEOUT: Duration = Duration::from_millis(100);
/// Seconds without a message after which a call has failed; named parameter `python.callTimeout`, 0 for no limit.
const CALL_TIMEOUT: f64 = 60.0;

/// A script's environment with its connection.
#[derive(Clone, Copy)]
pub(super) struct Conversation<'a> {
    pub env: &'a Env,
    pub link: &'a Link,
}

/// The results of an API function.
pub(super) struct ApiResults<'a> {
    values: Vec<Data>,
    declared: Declared<'a>,
}

impl Conversation<'_> {
    /// Calls a function of the script; None when there is none of that name.
    ///
    /// # Errors
    /// The function's, or when the process has ended.
    pub(super) fn call(self, name: &str, args: &[Data]) -> Result<Option<Vec<Data>>, ScriptError> {
        self.wait_for_turn(None)?;
        self.exchange(&message::call(name, args), self.call_limit())
    }

    /// Calls a callback that the script has. While its thread runs, the callback is queued until the thread sends its next message, and has no results.
    ///
    /// # Errors
    /// The callback's, or when the process has ended.
    pub(super) fn call_callback(
        self,
        call: SysCall,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError> {
        let timeout = if call == SysCall::Cleanup {
            CLEANUP_TIMEOUT
        } else {
            Duration::ZERO
        };
        if !self.wait_for_turn(Some(timeout))? {
            self.link.queue(call, args);
            return Ok(Vec::new());
        }
        Ok(self
            .exchange(&message::call(call.name(), args), self.call_limit())?
            .unwrap_or_default())
    }

    /// Lets the process do something by the letter of its handler.
    ///
    /// # Errors
    /// As of a call.
    pub(super) fn request(
        self,
        kind: &str,
        fields: &[Data],
        limit: Option<Duration>,
    ) -> Result<Vec<Data>, ScriptError> {
        self.wait_for_turn(None)?;
        Ok(self
            .exchange(&message::request(kind, fields), limit)?
            .unwrap_or_default())
    }

    /// Waits for the next message of the script's thread, if it runs; false when there is none within `limit`.
    fn wait_for_turn(self, limit: Option<Duration>) -> Result<bool, ScriptError> {
        if !self.link.busy.get() || self.link.early.borrow().is_some() {
            return Ok(true);
        }
        let early = self.link.receive(self.env, limit)?;
        let is_there = early.is_some();
        self.link.early.replace(early);
        Ok(is_there)
    }

    /// Runs callbacks that came while the thread was running.
    pub(super) fn run_queued(self) -> Result<(), ScriptError> {
        while let Some((call, args)) = self.link.next_queued() {
            self.call(call.name(), &args)?;
        }
        Ok(())
    }

    /// Sends a message and serves the script until it answers.
    fn exchange(
        self,
        message: &[u8],
        limit: Option<Duration>,
    ) -> Result<Option<Vec<Data>>, ScriptError> {
        if let Some(script) = self.link.embedded() {
            return outcome(
                self.link
                    .read(&script.ask(message).map_err(ScriptError::new)?)?,
            );
        }
        self.link.send(message)?;
        loop {
            let Some(message) = self.link.receive(self.env, limit)? else {
                self.link.kill();
                let seconds = limit.unwrap_or_default().as_secs_f64();
                return Err(ScriptError::new(format!(
                    "the Python process of this script did nothing for {seconds} seconds and was ended \
                     (named parameter python.callTimeout, 0 for no limit; for the start initTimeout)."
                )));
            };
            match message {
                Message::Call(name, args) => self.link.send(&self.answer_of(&name, &args))?,
                Message::BadCall(reason) => self.link.send(&message::error(&reason))?,
                answer => return outcome(answer),
            }
        }
    }

    fn call_limit(self) -> Option<Duration> {
        let sim = self.env.sim.upgrade()?;
        let app = sim.app.borrow();
        let text = app
            .named_params
            .get("python.callTimeout")
            .and_then(|value| std::str::from_utf8(value).ok());
        let seconds = text
            .and_then(|text| text.trim().parse().ok())
            .unwrap_or(CALL_TIMEOUT);
        Duration::try_from_secs_f64(seconds)
            .ok()
            .filter(|limit| !limit.is_zero())
    }

    /// The answer to a call of the script's.
    pub(super) fn answer_of(self, name: &str, args: &[Data]) -> Vec<u8> {
        match self.call_native(name, args) {
            Some(result) => answer(result),
            None => answer(self.call_lua(name, args)),
        }
    }

    /// Calls a native function; None when it is not native, or needs Lua.
    pub(super) fn call_native(
        self,
        name: &str,
        args: &[Data],
    ) -> Option<Result<ApiResults<'static>, String>> {
        let registry = &self.env.registry;
        let Some(Member::Native(id)) = registry.find(name) else {
            return None;
        };
        let bound = registry.bound(id);
        if bound.replacement.is_some() {
            return None;
        }
        match self.env.call_native(bound, args) {
            Ok(values) => Some(Ok(ApiResults {
                values,
                declared: declared_by(bound),
            })),
            Err(ApiError::NeedsLua) => None,
            Err(error) => Some(Err(format!("in {name}: {error}"))),
        }
    }

    /// Calls what has that name in the Lua part of the script.
    fn call_lua(self, name: &str, args: &[Data]) -> Result<ApiResults<'static>, String> {
        let gone = "the simulator is gone.";
        let runtime = self.env.runtime().ok_or(gone)?;
        let sim = self.env.sim.upgrade().ok_or(gone)?;
        let _level = Level::enter(&sim.scripts, self.env);
        let args: Vec<Data> = std::iter::once(Data::text(name))
            .chain(args.iter().cloned())
            .collect();
        let results = runtime
            .interpreter
            .call_library(LIBRARY, "serve", &args)
            .map_err(|error| error.text)?;
        Ok(ApiResults::of_library(results))
    }

    /// The same for an environment in a native function of Lua.
    pub(super) fn link_of(env: &Env) -> Rc<Link> {
        env.module_states.get()
    }
}

/// The outcome of the simulator's call that a message reports.
fn outcome(message: Message) -> Result<Option<Vec<Data>>, ScriptError> {
    match message {
        Message::Results(results) => Ok(Some(results)),
        Message::Error(text) => Err(ScriptError::new(text)),
        // The rest is output, which was shown.
        Message::NoFunction
        | Message::Call(..)
        | Message::BadCall(_)
        | Message::Print(_)
        | Message::Write(..) => Ok(None),
    }
}

/// The results of a call, or its error, as a message.
pub(super) fn answer(result: Result<ApiResults<'_>, String>) -> Vec<u8> {
    match result {
        Ok(results) => message::results(&results.values, results.declared),
        Err(text) => message::error(&plain_error(&text)),
    }
}

fn declared_by(bound: &Bound) -> Declared<'static> {
    let returns = bound.function.returns;
    Declared {
        results: !returns.is_empty(),
        first: returns.first().copied().unwrap_or_default(),
    }
}

impl ApiResults<'static> {
    /// What the library says: the type of the first result if results are declared, else false; then the results.
    pub(super) fn of_library(results: Vec<Data>) -> Self {
        let mut results = results.into_iter();
        let declared = match results.next() {
            Some(Data::Text(first)) if first == b"string" => Declared {
                results: true,
                first: "string",
            },
            Some(Data::Text(first)) if first == b"buffer" => Declared {
                results: true,
                first: "buffer",
            },
            Some(Data::Text(_)) => Declared {
                results: true,
                first: "",
            },
            _ => Declared::default(),
        };
        Self {
            values: results.collect(),
            declared,
        }
    }
}

/// The message without Lua's traceback and without the position of the library's line that made the call.
fn plain_error(text: &str) -> String {
    let text = text.split("\nstack traceback:").next().unwrap_or(text);
    let is_position = |before: &&str| {
        let line = before.rsplit(':').next().unwrap_or_default();
        !before.contains('\n') && !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit())
    };
    let after = text
        .split_once(": ")
        .filter(|(before, _)| is_position(before))
        .map(|(_, after)| after);
    after.unwrap_or(text).to_owned()
}

#[cfg(test)]
mod tests {
    use super::plain_error;

    #[test]
    fn positions_of_the_library_are_left_out() {
        for (text, plain) in [
            ("17: in sim._getObject: no.", "in sim._getObject: no."),
            (
                "[string \"x\"]:3: in sim.f: no.\nstack traceback:\n\t[C]: in ?",
                "in sim.f: no.",
            ),
            ("in sim.f: line: 3", "in sim.f: line: 3"),
            ("No such function: 3: x", "No such function: 3: x"),
            ("", ""),
        ] {
            assert_eq!(plain_error(text), plain);
        }
    }
}
