//! The thread of a Python script.
//!
//! It runs in the process. A coroutine of the script's Lua state stands for it: it waits for the thread's messages, handles them, and yields
//! when there is none, so that threads of both languages are resumed alike (`lua/library/swanilda/python.lua`). A stepping
//! thread is waited for. Others run beside the simulator, which looks after them once in each step: it serves a number of calls, and waits
//! for the next one as long as a thread takes that does not sleep, so that what threads do rarely depends on the machine.

use std::ffi::c_int;
use std::time::Duration;

use super::conversation::{ApiResults, Conversation, answer};
use super::message::{self, Message};
use crate::binding::data;
use crate::host::ScriptError;
use crate::lua::{Stack, push_callback};
use crate::lua_runtime::threads;
use crate::sys_call::SysCall;
use scene::Data;

/// A thread that makes no call for this long runs concurrently with the simulation.
const CALL_TIMEOUT: Duration = Duration::from_millis(50);
/// The same for the first call: most threads begin by setting their stepping mode.
const FIRST_CALL_TIMEOUT: Duration = Duration::from_secs(2);
/// Calls in a time slice, for each of its milliseconds.
const CALLS_PER_MS: u32 = 20;

/// What a turn of the thread ends with.
enum Turn {
    /// It runs on.
    Busy,
    /// It calls what only Lua can do.
    Call(String, Vec<Data>),
    Ended,
}

/// Pushes a table of what the library's Lua file needs.
pub(super) fn push_natives(stack: Stack<'_>) {
    stack.new_table(0, 3);
    push_callback(stack, turn, 0);
    stack.raw_set_field(-2, "turn");
    push_callback(stack, reply, 0);
    stack.raw_set_field(-2, "reply");
    push_callback(stack, ask, 0);
    stack.raw_set_field(-2, "ask");
}

/// Lets the thread go on. Returns nothing when it has ended, false when it is busy, or the name of a function and its arguments.
fn turn(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let link = Conversation::link_of(stack.env());
    let conversation = Conversation {
        env: stack.env(),
        link: &link,
    };
    match conversation.turn(|| threads::auto_level(stack) == 0) {
        Ok(Turn::Ended) => Ok(0),
        Ok(Turn::Busy) => {
            stack.push_bool(false);
            Ok(1)
        }
        Ok(Turn::Call(name, args)) => {
            if !stack.reserve(args.len() + 8) {
                return Err("stack overflow: too many arguments.".into());
            }
            stack.push_bytes(name.as_bytes());
            args.iter().for_each(|arg| data::push_data(stack, arg));
            Ok(1 + numbers::count_i32(args.len()))
        }
        Err(error) => {
            // Lua would add its own traceback.
            link.failure.replace(Some(error));
            Ok(0)
        }
    }
}

impl Conversation<'_> {
    /// Serves the thread; `may_run_beside` says whether the simulation goes on while it runs.
    fn turn(self, may_run_beside: impl Fn() -> bool) -> Result<Turn, ScriptError> {
        let mut timeout = CALL_TIMEOUT;
        if !self.link.thread_started.replace(true) {
            self.hand_over(&message::call(SysCall::Thread.name(), &[]))?;
            timeout = FIRST_CALL_TIMEOUT;
        }
        let calls_in_slice = CALLS_PER_MS.saturating_mul(self.env.yields.delay_ms.get().max(1));
        loop {
            let beside = self.env.yields.overall.get() == 0 && may_run_beside();
            if beside && self.link.thread_calls.get() >= calls_in_slice {
                return Ok(self.busy());
            }
            let timeout = if self.link.thread_active.get() {
                timeout
            } else {
                Duration::ZERO
            };
            let Some(message) = self.next_of_thread(beside.then_some(timeout))? else {
                self.link.thread_active.set(false);
                return Ok(self.busy());
            };
            self.link
                .thread_calls
                .set(self.link.thread_calls.get().saturating_add(1));
            self.link.busy.set(false);
            self.link.thread_active.set(true);
            self.run_queued()?;
            match message {
                Message::Call(name, args) => match self.call_native(&name, &args) {
                    Some(result) => {
                        self.link.send(&answer(result))?;
                        self.link.busy.set(true);
                    }
                    None => return Ok(Turn::Call(name, args)),
                },
                Message::BadCall(reason) => {
                    self.link.send(&message::error(&reason))?;
                    self.link.busy.set(true);
                }
                Message::Error(text) => return Err(ScriptError::new(text)),
                Message::Results(_) | Message::NoFunction => return Ok(Turn::Ended),
                // Output was shown.
                Message::Print(_) | Message::Write(..) => {}
            }
        }
    }

    /// The end of the thread's time slice.
    fn busy(self) -> Turn {
        self.link.thread_calls.set(0);
        Turn::Busy
    }

    /// The next message of the thread; None when there is none within `timeout`.
    fn next_of_thread(self, timeout: Option<Duration>) -> Result<Option<Message>, ScriptError> {
        match self.link.early.take() {
            Some(message) => Ok(Some(message)),
            None => self.link.receive(self.env, timeout),
        }
    }

    fn hand_over(self, message: &[u8]) -> Result<(), ScriptError> {
        self.link.send(message)?;
        self.link.busy.set(true);
        self.link.thread_active.set(true);
        Ok(())
    }
}

/// Answers the thread: gets whether its call succeeded, and what the library says of its results, or the error.
fn reply(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let link = Conversation::link_of(stack.env());
    let values = (2..=stack.top())
        .map(|index| data::read_data(stack, index))
        .collect::<Result<Vec<_>, _>>();
    let result = match values {
        Ok(values) if stack.truthy(1) => Ok(ApiResults::of_library(values)),
        Ok(_) => Err(String::from_utf8_lossy(&stack.text(2).unwrap_or_default()).into_owned()),
        Err(error) => Err(error.to_string()),
    };
    match link.send(&answer(result)) {
        Ok(()) => link.busy.set(true),
        Err(error) => drop(link.failure.replace(Some(error))),
    }
    Ok(0)
}

/// Calls a function of the script with the arguments after its name.
fn ask(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let link = Conversation::link_of(stack.env());
    let conversation = Conversation {
        env: stack.env(),
        link: &link,
    };
    let name = String::from_utf8_lossy(&stack.bytes(1).unwrap_or_default()).into_owned();
    let args: Vec<Data> = (2..=stack.top())
        .map(|index| data::read_data(stack, index))
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())?;
    let results = conversation
        .call(&name, &args)
        .map_err(|error| error.text)?;
    let results = results.ok_or_else(|| format!("there is no function {name} in this script."))?;
    if !stack.reserve(results.len() + 8) {
        return Err("stack overflow: too many results.".into());
    }
    results
        .iter()
        .for_each(|result| data::push_data(stack, result));
    Ok(numbers::count_i32(results.len()))
}
