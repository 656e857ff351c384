//! ZMTP 3.0, the protocol between ZeroMQ sockets, as far as a REP socket over TCP needs it: bytes in, requests out.
//!
//! Written here because a length in a message is only believed once its bytes have come: nine bytes must not make the simulator reserve
//! terabytes. Mechanisms other than NULL, and peers that speak versions before 3, are refused.

/// The longest message, with its envelope.
const MAX_MESSAGE: usize = 256 << 20;
/// The longest command: those of the handshake.
const MAX_COMMAND: usize = 4096;
/// Parts of an envelope; a REQ socket has one or two.
const MAX_ENVELOPE: usize = 16;
/// Maximum length of the context of a PING, from the protocol.
const MAX_CONTEXT: usize = 16;

const GREETING_SIZE: usize = 64;
const VERSION_AT: usize = 10;
const MECHANISM: std::ops::Range<usize> = 12..32;

/// Bits of a frame's first byte.
mod flag {
    pub const MORE: u8 = 1;
    pub const LONG: u8 = 2;
    pub const COMMAND: u8 = 4;
}

/// A protocol violation of the peer; the connection ends.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum Violation {
    #[error("not ZMTP 3 with the mechanism NULL")]
    Greeting,
    #[error("a malformed frame or command")]
    Frame,
    #[error("a message of more than {MAX_MESSAGE} bytes, or an envelope of too many parts")]
    TooLong,
    #[error("neither a REQ nor a DEALER socket")]
    SocketType,
}

/// A message or command from a peer.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum PeerMessage {
    Request(Request),
    /// Is the other side alive? Answered with the same context.
    Ping(Vec<u8>),
}

/// A request, and what its answer must begin with.
#[derive(Debug, PartialEq, Eq)]
pub struct Request {
    /// Frames up to the empty one, as they came.
    pub envelope: Vec<u8>,
    pub content: Vec<u8>,
}

/// The state of a connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    Greeting,
    Handshake,
    Traffic,
}

/// The receiving side of one connection.
pub(super) struct Decoder {
    stage: Stage,
    bytes: Vec<u8>,
    /// How many of them are done with.
    used: usize,
}

/// One frame: flags, range of its body, start of the next one.
struct Frame {
    flags: u8,
    body: std::ops::Range<usize>,
}

/// The greeting of this side.
pub(super) fn hello() -> Vec<u8> {
    let mut out = vec![0; GREETING_SIZE];
    (out[0], out[9]) = (0xff, 0x7f);
    out[VERSION_AT] = 3;
    out[MECHANISM.start..MECHANISM.start + 4].copy_from_slice(b"NULL");
    out.extend(command(b"READY", b"\x0bSocket-Type\0\0\0\x03REP"));
    out
}

/// The answer to a PING.
pub(super) fn pong(context: &[u8]) -> Vec<u8> {
    command(b"PONG", context)
}

/// A short command.
fn command(name: &[u8], data: &[u8]) -> Vec<u8> {
    let mut out = vec![
        flag::COMMAND,
        (1 + name.len() + data.len()) as u8,
        name.len() as u8,
    ];
    out.extend_from_slice(name);
    out.extend_from_slice(data);
    out
}

/// What comes before the content of an answer to a request.
pub(super) fn answer_head(envelope: &[u8], content: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(envelope.len() + 9);
    out.extend_from_slice(envelope);
    match u8::try_from(content.len()) {
        Ok(length) => out.extend([0, length]),
        Err(_) => {
            out.push(flag::LONG);
            out.extend_from_slice(&(content.len() as u64).to_be_bytes());
        }
    }
    out
}

impl Decoder {
    pub(super) fn new() -> Self {
        Self {
            stage: Stage::Greeting,
            bytes: Vec::new(),
            used: 0,
        }
    }

    /// Whether the handshake is over.
    pub(super) fn is_ready(&self) -> bool {
        self.stage == Stage::Traffic
    }

    /// Takes bytes as they come.
    pub(super) fn feed(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.used);
        self.used = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// How many bytes wait to be decoded.
    pub(super) fn stored(&self) -> usize {
        self.bytes.len() - self.used
    }

    /// Continues the handshake as far as the received bytes allow.
    ///
    /// # Errors
    /// When this is no peer of ours.
    pub(super) fn shake_hands(&mut self) -> Result<(), Violation> {
        if self.stage == Stage::Greeting && self.greeting()? {
            self.stage = Stage::Handshake;
        }
        if self.stage == Stage::Handshake && self.ready()? {
            self.stage = Stage::Traffic;
        }
        Ok(())
    }

    /// The next message or command of the peer; None when more bytes are needed.
    ///
    /// # Errors
    /// When this cannot become a message any more.
    pub(super) fn next(&mut self) -> Result<Option<PeerMessage>, Violation> {
        self.shake_hands()?;
        while self.stage == Stage::Traffic {
            match self.traffic()? {
                None => return Ok(None),
                Some(None) => {}
                Some(said) => return Ok(said),
            }
        }
        Ok(None)
    }

    /// Checks as much of the greeting as there is; whether it is complete.
    fn greeting(&mut self) -> Result<bool, Violation> {
        let begun = &self.bytes[self.used..];
        let wrong = begun.first().is_some_and(|&byte| byte != 0xff)
            || begun.get(9).is_some_and(|&byte| byte != 0x7f)
            || begun.get(VERSION_AT).is_some_and(|&version| version < 3);
        if wrong {
            return Err(Violation::Greeting);
        }
        let Some(greeting) = begun.get(..GREETING_SIZE) else {
            return Ok(false);
        };
        let (name, padding) = greeting[MECHANISM].split_at(4);
        if name != b"NULL" || padding.iter().any(|&byte| byte != 0) {
            return Err(Violation::Greeting);
        }
        self.used += GREETING_SIZE;
        Ok(true)
    }

    /// Reads the peer's READY; whether it was there.
    fn ready(&mut self) -> Result<bool, Violation> {
        let Some(frame) = self.frame(self.used)? else {
            return Ok(false);
        };
        let data = self.bytes[frame.body.clone()]
            .strip_prefix(b"\x05READY")
            .ok_or(Violation::Frame)?;
        if frame.flags & flag::COMMAND == 0 {
            return Err(Violation::Frame);
        }
        if !matches!(property(data, b"Socket-Type")?, Some(b"REQ" | b"DEALER")) {
            return Err(Violation::SocketType);
        }
        self.used = frame.body.end;
        Ok(true)
    }

    /// The next request or command; Some(None) for one that is ignored.
    fn traffic(&mut self) -> Result<Option<Option<PeerMessage>>, Violation> {
        let Some(first) = self.frame(self.used)? else {
            return Ok(None);
        };
        if first.flags & flag::COMMAND != 0 {
            let body = &self.bytes[first.body.clone()];
            let ping = body
                .strip_prefix(b"\x04PING")
                .and_then(|ping| ping.get(2..));
            let said = ping.map(|context| {
                PeerMessage::Ping(context[..context.len().min(MAX_CONTEXT)].to_vec())
            });
            self.used = first.body.end;
            return Ok(Some(said));
        }
        let Some(parts) = self.message(first)? else {
            return Ok(None);
        };
        let end = parts.last().map_or(self.used, |part| part.end);
        let request = self.request(&parts);
        self.used = end;
        Ok(Some(request.map(PeerMessage::Request)))
    }

    /// All frames of a message; None while some are missing.
    fn message(&self, first: Frame) -> Result<Option<Vec<std::ops::Range<usize>>>, Violation> {
        let mut parts = Vec::new();
        let mut frame = first;
        loop {
            let (more, end) = (frame.flags & flag::MORE != 0, frame.body.end);
            parts.push(frame.body);
            if !more {
                return Ok(Some(parts));
            }
            if parts.len() > MAX_ENVELOPE {
                return Err(Violation::TooLong);
            }
            let Some(next) = self.frame(end)? else {
                return Ok(None);
            };
            if next.flags & flag::COMMAND != 0 {
                return Err(Violation::Frame);
            }
            frame = next;
        }
    }

    /// An envelope that ends with an empty part, and one part after it; anything else is not a request.
    fn request(&self, parts: &[std::ops::Range<usize>]) -> Option<Request> {
        let (content, envelope) = parts.split_last()?;
        let delimiter = envelope.last().filter(|last| last.is_empty())?;
        let envelope = self.bytes[self.used..delimiter.end].to_vec();
        Some(Request {
            envelope,
            content: self.bytes[content.clone()].to_vec(),
        })
    }

    /// The frame at `at`; None while it is incomplete. Its length is checked before its bytes have come.
    fn frame(&self, at: usize) -> Result<Option<Frame>, Violation> {
        let rest = &self.bytes[at..];
        let Some(&flags) = rest.first() else {
            return Ok(None);
        };
        if flags & !(flag::MORE | flag::LONG | flag::COMMAND) != 0 {
            return Err(Violation::Frame);
        }
        let is_long = flags & flag::LONG != 0;
        let head = if is_long { 9 } else { 2 };
        let Some(length) = rest.get(1..head) else {
            return Ok(None);
        };
        let length = length
            .iter()
            .fold(0_u64, |length, &byte| length << 8 | u64::from(byte));
        let limit = if flags & flag::COMMAND != 0 {
            MAX_COMMAND
        } else {
            MAX_MESSAGE
        };
        let length = usize::try_from(length)
            .ok()
            .filter(|&length| length <= limit)
            .ok_or(Violation::TooLong)?;
        let body = at + head..at + head + length;
        if body.end - self.used > MAX_MESSAGE + GREETING_SIZE {
            return Err(Violation::TooLong);
        }
        Ok((self.bytes.len() >= body.end).then_some(Frame { flags, body }))
    }
}

/// The value of a property in the data of READY.
fn property<'a>(mut data: &'a [u8], wanted: &[u8]) -> Result<Option<&'a [u8]>, Violation> {
    while let Some((&length, rest)) = data.split_first() {
        let (name, rest) = rest
            .split_at_checked(usize::from(length))
            .ok_or(Violation::Frame)?;
        let (size, rest) = rest.split_first_chunk::<4>().ok_or(Violation::Frame)?;
        let size = usize::try_from(u32::from_be_bytes(*size)).map_err(|_| Violation::Frame)?;
        let (value, rest) = rest.split_at_checked(size).ok_or(Violation::Frame)?;
        if name.eq_ignore_ascii_case(wanted) {
            return Ok(Some(value));
        }
        data = rest;
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::*;

    fn opening(socket_type: &[u8]) -> Vec<u8> {
        let mut bytes = hello();
        bytes.truncate(GREETING_SIZE);
        let mut ready = b"\x0bSocket-Type\0\0\0".to_vec();
        ready.push(socket_type.len() as u8);
        ready.extend_from_slice(socket_type);
        bytes.extend(command(b"READY", &ready));
        bytes
    }

    fn answer(envelope: &[u8], content: &[u8]) -> Vec<u8> {
        [&answer_head(envelope, content), content].concat()
    }

    fn request(content: &[u8]) -> Vec<u8> {
        answer(&[flag::MORE, 0], content)
    }

    fn said_at_once(bytes: &[u8]) -> Result<Option<PeerMessage>, Violation> {
        let mut decoder = Decoder::new();
        decoder.feed(bytes);
        decoder.next()
    }

    /// All that is read of bytes that come in pieces, and what went wrong.
    fn read_in_pieces(bytes: &[u8], size: usize) -> (Vec<PeerMessage>, Option<Violation>) {
        let (mut decoder, mut read) = (Decoder::new(), Vec::new());
        for piece in bytes.chunks(size) {
            decoder.feed(piece);
            loop {
                match decoder.next() {
                    Ok(Some(said)) => read.push(said),
                    Ok(None) => break,
                    Err(violation) => return (read, Some(violation)),
                }
            }
            assert!(decoder.used <= decoder.bytes.len());
        }
        (read, None)
    }

    #[test]
    fn requests_come_byte_by_byte() {
        let mut bytes = opening(b"REQ");
        bytes.extend(request(b"short"));
        bytes.extend(command(b"PING", b"\0\x01ctx"));
        bytes.extend(request(&[7; 300]));
        let mut decoder = Decoder::new();
        let mut said = Vec::new();
        for byte in bytes {
            decoder.feed(&[byte]);
            while let Some(one) = decoder.next().expect("the bytes are well-formed") {
                said.push(one);
            }
        }
        let expect = |content: &[u8]| {
            PeerMessage::Request(Request {
                envelope: vec![1, 0],
                content: content.to_vec(),
            })
        };
        assert_eq!(
            said,
            [
                expect(b"short"),
                PeerMessage::Ping(b"ctx".to_vec()),
                expect(&[7; 300])
            ]
        );
    }

    #[test]
    fn the_whole_envelope_comes_back() {
        let mut bytes = opening(b"REQ");
        bytes.extend([flag::MORE, 2, 8, 9, flag::MORE, 0, 0, 1, b'x']);
        let Ok(Some(PeerMessage::Request(request))) = said_at_once(&bytes) else {
            panic!("a request")
        };
        assert_eq!(
            answer(&request.envelope, b"y"),
            [flag::MORE, 2, 8, 9, flag::MORE, 0, 0, 1, b'y']
        );
    }

    #[test]
    fn lengths_are_not_believed() {
        for length in [MAX_MESSAGE as u64 + 1, 1 << 42, u64::MAX] {
            let mut bytes = opening(b"REQ");
            bytes.push(flag::LONG);
            bytes.extend(length.to_be_bytes());
            assert_eq!(said_at_once(&bytes), Err(Violation::TooLong), "{length}");
        }
        let mut bytes = opening(b"REQ");
        bytes.extend([flag::MORE, 0].repeat(MAX_ENVELOPE + 1));
        assert_eq!(said_at_once(&bytes), Err(Violation::TooLong));
    }

    #[test]
    fn others_are_refused() {
        assert_eq!(said_at_once(b"GET / HTTP/1.1"), Err(Violation::Greeting));
        assert_eq!(said_at_once(&opening(b"SUB")), Err(Violation::SocketType));
        let mut old = opening(b"REQ");
        old[VERSION_AT] = 1;
        assert_eq!(said_at_once(&old), Err(Violation::Greeting));
        let mut curve = opening(b"REQ");
        curve[MECHANISM.start..MECHANISM.start + 5].copy_from_slice(b"CURVE");
        assert_eq!(said_at_once(&curve), Err(Violation::Greeting));
    }

    #[test]
    fn any_bytes_are_read_or_refused_however_they_are_cut() {
        let mut random = Random::new(1);
        let mut valid = opening(b"DEALER");
        valid.extend(request(b"abc"));
        valid.extend(command(b"PING", b"\0\0"));
        for _ in 0..20_000 {
            let mut bytes = valid.clone();
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len());
                bytes[at] = random.byte();
            }
            bytes.truncate(random.below(bytes.len() + 1));
            let pieces = random.below(40) + 1;
            assert_eq!(
                read_in_pieces(&bytes, bytes.len().max(1)),
                read_in_pieces(&bytes, pieces),
                "{bytes:?}"
            );
        }
    }
}
