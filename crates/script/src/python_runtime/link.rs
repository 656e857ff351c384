//! The connection of a script to what runs it, a process or the program's Python: whose turn it is, and what waits for it.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::process::ExitStatus;
use std::rc::Rc;
use std::time::Duration;

use capture::{Recorded, Tape};
use heap::resource::Resource;

use super::embedding::EmbeddedScript;
use super::message::Message;
use crate::error::ApiError;
use crate::host::{Env, ScriptError};
use crate::log::console::OutputStream;
use crate::log::verbosity;
use crate::sys_call::SysCall;
use crate::wall_clock;
use io::{PeerError, PeerProcess};
use scene::Data;

/// Interval at which a wait checks whether the program is to end.
const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// Messages of a script between checks whether it is to end.
const CHECK_INTERVAL: u64 = 4096;
/// Bytes that a script may print in one call.
const MAX_PRINTED: usize = 64 << 20;
/// How long a process may take to end once its connection is closed.
const END_TIMEOUT: Duration = Duration::from_millis(500);
/// Callbacks that wait for a busy thread.
const MAX_QUEUED: usize = 1000;

/// What runs a script.
pub(super) enum Peer {
    Process(PeerProcess),
    Embedded(Rc<dyn EmbeddedScript>),
    /// What a process has sent is in the capture that is replayed.
    Captured,
}

/// The connection; a state of the script.
#[derive(Default)]
pub(super) struct Link {
    peer: RefCell<Option<Peer>>,
    /// The tape on which the messages of a process come.
    tape: RefCell<Tape>,
    /// While it is open.
    resource: RefCell<Option<Resource>>,
    /// The thread of the script is running: the process has the turn, and the simulator does not wait for it.
    pub busy: Cell<bool>,
    /// A message of the running thread that was received and not handled yet.
    pub early: RefCell<Option<Message>>,
    /// Callbacks to run at the next message of the running thread.
    queued: RefCell<VecDeque<(SysCall, Vec<Data>)>>,
    pub thread_started: Cell<bool>,
    /// The thread has sent or received a message since the simulator last waited for it without success.
    pub thread_active: Cell<bool>,
    /// Calls of the thread in its present time slice.
    pub thread_calls: Cell<u32>,
    received: Cell<u64>,
    /// The error of the thread, for the hook that resumed it.
    pub failure: RefCell<Option<ScriptError>>,
}

impl Link {
    pub(super) fn open(&self, peer: Peer, tape: &Tape) {
        if !matches!(peer, Peer::Embedded(_)) {
            self.tape.replace(tape.clone());
        }
        // The variables of a captured one are in no process.
        let resource = || Resource::new(|| "the variables of a script in Python".to_owned());
        let is_captured = matches!(peer, Peer::Captured);
        self.resource.replace((!is_captured).then(resource));
        self.peer.replace(Some(peer));
    }

    pub(super) fn is_open(&self) -> bool {
        self.peer.borrow().is_some()
    }

    /// The script, if it runs in the program's Python.
    pub(super) fn embedded(&self) -> Option<Rc<dyn EmbeddedScript>> {
        let Some(Peer::Embedded(script)) = &*self.peer.borrow() else {
            return None;
        };
        Some(Rc::clone(script))
    }

    /// Ends the process, which may write its files before.
    pub(super) fn close(&self) {
        let peer = self.peer.take();
        self.resource.take();
        if let Some(Peer::Embedded(script)) = peer {
            script.close();
        }
    }

    /// Ends the process, which has no more time.
    pub(super) fn kill(&self) {
        let peer = self.peer.take();
        self.resource.take();
        match peer {
            Some(Peer::Process(mut process)) => process.kill(),
            Some(Peer::Embedded(script)) => script.close(),
            Some(Peer::Captured) | None => {}
        }
    }

    pub(super) fn queue(&self, call: SysCall, args: &[Data]) {
        let mut queued = self.queued.borrow_mut();
        if queued.len() < MAX_QUEUED {
            queued.push_back((call, args.to_vec()));
        }
    }

    pub(super) fn next_queued(&self) -> Option<(SysCall, Vec<Data>)> {
        self.queued.borrow_mut().pop_front()
    }

    /// Sends a message.
    ///
    /// # Errors
    /// When the process has ended.
    pub(super) fn send(&self, message: &[u8]) -> Result<(), ScriptError> {
        if let Some(script) = self.embedded() {
            return script.hand_over(message).map_err(ScriptError::new);
        }
        let send = || {
            let sent = match &mut *self.peer.borrow_mut() {
                Some(Peer::Process(process)) => process.send(message),
                _ => Err(PeerError::Closed),
            };
            sent.map_err(|error| self.ended(&error))
        };
        self.taped("a message to Python", send)
    }

    /// The next message that is no output; None when there is none within `limit`. Output is shown.
    ///
    /// # Errors
    /// When the process has ended, or the program is to end.
    pub(super) fn receive(
        &self,
        env: &Env,
        limit: Option<Duration>,
    ) -> Result<Option<Message>, ScriptError> {
        let mut printed = 0;
        let mut begun = None;
        self.received.set(self.received.get() + 1);
        self.look_after(env, self.received.get())?;
        loop {
            let wait = limit.map_or(POLL_INTERVAL, |limit| limit.min(POLL_INTERVAL));
            if let Some(message) = self.next_message(wait)? {
                let Some(message) = self.show(env, message, &mut printed)? else {
                    continue;
                };
                self.show_rest(env);
                return Ok(Some(message));
            }
            let begun = *begun.get_or_insert_with(wall_clock::now);
            let is_late = || limit.is_some_and(|limit| begun.elapsed() + wait >= limit);
            let tape = self.tape.borrow().clone();
            if tape.input("the timeout of Python", is_late) != Ok(false) {
                return Ok(None);
            }
            self.check_interruption(env)?;
        }
    }

    /// Looks whether the program is to end, once in a number of messages.
    ///
    /// # Errors
    /// When it is.
    pub(super) fn look_after(&self, env: &Env, messages: u64) -> Result<(), ScriptError> {
        if messages.is_multiple_of(CHECK_INTERVAL) {
            self.check_interruption(env)
        } else {
            Ok(())
        }
    }

    fn next_message(&self, limit: Duration) -> Result<Option<Message>, ScriptError> {
        let bytes = match self.embedded() {
            Some(script) => script.take(limit).map_err(ScriptError::new)?,
            None => self.taped("a message of Python", || {
                self.receive_of_process(limit)
                    .map_err(|error| self.ended(&error))
            })?,
        };
        bytes.map(|bytes| self.read(&bytes)).transpose()
    }

    /// What is asked of the process. When it has ended, a replay is without it as well.
    fn taped<T: Recorded>(
        &self,
        kind: &str,
        ask: impl FnOnce() -> Result<T, String>,
    ) -> Result<T, ScriptError> {
        let tape = self.tape.borrow().clone();
        let answer = tape.input(kind, ask);
        let answer = answer.unwrap_or_else(|lost| Err(lost.to_string()));
        answer.map_err(|reason| {
            self.peer.take();
            ScriptError::new(reason)
        })
    }

    fn receive_of_process(&self, limit: Duration) -> Result<Option<Vec<u8>>, PeerError> {
        match &mut *self.peer.borrow_mut() {
            Some(Peer::Process(process)) => process.receive(limit),
            _ => Err(PeerError::Closed),
        }
    }

    /// A message of the script. One that cannot be read ends it.
    pub(super) fn read(&self, bytes: &[u8]) -> Result<Message, ScriptError> {
        Message::read(bytes).map_err(|error| {
            self.kill();
            ScriptError::new(format!(
                "the Python process of this script sent what cannot be read: {error}"
            ))
        })
    }

    /// Shows output; another message comes back.
    pub(super) fn show(
        &self,
        env: &Env,
        message: Message,
        printed: &mut usize,
    ) -> Result<Option<Message>, ScriptError> {
        let Some(sim) = env.sim.upgrade() else {
            return Ok(Some(message));
        };
        let (Message::Print(text) | Message::Write(_, text)) = &message else {
            return Ok(Some(message));
        };
        *printed = printed.saturating_add(text.len() + 1);
        if *printed > MAX_PRINTED {
            self.kill();
            return Err(ScriptError::new(
                "the Python process of this script wrote more than 64 MiB in one call.",
            ));
        }
        let time = sim.clock.time();
        match &message {
            Message::Write(stream, text) => {
                let stream = if *stream == 2 {
                    OutputStream::Error
                } else {
                    OutputStream::Output
                };
                sim.log.write(text, stream, time);
            }
            _ => sim.log.print(text, time, env.script.id, || {
                env.script.log_name(&sim.scene.borrow())
            }),
        }
        self.check_interruption(env)?;
        Ok(None)
    }

    /// Logs what the process and programs it started wrote past the script's own output.
    fn show_rest(&self, env: &Env) {
        if self.embedded().is_some() {
            return;
        }
        let take = || match &*self.peer.borrow() {
            Some(Peer::Process(process)) => process.take_output(),
            _ => Default::default(),
        };
        let tape = self.tape.borrow().clone();
        let output = tape.input("the output beside Python", take);
        let (text, lost) = output.unwrap_or_default();
        if text.is_empty() {
            return;
        }
        let text = String::from_utf8_lossy(&text);
        text.lines()
            .for_each(|line| env.log(verbosity::SCRIPT_INFOS, line));
        if lost > 0 {
            env.log(
                verbosity::SCRIPT_WARNINGS,
                &format!("{lost} more bytes of output, which came too fast."),
            );
        }
    }

    fn check_interruption(&self, env: &Env) -> Result<(), ScriptError> {
        let interruption = env.interruption(|| "in a script in Python".into());
        let is_interrupted = || {
            env.sim
                .upgrade()
                .is_some_and(|sim| sim.options.is_interrupted())
        };
        match interruption {
            Some(text) => {
                self.kill();
                Err(ScriptError::new(text))
            }
            None if is_interrupted() => {
                self.kill();
                Err(ApiError::Interrupted.into())
            }
            None => Ok(()),
        }
    }

    /// Why the process is not there any more.
    fn ended(&self, error: &PeerError) -> String {
        self.resource.take();
        let Some(Peer::Process(mut process)) = self.peer.take() else {
            return "the Python process of this script has ended.".into();
        };
        let status = process.wait_for_end(END_TIMEOUT);
        let reason = match (error, status) {
            (_, Some(status)) => exit_text(status),
            (PeerError::Closed, None) => "it closed its connection".to_owned(),
            (error, None) => error.to_string(),
        };
        // Only a process that has ended says no more.
        let output = if status.is_some() {
            process.last_output()
        } else {
            process.take_output().0
        };
        let output = String::from_utf8_lossy(&output);
        let text = format!(
            "the Python process of this script has ended: {reason}.\n{}",
            output.trim_end()
        );
        text.trim_end().to_owned()
    }
}

/// How a process ended; its guardian reports a signal as shells do.
fn exit_text(status: ExitStatus) -> String {
    match status.code() {
        Some(code) if code > 128 => format!("signal {}", code - 128),
        Some(code) => format!("exit status {code}"),
        None => "it was killed".into(),
    }
}
