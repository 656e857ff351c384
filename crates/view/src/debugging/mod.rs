//! Pages that debug scripts: they are the client of a debugger in this process, in the messages of the Debug Adapter Protocol.
//!
//! Their requests wait where all requests wait. The debugger takes those that are for it on the simulator's thread: between iterations, in the
//! midst of code that goes on for long, and while code stands still. Meanwhile the others are answered here, as far as that needs no simulation
//! that goes on, so that a page which has stopped the code holds up no other page.

mod breakpoints;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::perform::scripts;
use crate::request::{Action, Breakpoint, Debug};
use crate::server::{Pending, Shared};
use ::debugger::{Client, Incoming, Link, Session};
use breakpoints::Placed;
use script::{Sim, wall_clock};

/// How often a simulator that stands still looks for requests.
const POLL: Duration = Duration::from_millis(20);
/// Code that stands still goes on when there is no page for so long: one that is loaded anew comes back.
const ALONE: Duration = Duration::from_secs(5);

/// Lets pages debug scripts, and see where others have stopped them.
#[derive(Clone)]
pub struct Debugging {
    pub(crate) shared: Arc<Shared>,
    state: Rc<RefCell<State>>,
    is_read_only: bool,
    /// What is evaluated would be missing in the capture of the run.
    is_captured: bool,
}

/// Where pages have breakpoints, and what they wait for.
#[derive(Default)]
struct State {
    is_connected: bool,
    /// By the handles of scripts.
    breakpoints: BTreeMap<i64, Vec<Placed>>,
    /// Requests without answers, by their numbers.
    asked: BTreeMap<i64, Asked>,
    seq: i64,
    /// For the debugger, before what pages ask for.
    next: VecDeque<Incoming>,
    /// Where everything stands still.
    stop: Option<Value>,
    /// A page has stopped the simulation meanwhile.
    leaves: bool,
    /// Since when there has been no page.
    alone: Option<Instant>,
}

/// A request to the debugger.
enum Asked {
    /// The breakpoints of a script; the page that wants them, unless they are only set again.
    Breakpoints(i64, Vec<Breakpoint>, Option<Pending>),
    Command(Pending),
}

impl Debugging {
    /// For pages that are not connected yet. With `is_read_only` they only see where scripts stand still.
    pub fn new(is_read_only: bool, is_captured: bool) -> Self {
        Self {
            shared: Arc::new(Shared::new(is_read_only)),
            state: Rc::default(),
            is_read_only,
            is_captured,
        }
    }

    pub(crate) fn is_read_only(&self) -> bool {
        self.is_read_only
    }

    /// The session of a simulator: of the client at a connection, or of the pages; None where nobody debugs.
    pub fn session(&self, link: Option<Link>) -> Option<Rc<Session>> {
        if link.is_none() && self.is_read_only {
            return None;
        }
        if link.is_none() {
            self.shared.allow_debugging();
        }
        let pages = self.clone();
        Some(Session::new(Clients { link, pages }, true))
    }

    /// A request to the debugger, as the protocol has it.
    fn request(&self, command: &str, arguments: Value, asked: Option<Asked>) -> Incoming {
        let mut state = self.state.borrow_mut();
        state.seq += 1;
        let seq = state.seq;
        if let Some(asked) = asked {
            state.asked.insert(seq, asked);
        }
        let message =
            json!({ "type": "request", "seq": seq, "command": command, "arguments": arguments });
        Incoming::Message(message)
    }

    fn try_receive(&self) -> Option<Incoming> {
        if !std::mem::replace(&mut self.state.borrow_mut().is_connected, true) {
            return Some(Incoming::Connected);
        }
        let next = self.state.borrow_mut().next.pop_front();
        next.or_else(|| self.next_of_pages())
    }

    fn next_of_pages(&self) -> Option<Incoming> {
        let is_debug = |action: &Action| matches!(action, Action::Debug(_));
        while let Some(pending) = self.shared.next_of(Duration::ZERO, is_debug) {
            let Action::Debug(debug) = pending.action.clone() else {
                break;
            };
            match self.refusal(&debug) {
                Some(reason) => self.answer(&pending, Err(reason)),
                None => return Some(self.incoming(debug, pending)),
            }
        }
        None
    }

    fn refusal(&self, debug: &Debug) -> Option<String> {
        let state = self.state.borrow();
        if self.is_captured && debug.may_change_variables() {
            return Some("the run is captured: what is evaluated would not be in it".into());
        }
        let needs_stop = matches!(debug, Debug::Command { name, .. } if name != "source");
        (needs_stop && state.stop.is_none()).then(|| "no script stands still".to_owned())
    }

    fn incoming(&self, debug: Debug, pending: Pending) -> Incoming {
        match debug {
            Debug::Set {
                script,
                breakpoints,
            } => self.set(script, breakpoints, Some(pending)),
            Debug::Command { name, arguments } => {
                self.request(&name, arguments, Some(Asked::Command(pending)))
            }
        }
    }

    fn set(&self, script: i64, wanted: Vec<Breakpoint>, pending: Option<Pending>) -> Incoming {
        let list: Vec<Value> = wanted.iter().map(Breakpoint::to_json).collect();
        let arguments = json!({ "source": { "script": script }, "breakpoints": list });
        let asked = Asked::Breakpoints(script, wanted, pending);
        self.request("setBreakpoints", arguments, Some(asked))
    }

    /// A page has its answer.
    fn answer(&self, pending: &Pending, result: Result<Value, String>) {
        pending.answer(result);
        self.shared.wake();
    }

    fn receive_while_stopped(&self, sim: &Rc<Sim>) -> Option<Incoming> {
        self.answer_others(sim);
        let incoming = self.try_receive();
        if incoming.is_some() {
            return incoming;
        }
        if self.is_being_stopped(sim) {
            return Some(self.request("continue", Value::Null, None));
        }
        if self.is_left_alone() {
            return Some(self.gone());
        }
        self.shared.wait_for_request(POLL);
        None
    }

    /// Whether a page has stopped the simulation where code stood still: the rest of it goes on to its end.
    fn is_being_stopped(&self, sim: &Rc<Sim>) -> bool {
        let is_asked = self.shared.stop_is_requested();
        let mut state = self.state.borrow_mut();
        state.leaves = is_asked || (state.leaves && sim.clock.is_ending());
        state.leaves
    }

    /// Whether nobody is left who could let the code go on.
    fn is_left_alone(&self) -> bool {
        let mut state = self.state.borrow_mut();
        if self.shared.has_pages() {
            state.alone = None;
            return false;
        }
        let since = *state.alone.get_or_insert_with(wall_clock::now);
        wall_clock::now().duration_since(since) > ALONE
    }

    /// The pages are gone, and their breakpoints.
    fn gone(&self) -> Incoming {
        let mut state = self.state.borrow_mut();
        state.is_connected = false;
        state.alone = None;
        state.breakpoints.clear();
        drop(state);
        self.show_breakpoints();
        Incoming::Gone(None)
    }

    /// Requests that are not for the debugger. A stop of the simulation is carried out when the code has gone on.
    fn answer_others(&self, sim: &Rc<Sim>) {
        let is_other = |action: &Action| !matches!(action, Action::Debug(_) | Action::Stop);
        while let Some(pending) = self.shared.next_of(Duration::ZERO, is_other) {
            let answer = self.answer_of(sim, &pending.action);
            self.answer(&pending, answer);
        }
    }

    fn answer_of(&self, sim: &Rc<Sim>, action: &Action) -> Result<Value, String> {
        match action {
            Action::Script(handle) => {
                let found = sim.copied_out(|sim| Some(sim.text_of(&*sim.script(*handle)?)));
                let found = found.ok_or("there is no such script")?;
                Ok(scripts::described(found))
            }
            Action::Inspect(None) => Ok(true.into()),
            Action::Play if self.shared.has_debugger() => {
                let go_on = self.request("continue", Value::Null, None);
                self.state.borrow_mut().next.push_back(go_on);
                Ok(true.into())
            }
            _ => Err(format!("{}: let it go on first", self.sentence())),
        }
    }

    /// Where everything stands still.
    fn sentence(&self) -> String {
        let state = self.state.borrow();
        let stop = state.stop.as_ref().unwrap_or(&Value::Null);
        let title = stop["title"].as_str().unwrap_or("a script");
        match stop["line"].as_u64() {
            Some(line) => format!("{title} stands still in line {line}"),
            None => "the simulation stands still".to_owned(),
        }
    }

    /// What the debugger sends.
    fn note(&self, message: &Value) {
        match message["type"].as_str() {
            Some("response") => self.note_response(message),
            Some("event") if message["event"] == "breakpoint" => {
                self.note_placed(&message["body"]["breakpoint"]);
            }
            Some("event") if message["event"] == "output" => self.print(&message["body"]),
            _ => {}
        }
    }

    fn note_response(&self, message: &Value) {
        let seq = message["request_seq"].as_i64().unwrap_or_default();
        let asked = self.state.borrow_mut().asked.remove(&seq);
        let result = match (message["success"].as_bool(), message.get("body")) {
            (Some(true), body) => Ok(body.cloned().unwrap_or(true.into())),
            (_, _) => Err(message["message"].as_str().unwrap_or_default().to_owned()),
        };
        match asked {
            Some(Asked::Breakpoints(script, wanted, pending)) => {
                let result = result.map(|body| self.note_set(script, &wanted, &body));
                if let Some(pending) = pending {
                    self.answer(&pending, result.map(|()| true.into()));
                }
            }
            Some(Asked::Command(pending)) => self.answer(&pending, result),
            None => {}
        }
    }

    /// A line for the console of pages.
    fn print(&self, body: &Value) {
        let text = body["output"].as_str().unwrap_or_default().trim_end();
        let line = json!({ "time": 0, "level": "infos", "origin": "debugger", "text": text });
        let mut mirror = self.shared.mirror();
        mirror.show_lines(vec![line.to_string()], true);
        drop(mirror);
        self.shared.wake();
    }

    fn note_stop(&self, place: Option<&Value>) {
        self.state.borrow_mut().stop = place.cloned();
        // Who watches over code that does not end leaves it alone.
        self.shared.set_asking(place.is_some());
        let text = place.unwrap_or(&Value::Null).to_string();
        self.shared.mirror().show_list("stopped", &text);
        self.shared.wake();
    }
}

/// The client at a connection if there is one, else the pages.
struct Clients {
    link: Option<Link>,
    pages: Debugging,
}

impl Client for Clients {
    fn try_receive(&self) -> Option<Incoming> {
        match &self.link {
            Some(link) => link.try_receive(),
            None => self.pages.try_receive(),
        }
    }

    fn receive(&self, timeout: Duration) -> Option<Incoming> {
        match &self.link {
            Some(link) => link.receive(timeout),
            None => self.pages.try_receive(),
        }
    }

    fn receive_while_stopped(&self, sim: &Rc<Sim>, _: Duration) -> Option<Incoming> {
        match &self.link {
            Some(link) => {
                self.pages.answer_others(sim);
                link.receive(POLL)
            }
            None => self.pages.receive_while_stopped(sim),
        }
    }

    fn send(&self, message: &Value) {
        match &self.link {
            Some(link) => link.send(message),
            None => self.pages.note(message),
        }
    }

    fn note_stop(&self, place: Option<&Value>) {
        self.pages.note_stop(place);
    }

    fn force_end_on_request(&self) {
        if let Some(link) = &self.link {
            link.force_end_on_request();
        }
    }

    fn finish(&self, timeout: Duration) {
        if let Some(link) = &self.link {
            link.finish(timeout);
        }
    }
}
