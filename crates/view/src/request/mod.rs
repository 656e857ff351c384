//! Requests of pages, from any bytes: each is checked before the simulation's thread sees it.

#[cfg(test)]
mod tests;

use crate::sample::Following;
use capture::{Input, Recorded};
use serde_json::{Map, Value, json};

/// Code and texts of a page, bytes.
const MAX_TEXT_LENGTH: usize = 100_000;
/// The text of a script, bytes.
const MAX_SCRIPT_LENGTH: usize = 4_000_000;
/// Handles in one request.
const MAX_HANDLES: usize = 100_000;
/// Steps of one request.
const MAX_STEPS: i64 = 1_000_000;

/// What a page asks for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Action {
    Play,
    Pause,
    Stop,
    /// So many steps, below zero back.
    Step(i64),
    /// To a place on the timeline of a capture.
    Seek(usize),
    /// Goes on from the moment of a capture that is shown.
    Live,
    /// Beside the wall clock; 0 for as fast as possible.
    Speed(f64),
    Select(Vec<i64>),
    /// None for no object.
    Inspect(Option<i64>),
    Set {
        handle: i64,
        name: String,
        value: Value,
    },
    Script(i64),
    /// A new text for the script that has the text of that version.
    SaveScript {
        handle: i64,
        text: String,
        version: String,
    },
    /// Whether a text is Lua.
    Check(String),
    /// Opens the settings of a model, which a script of it has.
    Configure(i64),
    Watch(Vec<i64>),
    Show {
        contacts: bool,
    },
    /// Numbers of properties at every step.
    Sample(Following),
    Graph(i64),
    Ui {
        window: Value,
        widget: Value,
        input: Value,
    },
    Run(String),
    /// To the dialog with that number; null: cancelled.
    Answer {
        question: u64,
        answer: Value,
    },
}

/// As a page would send it.
impl Recorded for Action {
    fn write(&self, out: &mut Vec<u8>) {
        self.to_json().to_string().write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let value = serde_json::from_str(&String::read(input)?).ok()?;
        let Value::Object(members) = value else {
            return None;
        };
        action(&members).ok()
    }
}

/// A request with the number that its reply has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Request {
    pub id: Value,
    pub action: Action,
}

/// A request that is none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Refusal {
    /// Null where there was none.
    pub id: Value,
    pub reason: String,
}

impl Action {
    fn to_json(&self) -> Value {
        match self {
            Self::Play => json!({ "do": "play" }),
            Self::Pause => json!({ "do": "pause" }),
            Self::Stop => json!({ "do": "stop" }),
            Self::Step(count) => json!({ "do": "step", "count": count }),
            Self::Seek(frame) => json!({ "do": "seek", "frame": frame }),
            Self::Live => json!({ "do": "live" }),
            Self::Speed(factor) => json!({ "do": "speed", "factor": factor }),
            Self::Select(handles) => json!({ "do": "select", "handles": handles }),
            Self::Inspect(handle) => json!({ "do": "inspect", "handle": handle.unwrap_or(-1) }),
            Self::Set {
                handle,
                name,
                value,
            } => json!({ "do": "set", "handle": handle, "name": name, "value": value }),
            Self::Script(handle) => json!({ "do": "script", "handle": handle }),
            Self::SaveScript {
                handle,
                text,
                version,
            } => {
                json!({ "do": "saveScript", "handle": handle, "text": text, "version": version })
            }
            Self::Check(code) => json!({ "do": "check", "code": code }),
            Self::Configure(handle) => json!({ "do": "configure", "handle": handle }),
            Self::Watch(handles) => json!({ "do": "watch", "handles": handles }),
            Self::Show { contacts } => json!({ "do": "show", "contacts": contacts }),
            Self::Sample(following) => following.to_json(),
            Self::Graph(handle) => json!({ "do": "graph", "handle": handle }),
            Self::Ui {
                window,
                widget,
                input,
            } => json!({ "do": "ui", "window": window, "widget": widget, "input": input }),
            Self::Run(code) => json!({ "do": "run", "code": code }),
            Self::Answer { question, answer } => {
                json!({ "do": "answer", "question": question, "answer": answer })
            }
        }
    }

    /// Whether it may change something, which pages that only read must not.
    pub(crate) fn changes_something(&self) -> bool {
        !matches!(
            self,
            Self::Inspect(_)
                | Self::Script(_)
                | Self::Check(_)
                | Self::Watch(_)
                | Self::Show { .. }
                | Self::Sample(_)
                | Self::Graph(_)
        )
    }

    /// Whether it goes to another moment of a capture, which changes nothing.
    pub(crate) fn moves_in_time(&self) -> bool {
        matches!(
            self,
            Self::Play | Self::Pause | Self::Stop | Self::Step(_) | Self::Speed(_) | Self::Seek(_)
        )
    }
}

impl Request {
    /// The request in a message.
    ///
    /// # Errors
    /// When it is no JSON object with a number and known, well-formed members.
    pub(crate) fn parse(message: &[u8]) -> Result<Self, Refusal> {
        let refuse = |id: Value, reason: &str| Refusal {
            id,
            reason: reason.to_owned(),
        };
        let value: Value = serde_json::from_slice(message)
            .map_err(|_| refuse(Value::Null, "a request is a JSON object"))?;
        let Value::Object(members) = value else {
            return Err(refuse(Value::Null, "a request is a JSON object"));
        };
        let id = members.get("id").filter(|id| id.is_number()).cloned();
        let id = id.ok_or_else(|| refuse(Value::Null, "a request has an `id`, a number"))?;
        match action(&members) {
            Ok(action) => Ok(Self { id, action }),
            Err(reason) => Err(Refusal { id, reason }),
        }
    }
}

type Members = Map<String, Value>;

fn action(members: &Members) -> Result<Action, String> {
    let name = members
        .get("do")
        .and_then(Value::as_str)
        .ok_or("a request says in `do` what to do")?;
    Ok(match name {
        "play" => Action::Play,
        "pause" => Action::Pause,
        "stop" => Action::Stop,
        "step" => Action::Step(count(members)?),
        "seek" => Action::Seek(frame(members)?),
        "live" => Action::Live,
        "speed" => Action::Speed(factor(members)?),
        "select" => Action::Select(handles(members)?),
        "inspect" => Action::Inspect(Some(handle(members)?).filter(|handle| *handle != -1)),
        "set" => Action::Set {
            handle: handle(members)?,
            name: text(members, "name")?,
            value: members.get("value").cloned().ok_or("`value` is missing")?,
        },
        "script" => Action::Script(handle(members)?),
        "saveScript" => Action::SaveScript {
            handle: handle(members)?,
            text: text_up_to(members, "text", MAX_SCRIPT_LENGTH)?,
            version: text(members, "version")?,
        },
        "check" => Action::Check(text_up_to(members, "code", MAX_SCRIPT_LENGTH)?),
        "configure" => Action::Configure(handle(members)?),
        "watch" => Action::Watch(handles(members)?),
        "show" => Action::Show {
            contacts: flag(members, "contacts")?,
        },
        "sample" => Action::Sample(Following::read(members)?),
        "graph" => Action::Graph(handle(members)?),
        "ui" => {
            let member = |name: &str| members.get(name).cloned().unwrap_or(Value::Null);
            Action::Ui {
                window: member("window"),
                widget: member("widget"),
                input: member("input"),
            }
        }
        "run" => Action::Run(text(members, "code")?),
        "answer" => {
            let question = members
                .get("question")
                .and_then(Value::as_u64)
                .ok_or("`question` is a number")?;
            Action::Answer {
                question,
                answer: members.get("answer").cloned().unwrap_or(Value::Null),
            }
        }
        other => return Err(format!("unknown request: {}", shortened(other))),
    })
}

fn shortened(text: &str) -> &str {
    text.char_indices()
        .nth(50)
        .map_or(text, |(end, _)| &text[..end])
}

fn count(members: &Members) -> Result<i64, String> {
    let Some(count) = members.get("count") else {
        return Ok(1);
    };
    let is_count = |count: &i64| *count != 0 && (-MAX_STEPS..=MAX_STEPS).contains(count);
    let count = count.as_i64().filter(is_count);
    count.ok_or_else(|| format!("`count` is a whole number, 1 to {MAX_STEPS}, or below zero"))
}

fn frame(members: &Members) -> Result<usize, String> {
    let frame = members.get("frame").and_then(Value::as_u64);
    let frame = frame.and_then(|frame| usize::try_from(frame).ok());
    frame.ok_or_else(|| "`frame` is a whole number, zero or more".to_owned())
}

fn factor(members: &Members) -> Result<f64, String> {
    let factor = members.get("factor").and_then(Value::as_f64);
    let factor = factor.filter(|factor| *factor == 0.0 || (0.001..=100.0).contains(factor));
    factor.ok_or_else(|| "`factor` is 0, or a number from 0.001 to 100".to_owned())
}

fn handle(members: &Members) -> Result<i64, String> {
    members
        .get("handle")
        .and_then(Value::as_i64)
        .ok_or_else(|| "`handle` is a whole number".to_owned())
}

fn handles(members: &Members) -> Result<Vec<i64>, String> {
    let wrong = || "`handles` is a list of whole numbers".to_owned();
    let list = members
        .get("handles")
        .and_then(Value::as_array)
        .ok_or_else(wrong)?;
    if list.len() > MAX_HANDLES {
        return Err(format!("`handles` has at most {MAX_HANDLES} items"));
    }
    list.iter()
        .map(Value::as_i64)
        .collect::<Option<_>>()
        .ok_or_else(wrong)
}

fn text(members: &Members, name: &str) -> Result<String, String> {
    text_up_to(members, name, MAX_TEXT_LENGTH)
}

fn text_up_to(members: &Members, name: &str, length: usize) -> Result<String, String> {
    let text = members
        .get(name)
        .and_then(Value::as_str)
        .ok_or_else(|| format!("`{name}` is a text"))?;
    if text.len() > length {
        return Err(format!("`{name}` is too long"));
    }
    Ok(text.to_owned())
}

fn flag(members: &Members, name: &str) -> Result<bool, String> {
    members
        .get(name)
        .and_then(Value::as_bool)
        .ok_or_else(|| format!("`{name}` is true or false"))
}
