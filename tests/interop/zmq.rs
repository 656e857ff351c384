//! Clients of the ZeroMQ remote API: the files `zmq_*.py`.

use test_support::process::{LIMIT, wait_within};

use crate::server::{Server, check, folder, python, run};

#[test]
fn the_protocol_byte_by_byte() {
    check("zmq_protocol.py", &[]);
}

#[test]
fn replies_as_they_were_recorded() {
    check("zmq_transcripts.py", &[]);
}

#[test]
fn callbacks_across_scripts() {
    check("zmq_callbacks.py", &[]);
}

#[test]
fn steps_and_locks() {
    check("zmq_stepping.py", &[]);
}

#[test]
fn clients_that_are_killed() {
    check("zmq_departures.py", &[]);
}

/// Requests that are lost, made twice, late, in another order, and clients that vanish.
#[test]
fn faults_of_the_link() {
    let Some(python) = python() else { return };
    let exchange = tempfile::tempdir().expect("a folder");
    let exchange = exchange.path().to_string_lossy();
    let faults = folder().join("link_faults.lua");
    let parameter = format!("folder={exchange}");
    let faults = ["--faults", &*faults.to_string_lossy(), "-D", &parameter];
    let server = Server::start_with(&[&["--remote-api=0"], &faults[..]].concat());
    run(python, "link_faults.py", &server, &[&exchange]);
}

#[test]
fn many_clients_and_improper_ones() {
    let Some(python) = python() else { return };
    let server = Server::start();
    run(
        python,
        "zmq_crowd.py",
        &server,
        &[&server.child.id().to_string()],
    );
}

#[test]
fn a_restart_while_clients_wait() {
    let Some(python) = python() else { return };
    run(
        python,
        "zmq_restart.py",
        &Server::start(),
        &[env!("CARGO_BIN_EXE_swanilda")],
    );
}

#[test]
fn whom_everything_waits_for() {
    let Some(python) = python() else { return };
    run(
        python,
        "zmq_waits.py",
        &Server::start(),
        &[env!("CARGO_BIN_EXE_swanilda")],
    );
}

#[test]
fn the_official_asyncio_client() {
    check("zmq_asyncio.py", &[]);
}

#[test]
#[cfg(unix)]
fn the_end_while_a_client_holds_up_the_simulation() {
    let Some(python) = python() else { return };
    let mut server = Server::start();
    let id = server.child.id().to_string();
    run(python, "zmq_end.py", &server, &[&id]);
    assert_eq!(
        wait_within(&mut server.child, LIMIT)
            .expect("it ends")
            .code(),
        Some(143)
    );
}

#[test]
fn the_official_client_with_cbor() {
    check("zmq_client.py", &["cbor"]);
}

#[test]
fn the_official_client_with_cbor2() {
    check("zmq_client.py", &["cbor2"]);
}

#[test]
fn several_calls_in_one_request() {
    check("zmq_batch.py", &[]);
}

#[test]
fn what_clients_do_not_get() {
    let Some(python) = python() else { return };
    run(
        python,
        "zmq_restricted.py",
        &Server::start_with(&["--remote-api=0", "--no-unsafe"]),
        &[],
    );
}
