//! Recordings that are written and read, and files that are none.

use std::io::Cursor;

use super::chunk::TimedMessage;
use super::*;
use crate::blobs::Blob;
use crate::mirror::Message;

fn text(text: &str) -> Message {
    Message::Text(text.to_owned())
}

/// Three chunks: a second, a second with a blob and an error, and a bit.
fn recording() -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), "a<b>.ttt", 0.05).expect("memory takes all");
    for step in 0..50 {
        let time = 0.05 * f64::from(step);
        if writer.chunk_is_full(time) {
            writer.end_chunk().expect("memory takes all");
            let snapshot =
                r#"{"type":"snapshot","scene":{"name":"a<b>.ttt","timeStep":0.05},"objects":[]}"#;
            writer.add(time, &text(snapshot)).expect("memory takes all");
        }
        writer
            .add(time, &Message::Binary(vec![1, 0, 0, step as u8]))
            .expect("memory takes all");
        if step == 30 {
            let blob = Blob::points(&[([1.0, 2.0, 3.0], [4, 5, 6])]);
            writer.add_blob(time, &blob).expect("memory takes all");
            writer.add_blob(time, &blob).expect("memory takes all");
            let update =
                r#"{"type":"update","log":[{"level":"scripterrors","text":"no","handle":7}]}"#;
            writer.add(time, &text(update)).expect("memory takes all");
            writer.mark(Mark {
                time,
                kind: MarkKind::Error,
                text: "no".into(),
                handle: Some(7),
            });
        }
    }
    writer.finish().expect("memory takes all")
}

fn open(file: &[u8]) -> Result<Recording<Cursor<&[u8]>>, RecordingError> {
    Recording::open(Cursor::new(file))
}

/// Reads everything; whether that was possible.
fn read_all(file: &[u8]) -> bool {
    let Ok(mut recording) = open(file) else {
        return false;
    };
    let (chunks, blobs) = (
        recording.index().chunks.len(),
        recording.index().blobs.clone(),
    );
    let blobs_are_there = blobs
        .keys()
        .all(|hash| matches!(recording.blob(*hash), Ok(Some(_))));
    let is_sound = |chunk: &[u8]| messages(chunk).all(|message| message.is_ok());
    blobs_are_there
        && (0..chunks).all(|number| recording.chunk(number).is_ok_and(|chunk| is_sound(&chunk)))
}

#[test]
fn what_is_written_is_read() {
    let file = recording();
    let mut recording = open(&file).expect("it is complete");
    let index = recording.index().clone();
    assert_eq!(
        (index.name.as_str(), index.start, index.time_step),
        ("a<b>.ttt", 0.0, 0.05)
    );
    assert!((index.end - 2.45).abs() < 1e-9);
    let times: Vec<f64> = index.chunks.iter().map(|chunk| chunk.time).collect();
    assert!(
        times
            .iter()
            .zip([0.0, 1.0, 2.0])
            .all(|(a, b)| (a - b).abs() < 1e-9)
            && times.len() == 3,
        "{times:?}"
    );
    assert_eq!(index.marks.len(), 1);
    assert_eq!(index.blobs.values().collect::<Vec<_>>(), [&1]);
    let hash = *index.blobs.keys().next().expect("there is one");
    assert_eq!(
        recording
            .blob(hash)
            .expect("it is sound")
            .expect("it is there")[..4],
        *b"PNTS"
    );
    let chunk = recording.chunk(1).expect("it is sound");
    let all: Vec<TimedMessage> = messages(&chunk)
        .collect::<Result<_, _>>()
        .expect("it is sound");
    assert!(
        matches!(all[0].content, Content::Text(text) if text.starts_with("{\"type\":\"snapshot\""))
    );
    assert_eq!(all[1].content, Content::Binary(&[1, 0, 0, 20]));
    assert_eq!(all.len(), 1 + 20 + 2);
    assert!(recording.chunk(3).is_err());
}

#[test]
fn a_file_without_an_end_is_read_from_the_front() {
    let file = recording();
    let whole = open(&file).expect("it is complete").index().clone();
    let mut found = Vec::new();
    for length in 0..file.len() {
        let cut = &file[..length];
        match open(cut) {
            Ok(recording) => {
                let index = recording.index();
                assert!(read_all(cut), "{length}");
                assert_eq!(
                    index.chunks[..],
                    whole.chunks[..index.chunks.len()],
                    "{length}"
                );
                assert_eq!(index.name, whole.name);
                found.push(index.chunks.len());
                if index.chunks.len() == 3 {
                    assert_eq!((&index.blobs, index.end), (&whole.blobs, whole.end));
                    assert_eq!((index.marks.len(), index.marks[0].handle), (1, Some(7)));
                }
            }
            Err(error) => assert!(found.is_empty(), "{length}: {error}"),
        }
    }
    found.dedup();
    assert_eq!(found, [1, 2, 3]);
}

#[test]
fn what_is_damaged_never_panics() {
    let file = recording();
    for at in 0..file.len() {
        for value in [0, 1, 0x7f, 0xff] {
            let mut damaged = file.clone();
            damaged[at] = value;
            read_all(&damaged);
        }
    }
    for nonsense in [
        &b""[..],
        b"SWRECORD",
        b"SWRECORD\x01\0\0\0\0\0\0\0",
        &[0xff; 200],
        &file[1..],
    ] {
        assert!(!read_all(nonsense));
    }
    let mut newer = file;
    newer[8] = 2;
    assert!(matches!(open(&newer), Err(RecordingError::Version(2))));
}

#[test]
fn an_index_leads_to_nothing_outside_of_the_file() {
    let index = |chunks: &str| {
        format!(
            r#"{{"version":1,"name":"","start":0,"end":1,"timeStep":0.05,"chunks":[{chunks}],"blobs":{{}},"marks":[]}}"#
        )
    };
    let is_read = |chunks: &str| Index::from_bytes(index(chunks).as_bytes(), 1000).is_ok();
    assert!(is_read(
        r#"{"time":0,"place":16,"length":100},{"time":1,"place":132,"length":10}"#
    ));
    for wrong in [
        r#"{"time":0,"place":0,"length":100}"#,
        r#"{"time":0,"place":900,"length":100}"#,
        r#"{"time":0,"place":18446744073709551615,"length":1}"#,
        r#"{"time":0,"place":16,"length":4294967295}"#,
        r#"{"time":0,"place":16,"length":100},{"time":1,"place":100,"length":10}"#,
        r#"{"time":"now","place":16,"length":1}"#,
        "7",
    ] {
        assert!(!is_read(wrong), "{wrong}");
    }
}

#[test]
fn a_bomb_is_not_unpacked_whole() {
    // A frame whose blocks repeat one byte: 128 KiB in four bytes each.
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x58];
    for _ in 0..100 {
        frame.extend([0x02, 0x00, 0x10, 0x00]);
    }
    assert!(matches!(
        chunk::decompress(&frame, 1 << 20),
        Err(RecordingError::Damaged(_))
    ));
}

#[test]
fn one_file_has_page_and_recording() {
    let file = recording();
    let read = |name: &str| match name {
        "index.html" => Some(
            "<head><link rel=\"stylesheet\" href=\"style.css\"></head><body>\
            <script type=\"module\" src=\"main.js\"></script></body>"
                .to_owned(),
        ),
        "style.css" => Some("p { color: red }\n".to_owned()),
        "main.js" => Some("show('</script>', a);\n".to_owned()),
        _ => None,
    };
    let mut out = Vec::new();
    html(&mut open(&file).expect("it is sound"), &read, &mut out).expect("memory takes all");
    let text = String::from_utf8(out).expect("it is text");
    assert!(text.starts_with(
        "<head><style>\np { color: red }\n</style></head><body><script type=\"application/json\" id=\"recording\">{"
    ));
    assert!(text.contains("\"name\":\"a\\u003cb>.ttt\"") && text.contains("data-chunk=\"2\">H4sI"));
    assert!(text.contains("show('<\\/script>', a);") && text.ends_with("</script></body>"));
}
