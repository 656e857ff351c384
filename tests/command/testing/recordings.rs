//! Recordings of tests that fail.

use super::{BOX, run_in, simulating};

#[test]
fn tests_that_fail_leave_a_recording_and_a_page() {
    let dir = tempfile::tempdir().expect("a folder");
    let suite = simulating(&format!(
        "{BOX} it('stays', function() box(0.05) t.run_for(0.2) end)
        it('flies', function() local handle = box(1) t.run_for(0.2) assert.is_true(sim.getObjectPosition(handle)[3] > 1) end)"
    ));
    let (code, output) = run_in(
        dir.path(),
        &[("a_test.lua", &suite)],
        &["--record-failures", "--html", "report.html"],
    );
    assert_eq!(code, 1, "{output}");
    let folder = std::fs::read_dir(dir.path().join("test-recordings")).expect("there is a folder");
    let mut names: Vec<String> = folder
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("a name")
        })
        .collect();
    names.sort();
    let [page, recording] = names.as_slice() else {
        panic!("{names:?}")
    };
    assert!(
        page.ends_with("flies.html") && recording.ends_with("flies.swr"),
        "{names:?}"
    );
    let read =
        |name: &str| std::fs::read(dir.path().join("test-recordings").join(name)).expect("a file");
    assert!(read(recording).starts_with(b"SWRECORD") && read(recording).ends_with(b"SWINDEX1"));
    let text = String::from_utf8(read(page)).expect("it is text");
    assert!(text.contains("id=\"recording\"") && text.contains("\"kind\":\"failure\""));
    let report = std::fs::read_to_string(dir.path().join("report.html")).expect("it is written");
    assert!(report.contains(page), "the report links the page");
}
