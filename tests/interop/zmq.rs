//! Clients of the ZeroMQ remote API: the files `zmq_*.py`.

use std::process::Command;

use crate::server::{Server, check, folder, python};
use crate::support::process::run_bounded;

#[test]
fn the_protocol_byte_by_byte() {
    check("zmq_protocol.py", &[]);
}

#[test]
#[cfg(unix)]
fn the_end_while_a_client_holds_up_the_simulation() {
    let Some(python) = python() else { return };
    let mut server = Server::start();
    let mut command = Command::new(python);
    command.arg(folder().join("zmq_end.py")).arg(&server.port).arg(server.child.id().to_string());
    assert_eq!(run_bounded(command.env("PYTHONDONTWRITEBYTECODE", "1")).as_deref(), Ok(""));
    assert!(server.child.wait().expect("the child is ours").success(), "SIGTERM is a clean end");
}

#[test]
fn the_official_client_with_cbor() {
    check("zmq_client.py", &["cbor"]);
}

#[test]
fn the_official_client_with_cbor2() {
    check("zmq_client.py", &["cbor2"]);
}
