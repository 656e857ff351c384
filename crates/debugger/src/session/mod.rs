//! A session: a client, and the simulation that it debugs.
//!
//! The session belongs to the thread of the simulator. [`script::Debugger`] is how code reaches it; while it holds the code, it answers
//! requests until one lets the code go on. Requests that come meanwhile are answered between two iterations of the application's loop, or
//! in the middle of code that takes long.

mod answer;
mod inspect;
mod launching;
mod stop;
mod travel;

use std::cell::{Cell, RefCell};
use std::collections::{BTreeSet, VecDeque};
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Duration;

use script::{Armed, Debuggee, Debugger, LoadedText, Place, Script, Sim};
use serde_json::{Value, json};

use crate::breakpoints::Breakpoints;
use crate::client::{Client, Incoming};
use crate::data::DataBreakpoints;
use crate::references::References;
use crate::request::{Request, event};
use crate::sources::{SourceKey, Sources};
use crate::stepping::{Mode, Origin};
pub(crate) use inspect::asked;
pub use launching::Launch;
use stop::Stop;
use travel::Goal;
pub use travel::Travel;

/// How long to wait for a message before looking whether the program is to end.
const POLL: Duration = Duration::from_millis(100);
/// How often to wait that long for the last message of a client.
const LAST_POLLS: u32 = 30;
/// How long to wait for the last messages to be written.
const FLUSH_TIMEOUT: Duration = Duration::from_secs(2);

/// A place in a run: it can be found again in a replay, where all traps are armed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The iteration of the application's loop, from 1.
    pub turn: usize,
    /// How many things have happened in it where code can stop: lines, calls, errors.
    pub events: u64,
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
    client: Box<dyn Client>,
    /// Whether the run goes on without a client.
    is_attached: bool,
    seq: Cell<i64>,
    mode: Cell<Mode>,
    pause: Cell<bool>,
    /// Code was asked to pause, and has not come to a line since.
    pause_is_late: Cell<bool>,
    position: Cell<Position>,
    ending: Cell<Option<Ending>>,
    /// Code of the client runs, or the session is over: nothing stops.
    ignores_code: Cell<bool>,
    has_client: Cell<bool>,
    exceptions: Cell<Exceptions>,
    breakpoints: RefCell<Breakpoints>,
    data: RefCell<DataBreakpoints>,
    /// The last error that was reported: who passes it on raises it again.
    last_error: RefCell<String>,
    /// What came while an expression of the client was evaluated.
    postponed: RefCell<VecDeque<Incoming>>,
    sources: RefCell<Sources>,
    texts: RefCell<Vec<Rc<LoadedText>>>,
    references: RefCell<References>,
    stop: RefCell<Option<Stop>>,
    launch: RefCell<Launch>,
    /// A capture is replayed: the session can go back.
    is_replay: Cell<bool>,
    /// It is loaded.
    can_travel: Cell<bool>,
    /// What the replay runs for.
    goal: RefCell<Goal>,
    /// The last stop: its position, and where a step back from there begins.
    last_stop: Cell<(Position, Option<Origin>)>,
    /// Where the client wants to go.
    travel: Cell<Option<Travel>>,
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
    /// A session with a client. `is_attached`: the simulation does not wait for it, and goes on without it.
    pub fn new(client: impl Client + 'static, is_attached: bool) -> Rc<Self> {
        if !is_attached {
            client.force_end_on_request();
        }
        Rc::new(Self {
            client: Box::new(client),
            is_attached,
            seq: Cell::new(0),
            mode: Cell::default(),
            pause: Cell::new(false),
            pause_is_late: Cell::new(false),
            position: Cell::default(),
            ending: Cell::new(None),
            ignores_code: Cell::new(false),
            has_client: Cell::new(false),
            exceptions: Cell::default(),
            breakpoints: RefCell::default(),
            data: RefCell::default(),
            last_error: RefCell::default(),
            postponed: RefCell::default(),
            sources: RefCell::default(),
            texts: RefCell::default(),
            references: RefCell::default(),
            stop: RefCell::default(),
            launch: RefCell::default(),
            is_replay: Cell::new(false),
            can_travel: Cell::new(false),
            goal: RefCell::default(),
            last_stop: Cell::default(),
            travel: Cell::new(None),
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

    /// The place where code has stopped last.
    pub fn last_stop(&self) -> Position {
        self.last_stop.get().0
    }

    /// Sends text that scripts have printed, or the simulator has said. `category` is that of the protocol: `stdout`, `stderr`, `console`.
    pub fn print(&self, category: &str, text: &str) {
        if self.has_client.get() && self.goal.borrow().is_live() {
            self.send(event(
                "output",
                json!({"category": category, "output": text}),
            ));
        }
    }

    /// Says that the run is over, and with which exit code, and waits a moment for the client to disconnect; everything is written when this
    /// returns.
    pub fn finish(&self, exit_code: u8) {
        let has_client = self.has_client.get();
        self.send(event("exited", json!({"exitCode": exit_code})));
        self.send(event("terminated", Value::Null));
        for _ in 0..LAST_POLLS {
            if !has_client || self.receives_disconnect() {
                break;
            }
        }
        self.client.finish(FLUSH_TIMEOUT);
    }

    /// Answers what comes after the end; whether the client is done.
    fn receives_disconnect(&self) -> bool {
        match self.client.receive(POLL) {
            Some(Incoming::Gone(_)) => true,
            Some(Incoming::Message(message)) => {
                let Some(request) = Request::parse(&message) else {
                    return false;
                };
                let is_disconnect = request.command == "disconnect";
                let over = "the run is over".to_owned();
                let result = if is_disconnect {
                    Ok(Value::Null)
                } else {
                    Err(over)
                };
                self.send(request.answer(result));
                is_disconnect
            }
            Some(Incoming::Connected) | None => false,
        }
    }

    /// Prepares for another run with the same breakpoints.
    pub fn begin_again(&self) {
        self.ending.set(None);
        self.ignores_code.set(false);
        self.mode.set(Mode::Run);
        self.pause.set(false);
        self.position.set(Position::default());
        self.goal.replace(Goal::default());
        self.travel.set(None);
        self.breakpoints.borrow_mut().forget_hits();
    }

    fn send(&self, mut message: Value) {
        let seq = self.seq.get() + 1;
        self.seq.set(seq);
        message["seq"] = json!(seq);
        self.client.send(&message);
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
        self.data.replace(DataBreakpoints::default());
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
        self.ignores_code.set(true);
        self.set_mode(sim, Mode::Run);
    }

    fn set_mode(&self, sim: Option<&Rc<Sim>>, mode: Mode) {
        let did_step = self.mode.replace(mode).steps();
        if did_step != mode.steps() || self.ignores_code.get() {
            self.arm_all(sim);
        }
    }

    /// Remembers the coroutine where a step begins.
    fn remember(&self, sim: &Rc<Sim>) {
        if let Some(origin) = self.mode.get().origin() {
            let remember = |debuggee: &dyn Debuggee| {
                debuggee.remember();
                Ok(())
            };
            // A script that has ended has nothing to remember.
            let _ = inspect::asked(sim, origin.script, remember);
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
        if self.is_replay.get() {
            // They are counted, see `Position`.
            Armed::All
        } else if self.ignores_code.get() {
            Armed::Lines(BTreeSet::new())
        } else if self.mode.get().steps() || self.pause.get() {
            Armed::All
        } else {
            Armed::Lines(self.breakpoints.borrow().lines(text))
        }
    }

    /// Counts what has happened, and goes to the next position.
    fn advance(&self) {
        let Position { turn, events } = self.position.get();
        let events = events + 1;
        self.position.set(Position { turn, events });
    }

    fn note_text(&self, text: &LoadedText) {
        // Kept longer than the simulator may have it.
        let text = &Rc::new(text.clone());
        let key = SourceKey::of(text);
        let is_new = self.sources.borrow_mut().add(text);
        let changed = self.breakpoints.borrow_mut().place(text);
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
        self.advance();
        self.last_error.borrow_mut().clear();
        if self.listens(sim) {
            self.consider_line(sim, place);
        }
    }

    fn error_raised(&self, sim: &Rc<Sim>, script: &Rc<Script>, message: &str, is_caught: bool) {
        self.advance();
        let Exceptions { caught, uncaught } = self.exceptions.get();
        let last = self.last_error.replace(message.to_owned());
        let is_passed_on = !last.is_empty() && message != last && message.contains(&last);
        let matters = if is_caught { caught } else { uncaught };
        if matters && !is_passed_on && self.listens(sim) {
            self.stop_at_error(sim, script, message, is_caught);
        }
    }

    fn scene_changed(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) {
        if self.stop.borrow().is_some() {
            return;
        }
        self.advance();
        if !self.ignores_code.get() && !sim.is_abandoned() && !self.data.borrow().is_empty() {
            self.consider_changes(sim, script);
        }
    }

    fn answer_requests(&self, sim: &Rc<Sim>, script: Option<&Rc<Script>>) -> bool {
        if self.stop.borrow().is_some() {
            return self.poll_while_stopped();
        }
        if script.is_none() {
            let turn = self.position.get().turn + 1;
            self.position.set(Position { turn, events: 0 });
        }
        while self.goal.borrow().is_live()
            && let Some(incoming) = self.client.try_receive()
        {
            self.receive(Some(sim), incoming);
        }
        // In the middle of code, the next line is a better place, if there is one: expressions can be interrupted there.
        let waits_for_line = script.is_some() && !self.pause_is_late.replace(true);
        if self.pause.get() && !waits_for_line && self.listens(sim) {
            self.stop_for_pause(sim, script);
        }
        self.ending.get().is_some()
    }
}

impl Session {
    /// An expression of the client takes long. It ends when the client does not want to wait for it.
    fn poll_while_stopped(&self) -> bool {
        let mut postponed = self.postponed.borrow_mut();
        while let Some(incoming) = self.client.try_receive() {
            postponed.push_back(incoming);
        }
        postponed.iter().any(|incoming| match incoming {
            Incoming::Message(message) => {
                let command = message["command"].as_str().unwrap_or_default();
                ["cancel", "disconnect", "terminate", "restart", "continue"].contains(&command)
            }
            Incoming::Gone(_) => true,
            Incoming::Connected => false,
        })
    }

    /// The next message, after those that came while an expression was evaluated.
    fn next_incoming(&self, sim: &Rc<Sim>) -> Option<Incoming> {
        let postponed = self.postponed.borrow_mut().pop_front();
        postponed.or_else(|| self.client.receive_while_stopped(sim, POLL))
    }
}

/// A path in a request; relative ones begin in the folder of the program.
fn path(value: &Value) -> Option<PathBuf> {
    value.as_str().map(PathBuf::from)
}
