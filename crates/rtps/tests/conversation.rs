//! Participants that talk by a network in which datagrams are lost and damaged. Payloads are multiples of four bytes: others are filled up.

use std::net::{Ipv4Addr, SocketAddrV4};
use std::time::Duration;

use rtps::{
    Core, CoreSettings, Durability, EntityId, History, Limits, Qos, Reliability, Timestamp, Written,
};
use test_support::random::Random;

const TYPE: &str = "std_msgs::msg::dds_::String_";

struct World {
    cores: Vec<Core>,
    now: Duration,
    random: Random,
    /// Of a hundred datagrams, how many are lost.
    lost: usize,
    sent: usize,
}

fn address(index: usize) -> SocketAddrV4 {
    SocketAddrV4::new(Ipv4Addr::LOCALHOST, 7410 + 2 * index as u16)
}

impl World {
    fn new(count: usize, lost: usize) -> Self {
        let cores = (0..count).map(|index| {
            let mut prefix = [0; 12];
            prefix[11] = index as u8 + 1;
            Core::new(CoreSettings {
                prefix,
                domain: 0,
                unicast: address(index),
                announce_to: (0..count).map(address).collect(),
                has_multicast: true,
                is_alone: false,
                name: String::new(),
                user_data: Vec::new(),
                is_loopback_only: true,
                limits: Limits {
                    max_messages: 100,
                    max_bytes: 1 << 20,
                    ..Limits::default()
                },
            })
        });
        Self {
            cores: cores.collect(),
            now: Duration::ZERO,
            random: Random::new(1),
            lost,
            sent: 0,
        }
    }

    /// Some time passes.
    fn run(&mut self, milliseconds: u64) {
        for _ in 0..milliseconds / 10 {
            self.now += Duration::from_millis(10);
            for sender in 0..self.cores.len() {
                self.cores[sender].tick(self.now);
                self.deliver(sender);
            }
        }
    }

    fn deliver(&mut self, sender: usize) {
        for datagram in self.cores[sender].take_outgoing() {
            self.sent += 1;
            let receiver = (0..self.cores.len()).find(|index| address(*index) == datagram.to);
            if let Some(receiver) = receiver.filter(|_| self.random.below(100) >= self.lost) {
                self.cores[receiver].receive(&datagram.bytes, address(sender), self.now);
            }
        }
    }

    fn write(&mut self, core: usize, writer: EntityId, text: &[u8]) {
        let payload = [&[0, 1, 0, 0], text].concat().into();
        self.cores[core].write(
            writer,
            &Written {
                payload,
                call: None,
                time: Timestamp::default(),
            },
        );
    }

    fn taken(&mut self, core: usize, reader: EntityId) -> Vec<Vec<u8>> {
        std::iter::from_fn(|| self.cores[core].take(reader))
            .map(|sample| sample.payload[4..].to_vec())
            .collect()
    }
}

fn all() -> Qos {
    Qos {
        history: History::KeepAll,
        ..Qos::default()
    }
}

#[test]
fn reliable_messages_arrive_in_order_whatever_is_lost() {
    let mut world = World::new(2, 30);
    let writer = world.cores[0].create_writer("rt/a", TYPE, all(), &[]);
    let reader = world.cores[1].create_reader("rt/a", TYPE, all(), &[]);
    world.run(10_000);
    assert_eq!(
        (
            world.cores[0].matched(writer),
            world.cores[1].matched(reader)
        ),
        (1, 1)
    );
    for number in 0..90u8 {
        world.write(0, writer, &[number; 12]);
    }
    // In four fragments, of which some are lost.
    world.write(0, writer, &[200; 60_000]);
    world.run(10_000);
    let taken = world.taken(1, reader);
    let expected: Vec<Vec<u8>> = (0..90u8)
        .map(|number| vec![number; 12])
        .chain([vec![200; 60_000]])
        .collect();
    assert!(
        taken == expected,
        "{} of {} messages",
        taken.len(),
        expected.len()
    );
}

/// Two, three or ten of them, each with a writer that all others read, and one that nobody reads.
#[test]
fn participants_with_nothing_to_say_are_quiet() {
    for count in [2, 3, 10] {
        let mut world = World::new(count, 0);
        let writers: Vec<_> = (0..count)
            .map(|index| {
                let core = &mut world.cores[index];
                core.create_reader("rt/a", TYPE, all(), &[]);
                core.create_writer(&format!("rt/b{index}"), TYPE, all(), &[]);
                core.create_writer("rt/a", TYPE, all(), &[])
            })
            .collect();
        world.run(3000);
        assert_eq!(world.cores[0].matched(writers[0]), count);
        world.sent = 0;
        world.run(6000);
        // Each announces itself every two seconds, at every place and to the group.
        assert!(
            world.sent <= count * (count + 1) * 4,
            "{} datagrams of {count}",
            world.sent
        );
        world.sent = 0;
        world.write(0, writers[0], b"abcd");
        world.run(10);
        assert!(
            (1..6 * count).contains(&world.sent),
            "{} datagrams of {count}",
            world.sent
        );
    }
}

#[test]
fn late_readers_get_what_is_durable() {
    let mut world = World::new(2, 10);
    let durable = Qos {
        durability: Durability::TransientLocal,
        history: History::KeepLast(3),
        ..Qos::default()
    };
    let writer = world.cores[0].create_writer("rt/a", TYPE, durable, &[]);
    for number in 0..10 {
        world.write(0, writer, &[number; 4]);
    }
    world.run(1000);
    let late = world.cores[1].create_reader("rt/a", TYPE, durable, &[]);
    let volatile = world.cores[1].create_reader("rt/a", TYPE, Qos::default(), &[]);
    let here = world.cores[0].create_reader("rt/a", TYPE, durable, &[]);
    world.run(5000);
    world.write(0, writer, &[77; 4]);
    world.run(1000);
    assert_eq!(
        world.taken(1, late),
        [[8; 4], [9; 4], [77; 4]],
        "the newest three"
    );
    assert_eq!(world.taken(1, volatile), [[77; 4]]);
    assert_eq!(world.taken(0, here), [[8; 4], [9; 4], [77; 4]]);
}

#[test]
fn policies_that_do_not_fit_find_no_partner() {
    let mut world = World::new(2, 0);
    let best_effort = Qos {
        reliability: Reliability::BestEffort,
        ..Qos::default()
    };
    let writer = world.cores[0].create_writer("rt/a", TYPE, best_effort, &[]);
    let reader = world.cores[1].create_reader("rt/a", TYPE, Qos::default(), &[]);
    let other_type =
        world.cores[1].create_reader("rt/a", "std_msgs::msg::dds_::Int32_", best_effort, &[]);
    let fitting = world.cores[1].create_reader("rt/a", TYPE, best_effort, &[]);
    world.run(3000);
    assert_eq!(world.cores[0].matched(writer), 1);
    world.write(0, writer, b"abcd");
    world.run(100);
    assert!(world.taken(1, reader).is_empty() && world.taken(1, other_type).is_empty());
    assert_eq!(world.taken(1, fitting), [b"abcd"]);
    world.cores[1].remove(fitting);
    world.run(100);
    assert_eq!(world.cores[0].matched(writer), 0, "its end is announced");
}

#[test]
fn a_reader_that_is_flooded_keeps_the_newest() {
    let mut world = World::new(2, 0);
    let writer = world.cores[0].create_writer("rt/a", TYPE, all(), &[]);
    let reader = world.cores[1].create_reader(
        "rt/a",
        TYPE,
        Qos {
            history: History::KeepLast(3),
            ..all()
        },
        &[],
    );
    world.run(3000);
    for number in 0..50 {
        world.write(0, writer, &[number; 4]);
        world.run(10);
    }
    assert_eq!(world.taken(1, reader), [[47; 4], [48; 4], [49; 4]]);
    assert_eq!(world.cores[1].dropped(reader), 47);
}

#[test]
fn participants_that_leave_or_fall_silent_are_forgotten() {
    let mut world = World::new(3, 0);
    world.run(1000);
    assert_eq!(world.cores[0].peers(), 2);
    world.cores[1].leave();
    world.deliver(1);
    assert_eq!(world.cores[0].peers(), 1);
    let silent = world.cores.split_off(1);
    world.run(30_000);
    assert_eq!(world.cores[0].peers(), 0);
    drop(silent);
}

#[test]
fn damaged_datagrams_do_no_harm() {
    let mut world = World::new(2, 0);
    let writer = world.cores[0].create_writer("rt/a", TYPE, all(), &[]);
    let reader = world.cores[1].create_reader("rt/a", TYPE, all(), &[]);
    world.run(1000);
    for round in 0..300u64 {
        world.write(
            0,
            writer,
            &vec![round as u8; (round * 97 % 40_000) as usize],
        );
        world.cores[0].tick(world.now);
        for datagram in world.cores[0].take_outgoing() {
            let mut bytes = datagram.bytes.clone();
            for _ in 0..=world.random.below(4) {
                let at = 20 + world.random.below(bytes.len() - 20);
                bytes[at] = world.random.byte();
            }
            bytes.truncate(bytes.len() - world.random.below(3) * 5);
            world.cores[1].receive(&bytes, address(0), world.now);
            world.cores[1].tick(world.now);
            world.cores[1].take_outgoing();
        }
        world.now += Duration::from_millis(10);
    }
    world.run(100);
    while world.cores[1].take(reader).is_some() {}
    assert!(world.cores[1].waiting(reader) == 0);
}

/// A datagram of a participant with one submessage, numbers in little-endian order.
fn datagram(from: u8, kind: u8, body: &[&[u8]]) -> Vec<u8> {
    let mut prefix = [0; 12];
    prefix[11] = from;
    let body = body.concat();
    [
        b"RTPS\x02\x03\0\0",
        &prefix[..],
        &[kind, 5],
        &(body.len() as u16).to_le_bytes(),
        &body,
    ]
    .concat()
}

#[test]
fn sequence_numbers_at_the_end_of_their_range_do_no_harm() {
    let mut world = World::new(2, 0);
    let writer = world.cores[0].create_writer("rt/a", TYPE, all(), &[]);
    let reader = world.cores[1].create_reader("rt/a", TYPE, all(), &[]);
    world.run(1000);
    for last in [i64::MAX, i64::MAX - 1, i64::MAX - 256, i64::MAX / 2] {
        let number = [
            ((last >> 32) as u32).to_le_bytes(),
            (last as u32).to_le_bytes(),
        ]
        .concat();
        let ends = [reader.0, writer.0].concat();
        let count = [1, 0, 0, 0];
        let messages = [
            datagram(1, 0x07, &[&ends, &number, &number, &count]),
            datagram(1, 0x08, &[&ends, &number, &number, &[0; 4]]),
            datagram(1, 0x15, &[&[0, 0, 16, 0], &ends, &number, &[0, 1, 0, 0]]),
            datagram(1, 0x15, &[&[0, 0, 16, 0], &ends, &number, &[0, 1, 0, 0]]),
            datagram(1, 0x07, &[&ends, &number, &number, &count]),
        ];
        for message in messages {
            world.cores[1].receive(&message, address(0), world.now);
        }
        world.run(20);
    }
    assert_eq!(world.cores[1].matched(reader), 1);
}
