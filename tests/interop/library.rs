//! The simulator as `libcoppeliaSim.so`: programs in C, and in Python with an extension by cffi, use it as those for CoppeliaSim do.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use test_support::process::{run_bounded, run_for_code};

use crate::server::{folder, python};

/// For the library, which is built in the profile of tests.
const BUILD: Duration = Duration::from_secs(1800);

/// The folder that `swanilda library` writes for CoppeliaSim 4.1, with the add-on of the programs.
fn root() -> &'static Path {
    static ROOT: OnceLock<PathBuf> = OnceLock::new();
    ROOT.get_or_init(|| {
        let root = written("4.1");
        let add_on = "simAddOnScript_Stack.lua";
        std::fs::copy(files().join(add_on), root.join(add_on)).expect("the folder is writable");
        root
    })
}

/// The folder for a version of CoppeliaSim.
fn written(version: &str) -> PathBuf {
    build();
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("coppeliasim-{version}"));
    let mut library = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    library.args(["library", "--for", version]).arg(&root);
    succeed(&mut library, BUILD);
    root
}

/// Builds the library of the simulator, beside the command.
fn build() {
    static BUILT: OnceLock<()> = OnceLock::new();
    BUILT.get_or_init(|| {
        let swanilda = Path::new(env!("CARGO_BIN_EXE_swanilda"));
        let target = swanilda
            .ancestors()
            .nth(2)
            .expect("it lies in target/debug");
        let mut cargo = Command::new(env!("CARGO"));
        cargo
            .args(["build", "--quiet", "-p", "swanilda-library", "--target-dir"])
            .arg(target)
            .current_dir(env!("CARGO_MANIFEST_DIR"));
        succeed(&mut cargo, BUILD);
    });
}

fn files() -> PathBuf {
    folder().join("library")
}

fn succeed(command: &mut Command, limit: Duration) -> String {
    let (code, text) =
        run_for_code(command, limit).unwrap_or_else(|reason| panic!("{command:?} {reason}"));
    assert_eq!(code, 0, "{command:?}\n{text}");
    text
}

/// Runs a program in Python, which says `ok` at its end.
fn run_program(name: &str) {
    run_program_on(name, root());
}

fn run_program_on(name: &str, root: &Path) {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let declarations = "crates/c-interface/src/abi_41.tsv";
    let mut program = Command::new(python);
    program
        .arg(files().join(name))
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(declarations))
        .arg(folder.path())
        .env("COPPELIASIM_ROOT", root)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    let text = succeed(&mut program, Duration::from_secs(300));
    assert_eq!(text.lines().last(), Some("ok"), "{text}");
}

#[test]
fn a_research_stack_finds_what_it_calls() {
    run_program("stack.py");
}

#[test]
fn programs_for_vrep_find_what_they_call() {
    run_program("more.py");
}

#[test]
fn calls_with_nothing_are_errors_and_no_crashes() {
    run_program("null_arguments.py");
    run_program_on("null_arguments.py", &written("4.10"));
}

#[test]
fn memory_does_not_grow_with_resets() {
    run_program("resets.py");
}

#[test]
fn threads_and_processes_are_kept_apart() {
    run_program("threads.py");
}

#[test]
fn the_package_of_the_original_finds_functions_modules_and_types() {
    run_program_on("package.py", &written("4.10"));
}

#[test]
fn a_program_in_c_starts_and_ends_the_simulator_twice() {
    let built = tempfile::tempdir().expect("a temporary folder can be made");
    let program = built.path().join("embed");
    let mut compiler = Command::new("cc");
    compiler
        .arg("-o")
        .arg(&program)
        .arg(files().join("embed.c"))
        .arg(format!("-L{}", root().display()))
        .arg(format!("-Wl,-rpath,{}", root().display()))
        .args(["-lcoppeliaSim", "-lpthread"]);
    succeed(&mut compiler, BUILD);
    let text = run_bounded(Command::new(program).arg(root()));
    let text = text.unwrap_or_else(|reason| panic!("{reason}"));
    assert_eq!(text.lines().last(), Some("ok"), "{text}");
}

/// Programs that start the executable find it there, with its options.
#[test]
fn the_executable_starts_with_the_options_of_the_original() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    let code = "sim = require 'sim'
        function sysCall_init() print(sim.getStringParam(sim.stringparam_app_arg1), sim.getNamedStringParam('a.b')) end
        function sysCall_cleanup() print(sim.getSimulationTime()) end";
    std::fs::write(&scene, code).expect("the folder is writable");
    let mut start = Command::new(root().join("coppeliaSim.sh"));
    start
        .args([
            "-h",
            "-s500",
            "-q",
            "-gone",
            "-Ga.b=7",
            "-c print('code')",
            "-vnone",
            "-GzmqRemoteApi.autoStart=false",
        ])
        .arg(&scene);
    let text = succeed(&mut start, Duration::from_secs(60));
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.contains("remote API"))
        .collect();
    assert_eq!(lines, ["one, 7", "code", "0.65"], "{text}");
    let (code, text) =
        run_for_code(Command::new(root().join("vrep.sh")).arg("-x"), BUILD).expect("it ends");
    assert!(code == 2 && text.contains("'-x' is no option"), "{text}");
}
