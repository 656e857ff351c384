//! The reports of `swanilda test`, as their readers get them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use test_support::process::{LIMIT, output_of, wait_within};

const SUITE: &str = "
describe('group', function()
    it('passes', function() print('said') end)
    it('fails', function()
        assert.equal(1, 2)
    end)
    it('crashes', function() error('boom') end)
    pending('later')
    it('ends itself', function() pending('not today') end)
end)";

/// A script of the scene that fails in its second line.
const SCENE_SUITE: &str = "
local sim = require 'sim'
local t = require 'swanilda.test'
it('has a broken robot', function()
    local code = 'function sysCall_sensing()\\n    nothing.at = 1\\nend'
    local script = sim.createScript(sim.scripttype_simulation, code)
    sim.setObjectAlias(script, 'controller')
    t.step(3)
end)";

fn command(folder: &Path, files: &[(&str, &str)], args: &[&str]) -> Command {
    for (name, text) in files {
        fs::write(folder.join(name), text).expect("our own folder is writable");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("test")
        .args(args)
        .args(["--timeout", "20"])
        .current_dir(folder)
        .stdin(Stdio::null());
    command
}

fn run(folder: &Path, files: &[(&str, &str)], args: &[&str]) -> Output {
    output_of(&mut command(folder, files, args))
}

fn stdout(files: &[(&str, &str)], args: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    String::from_utf8(run(folder.path(), files, args).stdout).expect("UTF-8")
}

#[test]
fn the_terminal_shows_a_line_per_file_failures_and_a_list() {
    let text = stdout(
        &[
            ("a_test.lua", SUITE),
            ("b_test.lua", "it('passes', function() end)"),
        ],
        &["--durations", "1"],
    );
    for part in [
        "FAIL a_test.lua::group fails\n    ",
        "    >    5 |         assert.equal(1, 2)\n",
        "\nFAIL a_test.lua (2 of 5 tests failed, 2 pending, ",
        "PASS b_test.lua (1 test, ",
        "\nSlowest tests:\n",
        "2 passed, 1 failed, 1 error, 2 pending in ",
    ] {
        assert!(text.contains(part), "{part}:\n{text}");
    }
    let list = text.split_once("Failures:\n").expect("a list").1;
    let lines: Vec<_> = list.lines().take(2).collect();
    assert!(
        lines[0].starts_with("  FAIL a_test.lua:5 group fails: "),
        "{list}"
    );
    assert_eq!(lines[1], "  ERROR a_test.lua:7 group crashes: boom");
    assert!(!text.contains('\x1b'), "no colours without a terminal");
}

#[test]
fn failures_are_listed_in_the_order_of_the_files_however_they_came() {
    let slow = "it('slow', function() local x = 0 for i = 1, 3e6 do x = x + i end error('a') end)";
    let text = stdout(
        &[
            ("a_test.lua", slow),
            ("b_test.lua", "it('fast', function() error('b') end)"),
        ],
        &["-j", "2"],
    );
    let list = text.split_once("Failures:\n").expect("a list").1;
    assert!(
        list.find("a_test.lua:1 slow") < list.find("b_test.lua:1 fast"),
        "{list}"
    );
}

#[test]
fn each_test_has_a_line_when_wanted_and_colours_are_a_choice() {
    let files = [("a_test.lua", SUITE)];
    let text = stdout(&files, &["-v", "--color", "always"]);
    assert!(
        text.contains("\x1b[32mPASS\x1b[0m a_test.lua::group passes"),
        "{text}"
    );
    assert!(
        text.contains("PENDING\x1b[0m a_test.lua::group ends itself: not today"),
        "{text}"
    );
    assert!(text.contains("stack traceback:"), "{text}");
}

#[test]
fn an_error_of_a_script_comes_with_its_path_and_its_source() {
    let text = stdout(&[("a_test.lua", SCENE_SUITE)], &[]);
    for part in [
        "    --> /controller:2\n",
        "    >    2 |     nothing.at = 1\n",
        "    --> a_test.lua:8\n",
        "    in script /controller\n",
        "    at simulated time 0.050 s, after 1 step, with seed 123456\n",
    ] {
        assert!(text.contains(part), "{part}:\n{text}");
    }
}

#[test]
fn a_file_that_cannot_be_loaded_is_quoted() {
    let text = stdout(&[("a_test.lua", "local x =\nit(")], &[]);
    assert!(
        text.contains(">    2 | it(") && text.contains("a_test.lua:2 (file): "),
        "{text}"
    );
}

#[test]
fn what_tests_print_cannot_command_the_terminal() {
    let text = stdout(
        &[(
            "a_test.lua",
            "it('x\\27[2J', function() print('\\27]0;title\\7') error('\\27[31m') end)",
        )],
        &[],
    );
    assert!(
        text.contains("␛[31m") && !text.contains('\x1b') && !text.contains('\x07'),
        "{text}"
    );
}

#[test]
fn tap_takes_standard_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = run(
        folder.path(),
        &[("a_test.lua", SUITE)],
        &["--tap", "-j", "1"],
    );
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let points: Vec<_> = text.lines().filter(|line| !line.starts_with(' ')).collect();
    assert_eq!(
        points,
        [
            "TAP version 14",
            "1..5",
            "ok 1 - a_test.lua::group passes",
            "not ok 2 - a_test.lua::group fails",
            "not ok 3 - a_test.lua::group crashes",
            "not ok 4 - a_test.lua::group later # TODO pending",
            "ok 5 - a_test.lua::group ends itself # SKIP not today",
        ]
    );
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        log.contains("1 passed, 1 failed, 1 error, 2 pending"),
        "{log}"
    );
}

#[test]
fn json_has_a_line_for_each_moment() {
    let text = stdout(&[("a_test.lua", SUITE)], &["--json", "--seed", "9"]);
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let types: Vec<_> = lines
        .iter()
        .map(|line| line["type"].as_str().expect("a type"))
        .collect();
    assert_eq!(
        types,
        ["begin", "test", "test", "test", "test", "test", "summary"]
    );
    let named = |title: &str| {
        lines
            .iter()
            .find(|line| line["title"] == title)
            .expect("the test")
    };
    assert_eq!(named("group passes")["console"][0]["text"], "said");
    let failed = named("group fails");
    assert_eq!(
        (&failed["status"], &failed["line"], &failed["seed"]),
        (&"failed".into(), &5.into(), &9.into())
    );
    assert_eq!(lines[6]["pending"], 2);
}

#[test]
fn one_stream_at_a_time() {
    let folder = tempfile::tempdir().expect("a folder");
    for args in [
        ["--tap", "--json"],
        ["--tap", "--watch"],
        ["--json", "--list"],
    ] {
        assert_eq!(
            run(folder.path(), &[], &args).status.code(),
            Some(4),
            "{args:?}"
        );
    }
}

#[test]
fn files_are_written_whatever_the_result_and_replace_older_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let args = ["--junit", "out/deep/junit.xml", "--html", "page.html"];
    fs::write(folder.path().join("page.html"), "old").expect("a file");
    assert_eq!(
        run(folder.path(), &[("a_test.lua", SUITE)], &args)
            .status
            .code(),
        Some(1)
    );
    let junit =
        fs::read_to_string(folder.path().join("out/deep/junit.xml")).expect("it is written");
    assert!(junit.contains(
        "<testsuites name=\"swanilda test\" tests=\"5\" failures=\"1\" errors=\"1\" skipped=\"2\""
    ));
    let page = fs::read_to_string(folder.path().join("page.html")).expect("it is written");
    assert!(page.contains("<title>2 of 5 tests failed</title>"));
    let names: Vec<_> = fs::read_dir(folder.path())
        .expect("a folder")
        .flatten()
        .map(|entry| entry.file_name())
        .collect();
    assert_eq!(names.len(), 3, "nothing else is left: {names:?}");
}

#[test]
fn a_file_that_cannot_be_written_is_an_error_before_anything_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("file"), "").expect("a file");
    for target in ["file/junit.xml", "."] {
        let output = run(
            folder.path(),
            &[("a_test.lua", SUITE)],
            &["--junit", target],
        );
        assert_eq!(
            (output.status.code(), &*output.stdout),
            (Some(4), &b""[..]),
            "{target}"
        );
        assert!(
            String::from_utf8_lossy(&output.stderr).starts_with("swanilda: cannot write "),
            "{target}"
        );
    }
}

#[test]
#[cfg(unix)]
fn devices_and_links_stay_what_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let (link, target) = (
        folder.path().join("link.xml"),
        folder.path().join("target.xml"),
    );
    fs::write(&target, "old").expect("a file");
    std::os::unix::fs::symlink(&target, &link).expect("a link");
    let args = ["--junit", "link.xml", "--html", "/dev/null"];
    assert_eq!(
        run(folder.path(), &[("a_test.lua", SUITE)], &args)
            .status
            .code(),
        Some(1)
    );
    assert!(
        fs::symlink_metadata(&link)
            .expect("it is there")
            .is_symlink()
    );
    assert!(
        fs::read_to_string(&target)
            .expect("readable")
            .contains("<testsuites")
    );
    assert!(!fs::metadata("/dev/null").expect("it is there").is_file());
}

#[test]
#[cfg(unix)]
fn an_interrupted_run_reports_what_it_did() {
    let folder = tempfile::tempdir().expect("a folder");
    let suite = "it('passes', function() end) it('loops', function() while true do end end) it('waits', function() end)";
    let args = [
        "--json",
        "--junit",
        "junit.xml",
        "--html",
        "page.html",
        "-j",
        "1",
    ];
    let mut child = command(folder.path(), &[("a_test.lua", suite)], &args)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    let mut lines = std::io::BufRead::lines(std::io::BufReader::new(
        child.stdout.take().expect("it is piped"),
    ));
    let first = lines
        .by_ref()
        .map(|line| line.expect("text"))
        .find(|line| line.contains("\"title\":\"passes\""));
    assert!(first.is_some(), "the first test comes to its end");
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill is there");
    assert!(signal.success());
    let last: Value =
        serde_json::from_str(&lines.last().expect("a summary").expect("text")).expect("JSON");
    assert_eq!(
        (&last["interrupted"], &last["notRun"], &last["passed"]),
        (&true.into(), &2.into(), &1.into())
    );
    let status = wait_within(&mut child, LIMIT).expect("it ends");
    assert_eq!(status.code(), Some(2));
    let junit = fs::read_to_string(folder.path().join("junit.xml")).expect("it is written");
    assert!(junit.contains("tests=\"1\""), "{junit}");
    let page = fs::read_to_string(folder.path().join("page.html")).expect("it is written");
    assert!(page.contains("<b>2</b> not run") && page.contains("interrupted"));
}

#[test]
fn the_page_has_plots_of_recordings_that_are_as_they_should_be() {
    let folder = tempfile::tempdir().expect("a folder");
    let suite = "local t = require 'swanilda.test'
        it('waves', function() t.golden('wave', {s = function() return math.sin(t.time()) end}) t.run_for(500) end)";
    let files = [("a_test.lua", suite)];
    assert_eq!(
        run(folder.path(), &files, &["--update-golden"])
            .status
            .code(),
        Some(0)
    );
    assert_eq!(
        run(folder.path(), &files, &["--html", "page.html"])
            .status
            .code(),
        Some(0)
    );
    let page = fs::read_to_string(folder.path().join("page.html")).expect("it is written");
    assert!(page.contains("src=\"data:image/svg+xml;base64,"));
    assert!(
        page.len() < 200_000,
        "10 000 samples take {} bytes",
        page.len()
    );
}
