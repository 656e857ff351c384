//! Messages between the simulator and the process of an interface.

use scene::Data;
use wire::marshal::{Encoder, MarshalError, decode};

/// The longest message of a process, bytes.
const LONGEST: usize = 32 << 20;
/// The longest side of a picture, pixels.
const LONGEST_SIDE: i64 = 8192;
/// How a PNG file begins.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// How much a line of an interface matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Info,
    Warning,
    Error,
}

/// A message of the process.
#[derive(Debug, PartialEq)]
pub(crate) enum Message {
    /// It is ready: the version of Qt.
    Hello([i64; 3]),
    /// It cannot work: what is missing.
    Lacks(String),
    /// The interface is there.
    Loaded,
    /// It is wrong: where and why.
    Failed(String),
    /// A window has come or changed.
    Window {
        number: i64,
        title: String,
        visible: bool,
        size: [u32; 2],
        resizable: bool,
    },
    /// A window is gone.
    Gone(i64),
    /// What a window looks like, as PNG.
    Picture {
        number: i64,
        size: [u32; 2],
        png: Vec<u8>,
    },
    /// An event for the script: its name, and JSON.
    Event(String, Vec<u8>),
    /// A line for the log.
    Said(Level, String),
    /// The answer to a question, by its number.
    Answer(i64, Data),
    /// Why a question has no answer.
    Refused(i64, String),
}

/// Why bytes are no message.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum BadMessage {
    #[error(transparent)]
    Value(#[from] MarshalError),
    #[error("a message of {0} bytes")]
    TooLong(usize),
    #[error("a message of an unknown form")]
    Form,
    #[error("a picture that is none")]
    Picture,
}

impl Message {
    /// # Errors
    /// When the bytes are no message.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, BadMessage> {
        if bytes.len() > LONGEST {
            return Err(BadMessage::TooLong(bytes.len()));
        }
        let Data::Array(mut fields) = decode(bytes)? else {
            return Err(BadMessage::Form);
        };
        if fields.is_empty() {
            return Err(BadMessage::Form);
        }
        let Data::Text(kind) = fields.remove(0) else {
            return Err(BadMessage::Form);
        };
        Self::of(&kind, fields)
    }

    fn of(kind: &[u8], fields: Vec<Data>) -> Result<Self, BadMessage> {
        match (kind, fields.as_slice()) {
            (b"loaded", []) => Ok(Self::Loaded),
            (b"gone", [Data::Int(number)]) => Ok(Self::Gone(*number)),
            (b"hello", [Data::Array(version)]) => version_of(version).map(Self::Hello),
            (b"lacks", [Data::Text(what)]) => Ok(Self::Lacks(lossy(what))),
            (b"failed", [Data::Text(why)]) => Ok(Self::Failed(lossy(why))),
            (b"event", [Data::Text(name), Data::Text(text)]) => {
                Ok(Self::Event(lossy(name), text.clone()))
            }
            (b"said", [Data::Text(level), Data::Text(text)]) => {
                Ok(Self::Said(level_of(level)?, lossy(text)))
            }
            (b"refused", [Data::Int(number), Data::Text(why)]) => {
                Ok(Self::Refused(*number, lossy(why)))
            }
            (b"window", fields) => Self::window(fields),
            _ => Self::large(kind, fields),
        }
    }

    /// Those with a content that is not copied.
    fn large(kind: &[u8], fields: Vec<Data>) -> Result<Self, BadMessage> {
        let mut fields = fields.into_iter();
        let mut next = || fields.next();
        match (kind, next(), next(), next(), next(), next()) {
            (b"answer", Some(Data::Int(number)), Some(value), None, ..) => {
                Ok(Self::Answer(number, value))
            }
            (
                b"picture",
                Some(Data::Int(number)),
                Some(Data::Int(width)),
                Some(Data::Int(height)),
                Some(Data::Buffer(png)),
                None,
            ) if png.starts_with(PNG) => {
                let size = [side(width)?, side(height)?];
                Ok(Self::Picture { number, size, png })
            }
            (b"picture", ..) => Err(BadMessage::Picture),
            _ => Err(BadMessage::Form),
        }
    }

    fn window(fields: &[Data]) -> Result<Self, BadMessage> {
        let [
            Data::Int(number),
            Data::Text(title),
            Data::Bool(visible),
            Data::Int(width),
            Data::Int(height),
            Data::Bool(resizable),
        ] = fields
        else {
            return Err(BadMessage::Form);
        };
        Ok(Self::Window {
            number: *number,
            title: lossy(title),
            visible: *visible,
            // One that has no size yet is not seen.
            size: [*width, *height].map(|side| side.clamp(1, LONGEST_SIDE) as u32),
            resizable: *resizable,
        })
    }
}

fn side(length: i64) -> Result<u32, BadMessage> {
    let side = u32::try_from(length).ok();
    side.filter(|side| (1..=LONGEST_SIDE).contains(&i64::from(*side)))
        .ok_or(BadMessage::Picture)
}

fn version_of(numbers: &[Data]) -> Result<[i64; 3], BadMessage> {
    match numbers {
        [Data::Int(major), Data::Int(minor), Data::Int(patch)] => Ok([*major, *minor, *patch]),
        _ => Err(BadMessage::Form),
    }
}

fn level_of(name: &[u8]) -> Result<Level, BadMessage> {
    match name {
        b"info" => Ok(Level::Info),
        b"warning" => Ok(Level::Warning),
        b"error" => Ok(Level::Error),
        _ => Err(BadMessage::Form),
    }
}

fn lossy(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

/// A message to the process.
pub(crate) fn request(kind: &str, fields: &[Data]) -> Vec<u8> {
    let mut message = Encoder::default();
    message.tuple(fields.len() + 1);
    message.text(kind);
    fields.iter().for_each(|field| message.value(field));
    message.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Data {
        Data::text(text)
    }

    fn read(kind: &str, fields: &[Data]) -> Result<Message, BadMessage> {
        Message::decode(&request(kind, fields))
    }

    #[test]
    fn messages_are_read() {
        let version = Data::Array(vec![Data::Int(6), Data::Int(12), Data::Int(0)]);
        assert_eq!(read("hello", &[version]), Ok(Message::Hello([6, 12, 0])));
        assert_eq!(read("loaded", &[]), Ok(Message::Loaded));
        assert_eq!(
            read("event", &[text("pressed"), text("{}")]),
            Ok(Message::Event("pressed".into(), b"{}".to_vec()))
        );
        assert_eq!(
            read("said", &[text("warning"), text("a.qml:3: no")]),
            Ok(Message::Said(Level::Warning, "a.qml:3: no".into()))
        );
        assert_eq!(
            read("answer", &[Data::Int(2), Data::Float(0.5)]),
            Ok(Message::Answer(2, Data::Float(0.5)))
        );
        let yes = Data::Bool(true);
        let fields = [
            Data::Int(1),
            text("Dials"),
            yes.clone(),
            Data::Int(0),
            Data::Int(1 << 40),
            yes,
        ];
        let window = Message::Window {
            number: 1,
            title: "Dials".into(),
            visible: true,
            size: [1, 8192],
            resizable: true,
        };
        assert_eq!(read("window", &fields), Ok(window));
    }

    #[test]
    fn pictures_are_of_their_form() {
        let picture = |width: i64, height: i64, png: &[u8]| {
            let png = Data::Buffer(png.to_vec());
            read(
                "picture",
                &[Data::Int(1), Data::Int(width), Data::Int(height), png],
            )
        };
        let read = Message::Picture {
            number: 1,
            size: [4, 3],
            png: PNG.to_vec(),
        };
        assert_eq!(picture(4, 3, PNG), Ok(read));
        for (width, height, png) in [
            (0, 3, PNG),
            (4, -1, PNG),
            (4, 8193, PNG),
            (4, 3, &b"BM"[..]),
        ] {
            assert_eq!(picture(width, height, png), Err(BadMessage::Picture));
        }
    }

    /// A message of each kind that has bounds of its own.
    fn some() -> Vec<Vec<u8>> {
        let picture = [1, 4, 3].map(Data::Int);
        let picture = [&picture[..], &[Data::Buffer(PNG.to_vec())]].concat();
        let window = [
            Data::Int(1),
            text("Dials"),
            Data::Bool(true),
            Data::Int(4),
            Data::Int(3),
            Data::Bool(false),
        ];
        let answer = [Data::Int(1), Data::Array(vec![Data::Float(1.5), Data::Nil])];
        vec![
            request("picture", &picture),
            request("window", &window),
            request("answer", &answer),
        ]
    }

    #[test]
    fn changed_and_cut_messages_keep_to_their_bounds() {
        let (mut read, mut refused) = (0, 0);
        for message in some() {
            assert!(Message::decode(&message).is_ok());
            for place in 0..message.len() {
                assert!(
                    Message::decode(&message[..place]).is_err(),
                    "cut at {place}"
                );
                for byte in [0, 1, b'i', b'l', 0x7f, 0x80, 0xff] {
                    let mut changed = message.clone();
                    changed[place] = byte;
                    match Message::decode(&changed) {
                        Ok(Message::Picture { size, .. } | Message::Window { size, .. }) => {
                            let in_bounds = |side: &u32| (1..=8192).contains(side);
                            assert!(size.iter().all(in_bounds), "{byte} at {place}");
                            read += 1;
                        }
                        Ok(_) => read += 1,
                        Err(_) => refused += 1,
                    }
                }
            }
        }
        assert!(read > 100 && refused > 100, "{read} {refused}");
    }

    #[test]
    fn what_is_no_message_is_refused() {
        for bytes in [
            &b""[..],
            b"N",
            b"(\0\0\0\0",
            b"(\x01\0\0\0i\x01\0\0\0",
            b"(\xff\xff\xff\x7fu",
            b"(\x01\0\0\0u\x06\0\0\0loade",
        ] {
            assert!(Message::decode(bytes).is_err(), "{bytes:?}");
        }
        let known = [
            "hello", "lacks", "loaded", "failed", "window", "gone", "event", "said", "answer",
            "refused",
        ];
        for kind in known.into_iter().chain(["unknown"]) {
            let fields = [Data::Nil, Data::Nil, Data::Nil];
            assert_eq!(read(kind, &fields), Err(BadMessage::Form), "{kind}");
        }
        assert_eq!(
            read("said", &[text("loud"), text("a")]),
            Err(BadMessage::Form)
        );
        let long = vec![0; LONGEST + 1];
        assert_eq!(
            Message::decode(&long),
            Err(BadMessage::TooLong(LONGEST + 1))
        );
    }
}
