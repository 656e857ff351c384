//! Code that stands still while pages look at it, and others wait for nothing.
#![allow(clippy::disallowed_methods, reason = "pages are on other threads")]

use std::io::Write as _;
use std::os::unix::net::UnixStream;
use std::sync::Mutex;

use super::*;
use crate::mirror::Message;
use scene::Data;
use simulator::{Options, ScriptKind, Simulator};

/// For whatever is waited for.
const LIMIT: Duration = Duration::from_secs(60);

const CODE: &str = "\
count = 0
function sysCall_nonSimulation()
    local before = count

    count = before + 1
    return before
end
function get()
    return count
end
";

/// A simulator whose scripts pages debug.
struct Desk {
    debugging: Debugging,
    sim: Simulator,
    script: i64,
}

impl Desk {
    fn new(is_captured: bool) -> Self {
        Self::with_client(is_captured, None)
    }

    /// A client at a connection debugs in place of the pages.
    fn with_client(is_captured: bool, link: Option<Link>) -> Self {
        let debugging = Debugging::new(false, is_captured);
        let session = debugging.session(link).expect("somebody debugs");
        let mut sim = Simulator::builder()
            .options(Options::default())
            .debugger(session)
            .build();
        let script = sim.add_script(ScriptKind::Customization, "", CODE.as_bytes());
        let script = script.expect("a script is added").handle();
        Self {
            debugging,
            sim,
            script,
        }
    }

    fn shared(&self) -> Arc<Shared> {
        Arc::clone(&self.debugging.shared)
    }

    /// Breakpoints in these lines, of which the debugger has heard.
    fn set(&mut self, lines: &'static [u64]) {
        let script = self.script;
        self.with_page(move |page| page.set(script, lines));
    }

    fn calls_get(&mut self) {
        let arguments = [Data::text("get"), Data::Int(self.script)];
        let called = self.sim.call_api("sim.callScriptFunction", &arguments);
        assert!(called.is_ok(), "{called:?}");
    }

    fn until(&mut self, is_over: impl Fn() -> bool) {
        let begun = Instant::now();
        while !is_over() {
            self.sim.iterate();
            assert!(begun.elapsed() < LIMIT);
        }
    }

    /// Lets a page do something while the simulator iterates; what it returns.
    fn with_page<T: Send + 'static>(&mut self, work: impl FnOnce(Page) -> T + Send + 'static) -> T {
        let page = Page(self.shared());
        let work = std::thread::spawn(move || work(page));
        self.until(|| work.is_finished());
        work.join().expect("the page has done it")
    }
}

/// A page that may write.
struct Page(Arc<Shared>);

impl Page {
    /// The reply to a request: its result, or the text of the error.
    fn ask(&self, action: Action) -> Value {
        let replies = Arc::<Mutex<VecDeque<String>>>::default();
        let pending = Pending {
            id: 1.into(),
            author: None,
            action,
            replies: Arc::clone(&replies),
        };
        assert!(self.0.submit(pending));
        let reply = self.until(|| replies.lock().ok()?.pop_front());
        let reply: Value = serde_json::from_str(&reply).expect("a reply in JSON");
        reply
            .get("result")
            .or(reply.get("error"))
            .cloned()
            .unwrap_or_default()
    }

    fn set(&self, script: i64, lines: &[u64]) {
        let breakpoints = lines.iter().map(|line| Breakpoint {
            line: *line,
            condition: None,
        });
        let action = Action::Debug(Debug::Set {
            script,
            breakpoints: breakpoints.collect(),
        });
        assert_eq!(self.ask(action), json!(true));
    }

    /// Lets the code go on for good.
    fn leave(&self, script: i64) {
        self.set(script, &[]);
        self.debug("continue", Value::Null);
    }

    fn debug(&self, name: &str, arguments: Value) -> Value {
        self.ask(Action::Debug(Debug::Command {
            name: name.into(),
            arguments,
        }))
    }

    fn until<T>(&self, look: impl Fn() -> Option<T>) -> T {
        let begun = Instant::now();
        loop {
            if let Some(found) = look() {
                return found;
            }
            assert!(begun.elapsed() < LIMIT);
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// What pages see.
    fn update(&self) -> Value {
        let (_, messages) = self.0.mirror().update_since(0);
        match messages.first() {
            Some(Message::Text(text)) => serde_json::from_str(text).expect("an update in JSON"),
            _ => Value::Null,
        }
    }

    /// A list that pages see.
    fn list(&self, name: &str) -> Value {
        self.update()[name].clone()
    }

    /// Waits until code stands still at a line.
    fn stopped_at(&self, line: u64) {
        self.until(|| (self.list("stopped")["line"] == line).then_some(()));
    }
}

#[test]
fn code_stops_and_is_looked_at() {
    let mut desk = Desk::new(false);
    let script = desk.script;
    desk.with_page(move |page| {
        page.set(script, &[4]);
        page.stopped_at(5);
        let placed =
            json!([{ "handle": script, "lines": [{ "line": 4, "condition": null, "at": 5 }] }]);
        assert_eq!(page.list("breakpoints"), placed);
        let stack = page.debug("stackTrace", json!({ "threadId": script }));
        let frame = &stack["stackFrames"][0];
        assert_eq!(
            (&frame["line"], &frame["script"]),
            (&json!(5), &json!(script))
        );
        let scopes = page.debug("scopes", json!({ "frameId": frame["id"] }));
        let locals = json!({ "variablesReference": scopes["scopes"][0]["variablesReference"] });
        let variables = page.debug("variables", locals);
        assert_eq!(variables["variables"][0]["name"], "before");
        page.debug("next", Value::Null);
        page.stopped_at(6);
        let sum = json!({ "frameId": 1, "expression": "count - before" });
        page.debug("stackTrace", json!({ "threadId": script }));
        assert_eq!(page.debug("evaluate", sum)["result"], "1");
        page.leave(script);
        page.until(|| page.list("stopped").is_null().then_some(()));
        let refused = page.debug("next", Value::Null);
        assert_eq!(refused, "no script stands still");
    });
}

#[test]
fn other_pages_are_answered_meanwhile() {
    let mut desk = Desk::new(false);
    let script = desk.script;
    desk.with_page(move |page| {
        page.set(script, &[3]);
        page.stopped_at(3);
        assert_eq!(page.ask(Action::Script(script))["text"], CODE);
        let refused = page.ask(Action::Select(vec![script]));
        let reason = refused.as_str().expect("a sentence");
        assert!(reason.contains("stands still in line 3"), "{reason}");
        page.set(script, &[]);
        assert_eq!(page.ask(Action::Play), json!(true));
        page.until(|| page.list("stopped").is_null().then_some(()));
    });
}

#[test]
fn a_stop_of_the_simulation_lets_code_go_on() {
    let mut desk = Desk::new(false);
    let script = desk.script;
    desk.with_page(move |page| {
        page.set(script, &[3, 5, 6]);
        page.stopped_at(3);
        let pending = Pending {
            id: 1.into(),
            author: None,
            action: Action::Stop,
            replies: Arc::default(),
        };
        assert!(page.0.submit(pending));
        page.until(|| page.list("stopped").is_null().then_some(()));
    });
    let left = desk.shared().next_request(Duration::ZERO);
    assert_eq!(left.map(|pending| pending.action), Some(Action::Stop));
}

#[test]
fn captured_runs_are_only_looked_at() {
    let mut desk = Desk::new(true);
    let script = desk.script;
    desk.with_page(move |page| {
        page.set(script, &[5]);
        page.stopped_at(5);
        let refused = page.debug("evaluate", json!({ "expression": "count" }));
        let reason = refused.as_str().expect("a sentence");
        assert!(reason.starts_with("the run is captured"), "{reason}");
        let stack = page.debug("stackTrace", json!({ "threadId": script }));
        assert_eq!(stack["stackFrames"][0]["line"], 5);
        page.leave(script);
    });
}

#[test]
fn breakpoints_outlive_an_undo() {
    let mut desk = Desk::new(false);
    let script = desk.script;
    desk.sim.iterate();
    let before = desk.sim.snapshot().expect("nothing is open");
    desk.set(&[9]);
    desk.sim.restore(&before).expect("it is brought back");
    desk.debugging.set_again();
    desk.sim.iterate();
    let shared = desk.shared();
    let page = std::thread::spawn(move || {
        let page = Page(shared);
        page.stopped_at(9);
        page.leave(script);
    });
    desk.calls_get();
    page.join().expect("the code has stopped");
}

#[test]
fn another_scene_has_no_breakpoints() {
    let mut desk = Desk::new(false);
    desk.set(&[9]);
    desk.debugging.forget();
    desk.sim.iterate();
    desk.calls_get();
    let page = Page(desk.shared());
    assert_eq!(page.list("breakpoints"), json!([]));
    assert!(page.update().get("stopped").is_none());
}

/// A message of the Debug Adapter Protocol.
fn framed(seq: i64, command: &str, arguments: &Value) -> String {
    let text = json!({ "seq": seq, "type": "request", "command": command, "arguments": arguments });
    let text = text.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len())
}

#[test]
fn pages_see_where_another_debugger_has_stopped() {
    let (mut client, stream) = UnixStream::pair().expect("a connection");
    let output = stream.try_clone().expect("its other end");
    let link = Link::of_streams(stream, output, Arc::new(|| {})).expect("threads");
    let mut desk = Desk::with_client(false, Some(link));
    let script = desk.script;
    let breakpoints = json!({ "source": { "script": script }, "breakpoints": [{ "line": 5 }] });
    let set = framed(1, "setBreakpoints", &breakpoints);
    client.write_all(set.as_bytes()).expect("it is sent");
    desk.with_page(move |page| {
        page.stopped_at(5);
        assert!(!page.0.has_debugger());
        assert_eq!(page.ask(Action::Script(script))["text"], CODE);
        let refused = page.ask(Action::Play);
        let reason = refused.as_str().expect("a sentence");
        assert!(reason.contains("stands still in line 5"), "{reason}");
        drop(client);
        page.until(|| page.list("stopped").is_null().then_some(()));
    });
}
