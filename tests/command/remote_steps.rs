//! Steps, starts, pauses and stops of several remote clients, in every order in which their requests can arrive.

use std::process::Command;

use test_support::process::run_bounded;

const EXPLORER: &str = include_str!("../support/remote_steps.lua");

/// What a script prints that has the function `explore`.
fn explore(code: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let script = folder.path().join("orders.lua");
    std::fs::write(&script, format!("{EXPLORER}\n{code}")).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(&script).args([
        "--as",
        "sandbox",
        "--empty",
        "--quiet",
        "--no-start",
        "--loops",
        "0",
    ]);
    run_bounded(&mut command).unwrap_or_else(|error| panic!("{error}"))
}

/// Every program of four requests.
#[test]
fn one_client() {
    let output = explore(
        "local words, count = {'on', 'off', 'step', 'start', 'pause', 'stop'}, 0
        for i = 0, 6 ^ 4 - 1 do
            local program = {}
            for k = 1, 4 do program[k], i = words[i % #words + 1], i // #words end
            count = count + explore({program}, 1)
        end
        print(count > 1296)",
    );
    assert_eq!(output, "true\n");
}

/// One of them steps, or both; starts, pauses and stops come in between.
#[test]
fn two_clients() {
    let output = explore(
        "local stepping, count = {'on', 'step', 'step'}, 0
        for _, other in ipairs{
            {'start'}, {'start', 'stop'}, {'start', 'pause', 'start'}, {'start', 'stop', 'start'}, {'on', 'start', 'step', 'step'},
            {'start', 'on', 'step', 'off'}, {'start', 'step', 'stop'}, {'start', 'call', 'stop'}, {'on', 'step', 'stop', 'start'},
        } do count = count + explore({stepping, other}, 1) end
        print(count > 1000)",
    );
    assert_eq!(output, "true\n");
}

/// Two that step, and one that starts, pauses or stops the simulation.
#[test]
fn three_clients() {
    let output = explore(
        "local count = 0
        for _, other in ipairs{{'start'}, {'start', 'stop'}, {'start', 'pause'}} do
            count = count + explore({{'on', 'step'}, {'on', 'step'}, other}, 0)
        end
        print(count > 1000)",
    );
    assert_eq!(output, "true\n");
}
