//! Requests of a client, and the answers.

use serde_json::{Map, Value, json};

/// A request.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    seq: i64,
    /// What is asked for.
    pub command: String,
    arguments: Map<String, Value>,
}

/// Why a request is refused: a sentence for people.
pub type Refusal = String;

impl Request {
    /// A message as a request; None for other messages.
    pub fn parse(message: &Value) -> Option<Self> {
        if message.get("type")?.as_str()? != "request" {
            return None;
        }
        let arguments = message.get("arguments").and_then(Value::as_object);
        Some(Self {
            seq: message.get("seq")?.as_i64()?,
            command: message.get("command")?.as_str()?.to_owned(),
            arguments: arguments.cloned().unwrap_or_default(),
        })
    }

    /// The answer to it; `seq` is set when it is sent.
    pub fn answer(&self, result: Result<Value, Refusal>) -> Value {
        let mut answer = json!({
            "type": "response", "request_seq": self.seq, "command": self.command, "success": result.is_ok(),
        });
        match result {
            Ok(Value::Null) => {}
            Ok(body) => answer["body"] = body,
            Err(reason) => {
                answer["message"] = json!(reason);
                answer["body"] = json!({"error": {"id": 1, "format": reason, "showUser": false}});
            }
        }
        answer
    }

    /// All arguments.
    pub fn arguments(&self) -> &Map<String, Value> {
        &self.arguments
    }

    /// An argument; null where there is none.
    pub fn get(&self, name: &str) -> &Value {
        self.arguments.get(name).unwrap_or(&Value::Null)
    }

    /// An argument that has to be a text.
    ///
    /// # Errors
    /// When it is none.
    pub fn text(&self, name: &str) -> Result<&str, Refusal> {
        self.get(name)
            .as_str()
            .ok_or_else(|| format!("{}: {name} has to be a text", self.command))
    }

    /// An argument that has to be a whole number.
    ///
    /// # Errors
    /// When it is none.
    pub fn number(&self, name: &str) -> Result<i64, Refusal> {
        self.get(name)
            .as_i64()
            .ok_or_else(|| format!("{}: {name} has to be a whole number", self.command))
    }

    /// A count that may be left out; zero then.
    pub fn count(&self, name: &str) -> usize {
        let number = self.get(name).as_u64().unwrap_or_default();
        usize::try_from(number).unwrap_or(usize::MAX)
    }

    /// The items of a list; none where there is no list.
    pub fn list(&self, name: &str) -> &[Value] {
        self.get(name).as_array().map_or(&[], Vec::as_slice)
    }
}

/// An event; `seq` is set when it is sent.
pub fn event(name: &str, body: Value) -> Value {
    let mut event = json!({"type": "event", "event": name});
    if !body.is_null() {
        event["body"] = body;
    }
    event
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_requests_are_requests() {
        for other in [
            json!(null),
            json!([]),
            json!({"type": "response"}),
            json!({"type": "request", "seq": "1", "command": "x"}),
            json!({"type": "request", "seq": 1}),
            json!({"type": "request", "seq": 1, "command": 5}),
        ] {
            assert_eq!(Request::parse(&other), None);
        }
        let odd = json!({"type": "request", "seq": 1, "command": "x", "arguments": 5});
        let request = Request::parse(&odd).expect("a request without arguments");
        assert!(request.text("a").is_err() && request.list("a").is_empty());
    }
}
