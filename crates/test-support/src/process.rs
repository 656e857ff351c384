//! Running the command with a bound on time.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::time::{Duration, Instant};

/// How long one command may take, and what a test waits for, on a machine that has other things to do.
pub const LIMIT: Duration = Duration::from_secs(120);

/// Runs a command; stdout and stderr merged in the order they were written.
///
/// # Errors
/// When it does not end in time, or by a signal.
pub fn run_bounded(command: &mut Command) -> Result<String, String> {
    run_within(command, LIMIT)
}

/// The same with a bound of one's own.
///
/// # Errors
/// When it does not end in time, or by a signal.
pub fn run_within(command: &mut Command, limit: Duration) -> Result<String, String> {
    run_for_code(command, limit).map(|(_, text)| text)
}

/// The same with the exit code.
///
/// # Errors
/// When it does not end in time, or by a signal.
pub fn run_for_code(command: &mut Command, limit: Duration) -> Result<(i32, String), String> {
    let mut output = tempfile();
    let (out, err) = (
        output.try_clone().expect("files can be cloned"),
        output.try_clone().expect("files can be cloned"),
    );
    let mut child = command
        .stdin(Stdio::null())
        .stdout(out)
        .stderr(err)
        .spawn()
        .expect("the command starts");
    let Some(status) = wait_within(&mut child, limit) else {
        return Err(format!(
            "did not end within {limit:?}; it said last:\n{}",
            last_lines(&mut output)
        ));
    };
    let text = without_notices(&read(&mut output));
    status
        .code()
        .map(|code| (code, text.clone()))
        .ok_or_else(|| format!("ended by a signal: {status}\n{text}"))
}

/// The text without notices of calls that take long: whether there are any depends on how busy the machine is.
fn without_notices(text: &str) -> String {
    let is_notice =
        |line: &&str| line.starts_with("swanilda: ") && line.contains(" has been running for ");
    text.split_inclusive('\n')
        .filter(|line| !is_notice(line))
        .collect()
}

/// Runs a command; what it wrote to standard output and to standard error.
///
/// # Panics
/// When it does not end within [`LIMIT`].
#[track_caller]
pub fn output_of(command: &mut Command) -> Output {
    let (mut out, mut err) = (tempfile(), tempfile());
    let (stdout, stderr) = (
        out.try_clone().expect("files can be cloned"),
        err.try_clone().expect("files can be cloned"),
    );
    let mut child = command
        .stdin(Stdio::null())
        .stdout(stdout)
        .stderr(stderr)
        .spawn()
        .expect("the command starts");
    let Some(status) = wait_within(&mut child, LIMIT) else {
        panic!(
            "{command:?} did not end within {LIMIT:?}; it said last:\n{}",
            last_lines(&mut err)
        );
    };
    Output {
        status,
        stdout: bytes(&mut out),
        stderr: bytes(&mut err),
    }
}

/// Waits for the end of a child. One that goes on is killed: None.
pub fn wait_within(child: &mut Child, limit: Duration) -> Option<ExitStatus> {
    let deadline = Instant::now() + limit;
    loop {
        match child.try_wait().expect("the child is ours") {
            Some(status) => return Some(status),
            None if Instant::now() > deadline => {
                let _ = child.kill();
                let _ = child.wait();
                return None;
            }
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    }
}

/// The number of processes with that word in their environment.
///
/// # Panics
/// Where there is no `/proc`.
pub fn processes_with(word: &str) -> usize {
    let processes = std::fs::read_dir("/proc")
        .expect("there are processes")
        .flatten();
    let environments =
        processes.filter_map(|process| std::fs::read(process.path().join("environ")).ok());
    environments
        .filter(|environment| {
            environment
                .windows(word.len())
                .any(|part| part == word.as_bytes())
        })
        .count()
}

/// Waits until that is so.
///
/// # Panics
/// When it is not within [`LIMIT`].
#[track_caller]
pub fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let deadline = Instant::now() + LIMIT;
    while !is_so() {
        assert!(Instant::now() < deadline, "not within {LIMIT:?}: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn read(output: &mut File) -> String {
    String::from_utf8_lossy(&bytes(output)).into_owned()
}

fn bytes(output: &mut File) -> Vec<u8> {
    let mut bytes = Vec::new();
    output
        .seek(SeekFrom::Start(0))
        .expect("files can be rewound");
    output
        .read_to_end(&mut bytes)
        .expect("our own file is readable");
    bytes
}

fn last_lines(output: &mut File) -> String {
    let text = read(output);
    let lines: Vec<&str> = text.lines().rev().take(5).collect();
    lines.into_iter().rev().collect::<Vec<_>>().join("\n")
}

fn tempfile() -> File {
    tempfile::tempfile().expect("a temporary file can be made")
}
