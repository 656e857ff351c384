//! The Python package: built by pip into the environment, then its own tests in `tests/python`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use test_support::process::run_for_code;

use crate::server::{Server, python};

/// For the extension, which is built in the profile of tests.
const BUILD: Duration = Duration::from_secs(1800);
const TESTS: Duration = Duration::from_secs(600);
const LEARNERS: [&str; 5] = [
    "torch==2.15.0",
    "stable-baselines3==2.9.2",
    "ray[rllib]==2.60.0",
    "maturin==1.16.0",
    "pytest==9.2.0",
];

/// The Python that has the package; None where there is no python3.
fn python_with_package() -> Option<&'static PathBuf> {
    static INSTALLED: OnceLock<()> = OnceLock::new();
    let python = python()?;
    INSTALLED.get_or_init(|| {
        install_package(python);
        // It is as large as all others together; its tests are skipped without it.
        if std::env::var_os("CI").is_some() {
            succeed(
                Command::new(python).args(["-m", "pip", "install", "--quiet", "ray[data]==2.60.0"]),
                BUILD,
            );
        }
    });
    Some(python)
}

/// Builds the package in the profile of tests, with what is in the environment.
fn install_package(python: &Path) {
    let mut pip = Command::new(python);
    pip.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-deps",
        "--no-build-isolation",
        "--force-reinstall",
    ]);
    pip.arg("--config-settings=build-args=--profile dev")
        .arg(root());
    // `cargo test` passes on what belongs to the package it tests.
    pip.env_remove("CARGO_MANIFEST_DIR")
        .env("PATH", path_with(python));
    succeed(&mut pip, BUILD);
}

/// Where pip finds maturin first.
fn path_with(python: &Path) -> std::ffi::OsString {
    let folder = python.parent().expect("it lies in a folder").to_owned();
    let rest = std::env::var_os("PATH").unwrap_or_default();
    std::env::join_paths(std::iter::once(folder).chain(std::env::split_paths(&rest)))
        .expect("paths have no colon")
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn succeed(command: &mut Command, limit: Duration) {
    let (code, text) =
        run_for_code(command, limit).unwrap_or_else(|reason| panic!("{command:?} {reason}"));
    assert_eq!(code, 0, "{command:?}\n{text}");
}

#[test]
fn the_package_passes_its_tests() {
    if let Some(python) = python_with_package() {
        pass(python, &["."]);
    }
}

/// Learners that need torch, whose wheels bring 3 GB of CUDA with them, 6 GB on disk: in an environment of their own, only where asked for.
#[test]
#[ignore = "installs torch: cargo test -p swanilda --test interop -- --ignored learners"]
fn the_package_works_with_learners_on_torch() {
    let Some(python) = python() else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("learners");
    succeed(
        Command::new(python).args(["-m", "venv"]).arg(&folder),
        BUILD,
    );
    let python = folder.join("bin/python");
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet"]).args(LEARNERS);
    succeed(&mut pip, BUILD);
    install_package(&python);
    pass(&python, &["test_sb3.py", "test_rllib.py"]);
}

fn pass(python: &Path, tests: &[&str]) {
    let server = Server::start();
    let mut pytest = Command::new(python);
    pytest
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .args(
            tests
                .iter()
                .map(|test| root().join("tests/python").join(test)),
        );
    pytest
        .env("SWANILDA_PORT", &server.port)
        .env("SWANILDA_BIN", env!("CARGO_BIN_EXE_swanilda"));
    pytest
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(root().join("tests"));
    succeed(&mut pytest, TESTS);
}
