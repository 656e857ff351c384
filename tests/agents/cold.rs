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

/// What was wrong, where, and the next step.
#[test]
fn errors_say_what_to_do_next() {
    let mut client = Client::start(&["scenes/inverted_pendulum.lua".into()]);
    for (tool, arguments, said) in [
        (
            "step",
            json!({"cuont": 3}),
            "there is no argument cuont; did you mean count?",
        ),
        ("run_code", json!({}), "the argument code is missing"),
        (
            "run_code",
            json!({"code": "local x = 1\nsim.getObjectPositio(x)"}),
            ">    2 | sim.getObjectPositio(x)",
        ),
        (
            "run_code",
            json!({"code": "local x = 1\nsim.getObjectPositio(x)"}),
            "did you mean getObjectPosition?",
        ),
        (
            "run_code",
            json!({"code": "\nlocal h = sim.getObject('/Nothing')\nreturn h"}),
            ">    2 | local h = sim.getObject('/Nothing')",
        ),
        ("run_code", json!({"code": "for"}), "line 1: "),
        (
            "get_properties",
            json!({"items": ["/Card.mass"]}),
            "Did you mean /Rail/Slider/Cart?",
        ),
        (
            "get_properties",
            json!({"items": ["/Cart.masss"]}),
            "Did you mean mass?",
        ),
        ("get_properties", json!({"items": ["/Cart"]}), "PATH.NAME"),
        (
            "set_properties",
            json!({"values": {"/Cart.mass": 2, "/Cart.masss": 2}}),
            "nothing was set",
        ),
        ("read_script", json!({"script": "/Cart"}), "is no script"),
        (
            "write_script",
            json!({"script": "/Controller", "old": "xyz", "new": ""}),
            "does not occur",
        ),
        (
            "write_script",
            json!({"script": "/Controller", "code": "function"}),
            "The script was not changed.",
        ),
        (
            "run_until",
            json!({"until": {"colision": ["/a", "/b"]}}),
            "did you mean collision?",
        ),
        (
            "run_until",
            json!({"until": {"collision": ["/Pole", "/Card"]}}),
            "Did you mean /Rail/Slider/Cart?",
        ),
        (
            "run_until",
            json!({"watch": ["/Cart.masss"]}),
            "Did you mean mass?",
        ),
        (
            "picture",
            json!({"camera": "/Cart"}),
            "is neither a camera nor a vision sensor",
        ),
        ("restore", json!({"name": "x"}), "`snapshot` makes one"),
        (
            "load",
            json!({"path": "/etc/hostname"}),
            "--allow-read=/etc",
        ),
        ("save", json!({"path": "/etc/x.ttt"}), "--allow-write=/etc"),
        ("run_tests", json!({"path": "/etc"}), "--allow-read"),
        (
            "api",
            json!({"name": "sim.getObjectPositio"}),
            "did you mean sim.getObjectPosition?",
        ),
        (
            "simulation",
            json!({"action": "halt"}),
            "one of \"start\", \"pause\", \"stop\" is needed",
        ),
    ] {
        let answer = client.call(tool, &arguments);
        let text = answer["text"].as_str().expect("text");
        assert!(
            answer["isError"] == true && text.contains(said),
            "{tool} {arguments}: {text}"
        );
    }
    let mass = client.call("get_properties", &json!({"items": ["/Cart.mass"]}));
    assert_eq!(mass["text"], "/Cart.mass = 1 kg\n");
}

#[test]
fn code_is_checked_before_it_runs() {
    let mut client = Client::start(&["scenes/inverted_pendulum.lua".into()]);
    for (arguments, said) in [
        (json!({}), "All 2 scripts are fine"),
        (json!({"path": "scenes/inverted_pendulum.lua"}), "fine"),
        (json!({"script": "/Controller"}), "fine"),
        (json!({"code": "x = = 1"}), "unexpected symbol"),
        (
            json!({"code": "sim.getObjectPositio(1)"}),
            "line 1: sim.getObjectPositio does not exist (did you mean getObjectPosition?)",
        ),
        (
            json!({"code": "simGetObjectPosition(1, -1)"}),
            "is an old name of sim.getObjectPosition",
        ),
        (
            json!({"code": "function sysCall_actution() end"}),
            "did you mean sysCall_actuation?",
        ),
    ] {
        let answer = client.call("check_code", &arguments);
        let text = answer["text"].as_str().expect("text");
        assert!(
            answer["isError"] == false && text.contains(said),
            "{arguments}: {text}"
        );
    }
}
