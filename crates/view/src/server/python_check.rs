//! Whether a text is Python, which Python itself says: its compiler runs in a process of its own, and the text does not run at all.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{Builder, sleep};
use std::time::Duration;

use serde_json::Value;

use super::lock;
use io::Program;
use script::{python_parts, wall_clock};

const CODE: &str = include_str!("python_check.py");
/// A check that takes longer finds nothing.
const LIMIT: Duration = Duration::from_secs(10);
const PAUSE: Duration = Duration::from_millis(5);
/// How many may run at once: one for each of some pages in which somebody types.
const MAX_RUNNING: usize = 4;

/// Checks texts, where there is a Python.
#[derive(Default)]
pub(super) struct PythonCheck {
    /// The interpreter and its arguments.
    command: Mutex<Option<Vec<String>>>,
    running: Arc<AtomicUsize>,
}

impl PythonCheck {
    /// What runs Python from now on; None where nothing does.
    pub(super) fn set(&self, command: Option<Vec<String>>) {
        *lock(&self.command) = command;
    }

    /// Calls `done` with the error in a text, or with None if there is none or nobody knows.
    ///
    /// # Errors
    /// When too many are checked already.
    pub(super) fn check(
        &self,
        code: &str,
        done: impl FnOnce(Option<Value>) + Send + 'static,
    ) -> Result<(), String> {
        let Some(program) = self.program() else {
            done(None);
            return Ok(());
        };
        let place = Place::among(&self.running).ok_or("too many texts are checked at once")?;
        let text = python_parts(code.as_bytes()).1;
        let thread = Builder::new().spawn(move || {
            let error = first_error(&program, text);
            drop(place);
            done(error);
        });
        thread.map(drop).map_err(|error| error.to_string())
    }

    fn program(&self) -> Option<Program> {
        let command = lock(&self.command).clone()?;
        let (path, args) = command.split_first()?;
        // Nothing of the folder, of the environment or of installed packages takes part.
        let own = ["-I", "-S", "-W", "ignore", "-c", CODE].map(str::to_owned);
        Some(Program {
            path: path.clone(),
            args: args.iter().cloned().chain(own).collect(),
            search_path: true,
            ..Program::default()
        })
    }
}

/// One of the few that may run at once.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn among(running: &Arc<AtomicUsize>) -> Option<Self> {
        let place = Self(Arc::clone(running));
        let before = running.fetch_add(1, Ordering::Relaxed);
        (before < MAX_RUNNING).then_some(place)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// What the program says of a text; None if it fails or takes too long, when it is killed.
#[expect(
    clippy::disallowed_methods,
    reason = "a thread of its own waits, for which nothing of the simulation does"
)]
fn first_error(program: &Program, text: Vec<u8>) -> Option<Value> {
    let mut run = program.run(text).ok()?;
    let end = wall_clock::now() + LIMIT;
    while run.exit_code().is_none() || !run.outputs_are_complete() {
        if wall_clock::now() > end {
            return None;
        }
        sleep(PAUSE);
    }
    let (output, _) = run.outputs().ok()?;
    let error: Value = serde_json::from_slice(&output).ok()?;
    error.is_object().then_some(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use permissions::Permissions;
    use simulator::{Options, ScriptKind, Simulator};
    use std::sync::mpsc::channel;

    fn python() -> PythonCheck {
        let check = PythonCheck::default();
        check.set(Some(vec!["python3".to_owned()]));
        check
    }

    fn checked(check: &PythonCheck, code: &str) -> Option<Value> {
        let (sender, answer) = channel();
        let done = move |error| sender.send(error).expect("the test waits");
        check.check(code, done).expect("there is room for one");
        answer.recv().expect("there is an answer")
    }

    /// Line and column of the error.
    fn place(code: &str) -> [Option<u64>; 2] {
        let error = checked(&python(), code).expect("it is no Python");
        assert!(!error["message"].as_str().expect("a text").is_empty());
        ["line", "column"].map(|name| error[name].as_u64())
    }

    #[test]
    fn python_says_where_the_first_error_is() {
        let good = "#luaExec x = 1\ninclude other\ndef f():\n    return 'ä'\n";
        assert_eq!(checked(&python(), good), None);
        assert_eq!(place("a = 1\r\nb = = 2\n"), [Some(2), Some(5)]);
        assert_eq!(place("x = 1\nreturn x\n")[0], Some(2));
        assert_eq!(place("s = '😀'; 1 = b\n"), [Some(1), Some(11)]);
    }

    #[test]
    fn no_text_is_run_and_none_is_too_odd() {
        let file = tempfile::tempdir().expect("there is room");
        let path = file.path().join("made");
        let code = format!("open({:?}, 'w').close()\n", path.to_str().expect("UTF-8"));
        assert_eq!(checked(&python(), &code), None);
        assert!(!path.exists());
        for odd in ["\0", &"(".repeat(100_000), "match = \n"] {
            assert!(checked(&python(), odd).is_some(), "{}", &odd[..1]);
        }
    }

    #[test]
    fn without_python_nothing_is_checked() {
        let check = PythonCheck::default();
        assert_eq!(checked(&check, "b = = 2"), None);
        check.set(Some(vec!["/no/such/python".to_owned()]));
        assert_eq!(checked(&check, "b = = 2"), None);
    }

    #[test]
    fn scripts_that_may_start_no_program_have_no_python() {
        let command = |permissions| {
            let options = Options {
                permissions,
                ..Options::default()
            };
            let mut sim = Simulator::new(options);
            let script = sim.add_script(ScriptKind::Customization, "", b"x = 1");
            let handle = script.expect("a script is added").handle();
            sim.python_command(handle).expect("the script is there")
        };
        assert_eq!(command(Permissions::strict()), None);
        assert_eq!(
            command(Permissions::all()),
            Some(vec!["python3".to_owned()])
        );
    }

    #[test]
    fn few_run_at_once() {
        let running = Arc::default();
        let places: Vec<_> = (0..=MAX_RUNNING).map(|_| Place::among(&running)).collect();
        assert_eq!(places.iter().flatten().count(), MAX_RUNNING);
        drop(places);
        assert!(Place::among(&running).is_some());
    }
}
