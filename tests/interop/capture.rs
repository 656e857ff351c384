//! Runs with programs of others, captured and replayed.

use std::process::Command;

use test_support::process::{LIMIT, output_of, wait_within};

use crate::server::{Server, python, run};

#[test]
#[cfg(unix)]
fn two_official_clients_that_step() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let capture = folder.path().join("run.swc");
    let name = capture.to_string_lossy();
    let mut server = Server::start_with(&["--remote-api=0", "--capture", &name]);
    run(python, "zmq_capture.py", &server, &[]);
    let id = server.child.id().to_string();
    let told = Command::new("kill").args(["-INT", &id]).status();
    assert!(told.expect("there is kill").success());
    wait_within(&mut server.child, LIMIT).expect("it ends");
    for threads in ["1", "2", "3"] {
        let mut replay = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        let replay = replay
            .arg("replay")
            .arg(&capture)
            .args(["--threads", threads]);
        let output = output_of(replay.current_dir("/"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.ends_with("as in the capture, to the end\n"), "{said}");
        assert_eq!(output.status.code(), Some(0));
    }
}
