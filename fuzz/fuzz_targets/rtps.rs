//! Any datagrams for a participant of ROS 2: it stays within its limits and goes on.
//!
//! `cargo fuzz run rtps`
#![no_main]

use std::net::{Ipv4Addr, SocketAddrV4};
use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use rtps::{Core, Limits, Qos, Settings, Time, Written};

fuzz_target!(|datagrams: Vec<Vec<u8>>| {
    let place = SocketAddrV4::new(Ipv4Addr::LOCALHOST, 7410);
    let mut core = Core::new(Settings {
        prefix: [1; 12],
        domain: 0,
        unicast: place,
        announce_to: Vec::new(),
        name: String::new(),
        user_data: Vec::new(),
        is_loopback_only: true,
        limits: Limits { max_bytes: 1 << 16, ..Limits::default() },
    });
    let writer = core.create_writer("rt/a", "T", Qos::default(), &[]);
    let reader = core.create_reader("rt/a", "T", Qos::default(), &[]);
    for (number, bytes) in datagrams.iter().enumerate() {
        // The head of the protocol, and of two senders.
        let head = [b"RTPS\x02\x03\x01\x10".as_slice(), &[number as u8 % 2; 12]].concat();
        core.receive(&[head, bytes.clone()].concat(), place, Duration::from_millis(number as u64));
        core.write(writer, &Written { payload: [0; 5].into(), call: None, time: Time::default() });
        core.tick(Duration::from_millis(number as u64 * 40));
        core.take_outgoing();
    }
    while core.take(reader).is_some() {}
});
