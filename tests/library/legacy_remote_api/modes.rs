//! Operation modes, streams and messages.

use std::time::{Duration, Instant};

use test_support::process::LIMIT;

use super::simx::{
    BLOCKING, Client, Command, DISCONTINUE, ONESHOT, ONESHOT_SPLIT, STREAMING, STREAMING_SPLIT,
    Server, command, floats, ints, packets, read_floats, text,
};

const SCENE: &str = "
    sim = require 'sim'
    local dummy = sim.createDummy(0.1)
    sim.setObjectAlias(dummy, 'target')
    sim.setObjectPosition(dummy, {1, 2, 3})
    sim.setStringSignal('long', string.rep('x', 3000))
";

fn serve() -> (Server, Client) {
    let server = Server::start(SCENE);
    let client = server.connect();
    (server, client)
}

/// Empty messages until a reply has commands.
fn next(client: &mut Client) -> Vec<Command> {
    let begun = Instant::now();
    loop {
        let reply = client.exchange(&[]);
        if !reply.commands.is_empty() {
            return reply.commands;
        }
        assert!(begun.elapsed() < LIMIT, "nothing comes");
    }
}

fn position(client: &mut Client) -> Vec<u8> {
    [client.handle("target"), (-1_i32).to_le_bytes()].concat()
}

#[test]
fn a_stream_goes_on_until_it_is_discontinued() {
    let (_server, mut client) = serve();
    let key = position(&mut client);
    let stream = command(0x200e, STREAMING, &key, &[]);
    let mut replies = vec![client.exchange(&[stream]).commands];
    replies.extend((0..3).map(|_| next(&mut client)));
    for answer in replies.concat() {
        assert_eq!(
            (answer.mode, answer.status, read_floats(&answer.data)),
            (STREAMING, 0, vec![1.0, 2.0, 3.0])
        );
    }
    let mut last = client
        .exchange(&[command(0x200e, DISCONTINUE, &key, &[])])
        .commands;
    while last.first().is_none_or(|answer| answer.mode == STREAMING) {
        last = client.exchange(&[]).commands;
    }
    assert_eq!(
        last,
        [Command {
            full: 34,
            ..command(0x200e, DISCONTINUE, &key, &[])
        }]
    );
    std::thread::sleep(Duration::from_millis(30));
    assert!(client.exchange(&[]).commands.is_empty() && client.exchange(&[]).commands.is_empty());
}

#[test]
fn a_stream_with_a_delay_waits() {
    let (_server, mut client) = serve();
    let key = position(&mut client);
    let begun = Instant::now();
    let mut answers = client
        .exchange(&[Command {
            delay: 50,
            ..command(0x200e, STREAMING, &key, &[])
        }])
        .commands
        .len();
    while answers < 6 {
        answers += next(&mut client).len();
    }
    // However busy the machine is: the server, which counts in whole milliseconds, has waited five times since it was asked.
    assert!(
        begun.elapsed() >= Duration::from_millis(5 * 49),
        "{answers} results within {:?}",
        begun.elapsed()
    );
}

#[test]
fn commands_of_one_message_are_executed_together() {
    let (_server, mut client) = serve();
    let log = Command {
        status: 1,
        ..command(0x3008, ONESHOT, &text("a"), &[])
    };
    let target = client.handle("target");
    let place = |x| {
        command(
            0x101b,
            ONESHOT,
            &target,
            &[ints(&[-1]), floats(&[x, 0.0, 0.0])].concat(),
        )
    };
    let sent = [log.clone(), log, place(5.0), place(7.0)];
    let mut answers = client.exchange(&sent).commands;
    if answers.is_empty() {
        answers = next(&mut client);
    }
    let ids: Vec<u16> = answers.iter().map(|answer| answer.id).collect();
    assert_eq!(
        ids,
        [0x3008, 0x3008, 0x101b],
        "texts are not merged, positions are"
    );
    let key = position(&mut client);
    assert_eq!(read_floats(&client.get(0x200e, &key, &[])), [7.0, 0.0, 0.0]);
}

#[test]
fn long_messages_come_in_packets() {
    let (_server, mut client) = serve();
    let long: Vec<u8> = (0..3000).map(|i| i as u8).collect();
    client.get(0x3015, &text("x"), &long);
    assert_eq!(client.get(0x3012, &text("x"), &[]), long);
}

#[test]
fn results_come_in_pieces() {
    let (_server, mut client) = serve();
    let split = Command {
        delay: 1300,
        ..command(0x3012, STREAMING_SPLIT, &text("long"), &[])
    };
    let mut pieces = client.exchange(&[split]).commands;
    while pieces.len() < 6 {
        pieces.extend(next(&mut client));
    }
    let offsets: Vec<usize> = pieces.iter().map(|piece| piece.offset).collect();
    assert_eq!(offsets, [0, 1300, 2600, 0, 1300, 2600]);
    assert!(pieces.iter().all(|piece| piece.full == 26 + 5 + 3000));
}

#[test]
fn commands_come_in_pieces_and_have_no_reply_without_data() {
    let (_server, mut client) = serve();
    let data: Vec<u8> = (0..700).map(|i| i as u8).collect();
    for (place, part) in data.chunks(300).enumerate() {
        let piece = command(0x3015, ONESHOT_SPLIT, &text("y"), part);
        let reply = client.exchange(&[Command {
            offset: 300 * place,
            full: 26 + 2 + 700,
            delay: 300,
            ..piece
        }]);
        assert!(reply.commands.is_empty());
    }
    assert_eq!(client.get(0x3012, &text("y"), &[]), data);
}

#[test]
fn a_stream_that_waits_for_a_signal_ends_with_it() {
    let (_server, mut client) = serve();
    let mut answers = client
        .exchange(&[command(0x3017, STREAMING, &text("event"), &[])])
        .commands;
    answers.extend(next(&mut client));
    assert!(answers.iter().all(|answer| answer.status == 1));
    client.exchange(&[command(0x3015, ONESHOT, &text("event"), b"now")]);
    let event = loop {
        if let Some(event) = next(&mut client)
            .into_iter()
            .find(|answer| answer.id == 0x3017 && answer.status == 0)
        {
            break event;
        }
    };
    assert_eq!((event.mode, &event.data[..]), (STREAMING, &b"now"[..]));
    client.get(0x3015, &text("event"), b"again");
    assert_eq!(
        client.get(0x3012, &text("event"), &[]),
        b"again",
        "the stream is over"
    );
}

#[test]
fn strings_are_streamed_without_failures() {
    let (_server, mut client) = serve();
    let mut read = client
        .exchange(&[command(0x3018, STREAMING, &text("s"), &[])])
        .commands;
    for part in ["1", "23"] {
        let mut answers = client
            .exchange(&[Command {
                status: 1,
                ..command(0x3016, BLOCKING, &text("s"), part.as_bytes())
            }])
            .commands;
        while !answers
            .iter()
            .any(|answer| answer.id == 0x3018 && !answer.data.is_empty())
        {
            read.append(&mut answers);
            answers = next(&mut client);
        }
        read.append(&mut answers);
    }
    let of_stream: Vec<Command> = read
        .into_iter()
        .filter(|answer| answer.id == 0x3018)
        .collect();
    assert!(of_stream.iter().all(|answer| answer.status == 0));
    assert_eq!(
        of_stream
            .into_iter()
            .flat_map(|answer| answer.data)
            .collect::<Vec<u8>>(),
        b"123"
    );
}

#[test]
fn unknown_commands_are_refused_and_the_connection_goes_on() {
    let (_server, mut client) = serve();
    for id in [0x1029, 0x2001, 0x0fff, 0x3800] {
        let key = match id {
            0x1029 => ints(&[1]),
            0x2001 => ints(&[1, 2]),
            _ => Vec::new(),
        };
        let answer = client.call(command(id, BLOCKING, &key, b"data"));
        assert_eq!(
            (answer.status, &answer.data[..]),
            (1, &b"data"[..]),
            "{id:04x}"
        );
    }
}

#[test]
fn a_client_of_the_other_byte_order_is_understood() {
    let (_server, mut client) = serve();
    let name = text("target");
    let mut message = vec![0, 0, 11, 0, 0, 0, 5];
    message.extend([0; 11]);
    let size = (26 + name.len() as i32).to_be_bytes();
    message.extend([size, size].concat());
    message.extend((name.len() as u16).to_be_bytes());
    message.extend([0; 4]);
    message.extend((BLOCKING << 16 | 0x3001).to_be_bytes());
    message.extend([0; 8]);
    message.extend(&name);
    let packet = [
        &[0, 1][..],
        &(message.len() as u16).to_be_bytes(),
        &[0, 0],
        &message,
    ]
    .concat();
    use std::io::{Read, Write};
    client.stream.write_all(&packet).expect("the server reads");
    let mut reply = [0; 6 + 18 + 26 + 7 + 4];
    client
        .stream
        .read_exact(&mut reply[..24])
        .expect("the server replies");
    assert_eq!(reply[..2], [1, 0]);
    if reply[3] > 18 {
        client
            .stream
            .read_exact(&mut reply[24..])
            .expect("all of it");
        assert_eq!(reply[9..13], [0, 0, 0, 5], "the id");
        assert_eq!(reply[24..28], [0, 0, 0, 37], "the size");
    }
}

#[test]
fn an_old_client_that_sends_a_checksum_gets_one() {
    let (_server, mut client) = serve();
    let mut message = vec![0; 18];
    message[0] = 1;
    message[2] = 11;
    let reply = client
        .exchange_bytes(&packets(&message))
        .expect("the server replies");
    let crc = reply.bytes[2..].iter().fold(0_u16, |crc, &byte| {
        (0..8).fold(crc ^ u16::from(byte) << 8, |crc, _| {
            if crc & 0x8000 == 0 {
                crc << 1
            } else {
                crc << 1 ^ 0x1021
            }
        })
    });
    assert_eq!(reply.bytes[..2], crc.to_le_bytes());
    assert_eq!(client.exchange(&[]).bytes[..2], [0, 0]);
}
