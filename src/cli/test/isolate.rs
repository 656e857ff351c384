//! `swanilda test --isolate`: each test in a child, which is called like its parent, with the test to run in its environment.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use io::signals::run_on_crash;
use testing::{self, Config, TestCase};

/// The variable with the number, repetition and file of the one test to run.
const TEST: &str = "SWANILDA_ISOLATED_TEST";

/// The command for a child that runs the test.
pub(super) fn command(test: &TestCase) -> Command {
    let program = std::env::current_exe().unwrap_or_else(|_| "swanilda".into());
    let mut which = OsString::from(format!("{} {} ", test.index, test.repetition));
    which.push(&test.file);
    let mut command = Command::new(program);
    command.args(std::env::args_os().skip(1)).env(TEST, which);
    command
}

/// When a test crashes the process, it begins anew with a child for each test.
pub(super) fn after_crash() {
    let Ok(program) = std::env::current_exe() else {
        return;
    };
    let mut args: Vec<_> = std::env::args_os().collect();
    let Some(subcommand) = args.iter().position(|arg| arg == "test") else {
        return;
    };
    args[0] = program.into_os_string();
    args.insert(subcommand + 1, "--isolate".into());
    let message = "\nswanilda: native code crashed in a test. All tests run again, each in a child process (--isolate).\n";
    run_on_crash(message.to_owned(), args);
}

/// In a child: restricts the tests to the one.
pub(super) fn restrict(config: &mut Config) -> bool {
    let Some(which) = std::env::var_os(TEST) else {
        return false;
    };
    let which = which.to_string_lossy().into_owned();
    let mut parts = which.splitn(3, ' ');
    let mut number = || {
        parts
            .next()
            .and_then(|part| part.parse::<usize>().ok())
            .unwrap_or_default()
    };
    config.only = Some((number(), number() as u32));
    config.paths = parts.next().map(PathBuf::from).into_iter().collect();
    config.isolate = None;
    (config.filters, config.shard, config.jobs) = (Vec::new(), None, 1);
    true
}

/// In a child: ends this process when its standard input ends, which its parent holds open as long as it lives, however it is ended. Whoever
/// reads standard input finds nothing there.
#[cfg(unix)]
fn end_with_parent() -> std::io::Result<()> {
    use rustix::process::{Signal, getpid, kill_process};
    use std::io::Read;

    let lifeline = rustix::io::fcntl_dupfd_cloexec(std::io::stdin(), 3)?;
    rustix::stdio::dup2_stdin(std::fs::File::open("/dev/null")?)?;
    let wait = move || {
        // Nobody writes to it.
        let _ = std::fs::File::from(lifeline).read_to_end(&mut Vec::new());
        // At once, whatever the test is in the middle of.
        let _ = kill_process(getpid(), Signal::KILL);
    };
    std::thread::Builder::new().spawn(wait).map(drop)
}

#[cfg(not(unix))]
fn end_with_parent() -> std::io::Result<()> {
    Ok(())
}

/// In a child: runs the test, and ends the process at once, since a test that could not be ended may still keep a thread.
pub(super) fn run(config: &Config) -> ! {
    if let Err(error) = end_with_parent() {
        super::super::complain(&format!(
            "this process may outlive the one that has started it: {error}"
        ));
    }
    let code = match testing::run_child(config) {
        Ok(line) => {
            super::super::say(line.as_bytes());
            0
        }
        Err(error) => {
            super::super::complain(&error.to_string());
            1
        }
    };
    std::process::exit(code)
}
