//! Events of endpoints, as a tape captures and replays them.

use std::io;

use ::io::{HttpReply, WsEvent};
use capture::{Input, Recorded};

/// Answers an HTTP request.
pub(super) type Answer = Box<dyn FnOnce(HttpReply)>;

/// An event of an endpoint: what has happened to a connection.
pub(super) struct Event {
    pub(super) connection: u64,
    pub(super) kind: EventKind,
}

/// What has happened.
pub(super) enum EventKind {
    Open,
    Fail(String),
    Unreachable(io::Error),
    Refused(String),
    Close,
    Message(Vec<u8>),
    Http {
        resource: String,
        body: Vec<u8>,
        /// None in a replay, where nobody waits for the answer.
        answer: Option<Answer>,
    },
}

impl From<WsEvent> for Event {
    fn from(event: WsEvent) -> Self {
        let (connection, kind) = match event {
            WsEvent::Open(connection) => (connection, EventKind::Open),
            WsEvent::Fail(connection, reason) => (connection, EventKind::Fail(reason)),
            WsEvent::Unreachable(connection, error) => (connection, EventKind::Unreachable(error)),
            WsEvent::Refused(connection, origin) => (connection, EventKind::Refused(origin)),
            WsEvent::Close(connection) => (connection, EventKind::Close),
            WsEvent::Message(connection, data) => (connection, EventKind::Message(data)),
            WsEvent::Http {
                connection,
                resource,
                body,
                requester,
            } => {
                let answer: Answer = Box::new(|reply| requester.answer(reply));
                let answer = Some(answer);
                (
                    connection,
                    EventKind::Http {
                        resource,
                        body,
                        answer,
                    },
                )
            }
        };
        Self { connection, kind }
    }
}

const OPEN: u8 = 0;
const FAIL: u8 = 1;
const UNREACHABLE: u8 = 2;
const REFUSED: u8 = 3;
const CLOSE: u8 = 4;
const MESSAGE: u8 = 5;
const HTTP: u8 = 6;

impl Recorded for Event {
    fn write(&self, out: &mut Vec<u8>) {
        self.connection.write(out);
        match &self.kind {
            EventKind::Open => out.push(OPEN),
            EventKind::Fail(reason) => {
                out.push(FAIL);
                reason.write(out);
            }
            EventKind::Unreachable(error) => {
                out.push(UNREACHABLE);
                error.write(out);
            }
            EventKind::Refused(origin) => {
                out.push(REFUSED);
                origin.write(out);
            }
            EventKind::Close => out.push(CLOSE),
            EventKind::Message(data) => {
                out.push(MESSAGE);
                data.write(out);
            }
            EventKind::Http { resource, body, .. } => {
                out.push(HTTP);
                resource.write(out);
                body.write(out);
            }
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let connection = Recorded::read(input)?;
        let kind = match input.byte()? {
            OPEN => EventKind::Open,
            FAIL => EventKind::Fail(Recorded::read(input)?),
            UNREACHABLE => EventKind::Unreachable(Recorded::read(input)?),
            REFUSED => EventKind::Refused(Recorded::read(input)?),
            CLOSE => EventKind::Close,
            MESSAGE => EventKind::Message(Recorded::read(input)?),
            HTTP => EventKind::Http {
                resource: Recorded::read(input)?,
                body: Recorded::read(input)?,
                answer: None,
            },
            _ => return None,
        };
        Some(Self { connection, kind })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_come_back() {
        let http = EventKind::Http {
            resource: "/a?b".into(),
            body: vec![0xff, 0],
            answer: None,
        };
        let kinds = [
            EventKind::Open,
            EventKind::Fail("x".into()),
            EventKind::Unreachable(io::Error::from_raw_os_error(111)),
            EventKind::Refused("http://x".into()),
            EventKind::Close,
            EventKind::Message(vec![1, 0xfe]),
            http,
        ];
        for kind in kinds {
            let (event, mut bytes) = (
                Event {
                    connection: 300,
                    kind,
                },
                Vec::new(),
            );
            event.write(&mut bytes);
            let mut input = Input::new(&bytes);
            let read = Event::read(&mut input).filter(|_| input.is_empty());
            let mut again = Vec::new();
            read.expect("what is written is read").write(&mut again);
            assert_eq!(again, bytes);
        }
        assert!(Event::read(&mut Input::new(&[1, 99])).is_none());
    }
}
