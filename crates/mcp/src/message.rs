//! Messages: JSON-RPC 2.0, without meaning.

use serde_json::{Value, json};

/// Codes of errors.
pub mod code {
    /// The text is no JSON.
    pub const PARSE: i64 = -32700;
    /// It is JSON, but no message that can be answered now.
    pub const INVALID_REQUEST: i64 = -32600;
    /// There is no such method.
    pub const NO_METHOD: i64 = -32601;
    /// The parameters are not those of the method.
    pub const INVALID_PARAMS: i64 = -32602;
    /// There is no such resource.
    pub const NO_RESOURCE: i64 = -32002;
}

/// One message of a client.
#[derive(Debug, Clone, PartialEq)]
pub enum Message {
    /// It wants an answer with this id, a string or a number.
    Request {
        /// What the answer is found by.
        id: Value,
        /// What is wanted.
        method: String,
        /// An object; empty where the message has none.
        params: Value,
    },
    /// It wants no answer.
    Notification {
        /// What has happened.
        method: String,
        /// As those of a request.
        params: Value,
    },
    /// The answer to a request of the server, which makes none.
    Response,
}

/// Why there is no result.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// One of [`code`].
    pub code: i64,
    /// What was wrong, and what to do.
    pub text: String,
    /// Id of the request, as far as it could be read.
    pub id: Value,
}

impl Fault {
    pub(crate) fn new(code: i64, text: impl Into<String>) -> Self {
        Self {
            code,
            text: text.into(),
            id: Value::Null,
        }
    }

    fn of(self, id: &Value) -> Self {
        Self {
            id: id.clone(),
            ..self
        }
    }

    /// The answer that says so.
    pub fn answer(&self) -> Value {
        json!({"jsonrpc": "2.0", "id": self.id, "error": {"code": self.code, "message": self.text}})
    }
}

/// The answer with a result.
pub(crate) fn result(id: &Value, result: Value) -> Value {
    json!({"jsonrpc": "2.0", "id": id, "result": result})
}

/// The messages of a text: one, or those of a batch, which older versions of the protocol have.
///
/// # Errors
/// When it is no JSON, or an empty batch.
pub fn parse(text: &[u8]) -> Result<Vec<Result<Message, Fault>>, Fault> {
    let value: Value = serde_json::from_slice(text)
        .map_err(|error| Fault::new(code::PARSE, format!("this is no JSON: {error}")))?;
    match value {
        Value::Array(all) if all.is_empty() => Err(Fault::new(
            code::INVALID_REQUEST,
            "a batch has one message at least",
        )),
        Value::Array(all) => Ok(all.into_iter().map(message).collect()),
        one => Ok(vec![message(one)]),
    }
}

/// The message in a JSON value.
fn message(value: Value) -> Result<Message, Fault> {
    let invalid = |text: &str| Fault::new(code::INVALID_REQUEST, text);
    let Value::Object(mut fields) = value else {
        return Err(invalid("a message is a JSON object"));
    };
    let id = fields.remove("id");
    // As far as it is one: what answers it is found by it.
    let known = id.clone().filter(is_id).unwrap_or_default();
    if fields.get("jsonrpc") != Some(&Value::from("2.0")) {
        return Err(invalid("a message has \"jsonrpc\": \"2.0\"").of(&known));
    }
    let method = match fields.remove("method") {
        Some(Value::String(method)) => method,
        None if fields.contains_key("result") || fields.contains_key("error") => {
            return Ok(Message::Response);
        }
        _ => return Err(invalid("a request has a method, which is a string").of(&known)),
    };
    let params = parameters(fields.remove("params")).map_err(|fault| fault.of(&known))?;
    match id {
        None => Ok(Message::Notification { method, params }),
        Some(id) if is_id(&id) => Ok(Message::Request { id, method, params }),
        Some(_) => Err(invalid("an id is a string or a number")),
    }
}

fn parameters(params: Option<Value>) -> Result<Value, Fault> {
    match params {
        None => Ok(json!({})),
        Some(params @ Value::Object(_)) => Ok(params),
        Some(_) => Err(Fault::new(code::INVALID_PARAMS, "params is an object")),
    }
}

fn is_id(id: &Value) -> bool {
    id.is_string() || id.is_number()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Result<Message, Fault> {
        parse(text.as_bytes())?.remove(0)
    }

    #[test]
    fn requests_notifications_and_responses_differ() {
        let request = one(r#"{"jsonrpc":"2.0","id":"a","method":"ping"}"#);
        assert_eq!(
            request,
            Ok(Message::Request {
                id: "a".into(),
                method: "ping".into(),
                params: json!({})
            })
        );
        let notification = one(r#"{"jsonrpc":"2.0","method":"x","params":{"b":1}}"#);
        assert_eq!(
            notification,
            Ok(Message::Notification {
                method: "x".into(),
                params: json!({"b": 1})
            })
        );
        assert_eq!(
            one(r#"{"jsonrpc":"2.0","id":1,"result":{}}"#),
            Ok(Message::Response)
        );
    }

    #[test]
    fn faults_have_their_codes_and_the_id_that_was_read() {
        for (text, code, id) in [
            ("{", code::PARSE, Value::Null),
            ("\u{fffd}", code::PARSE, Value::Null),
            ("[]", code::INVALID_REQUEST, Value::Null),
            ("3", code::INVALID_REQUEST, Value::Null),
            (
                r#"{"id":3,"method":"ping"}"#,
                code::INVALID_REQUEST,
                json!(3),
            ),
            (
                r#"{"jsonrpc":"2.0","id":3}"#,
                code::INVALID_REQUEST,
                json!(3),
            ),
            (
                r#"{"jsonrpc":"2.0","id":[],"method":"ping"}"#,
                code::INVALID_REQUEST,
                Value::Null,
            ),
            (
                r#"{"jsonrpc":"2.0","id":4,"method":"ping","params":[1]}"#,
                code::INVALID_PARAMS,
                json!(4),
            ),
        ] {
            let fault = one(text).expect_err(text);
            assert_eq!((fault.code, fault.id), (code, id), "{text}");
        }
    }

    #[test]
    fn deep_texts_are_refused() {
        let fault = one(&"[".repeat(100_000)).expect_err("nobody reads so deep");
        assert_eq!(fault.code, code::PARSE);
    }

    #[test]
    fn a_batch_has_its_messages() {
        let all = parse(br#"[{"jsonrpc":"2.0","id":1,"method":"ping"},3]"#).expect("a batch");
        assert!(all.len() == 2 && all[0].is_ok() && all[1].is_err());
    }
}
