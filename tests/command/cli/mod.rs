//! The command line as its users meet it: exit codes, streams, formats.
#![allow(
    clippy::disallowed_methods,
    reason = "every wait of a test is bounded by the clock"
)]

mod branches;
mod cache;
mod commands;
mod faults_of_runs;
#[cfg(target_os = "linux")]
mod full_disk;
mod graphs;
mod hashes;
#[cfg(unix)]
mod interrupts;
mod messages;
mod old_scripts;
mod recording;
mod render;
mod resources;
mod robots;
mod video;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;
use test_support::process::output_of;

const PRINTS_TIME: &str = "sim = require 'sim'
function sysCall_actuation() print(sim.getSimulationTime()) end
function sysCall_cleanup() print('cleanup') end";

fn swanilda() -> Command {
    Command::new(env!("CARGO_BIN_EXE_swanilda"))
}

/// A ball that rises, and a vision sensor of 16 by 12 pixels that looks at it.
const BALL: &str = "sim = require 'sim'
function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.5, 0.5, 0.5})
    sim.setObjectAlias(ball, 'Ball')
    eye = sim.createVisionSensor(1 + 2 + 128, {16, 12, 0, 0}, {0.1, 10, 1, 0.01, 0, 0, 0, 1, 0, 0, 0})
    sim.setObjectAlias(eye, 'Eye')
    sim.setObjectPosition(ball, {0, 0, 2})
end
function sysCall_actuation() sim.setObjectPosition(ball, {0, 0, 2 + sim.getSimulationTime()}) end";

/// A folder with one scene in it.
struct Scene {
    folder: TempDir,
}

impl Scene {
    fn new(code: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        fs::write(folder.path().join("scene.lua"), code).expect("our own folder is writable");
        Self { folder }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("scene.lua")
    }

    fn run(&self, args: &[&str]) -> Output {
        output_of(swanilda().arg("run").arg(self.path()).args(args))
    }
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn steps_end_the_run_as_a_stop_from_outside() {
    let output = Scene::new(PRINTS_TIME).run(&["--steps", "2", "--as", "simulation", "--empty"]);
    assert_eq!(output.status.code(), Some(0));
    // A stop asked for between two passes lets three more run.
    assert_eq!(stdout(&output), "0.\n0.05\n0.1\n0.15\n0.2\ncleanup\n");
    assert!(
        stderr(&output).contains("5 steps, 0.250 s simulated"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn time_and_step_length() {
    let output = Scene::new(PRINTS_TIME).run(&[
        "--time",
        "0.04",
        "--dt",
        "0.02",
        "--as",
        "simulation",
        "--empty",
    ]);
    assert_eq!(
        stdout(&output).lines().count(),
        2 + 3 + 1,
        "{}",
        stdout(&output)
    );
    // Why that is more than was asked for.
    let said = stderr(&output);
    assert!(said.contains("three more steps run"), "{said}");
}

#[test]
fn quiet_leaves_only_what_scripts_say() {
    let scene = Scene::new(
        "sim = require 'sim' addLog(sim.verbosity_scriptwarnings, 'mine') print('hello')",
    );
    let output = scene.run(&["--steps", "1", "--quiet", "--empty"]);
    assert_eq!(stdout(&output), "hello\n");
    assert_eq!(stderr(&output).lines().count(), 1, "{}", stderr(&output));
    assert!(stderr(&output).contains("mine"));
}

#[test]
fn verbosity_hides_log_lines() {
    let scene = Scene::new("sim = require 'sim' addLog(sim.verbosity_scriptwarnings, 'mine')");
    let output = scene.run(&[
        "--steps",
        "1",
        "--verbosity",
        "errors",
        "--quiet",
        "--empty",
    ]);
    assert_eq!(stderr(&output), "");
}

#[test]
fn an_error_names_script_and_line() {
    let output = Scene::new("\n\nerror('broken')").run(&["--steps", "1", "--empty"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("[/Script:error]"),
        "{}",
        stderr(&output)
    );
    assert!(
        stderr(&output).contains("scene.lua:3: broken"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_syntax_error_names_script_and_line() {
    let output = Scene::new("x = 1\ny = = 2").run(&["--steps", "1", "--empty"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("scene.lua:2:"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_caught_error_is_none() {
    let output = Scene::new("pcall(error, 'x')").run(&["--steps", "1", "--empty"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn a_pause_nobody_ends_is_ended() {
    let scene =
        Scene::new("sim = require 'sim' function sysCall_actuation() sim.pauseSimulation() end");
    let output = scene.run(&["--empty"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(
        stderr(&output).matches("nobody resumes it").count(),
        1,
        "{}",
        stderr(&output)
    );
    let scene = Scene::new("function sysCall_actuation() error('x') end");
    let output = scene.run(&["--empty"]);
    assert_eq!(output.status.code(), Some(1));
    let log = stderr(&output);
    assert_eq!(
        log.matches("Simulation ").count(),
        2,
        "the start and, after the error, one line: {log}"
    );
    assert!(
        log.contains("Simulation stopped because of the error."),
        "{log}"
    );
}

#[test]
fn scripts_read_parameters_of_the_command_line() {
    let scene = Scene::new("sim = require 'sim' print(sim.getNamedStringParam('speed'))");
    let output = scene.run(&["-D", "speed=1=2", "--steps", "1", "--empty", "--quiet"]);
    assert_eq!(stdout(&output), "1=2\n", "{}", stderr(&output));
    assert_eq!(scene.run(&["-D", "speed"]).status.code(), Some(2));
}

#[test]
fn modules_are_found_next_to_the_scene() {
    let scene = Scene::new("print(require('neighbour').answer)");
    fs::write(
        scene.folder.path().join("neighbour.lua"),
        "return {answer = 42}",
    )
    .expect("our own folder is writable");
    let output = scene.run(&["--steps", "1", "--empty", "--quiet"]);
    assert_eq!(stdout(&output), "42\n", "{}", stderr(&output));
}

#[test]
fn a_scene_has_its_own_files_where_the_library_has_some_for_itself() {
    let scene = Scene::new(
        "sim = require 'sim' print(require 'trajectory', require 'main')
        print(sim.moveToConfig_init{pos = {0}, targetPos = {1}}.timeLeft)",
    );
    for name in ["trajectory", "main"] {
        fs::write(
            scene.folder.path().join(format!("{name}.lua")),
            "return 'mine'",
        )
        .expect("our own folder is writable");
    }
    let output = scene.run(&["--no-start", "--loops", "1", "--empty"]);
    assert_eq!(stdout(&output), "mine, mine\n0\n");
}

#[test]
fn add_ons_start_before_the_scene() {
    let scene = Scene::new("print('scene')");
    let add_on = scene.folder.path().join("extra.lua");
    fs::write(&add_on, "function sysCall_init() print('add-on') end")
        .expect("our own folder is writable");
    let add_on = add_on.to_string_lossy();
    let output = scene.run(&["--addon", &add_on, "--steps", "1", "--empty", "--quiet"]);
    assert_eq!(stdout(&output), "add-on\nscene\n", "{}", stderr(&output));
}

#[test]
fn no_start_idles_for_the_given_passes() {
    let scene = Scene::new("n = 0 function sysCall_nonSimulation() n = n + 1 print(n) end");
    let output = scene.run(&["--no-start", "--loops", "3", "--empty", "--quiet"]);
    assert_eq!(stdout(&output), "1\n2\n3\n");
}

#[test]
fn json_is_one_object_per_line() {
    let scene = Scene::new("print('\"quoted\"\\n\\255') error('broken')");
    let output = scene.run(&["--json", "--steps", "1", "--empty"]);
    let text = stdout(&output);
    let objects: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect(line))
        .collect();
    let of_type = |ty: &str| {
        objects
            .iter()
            .find(|object| object["type"] == ty)
            .expect(ty)
    };
    assert!(
        of_type("print")["text"]
            .as_str()
            .expect("a text")
            .starts_with("\"quoted\"\n")
    );
    assert_eq!(of_type("log")["origin"], "/Script");
    assert_eq!(of_type("log")["level"], "error");
    let summary = objects.last().expect("at least a summary");
    assert_eq!(summary["type"], "summary");
    assert_eq!(summary["steps"], 4);
    assert_eq!(summary["errors"], 1);
    assert_eq!(summary["exitCode"], 1);
    assert_eq!(stderr(&output), "");
}

#[test]
fn wrong_command_lines_and_files_exit_with_2() {
    let missing = output_of(swanilda().args(["run", "/nowhere/scene.lua"]));
    assert_eq!(missing.status.code(), Some(2));
    assert!(stderr(&missing).contains("/nowhere/scene.lua"));
    let scene = Scene::new("");
    for wrong in [
        &["--as", "nonsense"][..],
        &["--steps", "-1"],
        &["--time", "inf"],
        &["--dt", "0"],
        &["--dt", "nan"],
        &["--steps", "1", "--time", "1"],
        &["--addon", "/nowhere.lua"],
        &["--verbosity", "loud"],
        &["--nonsense"],
    ] {
        assert_eq!(scene.run(wrong).status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn a_port_in_use_is_refused() {
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).expect("a port is free");
    let port = taken.local_addr().expect("it has an address").port();
    let legacy = format!("--legacy-remote-api={port}");
    for option in [
        format!("--remote-api={port}"),
        legacy,
        "-DzmqRemoteApi.rpcPort=nonsense".to_owned(),
    ] {
        let refused = output_of(swanilda().args(["serve", &option]));
        assert_eq!(refused.status.code(), Some(2), "{option}");
        assert!(
            stderr(&refused).contains("port") || stderr(&refused).contains(&port.to_string()),
            "{option}"
        );
    }
}

/// At an address of this machine that no other test uses, so that the default port is free but for this one.
#[test]
#[cfg(target_os = "linux")]
fn the_next_port_is_said_to_be_another_one() {
    let address = "127.52.7.23";
    let taken = std::net::TcpListener::bind((address, 23_000)).expect("it is free there");
    let args = ["--remote-api", "--bind", address, "--time", "0", "--empty"];
    let said = stderr(&Scene::new("").run(&args));
    let is_warning = |line: &&str| line.contains("port 23000 is in use") && line.contains("23001");
    assert_eq!(said.lines().filter(is_warning).count(), 1, "{said}");
    drop(taken);
    let said = stderr(&Scene::new("").run(&args));
    assert!(!said.contains("is in use"), "{said}");
}

#[test]
fn real_time_takes_its_time() {
    let begun = Instant::now();
    let output = Scene::new("").run(&["--realtime", "--time", "0.2", "--empty"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(begun.elapsed() > Duration::from_millis(200));
}

#[test]
fn no_unsafe_takes_programs_from_scripts() {
    let tells = "sim = require 'sim'
for _, call in ipairs{function() os.execute('true') end, function() io.popen('true') end, function() package.loadlib('x', 'y') end} do
    local ok, why = pcall(call)
    print(ok, why:match('%-%-allow%-') ~= nil)
end
print(sim.getBoolParam(sim.boolparam_execunsafe), sim.getBoolProperty(sim.handle_app, 'execUnsafeExt'))
sim.quitSimulator()";
    let refused = Scene::new(tells).run(&["--no-unsafe", "--no-start", "--empty"]);
    assert_eq!(
        stdout(&refused),
        "false, true\nfalse, true\nfalse, true\nfalse, false\n"
    );
    let allowed = Scene::new("print(os.execute('true'))").run(&["--no-start", "--empty"]);
    assert_eq!(stdout(&allowed), "true, exit, 0\n");
}

#[test]
fn listening_at_other_addresses_switches_programs_off() {
    let tells = "sim = require 'sim' print(sim.getBoolParam(sim.boolparam_execunsafe), sim.getBoolParam(sim.boolparam_execunsafeext))";
    let scene = Scene::new(tells);
    for (args, expected) in [
        (&["--bind", "127.0.0.2"][..], "true, true\n"),
        (&["--bind", "0.0.0.0"], "false, false\n"),
        (&["--bind", "0.0.0.0", "--unsafe"], "true, true\n"),
    ] {
        assert_eq!(
            stdout(&scene.run(&[&["--no-start", "--empty", "--loops", "1"], args].concat())),
            expected,
            "{args:?}"
        );
    }
    for restricted in [
        "--no-unsafe",
        "--deny-all",
        "--allow-read",
        "--allow-write=x",
        "--allow-run",
        "--allow-net=x:1",
    ] {
        assert_eq!(
            scene.run(&["--unsafe", restricted]).status.code(),
            Some(2),
            "{restricted}"
        );
    }
}

/// Each option restricts scripts to the scene's folder and to what it allows.
#[test]
fn permissions_of_the_command_line() {
    let scene = Scene::new(
        "sim = require 'sim'
local own = sim.getStringProperty(sim.handle_scene, 'scenePath')
local outside = package.config:sub(1, 1) == '/' and '/etc/hosts' or 'C:/Windows/win.ini'
local function open(...) return io.open(...) ~= nil end
print(open(own), open(outside), open(own .. '.new', 'w'), (pcall(os.execute, 'exit 0')))",
    );
    for (args, expected) in [
        (&[][..], "true, true, true, true"),
        (&["--no-unsafe"], "true, false, false, false"),
        (&["--bind", "0.0.0.0"], "true, false, false, false"),
        (
            &["--bind", "0.0.0.0", "--allow-run"],
            "true, false, false, true",
        ),
        (&["--deny-all"], "false, false, false, false"),
        (&["--deny-all", "--allow-run"], "false, false, false, true"),
        (&["--allow-read"], "true, true, false, false"),
        (
            &["--allow-read=/etc", "--allow-read=C:/Windows"],
            "true, true, false, false",
        ),
        (&["--allow-write"], "true, false, true, false"),
        (&["--allow-net=127.0.0.1:80"], "true, false, false, false"),
        (&["--unsafe"], "true, true, true, true"),
    ] {
        let output = scene.run(&[&["--no-start", "--empty", "--loops", "1"], args].concat());
        assert_eq!(stdout(&output).lines().next(), Some(expected), "{args:?}");
    }
    for wrong in [
        "--allow-net=host:port",
        "--allow-net=:1",
        "--allow-net=",
        "--allow-read=",
        "--allow-write=",
        "--allow-run=ls",
    ] {
        assert_eq!(scene.run(&[wrong]).status.code(), Some(2), "{wrong}");
    }
}

#[test]
fn compat_brings_old_code_up_to_date() {
    let old = "function sysCall_threadmain()
        while simGetSimulationState()~=sim_simulation_advancing_abouttostop do
            simSetThreadAutomaticSwitch(false) print('step') simSwitchThread()
        end
    end";
    let args = ["--steps", "2", "--as", "simulation", "--empty"];
    let output = Scene::new(old).run(&[&args[..], &["--compat"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).lines().count() >= 2, "{}", stdout(&output));
    assert_eq!(
        stdout(&Scene::new(old).run(&args)),
        "",
        "nobody calls sysCall_threadmain today"
    );
}

#[test]
fn texts_that_ask_for_the_call_are_called_by_number() {
    let old = "if sim_call_type==sim.syscb_init then count=0 end
        if sim_call_type==sim.syscb_actuation then count=count+1 end
        if sim_call_type==sim.syscb_cleanup then print(count) end";
    let output = Scene::new(old).run(&["--steps", "2", "--as", "simulation", "--empty"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stdout(&output), "5\n");
    assert!(
        stderr(&output).contains("compatibility mode"),
        "{}",
        stderr(&output)
    );
}
