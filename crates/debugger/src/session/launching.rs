//! What a client wants to be run.

use std::path::PathBuf;

use serde_json::{Map, Value};

use super::{Flow, POLL, Session, path};
use crate::request::{Refusal, Request};
use crate::stepping::Mode;

/// The arguments of `launch` or `attach`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Launch {
    /// The scene or script; None for the one of the command line.
    pub program: Option<PathBuf>,
    /// Options of the command line.
    pub args: Vec<String>,
    /// The folder to run in.
    pub cwd: Option<PathBuf>,
    /// Whether the first line stops.
    pub stop_on_entry: bool,
    /// Python scripts listen for a debugger of their own.
    pub debug_python: bool,
    /// The client has asked for something to be run.
    is_asked_for: bool,
    /// The client has set its breakpoints.
    pub(super) is_configured: bool,
}

impl Launch {
    fn parse(arguments: &Map<String, Value>) -> Result<Self, Refusal> {
        let get = |name: &str| arguments.get(name).unwrap_or(&Value::Null);
        let is_set = |name: &str| get(name) == &Value::Bool(true);
        let mut args = Vec::new();
        for name in ["time", "steps", "dt", "seed"] {
            if let Some(number) = get(name).as_number() {
                args.extend([format!("--{name}"), number.to_string()]);
            }
        }
        if is_set("realtime") {
            args.push("--realtime".into());
        }
        for (name, value) in get("params").as_object().into_iter().flatten() {
            args.extend(["-D".into(), format!("{name}={}", plain(value))]);
        }
        for arg in get("args").as_array().into_iter().flatten() {
            let arg = arg
                .as_str()
                .ok_or("launch: args has to be a list of texts")?;
            args.push(arg.to_owned());
        }
        Ok(Self {
            program: path(get("program")),
            args,
            cwd: path(get("cwd")),
            stop_on_entry: is_set("stopOnEntry"),
            debug_python: is_set("debugPython"),
            is_asked_for: true,
            is_configured: false,
        })
    }
}

/// A value as text without quotes.
fn plain(value: &Value) -> String {
    value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned)
}

impl Session {
    pub(super) fn note_launch(&self, request: &Request) -> Result<Value, Refusal> {
        if self.launch.borrow().is_asked_for && !self.is_attached {
            return Err("a simulation runs already".into());
        }
        self.launch.replace(Launch::parse(request.arguments())?);
        Ok(Value::Null)
    }

    /// A restart may come with new arguments.
    pub(super) fn note_restart(&self, request: &Request) {
        let new = request.get("arguments").as_object().map(Launch::parse);
        if let Some(Ok(new)) = new {
            self.launch.replace(new);
        }
        self.launch.borrow_mut().is_configured = true;
    }

    /// Waits until a client has said what to run, and has set its breakpoints; None when it goes before that, or `is_over`.
    pub fn wait_for_launch(&self, is_over: impl Fn() -> bool) -> Option<Launch> {
        loop {
            let launch = self.launch.borrow().clone();
            if launch.is_asked_for && launch.is_configured {
                self.mode.set(if launch.stop_on_entry {
                    Mode::Into
                } else {
                    Mode::Run
                });
                return Some(launch);
            }
            if is_over() || self.ending().is_some() {
                return None;
            }
            if let Some(incoming) = self.client.receive(POLL) {
                let flow: Flow = self.receive(None, incoming);
                debug_assert!(flow == Flow::Stay || self.ending().is_some());
            }
        }
    }
}
