//! The conversation with one client.

use serde_json::{Value, json};

use super::message::{Fault, Message, code, result};
use super::progress::{Notify, Progress};
use super::service::Service;

/// The newest version of the protocol that is spoken here.
pub const LATEST: &str = VERSIONS[0];
/// All of them.
pub const VERSIONS: [&str; 3] = ["2025-06-18", "2025-03-26", "2024-11-05"];
/// Resources that are listed at a time.
const PAGE: usize = 100;

/// What is known of a client.
#[derive(Debug, Default)]
pub struct Session {
    /// The version that was agreed on; None before the client has said hello.
    version: Option<&'static str>,
}

type Reply = Result<Value, Fault>;

impl Session {
    /// The version that was agreed on; None before the client has initialised the session.
    pub fn version(&self) -> Option<&'static str> {
        self.version
    }

    /// The answers to the messages of a text. None where there is nothing to say. What is said meanwhile goes to `notify`.
    pub fn answer(
        &mut self,
        service: &mut dyn Service,
        messages: Result<Vec<Result<Message, Fault>>, Fault>,
        notify: &Notify,
    ) -> Option<Value> {
        let mut messages = match messages {
            Ok(messages) => messages,
            Err(fault) => return Some(fault.answer()),
        };
        if messages.len() == 1 {
            return self.answer_one(service, messages.remove(0), notify);
        }
        // The newest version has no batches.
        if self.version == Some(LATEST) {
            let text = format!(
                "version {LATEST} of the protocol has no batches: send each message by itself"
            );
            return Some(Fault::new(code::INVALID_REQUEST, text).answer());
        }
        let all: Vec<Value> = messages
            .into_iter()
            .filter_map(|message| self.answer_one(service, message, notify))
            .collect();
        (!all.is_empty()).then_some(Value::Array(all))
    }

    fn answer_one(
        &mut self,
        service: &mut dyn Service,
        message: Result<Message, Fault>,
        notify: &Notify,
    ) -> Option<Value> {
        match message {
            Ok(Message::Request { id, method, params }) => {
                Some(match self.reply(service, &method, &params, notify) {
                    Ok(value) => result(&id, value),
                    Err(fault) => Fault { id, ..fault }.answer(),
                })
            }
            Ok(Message::Notification { .. } | Message::Response) => None,
            Err(fault) => Some(fault.answer()),
        }
    }

    fn reply(
        &mut self,
        service: &mut dyn Service,
        method: &str,
        params: &Value,
        notify: &Notify,
    ) -> Reply {
        match method {
            "ping" => Ok(json!({})),
            "initialize" => self.initialize(service, params),
            _ if self.version.is_none() => Err(Fault::new(
                code::INVALID_REQUEST,
                format!("{method}: the first request of a session is initialize"),
            )),
            "tools/list" => {
                let tools: Vec<Value> = service.tools().iter().map(|tool| tool.json()).collect();
                Ok(json!({"tools": tools}))
            }
            "tools/call" => call(service, params, &Progress::of(params, notify)),
            "resources/list" => list(service, params),
            "resources/templates/list" => {
                let all: Vec<Value> = service.templates().iter().map(|one| one.json()).collect();
                Ok(json!({"resourceTemplates": all}))
            }
            "resources/read" => read(service, params),
            _ => Err(Fault::new(
                code::NO_METHOD,
                format!("there is no method {method}"),
            )),
        }
    }

    fn initialize(&mut self, service: &dyn Service, params: &Value) -> Reply {
        let wanted = text_of(params, "protocolVersion")?;
        let known = VERSIONS.into_iter().find(|version| *version == wanted);
        let version = known.unwrap_or(LATEST);
        self.version = Some(version);
        let about = service.about();
        Ok(json!({
            "protocolVersion": version,
            "capabilities": {"tools": {}, "resources": {}},
            "serverInfo": {"name": about.name, "title": about.title, "version": about.version},
            "instructions": about.instructions,
        }))
    }
}

fn text_of<'a>(params: &'a Value, name: &str) -> Result<&'a str, Fault> {
    params[name].as_str().ok_or_else(|| {
        Fault::new(
            code::INVALID_PARAMS,
            format!("the parameter {name} is missing: a string is needed"),
        )
    })
}

fn call(service: &mut dyn Service, params: &Value, progress: &Progress) -> Reply {
    let name = text_of(params, "name")?;
    if !service.tools().iter().any(|tool| tool.name == name) {
        let names: Vec<&str> = service.tools().iter().map(|tool| tool.name).collect();
        let text = format!("there is no tool {name}; there are {}", names.join(", "));
        return Err(Fault::new(code::INVALID_PARAMS, text));
    }
    let none = json!({});
    let arguments = match &params["arguments"] {
        Value::Null => &none,
        arguments @ Value::Object(_) => arguments,
        _ => {
            return Err(Fault::new(
                code::INVALID_PARAMS,
                "the arguments of a tool are an object",
            ));
        }
    };
    Ok(service.call(name, arguments, progress).json())
}

fn list(service: &mut dyn Service, params: &Value) -> Reply {
    let from = match &params["cursor"] {
        Value::Null => Some(0),
        cursor => cursor.as_str().and_then(|text| text.parse::<usize>().ok()),
    };
    let all = service.resources();
    let Some(from) = from.filter(|from| *from == 0 || *from < all.len()) else {
        return Err(Fault::new(
            code::INVALID_PARAMS,
            "this cursor is none of those that resources/list returned: begin without one",
        ));
    };
    let page: Vec<Value> = all
        .iter()
        .skip(from)
        .take(PAGE)
        .map(|one| one.json())
        .collect();
    let next = from + page.len();
    let mut reply = json!({"resources": page});
    if next < all.len() {
        reply["nextCursor"] = next.to_string().into();
    }
    Ok(reply)
}

fn read(service: &mut dyn Service, params: &Value) -> Reply {
    let uri = text_of(params, "uri")?;
    let found = service
        .read(uri)
        .map_err(|error| Fault::new(code::NO_RESOURCE, error.0))?;
    Ok(json!({"contents": [{"uri": uri, "mimeType": found.mime_type, "text": found.text}]}))
}
