//! Which Python runs a script, and the start of its process.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::embedding::{EmbeddedScript, OutsideScript, PythonHost, ScriptCalls};
use crate::host::{Env, Script, Sim};
use io::PeerProcess;
use permissions::Denied;
use scene::Data;
use wire::marshal::Encoder;

/// The first code of a process.
const GUARDIAN: &str = include_str!("child/guardian.py");
/// The modules of a process, in the order of their dependencies.
const MODULES: [(&str, &str); 6] = [
    ("swanilda_link", include_str!("child/swanilda_link.py")),
    ("swanilda_api", include_str!("child/swanilda_api.py")),
    ("swanilda_trace", include_str!("child/swanilda_trace.py")),
    (
        "swanilda_coverage",
        include_str!("child/swanilda_coverage.py"),
    ),
    ("swanilda_seed", include_str!("child/swanilda_seed.py")),
    ("swanilda_script", include_str!("child/swanilda_script.py")),
];
/// What takes the place of the guardian in the program's Python.
const EMBEDDED: (&str, &str) = (
    "swanilda_embedded",
    include_str!("child/swanilda_embedded.py"),
);

/// The variable from which Python takes the start of its hashes, which is otherwise different in every process.
const HASH_SEED: &str = "PYTHONHASHSEED";

/// The variable with which a process listens for a debugger.
const DEBUG: &str = "SWANILDA_DEBUG_PYTHON";

/// Where virtual environments have their Python.
const VIRTUAL_ENVIRONMENTS: [&str; 2] = [".venv/bin/python", "venv/bin/python"];

/// Why there is no process.
#[derive(Debug, thiserror::Error)]
pub enum LaunchError {
    /// Programs must not be started.
    #[error("a script in Python can do what a program can: {0}")]
    Denied(#[from] Denied),
    /// There is no such interpreter.
    #[error(
        "The Python interpreter could not be called. It is currently set as: '{program}' ({reason}). Install Python 3.9 or newer, for \
         instance by 'apt install python3', or set another interpreter with -D python=PATH."
    )]
    NotStarted {
        /// The interpreter.
        program: String,
        /// The error of the system.
        reason: std::io::Error,
    },
    /// It has ended.
    #[error("the simulator is gone.")]
    NoSimulator,
    /// The program around the simulator has a Python that does not work.
    #[error("Python cannot run scripts: {0}")]
    NotEmbedded(String),
}

/// The Python interpreter chosen by the script or by the named parameter `python`. It may have arguments, separated by blanks.
pub(super) fn chosen_interpreter(sim: &Sim, by_script: Option<String>) -> Option<String> {
    let named = || {
        let app = sim.app.borrow();
        app.named_params
            .get("python")
            .map(|value| String::from_utf8_lossy(value).into_owned())
    };
    let by_script = by_script.filter(|program| !program.trim().is_empty());
    by_script.or_else(|| named().filter(|program| !program.trim().is_empty()))
}

/// The Python of a virtual environment in one of the folders, or that of the system.
pub(super) fn default_interpreter(folders: &[PathBuf]) -> String {
    environment_beside(folders).unwrap_or_else(|| "python3".into())
}

/// The Python of a virtual environment in one of the folders.
fn environment_beside(folders: &[PathBuf]) -> Option<String> {
    let candidates = folders
        .iter()
        .flat_map(|folder| VIRTUAL_ENVIRONMENTS.map(|python| folder.join(python)));
    candidates
        .filter(|python| python.is_file())
        .find_map(|python| python.to_str().map(str::to_owned))
}

/// The folders of the script's file and of the scene, then those in which scripts find their modules.
pub(super) fn scene_folders(sim: &Sim, script: &Script) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = Vec::new();
    for folder in named_folders(sim, script) {
        let absolute = sim.options.permissions.absolute(&folder);
        let folder = absolute.unwrap_or(folder);
        if !all.contains(&folder) {
            all.push(folder);
        }
    }
    all
}

/// The same as they are named.
fn named_folders(sim: &Sim, script: &Script) -> Vec<PathBuf> {
    let files = [
        script.file.borrow().clone().unwrap_or_default(),
        sim.scene_path(),
    ];
    let folder = |file: &String| Some(Path::new(file).parent()?.to_owned());
    let folders = files
        .iter()
        .filter_map(folder)
        .filter(|folder| folder != Path::new(""));
    folders
        .chain(sim.options.package_dirs.iter().cloned())
        .collect()
}

/// Makes a script without a text in the program's Python.
///
/// # Errors
/// When programs must not be started, or Python does not work.
pub(super) fn embed(
    sim: &Sim,
    host: &dyn PythonHost,
    env: &Rc<Env>,
) -> Result<Rc<dyn EmbeddedScript>, LaunchError> {
    sim.options.permissions.check_run("python3")?;
    let script = OutsideScript::start(
        host,
        &modules(&[&MODULES[..], &[EMBEDDED]].concat()),
        ScriptCalls::new(env),
    );
    Ok(Rc::new(script.map_err(LaunchError::NotEmbedded)?))
}

/// Starts a process without a script.
///
/// # Errors
/// When programs must not be started, or there is no such interpreter.
pub(super) fn start(sim: &Sim, interpreter: &str) -> Result<PeerProcess, LaunchError> {
    start_modules(sim, interpreter, &modules(&MODULES))
}

/// Starts a program in Python that works for a script and ends with the simulator: the function `run` of the last of its modules, which are names and
/// texts in the order of their dependencies, gets the connection. The interpreter is that of `-D python`, of a virtual environment beside the
/// scene, of the program around the simulator, or the system's.
///
/// # Errors
/// When programs must not be started, or there is no such interpreter.
pub fn start_python(env: &Env, parts: &[(&str, &str)]) -> Result<PeerProcess, LaunchError> {
    let sim = env.sim.upgrade().ok_or(LaunchError::NoSimulator)?;
    let interpreter = interpreter_beside(&sim, &scene_folders(&sim, &env.script));
    start_modules(&sim, &interpreter, &modules(parts))
}

/// The interpreter of that program.
fn interpreter_beside(sim: &Sim, folders: &[PathBuf]) -> String {
    chosen_interpreter(sim, None)
        .or_else(|| environment_beside(folders))
        .or_else(|| sim.options.python.clone())
        .unwrap_or_else(|| "python3".into())
}

/// The same interpreter with its arguments, for whoever starts it outside of the run, of whose capture this is no part; None where programs must not
/// be started.
pub fn python_command(sim: &Sim, script: &Script) -> Option<Vec<String>> {
    let interpreter = interpreter_beside(sim, &named_folders(sim, script));
    sim.options.permissions.check_run(&interpreter).ok()?;
    let words = words(&interpreter);
    Some(words.into_iter().map(str::to_owned).collect())
}

/// A program and its arguments. A path may contain blanks.
fn words(interpreter: &str) -> Vec<&str> {
    if Path::new(interpreter).is_file() {
        vec![interpreter]
    } else {
        interpreter.split_whitespace().collect()
    }
}

fn start_modules(sim: &Sim, interpreter: &str, modules: &[u8]) -> Result<PeerProcess, LaunchError> {
    sim.options.permissions.check_run(interpreter)?;
    let mut words = words(interpreter).into_iter();
    let program = words.next().unwrap_or(interpreter);
    let args: Vec<&str> = words.chain(["-c", GUARDIAN]).collect();
    let failed = |reason| LaunchError::NotStarted {
        program: interpreter.to_owned(),
        reason,
    };
    let seed = sim.scripts.seed.get().to_string();
    let mut variables = vec![(HASH_SEED, seed.as_str())];
    if sim.options.debug_python {
        variables.push((DEBUG, "1"));
    }
    let mut process = PeerProcess::start(program, &args, None, &variables).map_err(failed)?;
    // One that has ended already is noticed when it is to do something.
    let _ = process.send(modules);
    Ok(process)
}

/// The message with the modules of a process.
fn modules(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut message = Encoder::default();
    let module =
        |&(name, text): &(&str, &str)| Data::Array(vec![Data::text(name), Data::text(text)]);
    let modules: Vec<Data> = parts.iter().map(module).collect();
    message.list(&modules);
    message.into_bytes()
}
