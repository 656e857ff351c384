//! `swanilda run --isolate`: the scene runs in a child process. If that crashes, the program says so, and in which plugin.

use std::path::PathBuf;
use std::process::{Child, Command, ExitCode, ExitStatus};

use crate::cli::{INTERNAL, complain};
use io::signals;

/// The variable with the file in which the child notes the plugin that is running.
const NOTE: &str = "SWANILDA_PLUGIN_NOTE";

/// The variable with the number of the parent.
const PARENT: &str = "SWANILDA_ISOLATING_PROCESS";

/// In a child: the file to note plugins in. From now on the child ends with its parent.
pub(super) fn note() -> Option<PathBuf> {
    let note = std::env::var_os(NOTE).map(PathBuf::from)?;
    #[cfg(target_os = "linux")]
    end_with_parent();
    Some(note)
}

/// Its main thread has started this process, so the signal comes with the end of the process.
#[cfg(target_os = "linux")]
fn end_with_parent() {
    use rustix::process::{Signal, getppid, set_parent_process_death_signal};

    if let Err(error) = set_parent_process_death_signal(Some(Signal::TERM)) {
        complain(&format!(
            "this process may outlive the one that has started it: {error}"
        ));
    }
    let parent = getppid().map_or(0, |pid| pid.as_raw_nonzero().get());
    let started_by = std::env::var(PARENT).ok().and_then(|id| id.parse().ok());
    if started_by.is_some_and(|id: i32| id != parent) {
        // It had ended before it could be followed.
        std::process::exit(i32::from(INTERNAL));
    }
}

/// Runs this command line in a child; its exit code, or what ended it.
pub(super) fn run() -> ExitCode {
    match run_child() {
        Err(error) => {
            complain(&format!(
                "the scene cannot run in a process of its own: {error}"
            ));
            ExitCode::from(INTERNAL)
        }
        Ok((status, running)) => match status.code().map(u8::try_from) {
            Some(Ok(code)) => ExitCode::from(code),
            _ => {
                complain(&crashed(status, &running));
                ExitCode::from(INTERNAL)
            }
        },
    }
}

fn run_child() -> std::io::Result<(ExitStatus, String)> {
    let note = tempfile::NamedTempFile::new()?;
    let program = std::env::current_exe()?;
    let mut child = Command::new(program)
        .args(std::env::args_os().skip(1))
        .env(NOTE, note.path())
        .env(PARENT, std::process::id().to_string())
        .spawn()?;
    pass_on_requests(&child);
    let status = child.wait()?;
    Ok((
        status,
        std::fs::read_to_string(note.path()).unwrap_or_default(),
    ))
}

/// This process waits for the child's end when it is asked to end itself.
fn pass_on_requests(child: &Child) {
    #[cfg(unix)]
    let child = rustix::process::Pid::from_child(child);
    #[cfg(not(unix))]
    let _ = child;
    let listening = ctrlc::set_handler(move || {
        // Ctrl-c reaches all processes of a terminal, so the child has it already.
        #[cfg(unix)]
        if signals::last_request() != signals::INTERRUPT {
            // A child that has ended needs no request.
            let _ = rustix::process::kill_process(child, rustix::process::Signal::TERM);
        }
    });
    match listening {
        Ok(()) => signals::note_requests(),
        Err(error) => complain(&format!("cannot listen for ctrl-c: {error}")),
    }
}

fn crashed(status: ExitStatus, running: &str) -> String {
    let place = match running.split_once('\n') {
        Some((plugin, function)) => format!("in {function} of the plugin {plugin}"),
        None => "outside of plugins".to_owned(),
    };
    format!("the process of the scene has crashed {place}: {status}")
}
