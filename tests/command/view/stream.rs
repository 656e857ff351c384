//! CoppeliaSim's own visualization stream (protocol 3), as its web front end uses it.

use serde_json::{Value, json};

use super::page::{Page, Reply, request_at};
use super::served::Served;

const SCRIPT: &str = "
sim = require 'sim'
function sysCall_init()
    local parent = sim.createDummy(0.01)
    sim.setObjectAlias(parent, 'parent')
    local child = sim.createDummy(0.01)
    sim.setObjectParent(child, parent, true)
    sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
end
";

fn served(options: &[&str]) -> (Served, u16) {
    let served = Served::start(
        SCRIPT,
        &[&["--paused", "--visualization-stream=0"], options].concat(),
    );
    let port = served.address_of("Visualization stream at ");
    (served, port)
}

/// The events of a batch, from CBOR without tags.
fn events(bytes: &[u8]) -> Vec<Value> {
    let mut rest = bytes;
    let value = read(&mut rest);
    assert!(rest.is_empty(), "a message is one batch");
    value.as_array().expect("a batch is a list").clone()
}

/// Reads a value; panics at tags, which the front end does not know.
fn read(rest: &mut &[u8]) -> Value {
    let (&first, after) = rest.split_first().expect("a value");
    *rest = after;
    let (kind, short) = (first >> 5, first & 31);
    if first == 0xfa {
        return json!(f32::from_be_bytes(
            take(rest, 4).try_into().expect("so many bytes")
        ));
    }
    if matches!(first, 0x9f | 0xbf) {
        return read_open(rest, first == 0xbf);
    }
    let number = match short {
        0..=23 => u64::from(short),
        24 => u64::from(take(rest, 1)[0]),
        25 => u64::from(u16::from_be_bytes(
            take(rest, 2).try_into().expect("so many bytes"),
        )),
        26 => u64::from(u32::from_be_bytes(
            take(rest, 4).try_into().expect("so many bytes"),
        )),
        27 => u64::from_be_bytes(take(rest, 8).try_into().expect("so many bytes")),
        _ => panic!("no head of CBOR: {first:#x}"),
    };
    match kind {
        0 => json!(number),
        1 => json!(-1 - number as i64),
        2 => json!({ "bytes": take(rest, number as usize).len() }),
        3 => json!(String::from_utf8_lossy(take(rest, number as usize))),
        4 => (0..number).map(|_| read(rest)).collect(),
        5 => (0..number)
            .map(|_| {
                (
                    read(rest).as_str().expect("keys are texts").to_owned(),
                    read(rest),
                )
            })
            .collect(),
        6 => panic!("a tag: {number}"),
        _ => match short {
            20 | 21 => json!(short == 21),
            22 | 23 => Value::Null,
            27 => json!(f64::from_bits(number)),
            _ => panic!("no simple value: {first:#x}"),
        },
    }
}

fn read_open(rest: &mut &[u8], is_map: bool) -> Value {
    let (mut items, mut members) = (Vec::new(), serde_json::Map::new());
    while rest.first() != Some(&0xff) {
        let item = read(rest);
        match item.as_str().filter(|_| is_map) {
            Some(name) => drop(members.insert(name.to_owned(), read(rest))),
            None => items.push(item),
        }
    }
    *rest = &rest[1..];
    if is_map {
        Value::Object(members)
    } else {
        Value::Array(items)
    }
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> &'a [u8] {
    let (taken, after) = rest.split_at(count);
    *rest = after;
    taken
}

fn seq(event: &Value) -> i64 {
    event["seq"].as_i64().expect("events are numbered")
}

#[test]
fn a_client_begins_with_a_snapshot() {
    let (_served, port) = served(&[]);
    let mut client = Page::open_at(port, "");
    let genesis = events(&client.binary());
    assert_eq!(
        (&genesis[0]["event"], &genesis.last().unwrap()["event"]),
        (&json!("genesisBegin"), &json!("genesisEnd"))
    );
    let app = genesis
        .iter()
        .find(|event| event["handle"] == -13)
        .expect("the application");
    assert_eq!(app["data"]["protocolVersion"], 3);
    assert!(app["data"]["sessionId"].is_string());
    assert!(
        genesis
            .iter()
            .any(|event| event["handle"] == -12 && !event["data"]["sceneUid"].is_null())
    );
    assert!(
        genesis
            .windows(2)
            .all(|two| seq(&two[1]) == seq(&two[0]) + 1),
        "numbers follow each other"
    );
    let mut announced = vec![-1];
    for event in genesis
        .iter()
        .filter(|event| event["event"] == "objectAdded")
    {
        if let Some(parent) = event["data"]["parentUid"].as_i64() {
            assert!(announced.contains(&parent), "{event}");
        }
        announced.extend(event["uid"].as_i64());
    }
    assert!(announced.len() > 5);
}

#[test]
fn changes_continue_the_numbers_of_each_client() {
    let (served, port) = served(&[]);
    let mut first = Page::open_at(port, "");
    let mut last = seq(events(&first.binary()).last().unwrap());
    first.send_bytes(b"who are you?");
    let mut commander = Page::open(&served);
    let mut run = |code: &str| {
        commander
            .ask(json!({"do": "run", "code": code}))
            .expect("it runs")
    };
    run("d = sim.createDummy(0.01)");
    let mut seen: Vec<Value> = Vec::new();
    let mut follow = |seen: &mut Vec<Value>, wanted: &dyn Fn(&Value) -> bool| {
        while !seen.iter().any(wanted) {
            for event in events(&first.binary()) {
                assert_eq!(seq(&event), last + 1, "no gap");
                last += 1;
                seen.push(event);
            }
        }
    };
    follow(&mut seen, &|event| {
        event["event"] == "objectAdded" && event["data"]["objectType"] == "dummy"
    });
    let mut second = Page::open_at(port, "");
    assert_eq!(events(&second.binary())[0]["event"], "genesisBegin");
    run("for i = 1, 10 do sim.setObjectPosition(d, {i, 0, 0}) end");
    seen.clear();
    follow(&mut seen, &|event| event["data"]["pose"][0] == json!(10.0));
    assert_eq!(
        seen.iter()
            .filter(|event| !event["data"]["pose"].is_null())
            .count(),
        1,
        "poses of a batch are one"
    );
    run("sim.removeObjects({d})");
    seen.clear();
    follow(&mut seen, &|event| event["event"] == "objectRemoved");
    let removed = seen
        .iter()
        .find(|event| event["event"] == "objectRemoved")
        .unwrap();
    assert_eq!(removed["data"], json!({}));
    run("sim.startSimulation()");
    seen.clear();
    follow(&mut seen, &|event| {
        event["data"]["stepCount"]
            .as_i64()
            .is_some_and(|count| count > 2)
    });
    assert_eq!(seen.last().unwrap()["event"], "msgDispatchTime");
}

#[test]
fn another_scene_replaces_the_one_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("other.ttt");
    let (served, port) = served(&[]);
    let mut client = Page::open_at(port, "");
    let genesis = events(&client.binary());
    let uid_of = |events: &[Value]| {
        let scene = events
            .iter()
            .rfind(|event| event["handle"] == -12 && !event["data"]["sceneUid"].is_null());
        scene.map(|event| event["data"]["sceneUid"].clone())
    };
    let before = uid_of(&genesis).expect("a scene has a number");
    let mut commander = Page::open(&served);
    let mut run = |code: String| {
        commander
            .ask(json!({"do": "run", "code": code}))
            .expect("it runs")
    };
    run(format!("sim.saveScene([[{}]])", path.display()));
    run(format!("sim.loadScene([[{}]])", path.display()));
    let mut seen = Vec::new();
    while uid_of(&seen).is_none_or(|uid| uid == before) {
        let batch = events(&client.binary());
        let first = seen.last().or(genesis.last()).map(seq).unwrap();
        assert!(
            batch
                .iter()
                .zip(first + 1..)
                .all(|(event, number)| seq(event) == number),
            "no gap"
        );
        seen.extend(batch);
    }
    // Every object of the scene before is gone, or everything begins anew.
    let begins_anew = seen.iter().any(|event| event["event"] == "genesisBegin");
    let removed: Vec<&Value> = seen
        .iter()
        .filter(|event| event["event"] == "objectRemoved")
        .collect();
    let added = |events: &[Value]| -> Vec<Value> {
        let objects = events
            .iter()
            .filter(|event| event["event"] == "objectAdded" && event["data"]["pose"].is_array());
        objects.map(|event| event["uid"].clone()).collect()
    };
    let gone = |uid: &Value| removed.iter().any(|event| event["uid"] == *uid);
    assert!(begins_anew || added(&genesis).iter().all(gone), "{seen:?}");
    assert!(!added(&seen).is_empty(), "the other scene is shown");
}

#[test]
fn files_of_the_front_end_are_served_from_a_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(
        folder.path().join("index.html"),
        "<script>const wsPort = 23020;</script>",
    )
    .unwrap();
    std::fs::write(folder.path().join("main.js"), "1").unwrap();
    std::fs::write(folder.path().join("x.exe"), "1").unwrap();
    let option = format!(
        "-DvisualizationStream.resources={}",
        folder.path().display()
    );
    let (_served, port) = served(&[&option]);
    let get = |path: &str| -> Reply {
        request_at(
            port,
            &format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n"),
        )
    };
    let page = get("/");
    assert_eq!(page.status, 200);
    assert!(page.head.contains("text/html"));
    assert!(String::from_utf8_lossy(&page.body).contains(&format!("const wsPort = {port};")));
    let script = get("/main.js");
    assert!(script.status == 200 && script.head.contains("application/javascript"));
    for path in [
        "/x.exe",
        "/../index.html",
        "/%2e%2e/index.html",
        "/none.js",
        "/main.js/",
    ] {
        assert_eq!(get(path).status, 404, "{path}");
    }
}
