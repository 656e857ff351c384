//! The viewer's server as pages see it: `swanilda view` in a process of its own, plain HTTP and WebSockets.

#![allow(
    clippy::disallowed_methods,
    reason = "tests start programs and wait for them"
)]

pub mod page;
mod recorded;
pub mod served;
mod stream;
mod timeline;

use page::{Page, get, raw, send};
use serde_json::{Value, json};
use served::Served;

const SCRIPT: &str = "
sim = require 'sim'
function sysCall_init()
    dummy = sim.createDummy(0.01)
    sim.setObjectAlias(dummy, 'mover')
    sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    lines = sim.addDrawingObject(sim.drawing_lines, 2, 0, -1, 100, {1, 0, 0})
    print('hello </script>')
end
function sysCall_actuation()
    sim.setObjectPosition(dummy, {sim.getSimulationTime(), 0, 0})
    sim.addDrawingObjectItem(lines, {0, 0, 0, 1, 1, sim.getSimulationTime()})
end
";

fn handle(snapshot: &Value, alias: &str) -> i64 {
    let objects = snapshot["objects"]
        .as_array()
        .expect("a snapshot has objects");
    objects
        .iter()
        .find(|object| object["alias"] == alias)
        .expect("the object is there")["handle"]
        .as_i64()
        .expect("a number")
}

#[test]
fn a_page_sees_the_scene_and_what_moves() {
    let served = Served::start(SCRIPT, &[]);
    let mut page = Page::open(&served);
    let snapshot = page.text();
    assert_eq!(
        (&snapshot["type"], &snapshot["scene"]["mode"]),
        (&json!("snapshot"), &json!("live"))
    );
    let mover = handle(&snapshot, "mover");
    assert!(
        snapshot["log"]
            .as_array()
            .unwrap()
            .iter()
            .any(|line| line["text"] == "hello </script>")
    );
    let all = page.poses();
    assert_eq!(all.len(), snapshot["objects"].as_array().unwrap().len());
    let first = page.pose_of(mover);
    let later = page.pose_of(mover);
    assert!(later[0] > first[0], "{first:?} {later:?}");
    let drawing = page.wait_for(|update| {
        update["drawings"][0]["items"]
            .as_array()
            .is_some_and(|items| items.len() > 6)
    });
    assert_eq!(drawing["drawings"][0]["itemType"], "line");
}

#[test]
fn blobs_are_found_by_their_hash() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let snapshot = Page::open(&served).text();
    let shape = snapshot["objects"]
        .as_array()
        .unwrap()
        .iter()
        .find(|object| !object["meshes"].is_null())
        .unwrap();
    let hash = shape["meshes"][0]["blob"].as_str().unwrap().to_owned();
    let reply = get(&served, &format!("blob/{hash}"), &[]);
    assert_eq!((reply.status, &reply.body[..4]), (200, &b"MESH"[..]));
    assert!(reply.head.contains("immutable"));
    assert_eq!(
        get(&served, "blob/00000000000000000000000000000000", &[]).status,
        404
    );
}

#[test]
fn the_page_comes_compressed_with_its_policy() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let reply = get(&served, "", &[]);
    assert_eq!((reply.status, &reply.body[..2]), (200, &[0x1f, 0x8b][..]));
    let policy = reply
        .head
        .lines()
        .find(|line| line.starts_with("Content-Security-Policy"))
        .expect("there is a policy");
    assert!(policy.contains("default-src 'none'") && !policy.contains("unsafe"));
    let tag = reply
        .head
        .lines()
        .find_map(|line| line.strip_prefix("ETag: "))
        .expect("there is a tag");
    assert_eq!(get(&served, "", &[("If-None-Match", tag)]).status, 304);
    assert_eq!(get(&served, "main.js", &[]).status, 200);
    assert_eq!(get(&served, "../Cargo.toml", &[]).status, 404);
    let none = get(&served, "recording", &[]);
    assert!(none.status == 204 && none.body.is_empty() && !none.head.contains("Content-Length"));
}

#[test]
fn only_pages_of_this_server_get_in() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let port = served.port;
    assert_eq!(raw(port, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), 404);
    let token = &served.token;
    let asked = |host: &str, more: &str| {
        raw(
            port,
            &format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\n{more}\r\n"),
        )
    };
    assert_eq!(asked("evil.example", ""), 403);
    assert_eq!(
        asked(
            &format!("127.0.0.1:{port}"),
            "Origin: http://evil.example\r\n"
        ),
        403
    );
    assert_eq!(
        asked(&format!("127.0.0.1:{port}"), "Content-Length: 5\r\n"),
        400
    );
    assert_eq!(
        raw(
            port,
            &format!("POST /{token}/ HTTP/1.1\r\nHost: localhost\r\n\r\n")
        ),
        405
    );
    assert_eq!(raw(port, "\x16\x03\x01\r\n\r\n"), 400);
    assert!(Page::try_open(&served, "stream", &[("Origin", "http://evil.example")]).is_err());
    assert!(
        Page::try_open(
            &served,
            "stream",
            &[("Origin", &format!("http://127.0.0.1:{port}"))]
        )
        .is_ok()
    );
    assert!(Page::try_open(&served, "other", &[]).is_err());
}

#[test]
fn requests_are_done_and_answered() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let mut page = Page::open(&served);
    let snapshot = page.text();
    let mover = handle(&snapshot, "mover");
    assert_eq!(page.ask(json!({"do": "step", "count": 2})), Ok(json!(true)));
    let paused = page.wait_for(|update| update["scene"]["state"] == "paused");
    assert_eq!(paused["scene"]["steps"], 2);
    assert_eq!(
        page.ask(json!({"do": "select", "handles": [mover]})),
        Ok(json!(true))
    );
    assert_eq!(
        page.ask(json!({"do": "run", "code": "sim.getObjectSel()[1]"})),
        Ok(json!(mover.to_string()))
    );
    let rows = page
        .ask(json!({"do": "inspect", "handle": mover}))
        .expect("it is there");
    assert!(
        rows.as_array()
            .unwrap()
            .iter()
            .any(|row| row["name"] == "alias" && row["value"] == "mover")
    );
    assert_eq!(
        page.ask(json!({"do": "set", "handle": mover, "name": "alias", "value": "renamed"})),
        Ok(json!(true))
    );
    page.wait_for(|message| {
        let values = message["values"].as_array().cloned().unwrap_or_default();
        message["type"] == "properties"
            && values
                .iter()
                .any(|row| row["name"] == "alias" && row["value"] == "renamed")
    });
    let refused =
        page.ask(json!({"do": "set", "handle": mover, "name": "dummySize", "value": "big"}));
    assert_eq!(refused, Err("dummySize is a number".to_owned()));
    assert!(
        page.ask(json!({"do": "set", "handle": 99_999, "name": "alias", "value": "a"}))
            .is_err()
    );
    assert!(page.ask(json!({"do": "explode"})).is_err());
    assert_eq!(page.ask(json!({"do": "stop"})), Ok(json!(true)));
    page.wait_for(|update| update["scene"]["state"] == "stopped");
    assert_eq!(page.ask(json!({"do": "play"})), Ok(json!(true)));
    page.wait_for(|update| update["scene"]["state"] == "running");
}

#[test]
fn a_stop_right_after_an_error_ends_the_simulation() {
    let script = "function sysCall_actuation() error('no') end";
    let served = Served::start(script, &["--paused"]);
    let mut page = Page::open(&served);
    page.text();
    // The first step fails, so that the second is the last before a pause.
    assert_eq!(
        page.ask(json!({"do": "speed", "factor": 0.1})),
        Ok(json!(true))
    );
    assert_eq!(page.ask(json!({"do": "play"})), Ok(json!(true)));
    page.wait_for(|update| update["scene"]["errors"] == 1);
    assert_eq!(page.ask(json!({"do": "stop"})), Ok(json!(true)));
    page.wait_for(|update| update["scene"]["state"] == "stopped");
}

/// A script that never comes back from its third step, or from being loaded.
const ENDLESS: &str = "
sim = require 'sim'
local function work()
    while true do end
end
function sysCall_actuation()
    if sim.getSimulationTime() > 0.1 then work() end
end
";

#[test]
fn a_script_that_does_not_end_is_named_and_stop_ends_it() {
    let served = Served::start(ENDLESS, &[]);
    let mut page = Page::open(&served);
    let busy = page.wait_for(|message| message["type"] == "busy" && message["text"] != json!(null));
    let sentence = busy["text"].as_str().expect("a sentence");
    for part in [
        "sysCall_actuation",
        "at /Script:4, called from /Script:7",
        "Stop ends it",
    ] {
        assert!(sentence.contains(part), "{sentence} has no {part}");
    }
    // A page that connects meanwhile knows it too.
    let mut late = Page::open(&served);
    let told = late.wait_for(|message| message["type"] == "busy");
    assert_eq!(told["text"], busy["text"]);
    assert_eq!(page.ask(json!({"do": "stop"})), Ok(json!(true)));
    page.wait_for(|message| message["type"] == "busy" && message["text"] == json!(null));
    late.wait_for(|update| update["scene"]["state"] == "stopped");
    assert_eq!(
        late.ask(json!({"do": "run", "code": "1 + 1"})),
        Ok(json!("2"))
    );
}

#[test]
fn a_page_is_told_of_a_script_that_does_not_come_back_from_loading() {
    let served = Served::start("while true do end", &[]);
    let mut page = Page::open(&served);
    let busy = page.wait_for(|message| message["type"] == "busy");
    let sentence = busy["text"].as_str().expect("a sentence");
    assert!(sentence.contains("at /Script:1."), "{sentence}");
    assert_eq!(page.ask(json!({"do": "stop"})), Ok(json!(true)));
    assert_eq!(
        page.ask(json!({"do": "run", "code": "1 + 1"})),
        Ok(json!("2"))
    );
}

#[test]
fn what_scripts_select_is_seen_and_errors_name_their_script() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let mut page = Page::open(&served);
    let snapshot = page.text();
    let mover = handle(&snapshot, "mover");
    let code = "sim.setObjectSel({sim.getObject('/mover')})";
    page.ask(json!({"do": "run", "code": code}))
        .expect("it runs");
    page.wait_for(|update| update["selection"] == json!([mover]));
    let code = "local s = sim.createScript(sim.scripttype_customization, 'x = 1\\nerror(\"<b>no</b>\")') sim.initScript(s)";
    page.ask(json!({"do": "run", "code": code}))
        .expect("it runs");
    let update = page.wait_for(|update| {
        let objects = update["objects"].as_array().cloned().unwrap_or_default();
        objects.iter().any(|object| object["error"]["line"] == 2)
    });
    assert!(!update.is_null());
}

#[test]
fn a_page_that_only_reads_changes_nothing() {
    let served = Served::start(SCRIPT, &["--paused", "--view=read-only"]);
    let mut page = Page::open(&served);
    let snapshot = page.text();
    assert_eq!(snapshot["scene"]["readOnly"], true);
    let mover = handle(&snapshot, "mover");
    for request in [
        json!({"do": "play"}),
        json!({"do": "stop"}),
        json!({"do": "step"}),
        json!({"do": "speed", "factor": 2}),
        json!({"do": "select", "handles": []}),
        json!({"do": "set", "handle": mover, "name": "alias", "value": "a"}),
        json!({"do": "run", "code": "1"}),
        json!({"do": "ui", "window": 1}),
    ] {
        assert_eq!(
            page.ask(request.clone()),
            Err("this page may only read".to_owned()),
            "{request}"
        );
    }
    assert!(page.ask(json!({"do": "inspect", "handle": mover})).is_ok());
}

#[test]
fn bytes_that_are_no_requests_harm_nothing() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let mut page = Page::open(&served);
    page.text();
    for bytes in [
        &b""[..],
        b"{",
        b"[]",
        b"null",
        &[0xff; 100],
        &[b'['; 100_000],
    ] {
        page.send_bytes(bytes);
        let reply = page.wait_for(|message| message["type"] == "reply");
        assert!(reply["error"].is_string() && reply["id"].is_null());
    }
    let mut large = Page::open(&served);
    large.text();
    large.send_bytes(&vec![b' '; 3_000_000]);
    assert!(
        large.ends(),
        "a message that is too large ends the connection"
    );
    assert_eq!(
        page.ask(json!({"do": "run", "code": "1 + 1"})),
        Ok(json!("2"))
    );
}

#[test]
fn slow_pages_and_those_that_go_hold_up_nobody() {
    let served = Served::start(SCRIPT, &["--speed=0"]);
    // These read nothing of what they are sent.
    let slow: Vec<Page> = (0..20).map(|_| Page::open(&served)).collect();
    // These go in the middle of everything.
    for _ in 0..20 {
        let mut page = Page::open(&served);
        page.send_bytes(br#"{"id":1,"do":"run","code":"1"}"#);
        drop(page);
    }
    let half = send(served.port, "GET /");
    let mut page = Page::open(&served);
    let first = page.wait_for(|update| update["scene"]["steps"].as_u64().is_some());
    let goal = first["scene"]["steps"].as_u64().unwrap() + 200;
    page.wait_for(|update| {
        update["scene"]["steps"]
            .as_u64()
            .is_some_and(|steps| steps > goal)
    });
    drop((slow, half));
    assert_eq!(
        page.ask(json!({"do": "run", "code": "2 * 3"})),
        Ok(json!("6"))
    );
}

/// Numbers of a simulation that stands do not change: who asks for what is followed already gets them all the same.
#[test]
fn whoever_asks_for_numbers_gets_them() {
    let served = Served::start(SCRIPT, &["--paused"]);
    let mut pages = [Page::open(&served), Page::open(&served)];
    let items = json!([{"handle": -12, "name": "timeStep"}]);
    for (page, key) in [(0, 1), (0, 2), (1, 3), (0, 4)] {
        let page = &mut pages[page];
        page.ask(json!({"do": "sample", "key": key, "items": items}))
            .expect("numbers can be followed");
        let samples = page.wait_for(|text| text["type"] == "samples" && text["key"] == key);
        assert_eq!(
            samples["values"][0].as_array().unwrap().last(),
            Some(&json!(0.05))
        );
    }
}

#[test]
fn pages_are_told_of_the_end() {
    let mut served = Served::start(SCRIPT, &[]);
    let mut page = Page::open(&served);
    page.text();
    served.interrupt();
    page.wait_for(|message| message["type"] == "end");
    assert!(page.ends());
    assert_eq!(served.wait(), Some(130));
}

#[test]
fn a_run_can_be_watched_as_well() {
    let served = Served::start_command("run", SCRIPT, &["--view", "--time", "1000", "--realtime"]);
    let mut page = Page::open(&served);
    assert_eq!(page.text()["scene"]["state"], "running");
    assert_eq!(page.ask(json!({"do": "stop"})), Ok(json!(true)));
    page.wait_for(|message| message["type"] == "end");
}
