//! `swanilda debug`, as an editor uses it.

mod back;
mod more;

use std::path::PathBuf;

use serde_json::json;
use tempfile::TempDir;

use test_support::debug_client::{Client, named};

/// The command.
const SWANILDA: &str = env!("CARGO_BIN_EXE_swanilda");

/// A script with a line for everything that can be looked at.
const SCRIPT: &str = include_str!("script.lua");

/// A file with that text, in a folder of its own.
fn file(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder
        .path()
        .canonicalize()
        .expect("it is there")
        .join("script.lua");
    std::fs::write(&file, text).expect("the file is written");
    (folder, file)
}

fn start(file: &std::path::Path) -> Client {
    Client::start(SWANILDA, &[&file.to_string_lossy(), "--", "--time", "0.5"])
}

#[test]
fn lines_stop_and_variables_are_seen_and_set() {
    let (_folder, file) = file(SCRIPT);
    let mut client = start(&file);
    client.launch(json!({}));
    let set = client.set_breakpoints(&file, json!([{"line": 5}, {"line": 100}]));
    assert_eq!(
        (&set[0]["line"], &set[0]["verified"]),
        (&json!(6), &json!(true))
    );
    assert_eq!(set[1]["verified"], false);
    client.run();
    let stopped = client.stopped("breakpoint");
    assert_eq!(stopped.calls(), ["add:6", "sysCall_init:13"]);
    let (locals, variables) = client.scope(&stopped, "Locals");
    assert_eq!(named(&variables, "n")["value"], "1");
    assert_eq!(client.evaluate(&stopped, "n + count"), "1");
    client.request(
        "setVariable",
        json!({"variablesReference": locals, "name": "n", "value": "count + 40"}),
    );
    client.evaluate(&stopped, "count = 2");
    assert_eq!(client.evaluate(&stopped, "n + count"), "42");
    let upvalues = client.scope(&stopped, "Upvalues").1;
    assert_eq!(named(&upvalues, "count")["value"], "2");
    client.set_breakpoints(&file, json!([]));
    client.go("stepOut", &stopped);
    assert_eq!(client.stopped("step").calls(), ["sysCall_init:13"]);
    client.go("continue", &stopped);
    assert_eq!(client.end(), Some(0));
}

#[test]
fn tables_are_opened_page_by_page() {
    let (_folder, file) = file(SCRIPT);
    let mut client = start(&file);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 12}]));
    client.run();
    let stopped = client.stopped("breakpoint");
    let frame = stopped.frames[0]["id"].clone();
    let items = client.request("evaluate", json!({"expression": "items", "frameId": frame}));
    assert_eq!(items["result"], "nil", "this function does not use it");
    client.request(
        "evaluate",
        json!({"expression": "t = {1, 2, 3, name = 'x', inner = {a = 1}}", "frameId": frame}),
    );
    let table = client.request("evaluate", json!({"expression": "t", "frameId": frame}));
    assert_eq!(table["result"], "{1, 2, 3, inner = {…}, name = \"x\"}");
    assert_eq!(
        (&table["indexedVariables"], &table["namedVariables"]),
        (&json!(3), &json!(2))
    );
    let page = client.request("variables", json!({
        "variablesReference": table["variablesReference"], "filter": "indexed", "start": 1, "count": 1,
    }));
    assert_eq!(page["variables"].as_array().map(Vec::len), Some(1));
    assert_eq!(page["variables"][0]["name"], "[2]");
    let all = client.variables(&table["variablesReference"]);
    let inner = named(&all, "inner")["variablesReference"].clone();
    client.request(
        "setVariable",
        json!({"variablesReference": inner, "name": "a", "value": "'new'"}),
    );
    assert_eq!(client.evaluate(&stopped, "t.inner.a"), "\"new\"");
    let wrong = client.answer("evaluate", json!({"expression": "t.x.y", "frameId": frame}));
    let message = wrong["message"].as_str().unwrap_or_default().to_owned();
    assert!(
        message.contains("attempt to index a nil value") && !message.contains("traceback"),
        "{message}"
    );
    client.request("disconnect", json!({}));
    assert_eq!(client.end(), Some(0));
}

#[test]
fn steps_go_over_into_and_out_of_functions_and_threads() {
    let (_folder, file) = file(SCRIPT);
    let mut client = start(&file);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 19}]));
    client.run();
    let stopped = client.stopped("breakpoint");
    assert_eq!(stopped.calls()[0], "sysCall_thread:19");
    client.set_breakpoints(&file, json!([]));
    for (how, call) in [
        ("next", "sysCall_thread:20"),
        // Other code runs until the thread goes on.
        ("next", "sysCall_thread:21"),
        ("next", "sysCall_thread:18"),
    ] {
        client.go(how, &stopped);
        assert_eq!(client.stopped("step").calls()[0], call);
    }
    client.set_breakpoints(&file, json!([{"line": 26}]));
    client.go("continue", &stopped);
    let stopped = client.stopped("breakpoint");
    for (how, call) in [
        ("stepIn", "add:6"),
        ("next", "add:7"),
        ("stepOut", "sysCall_actuation:27"),
    ] {
        client.go(how, &stopped);
        assert_eq!(client.stopped("step").calls()[0], call);
    }
    client.request("terminate", json!({}));
    assert_eq!(client.end(), Some(0));
}

#[test]
fn the_first_line_stops_when_it_is_asked_for() {
    let (_folder, file) = file(SCRIPT);
    let mut client = Client::start(SWANILDA, &[]);
    client.launch(json!({"program": file, "stopOnEntry": true, "time": 0.2, "args": ["--empty"]}));
    client.run();
    let stopped = client.stopped("step");
    assert_eq!(stopped.calls()[0], "(main):1");
    client.go("continue", &stopped);
    assert_eq!(client.end(), Some(0));
}

#[test]
fn what_cannot_be_run_is_said() {
    let mut client = Client::start(SWANILDA, &["nothing.lua"]);
    client.launch(json!({"args": ["--empty"]}));
    client.run();
    client.output("cannot read nothing.lua");
    assert_eq!(client.end(), Some(2));
    let mut client = Client::start(SWANILDA, &[]);
    client.launch(json!({"program": "x.lua", "args": ["--no-such-option"]}));
    client.run();
    client.output("--no-such-option");
    assert_eq!(client.end(), Some(2));
}

#[test]
fn a_port_serves_too() {
    let (_folder, file) = file(SCRIPT);
    let mut client =
        Client::start_on_port(SWANILDA, &[&file.to_string_lossy(), "--", "--time", "0.2"]);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 26}]));
    client.run();
    assert_eq!(client.stopped("breakpoint").line(), 26);
    client.request("disconnect", json!({}));
    assert_eq!(client.end(), Some(0));
}

#[test]
fn nonsense_ends_the_connection_and_the_command() {
    for nonsense in [
        &b"GET / HTTP/1.1\r\n\r\n"[..],
        b"Content-Length: 3\r\n\r\n{x}",
        b"",
    ] {
        let (_folder, file) = file(SCRIPT);
        let mut client = start(&file);
        client.write(nonsense);
        client.close();
        assert_eq!(client.exit_code(), Some(0));
    }
    let (_folder, file) = file(SCRIPT);
    let mut client = start(&file);
    client.launch(json!({}));
    for (command, arguments) in [
        ("nonsense", json!({})),
        ("setBreakpoints", json!({"source": 5})),
        (
            "setBreakpoints",
            json!({"source": {"sourceReference": 99}, "breakpoints": {}}),
        ),
        ("stackTrace", json!({"threadId": "x"})),
        ("source", json!({"sourceReference": -1})),
        ("next", json!({"threadId": 1})),
    ] {
        assert_eq!(
            client.answer(command, arguments)["success"],
            false,
            "{command}"
        );
    }
    let odd = json!([{"line": -1}, {"line": "5"}, 7, {"line": 6, "hitCondition": "x"}]);
    let set = client.set_breakpoints(&file, odd);
    assert!(
        set.iter().all(|breakpoint| breakpoint["verified"] == false),
        "{set:?}"
    );
}
