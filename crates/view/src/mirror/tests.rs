//! Readers of different speeds.

use std::sync::Arc;

use serde_json::{Value, json};

use super::*;
use crate::blobs::Blob;

fn object(text: &str, blobs: &[Arc<Blob>]) -> ObservedObject {
    ObservedObject {
        text: text.into(),
        blobs: blobs.to_vec(),
    }
}

fn with_objects(objects: &[(i64, &str)]) -> Observation {
    let objects = objects
        .iter()
        .map(|(handle, text)| (*handle, object(text, &[])))
        .collect();
    Observation {
        objects,
        ..Observation::default()
    }
}

/// A mirror with two objects.
fn mirror() -> Mirror {
    let mut mirror = Mirror::default();
    let seen = with_objects(&[(1, r#"{"handle":1}"#), (2, r#"{"handle":2}"#)]);
    let poses = vec![(1, [1.0; 7]), (2, [2.0; 7])];
    let scene = Some(r#"{"time":0}"#.to_owned());
    assert!(mirror.apply(Observation {
        is_another_scene: true,
        is_complete: true,
        poses,
        scene,
        ..seen
    }));
    mirror
}

/// The text of an update, and its poses by handle.
fn read(mirror: &Mirror, seen: Revision) -> (Value, Vec<i32>) {
    let (_, messages) = mirror.update_since(seen);
    let (mut text, mut moved) = (Value::Null, Vec::new());
    for message in messages {
        match message {
            Message::Text(json) => text = serde_json::from_str(&json).expect("the text is JSON"),
            Message::Binary(bytes) => {
                assert_eq!(bytes[..4], [1, 0, 0, 0]);
                assert_eq!(
                    bytes.len(),
                    16 + 32 * u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize
                );
                let handle = |row: &[u8]| i32::from_le_bytes(row[..4].try_into().unwrap());
                moved = bytes[16..].chunks_exact(32).map(handle).collect();
            }
        }
    }
    (text, moved)
}

#[test]
fn a_new_reader_gets_everything() {
    let (text, moved) = read(&mirror(), 0);
    assert_eq!(text["type"], "snapshot");
    assert_eq!(text["objects"], json!([{"handle": 1}, {"handle": 2}]));
    assert_eq!(
        (&text["selection"], &text["log"], &text["removed"]),
        (&json!([]), &json!([]), &json!([]))
    );
    assert_eq!(moved, [1, 2]);
}

#[test]
fn others_get_what_changed_and_nothing_twice() {
    let mut mirror = mirror();
    let first = mirror.revision();
    assert_eq!(mirror.update_since(first), (first, Vec::new()));
    assert!(
        !mirror.apply(with_objects(&[(1, r#"{"handle":1}"#)])),
        "that is as it was"
    );
    let poses = vec![(1, [1.0; 7]), (2, [3.0; 7])];
    assert!(mirror.apply(Observation {
        poses,
        ..with_objects(&[(1, r#"{"handle":1,"a":1}"#)])
    }));
    let second = mirror.revision();
    assert!(mirror.apply(Observation {
        selection: Some(vec![2]),
        ..Observation::default()
    }));
    assert_eq!(
        read(&mirror, second),
        (json!({"type": "update", "selection": [2]}), vec![])
    );
    let expected = json!({"type": "update", "selection": [2], "objects": [{"handle": 1, "a": 1}]});
    assert_eq!(
        read(&mirror, first),
        (expected, vec![2]),
        "who is slow gets both at once"
    );
}

#[test]
fn what_is_gone_is_named_until_it_comes_back() {
    let mut mirror = mirror();
    let first = mirror.revision();
    mirror.apply(Observation {
        removed: vec![2],
        ..Observation::default()
    });
    assert_eq!(
        read(&mirror, first).0,
        json!({"type": "update", "removed": [2]})
    );
    assert_eq!(read(&mirror, 0).0["objects"], json!([{"handle": 1}]));
    mirror.apply(with_objects(&[(2, r#"{"handle":2,"uid":9}"#)]));
    assert_eq!(
        read(&mirror, first).0,
        json!({"type": "update", "objects": [{"handle": 2, "uid": 9}]})
    );
}

#[test]
fn another_scene_and_too_many_removals_begin_anew() {
    let mut mirror = mirror();
    let first = mirror.revision();
    for handle in 10..20_020 {
        mirror.apply(with_objects(&[(handle, "{}")]));
        mirror.apply(Observation {
            removed: vec![handle],
            ..Observation::default()
        });
    }
    assert_eq!(read(&mirror, first).0["type"], "snapshot");
    let last = mirror.revision();
    assert!(mirror.apply(Observation {
        is_another_scene: true,
        is_complete: true,
        ..Observation::default()
    }));
    let (text, _) = read(&mirror, last);
    assert_eq!(
        (&text["type"], &text["objects"]),
        (&json!("snapshot"), &json!([]))
    );
}

#[test]
fn blobs_stay_while_objects_show_them() {
    let blob = Blob::points(&[([0.0; 3], [0; 3])]);
    let mut mirror = Mirror::default();
    let seen = |handle, text: &str| {
        let objects = vec![(handle, object(text, &[Arc::clone(&blob)]))];
        Observation {
            objects,
            ..Observation::default()
        }
    };
    mirror.apply(seen(1, "{}"));
    let first = mirror.revision();
    assert_eq!(mirror.blobs_since(0).count(), 1);
    mirror.apply(seen(2, "{}"));
    mirror.apply(seen(1, "[]"));
    mirror.apply(seen(1, "[]"));
    assert_eq!(mirror.blobs_since(first).count(), 0, "it was there before");
    mirror.apply(Observation {
        removed: vec![1],
        ..Observation::default()
    });
    assert_eq!(mirror.blob(blob.hash).as_deref(), Some(&*blob));
    mirror.apply(Observation {
        removed: vec![2],
        ..Observation::default()
    });
    assert_eq!(mirror.blob(blob.hash), None);
}

#[test]
fn the_log_is_bounded() {
    let mut mirror = mirror();
    let first = mirror.revision();
    for line in 0..2 * LOG_LINES {
        mirror.apply(Observation {
            log: vec![line.to_string()],
            ..Observation::default()
        });
    }
    let (text, _) = read(&mirror, first);
    let lines = text["log"].as_array().unwrap();
    assert_eq!((lines.len(), &lines[0]), (LOG_LINES, &json!(LOG_LINES)));
}

#[test]
fn windows_of_scripts_come_change_and_go() {
    let windows = |changes: Value| ObservedWindows::of(&changes);
    let mut mirror = mirror();
    let first = mirror.revision();
    let changes = json!({"complete": false, "windows": [{"id": "1:UI", "title": "a"}], "removed": [], "dialogs": []});
    assert!(mirror.apply_windows(windows(changes.clone())));
    assert!(!mirror.apply_windows(windows(changes)));
    let second = mirror.revision();
    let (text, _) = read(&mirror, first);
    assert_eq!(
        text,
        json!({"type": "update", "windows": [{"id": "1:UI", "title": "a"}], "dialogs": []})
    );
    assert_eq!(
        read(&mirror, 0).0["windows"],
        json!([{"id": "1:UI", "title": "a"}])
    );
    assert!(mirror.apply_windows(windows(
        json!({"complete": true, "windows": [], "dialogs": []})
    )));
    assert_eq!(
        read(&mirror, second).0,
        json!({"type": "update", "removedWindows": ["1:UI"]})
    );
}

#[test]
fn lines_of_another_moment_take_the_place_of_those_before() {
    let mut mirror = mirror();
    mirror.show_lines(
        vec![r#"{"text":"a"}"#.into(), r#"{"text":"b"}"#.into()],
        false,
    );
    let seen = mirror.revision();
    mirror.show_lines(vec![r#"{"text":"c"}"#.into()], true);
    let more = json!({"type": "update", "log": [{"text": "c"}]});
    assert_eq!(read(&mirror, seen).0, more);
    mirror.show_lines(vec![r#"{"text":"a"}"#.into()], false);
    let anew = json!({"type": "update", "logBegins": true, "log": [{"text": "a"}]});
    assert_eq!(read(&mirror, seen).0, anew);
    let seen = mirror.revision();
    mirror.show_lines(Vec::new(), false);
    assert_eq!(
        read(&mirror, seen).0,
        json!({"type": "update", "logBegins": true})
    );
    let all = read(&mirror, 0).0;
    assert_eq!((&all["log"], &all["logBegins"]), (&json!([]), &Value::Null));
}
