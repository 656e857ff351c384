//! Scripts in Python inside a program that has a Python itself: they need no process.
//!
//! The messages are those of a process. The program calls [`ScriptCalls`] with the messages of a script, and receives the requests of the simulator.

use std::cell::Cell;
use std::rc::{Rc, Weak};
use std::time::Duration;

use heap::{Handle, Outer, brought_in, enter_and_copy};

use super::conversation::Conversation;
use super::message::{self, Message};
use crate::binding::registry::Member;
use crate::host::Env;

/// The Python of the program that the simulator is a part of.
pub trait PythonHost {
    /// Makes a script without a text.
    ///
    /// `modules` are the names and texts of the modules that it is made of, as a list in Python's `marshal` format. The last one,
    /// `swanilda_embedded`, has a class `Embedded` with the functions of [`EmbeddedScript`].
    ///
    /// # Errors
    /// When Python cannot run scripts.
    fn start(&self, modules: &[u8], calls: ScriptCalls) -> Result<Rc<dyn EmbeddedScript>, String>;
}

/// A script that runs in the program's Python. Errors are texts for people.
pub trait EmbeddedScript {
    /// Passes a request to the script and returns its answer.
    ///
    /// # Errors
    /// When Python ends, or the user has pressed ctrl-c.
    fn ask(&self, message: &[u8]) -> Result<Vec<u8>, String>;

    /// Starts the thread of the script with its first call, or answers what it has called.
    ///
    /// # Errors
    /// As of [`Self::ask`].
    fn hand_over(&self, message: &[u8]) -> Result<(), String>;

    /// The next message of the script's thread; None when there is none within `limit`.
    ///
    /// # Errors
    /// As of [`Self::ask`].
    fn take(&self, limit: Duration) -> Result<Option<Vec<u8>>, String>;

    /// Ends the script and its thread.
    fn close(&self);
}

/// What a script in the program's Python calls.
pub struct ScriptCalls {
    env: Weak<Env>,
    count: Cell<u64>,
    heap: Option<Handle>,
}

impl ScriptCalls {
    pub(super) fn new(env: &Rc<Env>) -> Self {
        Self {
            env: Rc::downgrade(env),
            count: Cell::new(0),
            heap: Handle::current(),
        }
    }

    /// Whether the function of that name returns at once: it reads or sets values, and runs no script.
    pub fn is_short(&self, name: &str) -> bool {
        let member = self.env.upgrade().and_then(|env| env.registry.find(name));
        member.is_some_and(|member| is_short(name, &member))
    }

    /// Handles a message of the script; returns the answer, which is empty when there is none.
    ///
    /// # Errors
    /// When the script has ended or is to end.
    pub fn serve(&self, message: &[u8]) -> Result<Vec<u8>, String> {
        enter_and_copy(self.heap, || self.serve_inside(message))
    }

    fn serve_inside(&self, message: &[u8]) -> Result<Vec<u8>, String> {
        let env = self.env.upgrade().ok_or("the script has ended.")?;
        let link = Conversation::link_of(&env);
        self.count.set(self.count.get() + 1);
        link.look_after(&env, self.count.get())
            .map_err(|error| error.text)?;
        let (name, args) = match Message::read(message).map_err(|error| error.to_string())? {
            Message::Call(name, args) => (name, args),
            Message::BadCall(reason) => return Ok(message::error(&reason)),
            output => {
                let shown = link.show(&env, output, &mut 0);
                return shown.map(|_| Vec::new()).map_err(|error| error.text);
            }
        };
        Ok(Conversation {
            env: &env,
            link: &link,
        }
        .answer_of(&name, &args))
    }
}

/// A script in the program's memory.
pub(super) struct OutsideScript(Outer<Rc<dyn EmbeddedScript>>);

impl OutsideScript {
    /// What `host` starts, in its own memory.
    pub(super) fn start(
        host: &dyn PythonHost,
        modules: &[u8],
        calls: ScriptCalls,
    ) -> Result<Self, String> {
        let script = heap::outside(|| host.start(modules, calls));
        match script {
            Ok(script) => Ok(Self(Outer::new(script))),
            Err(reason) => Err(brought_in(move || reason)),
        }
    }
}

impl EmbeddedScript for OutsideScript {
    fn ask(&self, message: &[u8]) -> Result<Vec<u8>, String> {
        brought_in(|| self.0.with(|script| script.ask(message)))
    }

    fn hand_over(&self, message: &[u8]) -> Result<(), String> {
        brought_in(|| self.0.with(|script| script.hand_over(message)))
    }

    fn take(&self, limit: Duration) -> Result<Option<Vec<u8>>, String> {
        brought_in(|| self.0.with(|script| script.take(limit)))
    }

    fn close(&self) {
        self.0.with(|script| script.close());
    }
}

/// Whether a function returns at once: it reads or sets values, and runs no script.
pub fn is_short(name: &str, member: &Member) -> bool {
    const SHORT: &[&str] = &["get", "set", "is", "has", "pack", "unpack", "read", "write"];
    let name = name
        .strip_prefix("sim.")
        .filter(|_| matches!(member, Member::Native(_)));
    name.is_some_and(|name| SHORT.iter().any(|verb| name.starts_with(verb)))
}
