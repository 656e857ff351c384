//! Subcommands that run no scene.

use std::fs;

use serde_json::Value;
use test_support::process::output_of;

use super::{Scene, stderr, stdout, swanilda};

#[test]
fn api_prints_the_reference() {
    let run = |args: &[&str]| output_of(swanilda().arg("api").args(args));
    let output = run(&["getSimulationTime"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(
        stdout(&output).contains("float time = sim.getSimulationTime()"),
        "{}",
        stdout(&output)
    );
    assert!(stdout(&run(&[])).contains("sim.getSimulationTime"));
    let near = run(&["sim.getSimulationTim"]);
    assert_eq!(near.status.code(), Some(2));
    assert!(
        stderr(&near).contains("did you mean sim.getSimulationTime"),
        "{}",
        stderr(&near)
    );
    let send = stdout(&run(&["simZMQ.send"]));
    assert!(
        send.contains("int result = simZMQ.send(string socket, buffer data, int flags)"),
        "{send}"
    );
    assert!(
        stdout(&run(&["simWS.start"]))
            .contains("string serverHandle = simWS.start(int listenPort)")
    );
    let module = stdout(&run(&["simWS"]));
    assert!(
        module.starts_with("WebSocket servers and clients.\n\n"),
        "{module}"
    );
    assert!(
        module.contains("simWS.connect") && !module.contains("sim.getObject"),
        "{module}"
    );
}

#[test]
fn doctor_tells_what_works() {
    let scene = Scene::new(
        "sim = require 'sim'\nsim.getObject('/a') -- sim.nothing()\nsim.frobnicate()\nsimGetSimulationTime()",
    );
    let doctor = |args: &[&str]| output_of(swanilda().arg("doctor").args(args));
    let folder = scene.folder.path().display().to_string();
    let output = doctor(&[&folder]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stdout(&output).contains("missing      sim.frobnicate: line 3\n"),
        "{}",
        stdout(&output)
    );
    assert!(
        stdout(&output)
            .ends_with("1 scripts call 3 functions: 2 work, 0 are approximated, 1 are missing.\n")
    );
    let json: Value = serde_json::from_slice(&doctor(&[&folder, "--json"]).stdout).expect("JSON");
    assert_eq!(json["summary"]["missing"], 1);
    assert_eq!(
        json["scripts"][0]["uses"][2]["written"],
        "simGetSimulationTime"
    );
    let fine = Scene::new("sim.getObject('/a')");
    assert_eq!(
        doctor(&[&fine.path().display().to_string()]).status.code(),
        Some(0)
    );
    assert_eq!(doctor(&["no such file"]).status.code(), Some(2));
}

#[test]
fn init_does_not_overwrite() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let run = |args: &[&str]| {
        swanilda()
            .arg("init")
            .args(args)
            .current_dir(folder.path())
            .status()
            .expect("the command starts")
            .code()
    };
    assert_eq!(run(&[]), Some(0));
    let settings = fs::read_to_string(folder.path().join(".luarc.json")).expect("it was written");
    let settings: Value = serde_json::from_str(&settings).expect("it is JSON");
    let library = settings["workspace.library"][0].as_str().expect("a folder");
    assert!(folder.path().join(library).join("sim.lua").exists());
    assert!(
        settings["diagnostics.globals"]
            .as_array()
            .is_some_and(|names| names.contains(&"simZMQ".into()))
    );
    assert!(
        settings["diagnostics.disable"]
            .as_array()
            .is_some_and(|names| names.contains(&"lowercase-global".into()))
    );
    assert_eq!(run(&[]), Some(2));
    assert_eq!(run(&["--force"]), Some(0));
}

#[test]
fn completions_and_version() {
    let completions = output_of(swanilda().args(["completions", "bash"]));
    assert!(stdout(&completions).contains("swanilda"));
    let version = output_of(swanilda().arg("--version"));
    assert_eq!(
        stdout(&version),
        format!("swanilda {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
#[cfg(unix)]
fn endless_files_are_refused() {
    for command in ["run", "doctor", "inspect"] {
        let output = output_of(swanilda().args([command, "/dev/zero"]));
        assert_eq!(output.status.code(), Some(2), "{command}");
        assert!(
            stderr(&output)
                .contains("cannot read /dev/zero: this device or pipe has more than 64 MiB"),
            "{command}"
        );
    }
    let scene = Scene::new(
        "sim = require 'sim'
        print(pcall(sim.loadModel, '/dev/zero'))
        print(pcall(sim.loadScene, '/dev/zero'))
        print(pcall(sim.loadImage, 0, '/dev/zero'))
        print(pcall(sim.createPath, {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}, 0, 1 << 30))",
    );
    let output = scene.run(&["--no-start"]);
    let printed = stdout(&output);
    assert_eq!(printed.lines().count(), 4, "{printed}");
    assert!(
        printed.lines().all(|line| line.starts_with("false, ")),
        "{printed}"
    );
    assert_eq!(printed.matches("more than 64 MiB").count(), 3, "{printed}");
    assert!(printed.contains("100000 at most"), "{printed}");
}

#[test]
fn the_first_lines_of_the_page_about_tests_run() {
    let page = include_str!("../../../docs/TESTING.md");
    let code = page
        .split("```lua\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .expect("the page begins with code");
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let file = folder.path().join("falling_test.lua");
    fs::write(&file, code).expect("our own folder is writable");
    let output = output_of(swanilda().arg("test").arg(&file));
    assert!(stdout(&output).contains("1 passed"), "{}", stdout(&output));
}

#[test]
fn memory_of_lua_code_has_a_limit_on_request() {
    let scene = Scene::new("print(pcall(function() return #('x'):rep(1 << 27) end))");
    let run = |limit| stdout(&scene.run(&["--empty", "--steps", "1", "--memory", limit]));
    assert!(run("64").contains("false, not enough memory"));
    assert!(run("1024").contains("true, 134217728"));
}
