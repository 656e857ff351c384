//! Any datagrams of two others for a participant of ROS 2: it stays within its limits and goes on.
//!
//! An input is a row of datagrams without their heads, each behind 16 bits: its sender, and its length.
//!
//! `cargo fuzz run rtps`
#![no_main]

use std::net::{Ipv4Addr, SocketAddrV4};
use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use rtps::{Core, CoreSettings, Limits, Qos, Timestamp, Written};

fn datagrams(mut input: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    std::iter::from_fn(move || {
        let (word, rest) = input.split_first_chunk()?;
        let word = u16::from_le_bytes(*word);
        let (body, rest) = rest.split_at(usize::from(word & 0x7fff).min(rest.len()));
        input = rest;
        let sender = [2 + (word >> 15) as u8; 12];
        Some([b"RTPS\x02\x03\x01\x10".as_slice(), &sender, body].concat())
    })
}

fuzz_target!(|input: &[u8]| {
    let place = SocketAddrV4::new(Ipv4Addr::LOCALHOST, 7410);
    let mut core = Core::new(CoreSettings {
        prefix: [1; 12],
        domain: 0,
        unicast: place,
        announce_to: Vec::new(),
        has_multicast: true,
        is_alone: false,
        name: String::new(),
        user_data: Vec::new(),
        is_loopback_only: true,
        limits: Limits { max_bytes: 1 << 16, ..Limits::default() },
    });
    let writer = core.create_writer("rt/a", "T", Qos::default(), &[]);
    let reader = core.create_reader("rt/a", "T", Qos::default(), &[]);
    for (number, datagram) in datagrams(input).enumerate() {
        core.receive(&datagram, place, Duration::from_millis(number as u64));
        core.write(writer, &Written { payload: [0; 5].into(), call: None, time: Timestamp::default() });
        core.tick(Duration::from_millis(number as u64 * 40));
        core.take_outgoing();
    }
    while core.take(reader).is_some() {}
});
