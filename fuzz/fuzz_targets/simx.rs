//! Any bytes as one connection of the legacy remote API: however they are cut into pieces, the same is read; every message has a reply,
//! whose commands are those that were executed; what waits is bounded.
//!
//! `cargo fuzz run simx`
#![no_main]

use libfuzzer_sys::fuzz_target;

use wire::simx::{Answer, Packets, Session, Stamp, Violation, cut};

/// All messages in `bytes`, which come in pieces of `size`.
fn read(bytes: &[u8], size: usize) -> (Vec<Vec<u8>>, Result<(), Violation>) {
    let (mut packets, mut read) = (Packets::default(), Vec::new());
    for piece in bytes.chunks(size) {
        packets.feed(piece);
        loop {
            match packets.next_message() {
                Ok(Some(message)) => read.push(message),
                Ok(None) => break,
                Err(violation) => return (read, Err(violation)),
            }
        }
    }
    (read, Ok(()))
}

/// A message of a client, executed and answered.
fn serve(session: &mut Session, message: &[u8], now: i64) -> Result<(), Violation> {
    session.receive(message, Default::default(), now)?;
    let mut executed = 0;
    if let Some(mut batch) = session.due(Stamp { system_time: now as i32, ..Stamp::default() }) {
        while let Some(command) = batch.next() {
            executed += 1;
            let data = command.data.clone();
            batch.answer(Answer { failed: executed % 3 == 0, data, ends_stream: executed % 5 == 0 });
        }
        session.complete(batch);
    }
    let reply = session.reply(now);
    assert!(reply.len() >= 18);
    let (messages, outcome) = read(&cut(&reply, 1300, Default::default()), usize::MAX);
    assert_eq!((messages, outcome), (vec![reply], Ok(())));
    Ok(())
}

fuzz_target!(|input: &[u8]| {
    let Some((&size, bytes)) = input.split_first() else { return };
    let whole = read(bytes, usize::MAX);
    assert_eq!(whole, read(bytes, usize::from(size) + 1));
    let mut session = Session::new(false);
    session.connect("fuzz".into());
    for (place, message) in whole.0.iter().enumerate() {
        if serve(&mut session, message, 10 * place as i64).is_err() {
            break;
        }
    }
    session.disconnect();
    assert!(!session.is_ready());
});
