//! Participants with sockets, which find each other without multicast or not at all. Each test has a domain of its own.

#![cfg(target_os = "linux")]

use std::net::Ipv4Addr;
use std::time::{Duration, Instant};

use rtps::{Discovery, EntityId, Network, Participant, Qos, Range, Timestamp, Written};

const HERE: Ipv4Addr = Ipv4Addr::LOCALHOST;
/// All of 127.0.0.0/8 is this machine on Linux: it stands for another one.
const THERE: Ipv4Addr = Ipv4Addr::new(127, 0, 0, 2);
const TYPE: &str = "std_msgs::msg::dds_::String_";

fn participant(domain: u32, address: Ipv4Addr, range: Range, peers: &[Ipv4Addr]) -> Participant {
    let discovery = Discovery {
        range,
        static_peers: peers.to_vec(),
    };
    let network = Network::Address(address);
    Participant::new(domain, network, &discovery, "", &[]).expect("the loopback is there")
}

/// Other programs may be in the same domain: the process decides which it is.
fn domain(number: u32) -> u32 {
    200 + (std::process::id() + number) % 30
}

#[expect(
    clippy::disallowed_methods,
    reason = "participants have threads and sockets: they need time"
)]
fn is_soon(holds: impl Fn() -> bool, limit: Duration) -> bool {
    let end = Instant::now() + limit;
    while Instant::now() < end {
        if holds() {
            return true;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    holds()
}

/// Whether what one writes to a new topic reaches the other.
fn talk(topic: &str, writing: &Participant, reading: &Participant) -> bool {
    let writer = writing.with(|core| core.create_writer(topic, TYPE, Qos::default(), &[]));
    let reader = reading.with(|core| core.create_reader(topic, TYPE, Qos::default(), &[]));
    let is_matched = |of: &Participant, entity: EntityId| of.with(|core| core.matched(entity)) > 0;
    let limit = Duration::from_secs(20);
    if !is_soon(
        || is_matched(writing, writer) && is_matched(reading, reader),
        limit,
    ) {
        return false;
    }
    let written = Written {
        payload: vec![0, 1, 0, 0, 7].into(),
        call: None,
        time: Timestamp::default(),
    };
    writing.with(|core| core.write(writer, &written));
    let has_arrived = || reading.with(|core| core.take(reader)).is_some();
    is_soon(has_arrived, limit)
}

#[test]
fn those_on_one_machine_need_no_multicast() {
    let one = participant(domain(0), HERE, Range::Localhost, &[]);
    let other = participant(domain(0), HERE, Range::Localhost, &[]);
    assert!(one.multicast_error().is_none());
    assert!(talk("rt/a", &one, &other));
}

#[test]
fn a_static_peer_is_found_by_one_side() {
    let asking = participant(domain(1), HERE, Range::Localhost, &[THERE]);
    let asked = participant(domain(1), THERE, Range::Localhost, &[]);
    assert!(talk("rt/there", &asking, &asked));
    assert!(talk("rt/back", &asked, &asking));
}

#[test]
fn nobody_finds_one_whose_discovery_is_off() {
    let off = participant(domain(2), HERE, Range::Off, &[THERE]);
    let seeking = participant(domain(2), THERE, Range::Localhost, &[HERE]);
    let third = participant(domain(2), THERE, Range::Localhost, &[]);
    // By then the announcements have come that the others need.
    assert!(talk("rt/a", &seeking, &third));
    let counts = [&off, &seeking, &third].map(|one| one.with(|core| core.peers()));
    assert_eq!(counts, [0, 1, 1]);
}
