//! A session: a client, and the simulation that it looks at.
//!
//! The session belongs to the thread of the simulator. [`script::Debugger`] is how code reaches it; while it holds the code, it answers
//! requests until one lets the code go on. Requests that come meanwhile are answered between two iterations of the application's loop, or
//! in the middle of code that takes long.

mod answer;
mod inspect;
mod launching;
mod stop;

use std::cell::{Cell, RefCell};
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Duration;

use script::{Armed, Debugger, LoadedText, Place, Script, Sim};
use serde_json::{Value, json};

use crate::breakpoints::Breakpoints;
use crate::link::{Incoming, Link};
use crate::references::References;
use crate::request::{Request, event};
use crate::sources::{SourceKey, Sources};
use crate::stepping::Mode;
pub use launching::Launch;
use stop::Stop;

/// How long to wait for a message before looking whether the program is to end.
const POLL: Duration = Duration::from_millis(100);
/// How long to wait for the last messages to be written.
const LAST_WORDS: Duration = Duration::from_secs(2);

/// A place in a run: it can be found again in the same run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The simulation step.
    pub step: u64,
    /// How many armed traps code has come to in that step.
    pub lines: u64,
}

/// How the client wants the session to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The run ends, as if a person had stopped it.
    Terminate,
    /// The run ends, and begins again.
    Restart,
    /// The client goes, and the run ends.
    Disconnect,
}

/// A session with a client.
pub struct Session {
    link: Link,
    /// Whether the run goes on without a client.
    is_attached: bool,
    seq: Cell<i64>,
    mode: Cell<Mode>,
    pause: Cell<bool>,
    position: Cell<Position>,
    ending: Cell<Option<Ending>>,
    /// Code of the client runs, or the session is over: nothing stops.
    is_deaf: Cell<bool>,
    has_client: Cell<bool>,
    exceptions: Cell<Exceptions>,
    breakpoints: RefCell<Breakpoints>,
    sources: RefCell<Sources>,
    texts: RefCell<Vec<Rc<LoadedText>>>,
    references: RefCell<References>,
    stop: RefCell<Option<Stop>>,
    launch: RefCell<Launch>,
}

/// Which errors stop code.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Exceptions {
    caught: bool,
    uncaught: bool,
}

/// Whether the code goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Flow {
    Stay,
    GoOn,
}

impl Session {
    /// A session with the client of a connection. `is_attached`: the simulation does not wait for it, and goes on without it.
    pub fn new(link: Link, is_attached: bool) -> Rc<Self> {
        Rc::new(Self {
            link,
            is_attached,
            seq: Cell::new(0),
            mode: Cell::default(),
            pause: Cell::new(false),
            position: Cell::default(),
            ending: Cell::new(None),
            is_deaf: Cell::new(false),
            has_client: Cell::new(false),
            exceptions: Cell::default(),
            breakpoints: RefCell::default(),
            sources: RefCell::default(),
            texts: RefCell::default(),
            references: RefCell::default(),
            stop: RefCell::default(),
            launch: RefCell::default(),
        })
    }

    /// How the client wants the run to end; None as long as it does not.
    pub fn ending(&self) -> Option<Ending> {
        self.ending.get()
    }

    /// The place in the run that code has come to.
    pub fn position(&self) -> Position {
        self.position.get()
    }

    /// Sends text that scripts have printed, or the simulator has said. `category` is that of the protocol: `stdout`, `stderr`, `console`.
    pub fn print(&self, category: &str, text: &str) {
        if self.has_client.get() {
            self.send(event(
                "output",
                json!({"category": category, "output": text}),
            ));
        }
    }

    /// Says that the run is over, and with which exit code; everything is written when this returns.
    pub fn finish(&self, exit_code: u8) {
        self.send(event("exited", json!({"exitCode": exit_code})));
        self.send(event("terminated", Value::Null));
        self.link.finish(LAST_WORDS);
    }

    /// Prepares for another run with the same breakpoints.
    pub fn begin_again(&self) {
        self.ending.set(None);
        self.is_deaf.set(false);
        self.mode.set(Mode::Run);
        self.pause.set(false);
        self.position.set(Position::default());
        self.breakpoints.borrow_mut().forget_hits();
    }

    fn send(&self, mut message: Value) {
        let seq = self.seq.get() + 1;
        self.seq.set(seq);
        message["seq"] = json!(seq);
        self.link.send(&message);
    }

    /// Answers what has come; whether the code goes on.
    fn receive(&self, sim: Option<&Rc<Sim>>, incoming: Incoming) -> Flow {
        match incoming {
            Incoming::Connected => {
                self.has_client.set(true);
                Flow::Stay
            }
            Incoming::Gone(reason) => {
                if let Some(reason) = reason {
                    self.print(
                        "stderr",
                        &format!("the debugger ends the connection: {reason}\n"),
                    );
                }
                self.lose_client(sim)
            }
            Incoming::Message(message) => match Request::parse(&message) {
                Some(request) => self.answer(sim, &request),
                None => Flow::Stay,
            },
        }
    }

    /// Forgets what the client wanted. A simulation that it has launched ends.
    fn lose_client(&self, sim: Option<&Rc<Sim>>) -> Flow {
        self.has_client.set(false);
        self.breakpoints.borrow_mut().clear();
        self.exceptions.set(Exceptions::default());
        if self.is_attached {
            self.set_mode(sim, Mode::Run);
        } else {
            self.end(sim, Ending::Disconnect);
        }
        Flow::GoOn
    }

    /// The run is to end: nothing stops any more.
    fn end(&self, sim: Option<&Rc<Sim>>, ending: Ending) {
        self.ending.set(Some(ending));
        self.is_deaf.set(true);
        self.set_mode(sim, Mode::Run);
    }

    fn set_mode(&self, sim: Option<&Rc<Sim>>, mode: Mode) {
        let did_step = self.mode.replace(mode).steps();
        if did_step != mode.steps() || self.is_deaf.get() {
            self.arm_all(sim);
        }
    }

    /// Arms the traps of all scripts as breakpoints and steps want it.
    fn arm_all(&self, sim: Option<&Rc<Sim>>) {
        let Some(sim) = sim else { return };
        for (script, _) in sim.named_scripts() {
            self.arm(&script);
        }
    }

    fn arm(&self, script: &Rc<Script>) {
        let runtime = script.current_runtime();
        if let Some(debuggee) = runtime
            .as_ref()
            .and_then(|runtime| runtime.interpreter.debuggee())
        {
            debuggee.arm(&|text| self.armed(text));
        }
    }

    fn armed(&self, text: &LoadedText) -> Armed {
        if self.is_deaf.get() {
            Armed::Lines(std::collections::BTreeSet::new())
        } else if self.mode.get().steps() || self.pause.get() {
            Armed::All
        } else {
            Armed::Lines(self.breakpoints.borrow().lines(text))
        }
    }

    /// Counts the lines that code has come to.
    fn advance(&self, sim: &Sim) {
        let (step, before) = (sim.clock.steps(), self.position.get());
        let lines = if step == before.step {
            before.lines + 1
        } else {
            1
        };
        self.position.set(Position { step, lines });
    }

    fn note_text(&self, text: &Rc<LoadedText>) {
        let key = SourceKey::of(text);
        let is_new = self.sources.borrow_mut().add(text);
        let changed = self.breakpoints.borrow_mut().place(&key, text);
        self.texts
            .borrow_mut()
            .retain(|known| SourceKey::of(known) != key);
        self.texts.borrow_mut().push(Rc::clone(text));
        if is_new {
            let source = self.sources.borrow().describe(text);
            self.send(event(
                "loadedSource",
                json!({"reason": "new", "source": source}),
            ));
        }
        for breakpoint in changed {
            self.send(event(
                "breakpoint",
                json!({"reason": "changed", "breakpoint": breakpoint}),
            ));
        }
    }
}

impl Debugger for Session {
    fn text_loaded(&self, _: &Rc<Sim>, script: &Rc<Script>, text: &Rc<LoadedText>) {
        self.note_text(text);
        self.arm(script);
    }

    fn line_reached(&self, sim: &Rc<Sim>, place: &Place<'_>) {
        self.advance(sim);
        if !self.is_deaf.get() {
            self.consider_line(sim, place);
        }
    }

    fn error_raised(&self, sim: &Rc<Sim>, script: &Rc<Script>, message: &str, is_caught: bool) {
        let Exceptions { caught, uncaught } = self.exceptions.get();
        if !self.is_deaf.get() && if is_caught { caught } else { uncaught } {
            self.stop_at_error(sim, script, message, is_caught);
        }
    }

    fn scene_changed(&self, _: &Rc<Sim>, _: Option<&Rc<Script>>) {}

    fn look(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) {
        if self.stop.borrow().is_some() {
            return;
        }
        while let Some(incoming) = self.link.try_receive() {
            self.receive(Some(sim), incoming);
        }
        if self.pause.get() && !self.is_deaf.get() {
            self.stop_for_pause(sim, script);
        }
    }
}

/// A path in a request; relative ones begin in the folder of the program.
fn path(value: &Value) -> Option<PathBuf> {
    value.as_str().map(PathBuf::from)
}
