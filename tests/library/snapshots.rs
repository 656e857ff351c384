//! A simulator that is brought back goes on with the same bytes as the first time.

use std::backtrace::Backtrace;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::rc::Rc;
use std::sync::atomic::{AtomicUsize, Ordering};

use geometry::pose::pose_to_array;
use swanilda::{Console, LogLine, Options, ScriptKind, Simulator};
use test_support::parallel;

use super::determinism::{on_a_large_stack, scenes};

/// Steps before the first snapshot, between snapshots, and after the last one.
const STEPS: u64 = 12;

/// Blocks that were freed on the other side of the border of a heap: each is shown with the way to it.
static CROSSINGS: AtomicUsize = AtomicUsize::new(0);

/// Keeps all lines, with the bits of all poses after each step.
#[derive(Clone, Default)]
struct Transcript(Rc<RefCell<String>>);

impl Console for Transcript {
    fn print(&mut self, line: &[u8], _: f64) {
        *self.0.borrow_mut() += &format!("{}\n", String::from_utf8_lossy(line));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        *self.0.borrow_mut() += &format!("{}\n", line.decorated());
    }
}

impl Transcript {
    /// What follows while the simulator takes steps.
    fn of_steps(&self, sim: &mut Simulator, steps: u64) -> String {
        self.0.borrow_mut().clear();
        for _ in 0..steps {
            sim.iterate();
            let scene = sim.scene();
            for object in scene.objects() {
                let pose = scene.world_pose(object.handle()).expect("it is there");
                let bits = pose_to_array(&pose).map(f64::to_bits);
                *self.0.borrow_mut() += &format!("{} {bits:x?}\n", object.handle().raw());
            }
        }
        self.0.take()
    }
}

fn simulator_of(scene: &Path) -> (Simulator, Transcript) {
    let transcript = Transcript::default();
    let options = Options {
        package_dirs: vec![scene.parent().expect("scenes lie in a folder").to_owned()],
        ..Options::default()
    };
    let mut sim = Simulator::with_console(options, Box::new(transcript.clone()));
    sim.open(scene, ScriptKind::Customization)
        .expect("the scene loads");
    (sim, transcript)
}

/// Set in the process in which only [`every_scene_goes_on_as_the_first_time`] runs.
const ALONE: &str = "SWANILDA_TEST_ALONE";

/// Each future of a scene is the same, from the start and from the middle of the run, in whatever order they are brought back.
///
/// In a process of its own: what is freed beyond the border of a heap is counted for all threads of a process.
#[test]
#[expect(
    clippy::disallowed_methods,
    reason = "the variable is set by this test, for itself"
)]
fn every_scene_goes_on_as_the_first_time() {
    if std::env::var_os(ALONE).is_some() {
        parallel::map(&scenes(), |scene| on_a_large_stack(futures, scene.clone()));
        return;
    }
    let name = "snapshots::every_scene_goes_on_as_the_first_time";
    let ran = Command::new(std::env::current_exe().expect("this program is a file"))
        .args(["--exact", name, "--nocapture"])
        .env(ALONE, "")
        .output()
        .expect("this program starts");
    let output = [ran.stdout, ran.stderr].concat();
    let output = String::from_utf8_lossy(&output);
    assert!(ran.status.success(), "{output}");
    assert!(output.contains("1 passed"), "{name} is no test: {output}");
}

fn futures(scene: PathBuf) {
    heap::on_crossing(|crossing, size| {
        CROSSINGS.fetch_add(1, Ordering::Relaxed);
        eprintln!("{crossing:?}: {size} bytes\n{}", Backtrace::force_capture());
    });
    let (mut sim, transcript) = simulator_of(&scene);
    let stopped = sim.snapshot().expect("nothing is open");
    sim.start();
    let mut moments = vec![stopped];
    let mut texts = Vec::new();
    for _ in 0..4 {
        texts.push(transcript.of_steps(&mut sim, STEPS));
        moments.push(sim.snapshot().expect("nothing is open"));
    }
    texts.push(transcript.of_steps(&mut sim, STEPS));
    for at in [2, 4, 1, 3, 1, 2] {
        sim.restore(&moments[at]).expect("nothing is open");
        assert_same(&texts[at], &transcript.of_steps(&mut sim, STEPS), &scene);
    }
    sim.restore(&moments[0]).expect("nothing is open");
    sim.start();
    for text in &texts {
        assert_same(text, &transcript.of_steps(&mut sim, STEPS), &scene);
    }
    sim.stop();
    drop(sim);
    let crossings = CROSSINGS.load(Ordering::Relaxed);
    assert_eq!(crossings, 0, "blocks are freed beyond the border of a heap");
}

fn assert_same(first: &str, second: &str, scene: &Path) {
    let difference = first.lines().zip(second.lines()).find(|(a, b)| a != b);
    assert!(
        first == second,
        "{}: the second future is another, first at {difference:?}",
        scene.display()
    );
}

/// Opens something when it starts, and closes what `close` says.
fn refusal(open: &str, close: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("notes.txt");
    std::fs::write(&path, "one\ntwo\n").expect("our own folder is writable");
    let mut sim = Simulator::new(Options::default());
    let code = format!(
        "path = '{}'\nfunction open() {open} end\nfunction close() {close} end",
        path.display()
    );
    let script = sim
        .add_script(ScriptKind::Customization, "", code.as_bytes())
        .expect("the script loads");
    let before = sim.snapshot().expect("nothing is open");
    sim.call(&script, "open", &[]).expect("it opens");
    let refused = sim.snapshot().map(drop).expect_err("something is open");
    assert_eq!(sim.restore(&before), Err(refused.clone()));
    sim.call(&script, "close", &[]).expect("it closes");
    sim.snapshot().expect("nothing is open any more");
    sim.restore(&before).expect("nothing is open any more");
    sim.call(&script, "open", &[]).expect("it opens");
    drop(sim);
    refused
        .to_string()
        .replace(&path.display().to_string(), "PATH")
}

/// Files of scripts are no memory: a snapshot names those that are open.
#[test]
fn files_that_are_open_are_named() {
    let file = "a snapshot does not reach the file PATH: close it first.";
    let cases = [
        ("f = io.open(path)", "f:close()", file),
        ("f = io.open(path, 'a+b')", "io.close(f)", file),
        ("io.open(path)", "collectgarbage()", file),
        ("io.output(path)", "io.close() io.output(io.stdout)", file),
        (
            "io.input(path)",
            "io.input():close() io.input(io.stdin)",
            file,
        ),
        ("lines = io.lines(path) lines()", "lines() lines()", file),
        (
            "f = io.tmpfile()",
            "f:close()",
            "a snapshot does not reach a temporary file: close it first.",
        ),
        (
            "f = io.popen('cat', 'w')",
            "f:close()",
            "a snapshot does not reach the program cat: close it first.",
        ),
        (
            "f, g = io.open(path), io.tmpfile()",
            "f:close() g:close()",
            "a snapshot does not reach the file PATH, a temporary file: close it first.",
        ),
    ];
    for (open, close, expected) in cases {
        assert_eq!(refusal(open, close), expected, "{open}");
    }
}

/// Files that a script has closed, or could not open, are nobody's business, nor are those that Lua opens itself.
#[test]
fn files_that_are_closed_are_not_named() {
    let mut sim = Simulator::new(Options::default());
    let code = b"local path = os.tmpname()
        for i = 1, 3 do
            local f <close> = assert(io.open(path, 'w'))
            f:write(i)
        end
        for line in io.lines(path) do assert(line == '3') end
        local p = io.popen('echo x') assert(p:read('a') == 'x\\n') p:close()
        assert(not io.open('/nowhere/at/all') and not pcall(io.lines, '/nowhere/at/all'))
        assert(not loadfile('/nowhere/at/all') and loadfile(path) == nil)
        os.remove(path)";
    sim.add_script(ScriptKind::Sandbox, "files", code)
        .expect("the script runs");
    assert_eq!(sim.errors(), 0);
    sim.snapshot().expect("nothing is open");
}

/// What programs hold of a simulator is counted in their memory, which no restore brings back.
#[test]
fn callers_come_and_go_between_restores() {
    let mut sim = Simulator::new(Options::default());
    let script = sim
        .add_script(ScriptKind::Customization, "", b"sim = require 'sim'")
        .expect("the script loads");
    let before = sim.snapshot().expect("nothing is open");
    let mut callers: Vec<_> = (0..1000).map(|_| sim.caller(&script)).collect();
    sim.restore(&before).expect("nothing is open");
    // Without a snapshot, what is counted as unused is freed.
    drop(before);
    callers.truncate(1);
    let last = callers.remove(0);
    let create = last.function("sim.createDummy");
    let created = last.call(&create, &[swanilda::scene::Data::Float(0.1)]);
    assert!(created.is_ok(), "{created:?}");
}

/// The place of a simulator is free again when it is gone.
#[test]
fn there_are_snapshots_however_many_simulators_there_were() {
    for round in 0..1100 {
        let mut sim = Simulator::new(Options::default());
        let script = sim
            .add_script(ScriptKind::Customization, "", b"")
            .expect("the script loads");
        let caller = sim.caller(&script);
        let taken = sim.snapshot();
        assert!(taken.is_ok(), "{round}");
        drop((taken, caller, sim));
    }
}
