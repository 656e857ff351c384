//! Packages of others that drive CoppeliaSim, from the Python index and unchanged: the files `with_*.py` use what they offer.
//!
//! They have an environment of their own, into which each is installed with what it needs. One that cannot be installed here is skipped, with
//! the reason: some have programs for few versions of Python.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Duration;

use test_support::process::{LIMIT, run_for_code};
use test_support::skipped;

use crate::server::{Server, folder};

/// For what comes from the Python index.
const INSTALL: Duration = Duration::from_secs(900);
/// The Python client of CoppeliaSim, which most of them use.
const CLIENT: &str = "coppeliasim-zmqremoteapi-client==2.0.4";
const NUMPY: &str = "numpy==2.2.6";

/// A package with what it needs.
struct Package {
    name: &'static str,
    /// What pip installs with all that it asks for.
    whole: &'static [&'static str],
    /// What pip installs alone.
    alone: &'static [&'static str],
    /// What shows that it works here.
    import: &'static str,
}

#[test]
fn coppeliasim_mcp() {
    check(&Package {
        name: "mcp",
        whole: &["coppeliasim-mcp==0.4.0", "mcp==2.3.0", CLIENT, NUMPY],
        alone: &[],
        import: "import coppeliasim_mcp, mcp",
    });
}

#[test]
fn dqrobotics() {
    check(&Package {
        name: "dqrobotics",
        whole: &[
            "dqrobotics==26.4.0a7",
            "dqrobotics-interface-coppeliasim-zmq==25.4.0a19",
            "pyzmq==27.3.0",
            NUMPY,
        ],
        alone: &[],
        import: "import dqrobotics.interfaces.coppeliasim",
    });
}

#[test]
fn screws() {
    check(&Package {
        name: "screws",
        whole: &["screws==0.7.0", CLIENT, NUMPY],
        alone: &[],
        import: "import screws.coppelia",
    });
}

#[test]
fn ur5_lab_helper() {
    check(&Package {
        name: "ur5",
        whole: &["ur5-lab-helper==1.0.2", CLIENT, NUMPY],
        alone: &[],
        import: "import importlib.util as u; assert u.find_spec('helper')",
    });
}

/// It asks for versions of NumPy and pandas from before Python 3.12, and runs with later ones.
#[test]
fn guira() {
    check(&Package {
        name: "guira",
        whole: &["pandas==2.3.3", NUMPY],
        alone: &["guira==0.1.0"],
        import: "import guira.scene",
    });
}

/// Installs a package and runs its file against a server.
fn check(package: &Package) {
    let python = match install(package) {
        Ok(python) => python,
        Err(reason) => return skipped(&format!("{} does not install: {reason}", package.name)),
    };
    let scene = folder().join("foreign/scene.lua").display().to_string();
    let is_legacy = package.name == "guira";
    let server = Server::start_with(&if is_legacy {
        ["--no-remote-api", "--legacy-remote-api=0", &scene]
    } else {
        ["--remote-api=0", "--bind=127.0.0.1", &scene]
    });
    let mut command = with_libzmq(&python);
    command
        .arg(folder().join(format!("foreign/with_{}.py", package.name)))
        .arg(&server.port)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    let (code, said) = run_for_code(&mut command, LIMIT).expect("it ends");
    assert_eq!(code, 0, "{}: {said}", package.name);
}

/// Installs a package once; the Python that has it.
///
/// # Errors
/// When that does not work here: the last line of pip or Python.
fn install(package: &Package) -> Result<PathBuf, String> {
    // One at a time: they share an environment.
    static ENVIRONMENT: Mutex<()> = Mutex::new(());
    let _one = ENVIRONMENT.lock().map_err(|error| error.to_string())?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("foreign-venv");
    let python = folder.join("bin/python");
    if !python.exists() {
        try_run(Command::new("python3").args(["-m", "venv"]).arg(&folder))?;
    }
    let stamp = folder.join(format!("{}.txt", package.name));
    let wanted = [package.whole, package.alone].concat().join("\n");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(python);
    }
    let pip = || {
        let mut pip = Command::new(&python);
        pip.args(["-m", "pip", "install", "--quiet"]);
        pip.args(["--no-compile", "--disable-pip-version-check"]);
        pip
    };
    try_run(pip().args(package.whole))?;
    if !package.alone.is_empty() {
        try_run(pip().arg("--no-deps").args(package.alone))?;
    }
    try_run(with_libzmq(&python).args(["-c", package.import]))?;
    fs::write(stamp, wanted).map_err(|error| error.to_string())?;
    Ok(python)
}

/// Runs a command to its end.
///
/// # Errors
/// When it does not work: its last line.
fn try_run(command: &mut Command) -> Result<(), String> {
    match run_for_code(command, INSTALL)? {
        (0, _) => Ok(()),
        (_, said) => Err(said.lines().last().unwrap_or("it says nothing").to_owned()),
    }
}

/// Python, in which programs that are linked to the system's libzmq find the one that comes with pyzmq.
fn with_libzmq(python: &Path) -> Command {
    let mut command = Command::new(python);
    let environment = python.ancestors().nth(2).unwrap_or(python);
    if let Some(library) = bundled_libzmq(environment) {
        let links = environment.join("libzmq");
        let _ = fs::create_dir_all(&links);
        // It may be there.
        #[cfg(unix)]
        let _ = std::os::unix::fs::symlink(&library, links.join("libzmq.so.5"));
        let beside = library.parent().unwrap_or(&library);
        let folders = std::env::join_paths([links.as_path(), beside]).expect("paths have no colon");
        command.env("LD_LIBRARY_PATH", folders);
    }
    command
}

fn bundled_libzmq(environment: &Path) -> Option<PathBuf> {
    let versions = fs::read_dir(environment.join("lib")).ok()?.flatten();
    let folders = versions.map(|version| version.path().join("site-packages/pyzmq.libs"));
    let files = folders.filter_map(|folder| fs::read_dir(folder).ok());
    let mut libraries = files.flatten().flatten().map(|file| file.path());
    libraries.find(|path| {
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().starts_with("libzmq-")
    })
}
