//! `--capture` and `swanilda replay`: the same run again, without the world outside.

#[cfg(unix)]
mod clients;
mod moments;
mod scenes;
mod tests;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;
use test_support::process::{output_of, wait_until};

/// A scene in a folder of its own, and captures of it elsewhere.
struct Bench {
    scene: TempDir,
    captures: TempDir,
}

impl Bench {
    fn new(files: &[(&str, &str)]) -> Self {
        let bench = Self {
            scene: tempfile::tempdir().expect("a temporary folder can be made"),
            captures: tempfile::tempdir().expect("a temporary folder can be made"),
        };
        for (name, text) in files {
            fs::write(bench.scene.path().join(name), text).expect("our own folder is writable");
        }
        bench
    }

    fn capture(&self) -> PathBuf {
        self.captures.path().join("run.swc")
    }

    /// `swanilda` in the folder of the scene.
    fn swanilda(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command.current_dir(self.scene.path()).args(args);
        command
    }

    /// Captures a run of the scene.
    fn run(&self, args: &[&str]) -> Output {
        let mut command = self.swanilda(args);
        output_of(command.arg("--capture").arg(self.capture()))
    }

    /// The scene is gone, and with it the folder: what is left is the capture.
    fn without_scene(self) -> TempDir {
        self.scene.close().expect("our own folder can be removed");
        self.captures
    }
}

/// Replays a capture from another folder, in another time zone and language, for another user.
fn replay(capture: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("replay")
        .arg(capture)
        .args(args)
        .current_dir("/")
        .env_clear()
        .envs([
            ("TZ", "Asia/Tokyo"),
            ("LC_ALL", "de_DE.UTF-8"),
            ("HOME", "/nowhere"),
        ]);
    output_of(&mut command)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The outcome and the step of a replay.
fn outcome(capture: &Path) -> (String, u64, String) {
    let output = replay(capture, &["--json"]);
    let lines = text(&output.stdout);
    let last: Value = serde_json::from_str(lines.lines().last().unwrap_or_default())
        .unwrap_or_else(|_| panic!("{lines}\n{}", text(&output.stderr)));
    let word = |name: &str| last[name].as_str().unwrap_or_default().to_owned();
    let step = last["step"].as_u64().unwrap_or_default();
    assert_eq!(
        output.status.code(),
        Some(i32::from(word("outcome") == "differs")),
        "{lines}"
    );
    (word("outcome"), step, word("text"))
}

const ASKS_FOR_EVERYTHING: &str = r"
sim = require 'sim'
local part = require 'part'
function sysCall_init()
    print(os.time(), os.date '%c', os.clock(), os.tmpname(), os.getenv 'SECRET', os.getenv 'NOTHING')
    print(sim.getSystemTime(), sim.getStringParam(sim.stringparam_scene_path_and_name))
    local file = assert(io.open 'data.txt')
    print(file:read 'l', file:seek(), file:read 'a')
    file:close()
    for line in io.lines 'data.txt' do print(line) end
    print(io.open 'nothing.txt')
    print(pcall(io.lines, 'nothing.txt'))
    print(pcall(os.getenv))
    local program = io.popen 'echo hello; exit 3'
    print(program:read 'a', program:close())
    print(os.execute 'exit 4')
    print(part.secret, (pcall(require, 'nothing')))
    local output = io.open('out.txt', 'w')
    output:write 'written'
    output:close()
    print(io.open 'out.txt':read 'a', os.remove 'out.txt', os.remove 'out.txt')
    print(loadfile 'nothing.lua', pcall(loadfile 'bad.lua' or error))
    print(pcall(sim.loadModel, 'nothing.ttm'))
    print(io.read())
    lfs = require 'lfs'
    print(lfs.attributes('data.txt', 'modification'), lfs.currentdir())
    sim.writeCustomDataBlock(sim.handle_appstorage, 'count', 'x' .. os.time())
    print(sim.readCustomDataBlock(sim.handle_appstorage, 'count'))
end
function sysCall_actuation() print(sim.getSimulationTime(), sim.getSystemTime()) end
function sysCall_cleanup() print('end', os.time()) end
";

#[test]
fn a_replay_asks_nobody() {
    let bench = Bench::new(&[
        ("scene.lua", ASKS_FOR_EVERYTHING),
        ("part.lua", "return {secret = os.getenv 'SECRET'}"),
        ("data.txt", "one\ntwo\n"),
        ("bad.lua", "#!/usr/bin/lua\nreturn ="),
        ("in.txt", "from standard input\n"),
    ]);
    let input = fs::File::open(bench.scene.path().join("in.txt")).expect("it is there");
    let mut command = bench.swanilda(&["run", "scene.lua", "--steps", "3", "--data-dir", "data"]);
    command.arg("--capture").arg(bench.capture());
    let command = command.env("SECRET", "sesame").stdin(Stdio::from(input));
    let first = command.output().expect("the program starts");
    let printed = text(&first.stdout);
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    assert!(printed.contains("sesame") && printed.contains("from standard input"));
    let (capture, folder) = (bench.capture(), bench.without_scene());
    let again = replay(&capture, &[]);
    assert_eq!(text(&again.stdout), printed, "{}", text(&again.stderr));
    assert_eq!(again.status.code(), Some(0));
    let said = text(&again.stderr);
    assert!(
        said.ends_with("6 steps as in the capture, to the end\n"),
        "{said}"
    );
    drop(folder);
}

#[test]
fn a_capture_changes_nothing_that_scripts_see() {
    let code = "sim = require 'sim'
        print(pcall(io.lines, 'nothing.txt'))
        print(pcall(os.getenv), select('#', os.getenv 'NOTHING'))
        print(pcall(os.time, {}))
        print(pcall(loadfile, 'nothing.lua'))
        print(select('#', os.remove 'nothing.txt'), io.open 'nothing.txt')
        print(pcall(require, 'nothing'))
        print(io.popen('exit 3'):close())
        local file = io.popen('cat > written.txt', 'w')
        print(file:write 'x' == file, file:close())
        print(io.type(file), io.open 'written.txt':read 'a', pcall(file.read, file))
        print(pcall(io.open, 'a', 'bad'))";
    let bench = Bench::new(&[("scene.lua", code)]);
    let plain = output_of(&mut bench.swanilda(&["run", "scene.lua", "--steps", "1"]));
    let captured = bench.run(&["run", "scene.lua", "--steps", "1"]);
    assert_eq!(text(&captured.stdout), text(&plain.stdout));
    assert_eq!(outcome(&bench.capture()).0, "same");
}

#[test]
fn with_permissions_of_its_own_a_replay_asks_nobody_either() {
    let code = "print((pcall(io.open, 'data.txt'))) print(io.open '/etc/hostname') print(os.getenv 'HOME')
        print(pcall(os.execute, 'true')) print(pcall(require, 'nothing')) print(io.open 'data.txt':read 'a')";
    let bench = Bench::new(&[("scene.lua", code), ("data.txt", "text")]);
    let first = bench.run(&["run", "scene.lua", "--steps", "1", "--no-unsafe"]);
    assert!(
        text(&first.stdout).contains("text"),
        "{}",
        text(&first.stdout)
    );
    let capture = bench.capture();
    let _folder = bench.without_scene();
    let (word, _, said) = outcome(&capture);
    assert_eq!(word, "same", "{said}");
}

#[test]
fn the_first_difference_is_named() {
    let bench = Bench::new(&[(
        "scene.lua",
        "function sysCall_actuation() sim.getSystemTime() end sim = require 'sim'",
    )]);
    bench.run(&["run", "scene.lua", "--steps", "5"]);
    // A capture whose script asks for something else than the one that ran.
    let bytes = fs::read(bench.capture()).expect("it was captured");
    assert_eq!(outcome(&bench.capture()).0, "same");
    fs::write(bench.capture(), &bytes[..bytes.len() - 3]).expect("our own folder is writable");
    let (word, _, said) = outcome(&bench.capture());
    assert_eq!(word, "cut", "{said}");
    fs::write(bench.capture(), "no capture").expect("our own folder is writable");
    let output = replay(&bench.capture(), &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("it is no capture"));
}

/// A simulator that is killed leaves its capture up to shortly before.
#[test]
#[cfg(unix)]
fn what_was_captured_survives_a_kill() {
    let bench = Bench::new(&[(
        "scene.lua",
        "sim = require 'sim' function sysCall_actuation() print(sim.getSystemTime()) end",
    )]);
    let mut command = bench.swanilda(&["run", "scene.lua", "--realtime"]);
    command.arg("--capture").arg(bench.capture());
    let mut child = command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let size = || fs::metadata(bench.capture()).map_or(0, |data| data.len());
    wait_until("the capture grows", || size() > 2000);
    child.kill().expect("it runs");
    child.wait().expect("it was killed");
    let (word, steps, said) = outcome(&bench.capture());
    assert_eq!(word, "cut", "{said}");
    assert!(steps > 2, "{said}");
}

/// A request to end the program happens at the same step again.
#[test]
#[cfg(unix)]
fn an_interrupt_is_part_of_the_run() {
    let bench = Bench::new(&[(
        "scene.lua",
        "sim = require 'sim' function sysCall_cleanup() print('over', sim.getSimulationTime()) end
        function sysCall_actuation() print(sim.getSimulationTime()) io.stdout:flush() end",
    )]);
    let mut command = bench.swanilda(&["run", "scene.lua", "--realtime"]);
    command.arg("--capture").arg(bench.capture());
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let size = || fs::metadata(bench.capture()).map_or(0, |data| data.len());
    wait_until("the capture grows", || size() > 2000);
    let id = child.id().to_string();
    let told = Command::new("kill")
        .args([OsStr::new("-INT"), id.as_ref()])
        .status();
    assert!(told.expect("there is a kill").success());
    let first = child.wait_with_output().expect("it ends");
    assert_eq!(first.status.code(), Some(130));
    let again = replay(&bench.capture(), &[]);
    assert_eq!(
        text(&again.stdout),
        text(&first.stdout),
        "{}",
        text(&again.stderr)
    );
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    assert!(text(&first.stdout).contains("over"));
}
