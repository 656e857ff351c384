//! Files that clients send.

use super::simx::{BLOCKING, Server, command, ints, text};

#[test]
fn a_scene_that_was_sent_is_loaded_and_erased() {
    let server =
        Server::start("sim = require 'sim' sim.setObjectAlias(sim.createDummy(0.1), 'old')");
    let mut client = server.connect();
    let scene = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/robot.ttt"))
        .expect("it is there");
    let name = text("REMOTE_API_TEMPFILE_1234.ttt");
    client.get(0x3004, &name, &scene);
    client.handle("old");
    client.get(0x3002, &name, &[]);
    assert!(client.fails(0x3001, &text("old"), &[]));
    client.get(0x3006, &name, &[]);
    assert!(client.fails(0x3002, &name, &[]), "it is erased");
}

#[test]
fn names_lead_nowhere_else() {
    let server = Server::start("sim = require 'sim'");
    let mut client = server.connect();
    for name in ["", ".", "..", "../x", "/tmp/x", "a/b", "a\\b", "c:x"] {
        assert!(client.fails(0x3004, &text(name), b"data"), "{name}");
        assert!(client.fails(0x3006, &text(name), &[]), "{name}");
    }
    client.get(0x3004, &text("plain"), b"data");
    let folder = client.get(0x1025, &ints(&[16]), &[]);
    let path = format!(
        "{}/plain",
        String::from_utf8_lossy(&folder[..folder.len() - 1])
    );
    assert_eq!(std::fs::read(&path).ok().as_deref(), Some(&b"data"[..]));
    drop((client, server));
    assert!(
        !std::path::Path::new(&path).exists(),
        "files go with the server"
    );
}

#[test]
fn a_scene_is_not_loaded_while_a_simulation_runs() {
    let server = Server::start("sim = require 'sim'");
    let mut client = server.connect();
    client.get(0x1007, &ints(&[0]), &[]);
    assert_eq!(client.call(command(0x0005, BLOCKING, &[], &[])).status, 1);
}
