//! Requests of pages, from any bytes: each is checked before the simulation's thread sees it.

mod debugging;
mod members;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use capture::{Input, Recorded};
use serde_json::{Value, json};

use crate::edit::Files;
use crate::sample::Following;
pub(crate) use debugging::{Breakpoint, Debug};
use members::{
    Members, bytes, count, factor, files, flag, frame, gesture, handle, handles, is_python,
    language, others, point, shortened, text, text_up_to,
};

/// The text of a script, bytes.
const MAX_SCRIPT_LENGTH: usize = 4_000_000;

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
        gesture: Option<u64>,
    },
    Script(i64),
    /// A new text for the script that has the text of that version.
    SaveScript {
        handle: i64,
        text: String,
        version: String,
    },
    /// Whether a text is Lua, or Python.
    Check {
        code: String,
        is_python: bool,
    },
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
    /// A change of the scene by its name; those with the same number of a gesture are one step of undo.
    Edit {
        edit: String,
        arguments: Value,
        gesture: Option<u64>,
    },
    /// With `others` also what another page has done.
    Undo {
        others: bool,
    },
    Redo {
        others: bool,
    },
    /// The number by which a page says who it is.
    Author(u64),
    /// Pulls a point of an object (in its frame) towards a place of the world during the next step; without a target it ends.
    Pull {
        handle: i64,
        point: [f64; 3],
        target: Option<[f64; 3]>,
    },
    /// A piece of a file that is to be loaded.
    Upload {
        name: String,
        data: Vec<u8>,
    },
    /// Loads one of the files that were sent.
    Load {
        main: String,
        files: Arc<Files>,
        /// Where it is put, or null.
        position: Value,
    },
    Save {
        path: String,
        /// The base of a model, instead of the scene.
        model: Option<i64>,
        may_overwrite: bool,
    },
    /// What is different from the scene that was loaded.
    Changes,
    /// Of the debugger, which has requests of its own.
    Debug(Debug),
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
                gesture,
            } => {
                json!({ "do": "set", "handle": handle, "name": name, "value": value, "gesture": gesture })
            }
            Self::Script(handle) => json!({ "do": "script", "handle": handle }),
            Self::SaveScript {
                handle,
                text,
                version,
            } => {
                json!({ "do": "saveScript", "handle": handle, "text": text, "version": version })
            }
            Self::Check { code, is_python } => {
                json!({ "do": "check", "code": code, "language": language(*is_python) })
            }
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
            Self::Edit {
                edit,
                arguments,
                gesture,
            } => {
                json!({ "do": "edit", "edit": edit, "arguments": arguments, "gesture": gesture })
            }
            Self::Undo { others } => json!({ "do": "undo", "others": others }),
            Self::Redo { others } => json!({ "do": "redo", "others": others }),
            Self::Author(number) => json!({ "do": "author", "number": number }),
            Self::Pull {
                handle,
                point,
                target,
            } => json!({ "do": "pull", "handle": handle, "point": point, "target": target }),
            Self::Upload { name, data } => {
                json!({ "do": "upload", "name": name, "data": BASE64.encode(data) })
            }
            Self::Load {
                main,
                files,
                position,
            } => {
                let encoded = files
                    .iter()
                    .map(|(name, data)| (name.clone(), BASE64.encode(data).into()));
                let files: Members = encoded.collect();
                json!({ "do": "load", "main": main, "files": files, "position": position })
            }
            Self::Save {
                path,
                model,
                may_overwrite,
            } => json!({ "do": "save", "path": path, "model": model, "overwrite": may_overwrite }),
            Self::Changes => json!({ "do": "changes" }),
            Self::Debug(request) => request.to_json(),
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
                | Self::Check { .. }
                | Self::Watch(_)
                | Self::Show { .. }
                | Self::Sample(_)
                | Self::Graph(_)
                | Self::Author(_)
                | Self::Changes
        )
    }

    /// Whether pages can take it back.
    pub(crate) fn is_undoable(&self) -> bool {
        self.is_edit()
            || matches!(
                self,
                Self::Set { .. } | Self::SaveScript { .. } | Self::Run(_)
            )
    }

    /// Whether it is done whole or not at all.
    pub(crate) fn is_edit(&self) -> bool {
        matches!(self, Self::Edit { .. } | Self::Load { .. })
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
            gesture: gesture(members),
        },
        "script" => Action::Script(handle(members)?),
        "saveScript" => Action::SaveScript {
            handle: handle(members)?,
            text: text_up_to(members, "text", MAX_SCRIPT_LENGTH)?,
            version: text(members, "version")?,
        },
        "check" => Action::Check {
            code: text_up_to(members, "code", MAX_SCRIPT_LENGTH)?,
            is_python: is_python(members)?,
        },
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
        "edit" => Action::Edit {
            edit: text(members, "edit")?,
            arguments: members.get("arguments").cloned().unwrap_or(Value::Null),
            gesture: gesture(members),
        },
        "undo" => Action::Undo {
            others: others(members),
        },
        "redo" => Action::Redo {
            others: others(members),
        },
        "author" => {
            let number = members.get("number").and_then(Value::as_u64);
            Action::Author(number.ok_or("`number` is a whole number, zero or more")?)
        }
        "pull" => Action::Pull {
            handle: handle(members)?,
            point: point(members, "point")?.ok_or("`point` is missing")?,
            target: point(members, "target")?,
        },
        "upload" => Action::Upload {
            name: text(members, "name")?,
            data: bytes(members.get("data"))?,
        },
        "load" => Action::Load {
            main: text(members, "main")?,
            files: files(members)?,
            position: members.get("position").cloned().unwrap_or(Value::Null),
        },
        "save" => Action::Save {
            path: text(members, "path")?,
            model: members.get("model").and_then(Value::as_i64),
            may_overwrite: members.get("overwrite").and_then(Value::as_bool) == Some(true),
        },
        "changes" => Action::Changes,
        "breakpoints" => Action::Debug(Debug::set(members)?),
        "debug" => Action::Debug(Debug::command(members)?),
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
