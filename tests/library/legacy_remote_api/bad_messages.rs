//! Messages that no client sends.

use super::simx::{Client, Command, Server, command, ints, packets, text};

/// Whatever comes instead of a message of the legacy remote API: the connection goes on or ends, and the next client is served.
#[test]
fn spoilt_legacy_messages() {
    let server = Server::start("sim = require 'sim' function echo(...) return ... end");
    let mut good = Client::connect(server.address);
    let script = good.handle("/Script");
    let call = [&script[..], &[0], &text("echo")].concat();
    good.exchange(&[command(0x000a, 0, &[], &[])]);
    let commands = [
        command(0x3401, 1, &call, &ints(&[1, 1, 1, 4, 7, 0, 65, 0])),
        command(0x200e, 2, &ints(&[0, -1]), &[]),
        command(0x3015, 3, &text("signal"), b"data"),
        command(0x102e, 1, &ints(&[0]), &ints(&[0])),
    ];
    let mut message = vec![0; 18];
    commands
        .iter()
        .for_each(|command| command.write(&mut message));
    let mut count = 0;
    for at in 0..message.len() {
        for byte in [0, 1, 0x1a, 0x7f, 0x80, 0xff] {
            let mut spoilt = message.clone();
            spoilt[at] = byte;
            let mut client = Client::connect(server.address);
            // A reply, or the end of the connection.
            let _ = client.exchange_bytes(&packets(&spoilt));
            count += 1;
        }
        let _ = Client::connect(server.address).exchange_bytes(&packets(&message[..at + 1]));
    }
    assert!(count > 500);
    Client::connect(server.address).handle("/Script");
}

/// Packets and sizes that lie cost no memory and no time.
#[test]
fn legacy_sizes_that_lie() {
    let server = Server::start("sim = require 'sim'");
    let huge = Command {
        full: i32::MAX as usize,
        ..command(0x3015, 3, &text("x"), b"data")
    };
    let part = Command {
        full: 200 << 20,
        ..command(0x3015, 3, &text("x"), b"data")
    };
    let outside = Command {
        offset: i32::MAX as usize,
        ..command(0x3015, 3, &text("x"), b"data")
    };
    for lie in [huge, outside] {
        let mut message = vec![0; 18];
        lie.write(&mut message);
        let mut client = Client::connect(server.address);
        assert!(
            client.exchange_bytes(&packets(&message)).is_err(),
            "{lie:?}"
        );
    }
    let mut client = Client::connect(server.address);
    assert!(client.exchange(&[part]).commands.is_empty());
    let announced = [1, 0, 0xff, 0xff, 0xff, 0xff];
    let mut silent = Client::connect(server.address);
    std::io::Write::write_all(&mut silent.stream, &announced).expect("the system takes it");
    drop((client, silent));
    Client::connect(server.address).handle("/Floor");
}

/// A client that sends as many commands as it can.
#[test]
fn too_many_legacy_commands() {
    let server = Server::start("sim = require 'sim'");
    let log = Command {
        status: 1,
        ..command(0x3012, 0, &text("x"), &[])
    };
    let mut message = vec![0; 18];
    (0..10_001).for_each(|_| log.write(&mut message));
    assert!(
        Client::connect(server.address)
            .exchange_bytes(&packets(&message))
            .is_err()
    );
    Client::connect(server.address).handle("/Floor");
}
