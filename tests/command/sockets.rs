//! The module `socket`: what LuaSocket 3.0.0 printed for `sockets/probe.lua`, and the end of a script that waits.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use test_support::process::{LIMIT, run_bounded, wait_within};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/sockets")
}

fn run(file: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(file).args([
        "--as",
        "sandbox",
        "--empty",
        "--quiet",
        "--no-start",
        "--loops",
        "0",
    ]);
    run_bounded(&mut command).expect("the script ends")
}

/// What is different in every run, or with every installation: addresses, free ports, times, names of files.
fn masked(line: &str) -> String {
    let label = line.split(" => ").next().unwrap_or_default();
    match label {
        "stats type" => {
            return line
                .rsplit_once(", ")
                .map_or(line, |(rest, _)| rest)
                .to_owned();
        }
        "unix" => return "unix => true, table".to_owned(),
        _ => {}
    }
    let words = line.split(' ').map(|word| match word {
        _ if word.starts_with("0x") => word
            .split_once(',')
            .map_or("ADDR".into(), |(_, rest)| format!("ADDR,{rest}")),
        _ if is_port(word) => "PORT".into(),
        _ if word.contains("sock.lua:") => word.replace("sock.lua:", "[string \\\"probe\\\"]:"),
        _ => word.into(),
    });
    words.collect::<Vec<String>>().join(" ")
}

/// A number above the well-known ports, with its quotes and comma.
fn is_port(word: &str) -> bool {
    word.trim_matches(['"', ','])
        .parse::<u16>()
        .is_ok_and(|port| port > 10_000)
}

#[test]
fn the_probe_prints_what_luasocket_printed() {
    let recorded =
        fs::read_to_string(folder().join("probe.txt")).expect("the recording is readable");
    let mut expected = recorded
        .lines()
        .filter(|line| !line.starts_with("# "))
        .map(masked);
    let printed = run(&folder().join("probe.lua"));
    let mut lines = printed.lines().map(masked);
    for expected in expected.by_ref() {
        let line = lines.next().unwrap_or_default();
        match expected.split_once("try:f") {
            // The recording cuts the list of names.
            Some(_) => assert!(line.starts_with(&expected), "{line}"),
            // Serial ports have functions of their own: sim.serialOpen.
            None if expected.starts_with("serial => ") => {
                assert!(line.starts_with("serial => false"), "{line}");
            }
            None => assert_eq!(line, expected),
        }
        if line.starts_with("serial => ") {
            break;
        }
    }
    assert_eq!(lines.next_back(), expected.next_back());
}

#[test]
#[cfg(unix)]
fn an_interrupt_ends_every_wait() {
    let script = "
        local socket = require 'socket'
        local server = socket.bind('127.0.0.1', 0)
        local _, port = server:getsockname()
        local client = socket.connect('127.0.0.1', port)
        local waits = {
            accept = function() server:accept() server:accept() end,
            receive = function() client:receive() end,
            send = function() while true do client:send(('x'):rep(1000000)) end end,
            select = function() socket.select({client}) end,
            sleep = function() socket.sleep(1000000) end,
        }
        print('waiting')
        waits[sim.getNamedStringParam('wait')]()";
    let dir = tempfile::tempdir().expect("a temporary folder can be made");
    let file = dir.path().join("waits.lua");
    fs::write(&file, script).expect("the folder is ours");
    for wait in ["accept", "receive", "send", "select", "sleep"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command.arg("run").arg(&file).args([
            "--as",
            "sandbox",
            "--empty",
            "--quiet",
            "-D",
            &format!("wait={wait}"),
        ]);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut out = BufReader::new(child.stdout.take().expect("standard output is piped"));
        out.read_line(&mut String::new())
            .expect("the script says when it waits");
        run_bounded(Command::new("kill").args(["-INT", &child.id().to_string()]))
            .expect("the signal is sent");
        assert!(wait_within(&mut child, LIMIT).is_some(), "{wait} goes on");
        let output = child.wait_with_output().expect("the command ends");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains("interrupted"), "{wait}: {said}");
    }
}
