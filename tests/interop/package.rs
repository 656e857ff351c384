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

/// The Python that has the package; None where there is no python3.
fn python_with_package() -> Option<&'static PathBuf> {
    static INSTALLED: OnceLock<()> = OnceLock::new();
    let python = python()?;
    INSTALLED.get_or_init(|| {
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
    let Some(python) = python_with_package() else {
        return;
    };
    let server = Server::start();
    let mut pytest = Command::new(python);
    pytest
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .arg(root().join("tests/python"));
    pytest
        .env("SWANILDA_PORT", &server.port)
        .env("SWANILDA_BIN", env!("CARGO_BIN_EXE_swanilda"));
    pytest
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(root().join("tests"));
    succeed(&mut pytest, TESTS);
}
