//! What clients do that say something else than they should, or change their minds.

use std::fmt::Write as _;

use serde_json::json;

use crate::client::Client;

fn call(tool: &str, arguments: &serde_json::Value) -> serde_json::Value {
    json!({"name": tool, "arguments": arguments})
}

#[test]
fn nothing_is_answered_before_the_session_begins_but_ping() {
    let mut client = Client::connect(&[]);
    assert_eq!(
        client.request("tools/list", &json!({}))["error"]["code"],
        -32600
    );
    assert_eq!(client.request("ping", &json!({}))["result"], json!({}));
    let old = client.request("initialize", &json!({"protocolVersion": "2024-11-05"}));
    assert_eq!(old["result"]["protocolVersion"], "2024-11-05");
    let unknown = client.request("initialize", &json!({"protocolVersion": "1999-01-01"}));
    assert_eq!(unknown["result"]["protocolVersion"], "2025-06-18");
}

#[test]
fn broken_lines_are_answered_and_the_session_goes_on() {
    let mut client = Client::start(&[]);
    for (text, code) in [
        ("{", -32700),
        ("nonsense", -32700),
        ("[]", -32600),
        (
            r#"[{"jsonrpc":"2.0","id":1,"method":"ping"},{"jsonrpc":"2.0","id":2,"method":"ping"}]"#,
            -32600,
        ),
        (r#"{"jsonrpc":"1.0","id":1,"method":"ping"}"#, -32600),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"nothing/such"}"#,
            -32601,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{}}"#,
            -32602,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{"name":"x"}}"#,
            -32602,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{"name":"scene","arguments":[]}}"#,
            -32602,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"resources/list","params":{"cursor":"x"}}"#,
            -32602,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"resources/read","params":{"uri":"file:///etc/passwd"}}"#,
            -32002,
        ),
        (
            r#"{"jsonrpc":"2.0","id":1,"method":"resources/read","params":{"uri":"script:///nobody"}}"#,
            -32002,
        ),
    ] {
        client.send_text(text);
        assert_eq!(client.receive()["error"]["code"], code, "{text}");
    }
    assert_eq!(
        client.call("run_code", &json!({"code": "1 + 1"}))["text"],
        "2"
    );
}

#[test]
fn what_scripts_print_is_never_between_messages() {
    let mut client = Client::start(&[]);
    let code = "print('{\"jsonrpc\":\"2.0\"}') io.write('x\\n') io.stdout:write('y\\n') io.stdout:flush() return 3";
    let answer = client.call("run_code", &json!({"code": code}));
    assert!(
        answer["text"].as_str().expect("text").starts_with('3'),
        "{answer}"
    );
}

#[test]
fn a_call_can_be_cancelled_and_is_not_answered() {
    let mut client = Client::start(&[]);
    let id = client.begin(
        "tools/call",
        &call("run_code", &json!({"code": "while true do end"})),
    );
    client.send(&json!({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": id}}));
    assert_eq!(client.request("ping", &json!({}))["result"], json!({}));
}

#[test]
fn code_without_end_is_ended_and_said_so() {
    let mut client = Client::start(&["--call-timeout=1".into()]);
    for code in ["while true do end", "while true do pcall(error) end"] {
        let answer = client.call("run_code", &json!({"code": code}));
        let text = answer["text"].as_str().expect("text");
        assert!(
            text.contains("ended after 1 s of wall-clock time"),
            "{text}"
        );
        assert_eq!(
            client.call("run_code", &json!({"code": "1 + 1"}))["text"],
            "2",
            "{code}"
        );
    }
    let script = "function sysCall_actuation() while true do end end";
    client.call("write_script", &json!({"code": script}));
    let answer = client.call("step", &json!({"count": 5}));
    assert!(
        answer["text"]
            .as_str()
            .expect("text")
            .contains("ended after 1 s"),
        "{answer}"
    );
}

#[test]
fn scripts_and_tools_reach_nothing_outside_unless_they_may() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("secret.lua");
    std::fs::write(&path, "x = 1").expect("it is ours");
    let path = path.to_string_lossy();
    let attempts = [
        (
            "run_code",
            json!({"code": format!("assert(io.open('{path}'))")}),
        ),
        ("run_code", json!({"code": "assert(os.execute('true'))"})),
        ("run_code", json!({"code": "assert(os.getenv('PATH'))"})),
        ("load", json!({"path": path})),
        ("run_tests", json!({"path": path})),
        ("save", json!({"path": format!("{path}.ttt")})),
    ];
    let mut client = Client::start(&[]);
    for (tool, arguments) in &attempts {
        let answer = client.call(tool, arguments);
        assert_eq!(answer["isError"], true, "{tool} {arguments}: {answer}");
    }
    let mut trusted = Client::start(&["--unsafe".into()]);
    for (tool, arguments) in &attempts {
        let answer = trusted.call(tool, arguments);
        assert_eq!(answer["isError"], false, "{tool} {arguments}: {answer}");
    }
}

#[test]
fn long_lists_of_resources_come_in_pages() {
    let mut client = Client::start(&[]);
    let mut code = String::new();
    for number in 0..120 {
        let _ = writeln!(
            code,
            "sim.setObjectAlias(sim.createScript(sim.scripttype_simulation, ''), 's{number}')"
        );
    }
    client.call("run_code", &json!({"code": code}));
    let (mut cursor, mut names) = (json!(null), Vec::new());
    loop {
        let page = client.request("resources/list", &json!({"cursor": cursor}));
        let found = page["result"]["resources"]
            .as_array()
            .expect("resources")
            .clone();
        names.extend(found.iter().map(|one| one["uri"].to_string()));
        cursor = page["result"]["nextCursor"].clone();
        if cursor.is_null() {
            break;
        }
    }
    let mut unique = names.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), names.len());
    assert!(
        names.contains(&"\"script:///s119\"".to_owned())
            && names.contains(&"\"scene://tree\"".to_owned())
    );
}
