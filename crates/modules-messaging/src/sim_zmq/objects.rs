//! The contexts, sockets and messages of one script, by the handles it has of them.
//!
//! A handle is a text, `<hexadecimal number>:zmq.<kind>`. The number holds that of the script, so that nobody takes the object of another
//! script for his own. The context all scripts share has a number of its own.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use crate::{ApiError, Cx, Result};
use io::zmq::{Context, Errno, Message, Socket, Termination, ZmqResult};
use script::States;

/// The number of the context all scripts of a simulator share.
const SINGLETON: u64 = 1;
/// Handles of one script.
const NUMBERS_PER_SCRIPT: u64 = 1 << 32;
/// Contexts of one script: each has threads.
const MAX_CONTEXTS: usize = 64;

const CONTEXT: &str = "zmq.context";
const SOCKET: &str = "zmq.socket";
const MESSAGE: &str = "zmq.msg";

/// State shared by the scripts of a simulator.
#[derive(Default)]
struct Shared {
    /// The context with the number `SINGLETON`; made at first need.
    context: OnceCell<Rc<Context>>,
    /// A share of it is held for each script that has sockets.
    users: Rc<()>,
}

/// Whether some script has ZeroMQ sockets. Nothing wakes the simulator for those: scripts look whether a message has come.
pub fn has_sockets(states: &States) -> bool {
    states
        .existing::<Shared>()
        .is_some_and(|shared| Rc::strong_count(&shared.users) > 1)
}

/// Sockets and messages of the calling script. They are closed with the script's state.
#[derive(Default)]
pub(super) struct Objects {
    messages: RefCell<BTreeMap<u64, Message>>,
    sockets: RefCell<BTreeMap<u64, Rc<Socket>>>,
    contexts: RefCell<BTreeMap<u64, Life>>,
    /// Records that there are sockets.
    presence: RefCell<Option<Rc<()>>>,
    last: Cell<u64>,
    /// Why the last call that failed did.
    errno: Cell<i32>,
}

/// A context from its beginning to its end.
enum Life {
    Open(Rc<Context>),
    Ending(Termination),
}

pub(super) fn objects(cx: &Cx) -> Rc<Objects> {
    cx.script_state()
}

fn invalid() -> ApiError {
    ApiError::Other("invalid object handle".into())
}

fn number(handle: &str, kind: &str) -> Result<u64> {
    let (digits, named) = handle.split_once(':').ok_or_else(invalid)?;
    let number = u64::from_str_radix(digits, 16)
        .ok()
        .filter(|_| named == kind);
    number.ok_or_else(invalid)
}

fn handle(number: u64, kind: &str) -> String {
    format!("{number:x}:{kind}")
}

/// The handle of a socket that could not be created.
pub(super) fn no_socket() -> String {
    handle(0, SOCKET)
}

fn warn_of_lost_events(cx: &Cx, socket: &Socket) {
    if socket.has_lost_events() {
        cx.env().warn_once(
            "simZMQ.socket_monitor",
            "events of a ZeroMQ monitor were lost: nobody reads them.",
        );
    }
}

/// The context all scripts share, made when it is first asked for.
fn singleton(cx: &Cx) -> ZmqResult<Rc<Context>> {
    let shared = cx.module_state::<Shared>();
    if let Some(context) = shared.context.get() {
        return Ok(context.clone());
    }
    let context = Rc::new(Context::lasting()?);
    Ok(shared.context.get_or_init(|| context).clone())
}

pub(super) fn singleton_handle() -> String {
    handle(SINGLETON, CONTEXT)
}

/// Fails for the context shared by all scripts, which may not be ended; `done` is the verb of the message.
pub(super) fn forbid_singleton(context: &str, done: &str) -> Result<()> {
    if number(context, CONTEXT)? == SINGLETON {
        return Err(ApiError::Other(format!(
            "singleton context must not be {done}"
        )));
    }
    Ok(())
}

impl Objects {
    /// The result of a call; -1 if it failed, and then errnum returns the reason.
    pub(super) fn result_code<T: Into<i64>>(&self, outcome: ZmqResult<T>) -> i64 {
        outcome.map_or_else(|errno| self.failed(errno), Into::into)
    }

    /// 0; -1 if the call failed, and then errnum returns the reason.
    pub(super) fn done(&self, outcome: ZmqResult<()>) -> i64 {
        self.result_code(outcome.map(|()| 0))
    }

    pub(super) fn failed(&self, errno: Errno) -> i64 {
        self.errno.set(errno.0);
        -1
    }

    pub(super) fn errno(&self) -> i64 {
        self.errno.get().into()
    }

    fn next(&self, cx: &Cx) -> u64 {
        self.last.set(self.last.get() + 1);
        cx.script().id.unsigned_abs() * NUMBERS_PER_SCRIPT + self.last.get()
    }

    pub(super) fn add_context(&self, cx: &Cx, context: Context) -> Result<String> {
        if self.contexts.borrow().len() >= MAX_CONTEXTS {
            return Err(ApiError::Other(format!(
                "too many contexts: a script may have {MAX_CONTEXTS}"
            )));
        }
        let number = self.next(cx);
        self.contexts
            .borrow_mut()
            .insert(number, Life::Open(Rc::new(context)));
        Ok(handle(number, CONTEXT))
    }

    pub(super) fn context(&self, cx: &Cx, context: &str) -> Result<Rc<Context>> {
        let number = number(context, CONTEXT)?;
        if number == SINGLETON {
            return singleton(cx).map_err(|_| invalid());
        }
        match self.contexts.borrow().get(&number) {
            Some(Life::Open(context)) => Ok(context.clone()),
            _ => Err(invalid()),
        }
    }

    /// Makes the sockets of a context answer that it is over.
    pub(super) fn shut_down(&self, context: &Rc<Context>) -> ZmqResult<()> {
        let sockets = self.sockets.borrow();
        sockets
            .values()
            .filter(|socket| socket.is_in(context))
            .for_each(|socket| socket.limit_linger());
        context.shutdown()
    }

    /// Ends a context, and waits as long as `wait` does; whether it has ended. It cannot while it has sockets.
    pub(super) fn end_context(
        &self,
        context: &str,
        wait: impl FnOnce(&Termination) -> bool,
    ) -> Result<ZmqResult<()>> {
        let number = number(context, CONTEXT)?;
        let mut contexts = self.contexts.borrow_mut();
        let termination = match contexts.remove(&number).ok_or_else(invalid)? {
            Life::Ending(termination) => termination,
            Life::Open(context) => match Rc::try_unwrap(context) {
                Ok(context) => context.terminate(),
                Err(in_use) => {
                    let outcome = self.shut_down(&in_use);
                    contexts.insert(number, Life::Open(in_use));
                    return Ok(outcome.and(Err(Errno::INTERRUPTED)));
                }
            },
        };
        if wait(&termination) {
            return Ok(Ok(()));
        }
        contexts.insert(number, Life::Ending(termination));
        Ok(Err(Errno::INTERRUPTED))
    }

    pub(super) fn add_socket(&self, cx: &Cx, socket: Socket) -> String {
        let number = self.next(cx);
        self.sockets.borrow_mut().insert(number, Rc::new(socket));
        self.presence
            .replace(Some(cx.module_state::<Shared>().users.clone()));
        handle(number, SOCKET)
    }

    pub(super) fn socket(&self, cx: &Cx, socket: &str) -> Result<Rc<Socket>> {
        let socket = self
            .sockets
            .borrow()
            .get(&number(socket, SOCKET)?)
            .cloned()
            .ok_or_else(invalid)?;
        warn_of_lost_events(cx, &socket);
        Ok(socket)
    }

    pub(super) fn take_socket(&self, cx: &Cx, socket: &str) -> Result<Rc<Socket>> {
        let mut sockets = self.sockets.borrow_mut();
        let socket = sockets
            .remove(&number(socket, SOCKET)?)
            .ok_or_else(invalid)?;
        warn_of_lost_events(cx, &socket);
        if sockets.is_empty() {
            self.presence.take();
        }
        Ok(socket)
    }

    pub(super) fn add_message(&self, cx: &Cx) -> String {
        let number = self.next(cx);
        self.messages.borrow_mut().insert(number, Message::closed());
        handle(number, MESSAGE)
    }

    /// Calls `f` with a message and returns its result.
    pub(super) fn with_message<R>(
        &self,
        message: &str,
        f: impl FnOnce(&mut Message) -> R,
    ) -> Result<R> {
        self.messages
            .borrow_mut()
            .get_mut(&number(message, MESSAGE)?)
            .map(f)
            .ok_or_else(invalid)
    }

    pub(super) fn remove_message(&self, message: &str) -> Result<()> {
        self.messages
            .borrow_mut()
            .remove(&number(message, MESSAGE)?)
            .map(drop)
            .ok_or_else(invalid)
    }
}

impl Drop for Objects {
    fn drop(&mut self) {
        self.sockets.take();
        let endings = self
            .contexts
            .take()
            .into_values()
            .filter_map(|life| match life {
                Life::Open(context) => Rc::try_unwrap(context).ok().map(Context::terminate),
                Life::Ending(termination) => Some(termination),
            });
        Termination::wait_for_all(endings);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handle_is_a_number_and_a_kind() {
        assert_eq!(number(&handle(0xabc, SOCKET), SOCKET), Ok(0xabc));
        for bad in [
            "",
            ":",
            "zmq.socket",
            "1",
            "1:zmq.msg",
            "x:zmq.socket",
            "-1:zmq.socket",
            "1:zmq.socket:",
        ] {
            assert_eq!(number(bad, SOCKET), Err(invalid()), "{bad}");
        }
    }
}
