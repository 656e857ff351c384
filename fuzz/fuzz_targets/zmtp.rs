//! Any bytes as one connection of the ZeroMQ remote API: however they are cut into pieces, the same is read, and what follows a valid
//! handshake is read as well.
//!
//! `cargo fuzz run zmtp`
#![no_main]

use libfuzzer_sys::fuzz_target;

// The decoder is private to the simulator and needs nothing of it.
#[allow(dead_code)]
#[path = "../../crates/io/src/zmtp.rs"]
mod zmtp;

use zmtp::{Decoder, PeerMessage, Violation};

const GREETING_SIZE: usize = 64;
const READY: &[u8] = b"\x04\x19\x05READY\x0bSocket-Type\0\0\0\x03REQ";

/// All that is read from `bytes`, which come in pieces of `size`.
fn read(bytes: &[u8], size: usize) -> (Vec<PeerMessage>, Result<(), Violation>) {
    let (mut decoder, mut read) = (Decoder::new(), Vec::new());
    for piece in bytes.chunks(size) {
        decoder.feed(piece);
        loop {
            match decoder.next() {
                Ok(Some(message)) => read.push(message),
                Ok(None) => break,
                Err(violation) => return (read, Err(violation)),
            }
        }
    }
    (read, Ok(()))
}

/// A request, sent again, is the same request.
fn check_again(request: &zmtp::Request) {
    let sent = zmtp::answer(&request.envelope, &request.content);
    let (again, outcome) = read(&[&handshake()[..], &sent].concat(), usize::MAX);
    assert_eq!(outcome, Ok(()));
    let again = again.into_iter().next();
    assert!(matches!(again, Some(PeerMessage::Request(again)) if again == *request));
}

fn handshake() -> Vec<u8> {
    [&zmtp::hello()[..GREETING_SIZE], READY].concat()
}

fuzz_target!(|input: &[u8]| {
    let Some((&control, rest)) = input.split_first() else { return };
    let bytes = if control & 0x80 == 0 { rest.to_vec() } else { [&handshake()[..], rest].concat() };
    let whole = read(&bytes, usize::MAX);
    assert_eq!(whole, read(&bytes, usize::from(control & 0x7f) + 1));
    for message in &whole.0 {
        if let PeerMessage::Request(request) = message {
            check_again(request);
        }
    }
});
