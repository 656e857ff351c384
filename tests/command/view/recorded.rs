//! `swanilda view run.swr`: a recording as pages see it.

use std::io::Read;
use std::process::Command;

use flate2::read::GzDecoder;
use serde_json::{Value, json};
use test_support::process::output_of;

use super::SCRIPT;
use super::page::{Page, get};
use super::served::Served;

/// Records two seconds and more of a script, and shows them.
fn served() -> Served {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.lua"), SCRIPT).expect("the scene is written");
    let mut run = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    run.args([
        "run",
        "scene.lua",
        "--quiet",
        "--steps",
        "50",
        "--record",
        "run.swr",
    ])
    .current_dir(folder.path());
    assert!(output_of(&mut run).status.success());
    Served::start_file("view", folder, "run.swr", &["--no-open"])
}

fn index(served: &Served) -> Value {
    let reply = get(served, "recording", &[]);
    assert_eq!(reply.status, 200);
    serde_json::from_slice(&reply.body).expect("it is JSON")
}

/// Time, kind and bytes of the messages of a chunk (docs/VIEW_PROTOCOL.md, "Recordings").
fn messages(served: &Served, number: usize) -> Vec<(f64, u8, Vec<u8>)> {
    let reply = get(served, &format!("recording/{number}"), &[]);
    assert_eq!(reply.status, 200);
    let mut chunk = Vec::new();
    GzDecoder::new(&*reply.body)
        .read_to_end(&mut chunk)
        .expect("it is compressed");
    let (mut rest, mut messages) = (&*chunk, Vec::new());
    while let Some((head, after)) = rest.split_first_chunk::<13>() {
        let length = u32::from_le_bytes(head[9..].try_into().expect("four bytes")) as usize;
        let time = f64::from_le_bytes(head[..8].try_into().expect("eight bytes"));
        messages.push((time, head[8], after[..length].to_vec()));
        rest = &after[length..];
    }
    assert!(rest.is_empty(), "a chunk ends with a message");
    messages
}

#[test]
fn a_recording_is_served_with_its_chunks_and_blobs() {
    let served = served();
    assert_eq!(get(&served, "", &[]).status, 200);
    let index = index(&served);
    assert_eq!(
        (&index["name"], &index["version"]),
        (&json!("scene.lua"), &json!(1))
    );
    let chunks = index["chunks"].as_array().expect("a list");
    assert!(chunks.len() >= 2, "a chunk lasts a second");
    let mut last = 0.0;
    for (number, chunk) in chunks.iter().enumerate() {
        let messages = messages(&served, number);
        assert_eq!(chunk["time"], messages[0].0);
        let (_, kind, text) = messages
            .iter()
            .find(|(_, kind, _)| *kind != 2)
            .expect("not only blobs");
        let first: Value = serde_json::from_slice(text).expect("it is JSON");
        assert_eq!(
            (*kind, &first["type"], &first["scene"]["mode"]),
            (0, &json!("snapshot"), &json!("recording"))
        );
        assert!(
            messages
                .iter()
                .all(|(time, _, _)| std::mem::replace(&mut last, *time) <= *time),
            "times never fall"
        );
    }
    assert_eq!(index["end"], last);
    let blobs = index["blobs"].as_object().expect("there are blobs");
    assert!(!blobs.is_empty());
    for address in blobs.values() {
        assert_eq!(
            &get(&served, address.as_str().expect("an address"), &[]).body[..4],
            b"MESH"
        );
    }
}

#[test]
fn there_is_nothing_beside_a_recording() {
    let served = served();
    for path in [
        "recording/99",
        "recording/-1",
        "recording/x",
        "blob/00000000000000000000000000000000",
        "run.swr",
    ] {
        assert_eq!(get(&served, path, &[]).status, 404, "{path}");
    }
    assert!(
        Page::try_open(&served, "stream", &[]).is_err(),
        "nobody runs"
    );
}
