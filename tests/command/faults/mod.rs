//! `swanilda run --faults` with messages of networks.

use std::path::Path;
use std::process::Command;

use test_support::process::run_bounded;

/// What arrives of the numbers 1 to 6 by ZeroMQ, WebSocket and ROS 2 with that fault of the calls that send them.
fn received(fault: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("faults.lua");
    let code = format!(
        "for _, name in ipairs {{'simZMQ.send', 'simWS.send', 'simROS2.publish'}} do faults.{fault}('/Script', name) end"
    );
    std::fs::write(&file, code).expect("our own folder is writable");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/faults/networks.lua");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(scene).arg("--quiet");
    command.arg("--faults").arg(file);
    run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}"))
}

fn all(numbers: &str) -> String {
    ["zmq", "ws", "ros"]
        .map(|network| format!("{network} {numbers}\n"))
        .concat()
}

#[test]
fn messages_of_networks_are_lost_doubled_and_reordered() {
    assert_eq!(received("double"), all("1 1 2 2 3 3 4 4 5 5 6 6"));
    assert_eq!(received("reorder"), all("2 1 4 3 6 5"));
    assert_eq!(received("lose"), all(""));
}
