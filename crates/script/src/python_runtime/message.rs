//! Messages between the simulator and the process of a script.

use scene::Data;
use wire::marshal::{Declared, Encoder, MarshalError, decode};

/// A message of the process.
#[derive(Debug, PartialEq)]
pub(crate) enum Message {
    /// A call of a function of the simulator.
    Call(String, Vec<Data>),
    /// A call with arguments that a script of the simulator cannot have, and why not.
    BadCall(String),
    /// The results of a call of the simulator's.
    Results(Vec<Data>),
    /// Its error, as people read it.
    Error(String),
    /// There is no such function.
    NoFunction,
    /// A line that was printed.
    Print(Vec<u8>),
    /// A part of the output or the error output; the latter has number 2.
    Write(i64, Vec<u8>),
}

/// Why bytes are no message.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum BadMessage {
    #[error(transparent)]
    Value(#[from] MarshalError),
    #[error("a message of an unknown form")]
    Form,
}

impl Message {
    /// # Errors
    /// When the bytes are no message.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, BadMessage> {
        let Data::Array(fields) = decode(bytes)? else {
            return Err(BadMessage::Form);
        };
        let mut fields = fields.into_iter();
        let Some(Data::Text(kind)) = fields.next() else {
            return Err(BadMessage::Form);
        };
        let message = match (kind.as_slice(), fields.next(), fields.next()) {
            (b"c", Some(Data::Text(name)), Some(Data::Array(args))) => {
                Self::Call(lossy(&name), args)
            }
            (b"r", Some(Data::Array(results)), None) => Self::Results(results),
            (b"e", Some(Data::Text(error)), None) => Self::Error(lossy(&error)),
            (b"n", None, None) => Self::NoFunction,
            (b"p", Some(Data::Text(line)), None) => Self::Print(line),
            (b"w", Some(Data::Int(stream)), Some(Data::Text(text))) => Self::Write(stream, text),
            _ => return Err(BadMessage::Form),
        };
        if fields.next().is_none() {
            Ok(message)
        } else {
            Err(BadMessage::Form)
        }
    }
}

/// How bytes begin that are a call, and those that are results: a tuple of so many, then a text with the letter.
const CALL: &[u8] = b"(\x03\0\0\0u\x01\0\0\0c";
const RESULTS: &[u8] = b"(\x02\0\0\0u\x01\0\0\0r";

impl Message {
    /// A message that may hold values which the simulator has no counterpart for: then it is an error of the call, not of the connection.
    ///
    /// # Errors
    /// When the bytes are no message.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, BadMessage> {
        match Self::decode(bytes) {
            Err(BadMessage::Value(error)) if bytes.starts_with(CALL) => Ok(Self::BadCall(format!(
                "an argument cannot be passed: {error}"
            ))),
            Err(BadMessage::Value(error)) if bytes.starts_with(RESULTS) => {
                Ok(Self::Error(format!("a result cannot be passed: {error}")))
            }
            other => other,
        }
    }
}

fn lossy(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

/// A call of a function of the script.
pub(super) fn call(name: &str, args: &[Data]) -> Vec<u8> {
    let mut message = Encoder::default();
    message.tuple(3);
    message.text("c");
    message.text(name);
    message.list(args);
    message.into_bytes()
}

/// The results of a call of the script's.
pub(super) fn results(results: &[Data], declared: Declared<'_>) -> Vec<u8> {
    let mut message = Encoder::default();
    message.tuple(2);
    message.text("r");
    message.results(results, declared);
    message.into_bytes()
}

/// Its error.
pub(super) fn error(text: &str) -> Vec<u8> {
    request("e", &[Data::text(text)])
}

/// Something else the process is to do, by the letter of its handler.
pub(super) fn request(kind: &str, fields: &[Data]) -> Vec<u8> {
    let mut message = Encoder::default();
    message.tuple(fields.len() + 1);
    message.text(kind);
    fields.iter().for_each(|field| message.value(field));
    message.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_read() {
        let bytes = call("sim.getObject", &[Data::text("/a"), Data::Nil]);
        let args = vec![Data::text("/a"), Data::Nil];
        assert_eq!(
            Message::decode(&bytes),
            Ok(Message::Call("sim.getObject".into(), args))
        );
        assert_eq!(
            Message::decode(&error("no")),
            Ok(Message::Error("no".into()))
        );
        assert_eq!(
            Message::decode(&results(&[], Declared::default())),
            Ok(Message::Results(Vec::new()))
        );
    }

    #[test]
    fn values_without_a_counterpart_are_errors_of_the_call() {
        // ('c', 'f', [{(): 1}]) and ('r', [{(): 1}]).
        let list = b"[\x01\0\0\0{(\0\0\0\0i\x01\0\0\x000";
        let bytes = [CALL, b"u\x01\0\0\0f", list].concat();
        let key = "this cannot be the key of a table";
        assert_eq!(
            Message::read(&bytes),
            Ok(Message::BadCall(format!(
                "an argument cannot be passed: {key}"
            )))
        );
        let bytes = [RESULTS, list].concat();
        assert_eq!(
            Message::read(&bytes),
            Ok(Message::Error(format!("a result cannot be passed: {key}")))
        );
        assert!(Message::read(&bytes[..8]).is_err());
    }

    #[test]
    fn what_is_no_message_is_refused() {
        for bytes in [
            &b""[..],
            b"N",
            b"(\0\0\0\0",
            b"(\x01\0\0\0u\x01\0\0\0q",
            b"(\x01\0\0\0u\x01\0\0\0c",
        ] {
            assert!(Message::decode(bytes).is_err(), "{bytes:?}");
        }
        assert_eq!(
            Message::decode(&request("c", &[Data::Int(1), Data::Int(2)])),
            Err(BadMessage::Form)
        );
        assert_eq!(
            Message::decode(&request("n", &[Data::Int(1)])),
            Err(BadMessage::Form)
        );
    }
}
