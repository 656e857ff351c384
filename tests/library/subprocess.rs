//! Programs that scripts start: what comes out of them, and that nothing of them is left.
#![cfg(unix)]

use std::path::Path;
use std::process::Command;
use std::sync::atomic::Ordering;

use swanilda::scene::Data;
use swanilda::{Options, Permissions, ScriptKind, ScriptRef, Simulator};
use test_support::process::{run_bounded, wait_until};

/// A script that does what it is told.
const SCRIPT: &[u8] = b"
    sim = require 'sim'
    simSubprocess = require 'simSubprocess'
    function run(code) return load(code)() end";

struct Bench {
    sim: Simulator,
    script: ScriptRef,
}

impl Bench {
    fn new() -> Self {
        Self::with(Options::default())
    }

    fn with(options: Options) -> Self {
        let mut sim = Simulator::new(options);
        let script = sim
            .add_script(ScriptKind::Customization, "script", SCRIPT)
            .expect("the script loads");
        Self { sim, script }
    }

    fn run(&mut self, code: &str) -> Vec<Data> {
        let results = self.sim.call(&self.script, "run", &[Data::text(code)]);
        results.unwrap_or_else(|error| panic!("{code}: {error}"))
    }

    /// The error `code` raises.
    fn error(&mut self, code: &str) -> String {
        let results = self.run(&format!(
            "local ok, why = pcall(function() {code} end) return ok, tostring(why)"
        ));
        match &results[..] {
            [Data::Bool(false), Data::Text(text)] => String::from_utf8_lossy(text).into_owned(),
            other => panic!("{code} does not fail: {other:?}"),
        }
    }

    fn pid(&mut self, handle: &str) -> i64 {
        let pid = self.run(&format!("return simSubprocess.getpid({handle})"));
        let [Data::Int(pid)] = pid[..] else {
            panic!("{pid:?}")
        };
        pid
    }
}

fn bytes(text: &[u8]) -> Data {
    Data::Buffer(text.to_vec())
}

#[test]
fn exec_gives_exit_code_and_outputs() {
    let mut bench = Bench::new();
    let results =
        bench.run("return simSubprocess.exec('sh', {'-c', 'cat; echo -n no >&2; exit 3'}, 'in')");
    assert_eq!(results, [Data::Int(3), bytes(b"in"), bytes(b"no")]);
    let results =
        bench.run("return simSubprocess.exec('echo', {'a b', '\"c\"', 1}, tobuffer('unread'))");
    assert_eq!(results, [Data::Int(0), bytes(b"a b \"c\" 1\n"), bytes(b"")]);
    let results = bench.run("return simSubprocess.exec('pwd', {}, '', {workingDir = '/usr'})");
    assert_eq!(results[1], bytes(b"/usr\n"));
    let results =
        bench.run("return simSubprocess.exec('/bin/sh', {'-c', ':'}, '', {useSearchPath = false})");
    assert_eq!(results[0], Data::Int(0));
}

#[test]
fn much_goes_both_ways_at_once() {
    let mut bench = Bench::new();
    let results = bench.run(
        "local text = ('0123456789abcdef'):rep(1 << 18)
        local code, out, err = simSubprocess.exec('sh', {'-c', 'tee /dev/stderr'}, text)
        return code, tostring(out) == text, tostring(err) == text",
    );
    assert_eq!(results, [Data::Int(0), Data::Bool(true), Data::Bool(true)]);
    // A program that reads nothing does not hold up the one that writes.
    let results = bench.run("return simSubprocess.exec('true', {}, ('x'):rep(1 << 22))");
    assert_eq!(results[0], Data::Int(0));
}

#[test]
fn what_cannot_run() {
    let mut bench = Bench::new();
    for (code, reason) in [
        ("exec('no-such-program', {})", "waitForStarted timed out"),
        (
            "exec('sh', {}, '', {useSearchPath = false})",
            "waitForStarted timed out",
        ),
        (
            "exec('sh', {}, '', {workingDir = '/no/such/folder'})",
            "waitForStarted timed out",
        ),
        ("exec('a\\0b', {})", "waitForStarted timed out"),
        (
            "execAsync('no-such-program', {})",
            "waitForStarted timed out",
        ),
        ("exec('sh', {'-c', 'kill -9 $$'})", "the process crashed"),
        ("exec('cat', {'/dev/zero'})", "256 MiB"),
        ("exec('sh', {{}})", "a string is needed"),
        ("exec('sh', {a = 1})", "a list of strings"),
        ("exec('sh')", "arguments"),
        ("exec('sh', 'x')", "table"),
        ("isRunning('x')", "invalid object handle"),
        ("wait('x')", "invalid object handle"),
        ("kill('')", "invalid object handle"),
        ("getpid('1:simSubprocess.child')", "invalid object handle"),
    ] {
        let error = bench.error(&format!("simSubprocess.{code}"));
        assert!(error.contains(reason), "{code}: {error}");
    }
    let error = bench.error("sim.launchExecutable('no-such-program')");
    assert!(error.contains("cannot launch no-such-program"), "{error}");
}

#[test]
fn programs_that_run_on() {
    let mut bench = Bench::new();
    bench.run("h = simSubprocess.execAsync('sleep', {'60'})");
    assert_eq!(
        bench.run("return h:match('^%x+:simSubprocess%.child$') == h"),
        [Data::Bool(true)]
    );
    assert!(is_running(bench.pid("h")));
    assert_eq!(
        bench.run("return simSubprocess.isRunning(h)"),
        [Data::Bool(true)]
    );
    assert_eq!(bench.run("return simSubprocess.wait(h, 0.01)"), [Data::Nil]);
    let pid = bench.pid("h");
    assert_eq!(bench.run("return simSubprocess.kill(h)"), [Data::Nil]);
    assert!(!is_running(pid), "killed and reaped");
    assert!(
        bench
            .error("simSubprocess.isRunning(h)")
            .contains("invalid object handle")
    );

    bench.run("h = simSubprocess.execAsync('sh', {'-c', 'exit 7'})");
    assert_eq!(bench.run("return simSubprocess.wait(h)"), [Data::Int(7)]);
    assert_eq!(
        bench.run("return simSubprocess.wait(h, 0/0), simSubprocess.isRunning(h)"),
        [7.into(), Data::Bool(false)]
    );
    bench.run("h = simSubprocess.execAsync('sh', {'-c', 'kill -9 $$'})");
    assert!(
        bench
            .error("simSubprocess.wait(h, -1)")
            .contains("the process crashed")
    );
}

#[test]
fn programs_end_with_their_script() {
    let mut bench = Bench::new();
    bench.run("hs = {} for i = 1, 5 do hs[i] = simSubprocess.execAsync('sleep', {'60'}) end");
    let pids: Vec<i64> = (1..=5).map(|i| bench.pid(&format!("hs[{i}]"))).collect();
    bench.sim.clear_scene();
    assert!(pids.iter().all(|&pid| !is_running(pid)));
}

#[test]
fn a_launched_program_goes_on_by_itself() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let (started, go, done) = (
        folder.path().join("started"),
        folder.path().join("go"),
        folder.path().join("done it"),
    );
    let script = folder.path().join("launched.sh");
    let code =
        "#!/bin/sh\ntouch \"$1\"\nwhile [ ! -e \"$2\" ]; do sleep 0.01; done\ntouch \"$3\"\n";
    std::fs::write(&script, code).expect("our own folder is writable");
    let parameters = format!(
        "{} {} {} \"{}\"",
        script.display(),
        started.display(),
        go.display(),
        done.display()
    );
    bench.run(&format!("sim.launchExecutable('sh', [[{parameters}]])"));
    wait_until("the program has started", || started.exists());
    drop(bench);
    std::fs::write(&go, "").expect("our own folder is writable");
    wait_until("the program has gone on", || done.exists());
}

#[test]
fn a_stop_ends_a_program_that_does_not() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let file = folder.path().join("pid");
    let options = Options::default();
    let stop = options.stop.clone();
    let mut bench = Bench::with(options);
    let started = file.clone();
    let thread = std::thread::spawn(move || {
        wait_until("the program has started", || pid_in(&started).is_some());
        stop.store(true, Ordering::Relaxed);
    });
    let code = format!(
        "simSubprocess.exec('sh', {{'-c', 'echo $$ > {}; exec sleep 1000'}})",
        file.display()
    );
    let error = bench.error(&code);
    assert!(error.contains("interrupted"), "{error}");
    thread.join().expect("the other thread ends");
    assert!(
        !is_running(pid_in(&file).expect("it was started")),
        "it was killed and reaped"
    );
}

/// The number in the first line of a file, once the line is complete.
fn pid_in(file: &Path) -> Option<i64> {
    std::fs::read_to_string(file)
        .ok()?
        .strip_suffix('\n')?
        .parse()
        .ok()
}

/// Neither open files nor children, zombies included, of a process of its own, which counts them where the system tells.
#[test]
fn nothing_is_left() {
    let code = "
        local lfs, socket, simSubprocess = require 'lfs', require 'socket', require 'simSubprocess'
        local function names(folder)
            local all = {}
            for name in lfs.dir(folder) do all[#all + 1] = name end
            return all
        end
        local function children()
            local count = 0
            for _, task in ipairs(lfs.attributes('/proc/self/task') and names('/proc/self/task') or {}) do
                local file = io.open('/proc/self/task/' .. task .. '/children')
                for _ in (file and file:read('a') or ''):gmatch('%S+') do count = count + 1 end
                if file then file:close() end
            end
            return count
        end
        local function some()
            simSubprocess.exec('sh', {'-c', 'cat'}, ('x'):rep(1000))
            pcall(simSubprocess.exec, 'no-such-program', {})
            pcall(simSubprocess.exec, 'sh', {'-c', 'kill -9 $$'})
            simSubprocess.kill(simSubprocess.execAsync('sleep', {'60'}))
        end
        some()
        -- The pipes of the first programs may still be closing while they are counted: fewer later is no fault.
        local open = #names('/dev/fd')
        for _ = 1, 20 do some() end
        for _ = 1, 2000 do
            if #names('/dev/fd') <= open then break end
            socket.sleep(0.005)
        end
        print(math.max(#names('/dev/fd') - open, 0), children())";
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let scene = folder.path().join("scene.lua");
    std::fs::write(&scene, code).expect("our own folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(&scene).args([
        "--as",
        "sandbox",
        "--empty",
        "--no-start",
        "--loops",
        "1",
        "--quiet",
    ]);
    assert_eq!(run_bounded(&mut command).as_deref(), Ok("0, 0\n"));
}

#[test]
fn no_programs_without_permission() {
    let mut bench = Bench::with(Options {
        permissions: Permissions::strict(),
        ..Options::default()
    });
    for code in [
        "simSubprocess.exec('true', {})",
        "simSubprocess.execAsync('true', {})",
        "sim.launchExecutable('true')",
    ] {
        let error = bench.error(code);
        assert!(error.contains("--allow-run"), "{code}: {error}");
    }
}

/// Whether there is a process of that number, if only as a zombie.
fn is_running(pid: i64) -> bool {
    Command::new("kill")
        .args(["-0", &pid.to_string()])
        .output()
        .expect("kill starts")
        .status
        .success()
}
