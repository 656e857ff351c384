//! The same scene gives the same bytes: twice in one process, and twice in processes of their own (docs/ARCHITECTURE.md).
//! So do a run of 10 000 steps with contacts, motors and chains, and the run after it.

use std::cell::RefCell;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::rc::Rc;
use std::time::Duration;

use geometry::pose::pose_to_array;

use swanilda::{Channels, Console, LogLine, Options, Picture, ScriptKind, Simulator};
use test_support::parallel;
use test_support::process::run_for_code;

/// Steps after which a scene that does not end by itself is stopped.
const LONGEST: u64 = 400;

/// How long a command may take.
const LIMIT: Duration = Duration::from_secs(600);

/// Scenes that speak with the world outside; how they go is a matter of who is there.
const OUTSIDE: [&str; 5] = ["ros", "ws_", "zmq_", "serial_", "fetch_"];

pub(super) fn scenes() -> Vec<PathBuf> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let folders = [top.clone(), top.join("messaging")];
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).expect("scenes/ is readable").flatten());
    let files = entries.map(|entry| entry.path());
    let mut scenes: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|e| e == "lua"))
        .collect();
    let is_outside = |name: &str| OUTSIDE.iter().any(|start| name.starts_with(start));
    scenes.retain(|path| {
        !path
            .file_name()
            .is_some_and(|name| is_outside(&name.to_string_lossy()))
    });
    scenes.sort();
    scenes
}

#[test]
fn twice_in_one_process() {
    parallel::map(&scenes(), |scene| {
        let run = || on_a_large_stack(record, scene.clone());
        assert_same(&run(), &run(), scene);
    });
}

#[test]
fn twice_in_processes_of_their_own() {
    parallel::map(&scenes(), |scene| {
        let run = || {
            let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
            command.arg("run").arg(scene).args([
                "--quiet",
                "--json",
                "--steps",
                &LONGEST.to_string(),
            ]);
            let (code, said) = run_for_code(&mut command, LIMIT).expect("it ends");
            assert!(code == 0, "{} fails: {said}", scene.display());
            said
        };
        assert_same(&run(), &run(), scene);
    });
}

/// Colours, depths and objects do not depend on how many threads draw.
#[test]
fn pictures_with_any_number_of_threads() {
    for name in ["camera", "line_follower"] {
        let pictures = [1, 2, 7].map(|threads| on_a_large_stack(picture, (name, threads)));
        assert!(
            pictures[0].depth.iter().any(|depth| *depth < 1.0),
            "{name}: something is seen"
        );
        assert!(
            pictures.iter().all(|picture| *picture == pictures[0]),
            "{name}"
        );
    }
}

fn picture((name, threads): (&'static str, usize)) -> Picture {
    let options = Options {
        render_threads: NonZero::new(threads),
        ..Options::default()
    };
    let mut sim = Simulator::new(options);
    sim.scene_mut()
        .add_default_objects()
        .expect("there is room");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.lua"));
    let code = fs::read(scene).expect("the scene is readable");
    sim.add_script(ScriptKind::Customization, "scene", &code)
        .expect("the scene loads");
    sim.picture(None, Some([211, 157]), Channels::ALL)
        .expect("there is a view")
}

/// Bodies and readings do not depend on how many threads solve mechanisms.
#[test]
fn mechanisms_with_any_number_of_threads() {
    let runs = [1, 2, 4].map(|threads| on_a_large_stack(swarm, threads));
    assert!(runs[0].lines().count() > 10, "{}", runs[0]);
    assert!(runs.iter().all(|run| *run == runs[0]), "{runs:?}");
}

/// What `swarm.lua` prints.
fn swarm(threads: usize) -> String {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/determinism/swarm.lua");
    let transcript = Transcript::default();
    let options = Options {
        threads: NonZero::new(threads).expect("from one"),
        ..Options::default()
    };
    let mut sim = Simulator::with_console(options, Box::new(transcript.clone()));
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    sim.add_script(
        ScriptKind::Customization,
        "scene",
        &fs::read(&scene).expect("a scene is readable"),
    )
    .expect("a scene loads");
    sim.step(40);
    assert_eq!(sim.errors(), 0, "{}", transcript.text.borrow());
    transcript.text.take()
}

/// The hashes of `long_run.lua`: of two processes at once, and of two shorter runs of one simulator.
#[test]
fn ten_thousand_steps() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/determinism/long_run.lua");
    let start = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command.arg("run").arg(&scene).args(["--quiet", "--json"]);
        std::thread::spawn(move || run_for_code(&mut command, LIMIT).expect("it ends"))
    };
    let processes = [start(), start()];
    let runs = on_a_large_stack(two_short_runs, scene.clone());
    let hashes: Vec<_> = runs
        .lines()
        .filter(|line| line.ends_with("after 10.0 s"))
        .collect();
    let [first, second] = hashes[..] else {
        panic!("each run prints a line: {runs}")
    };
    assert_eq!(first, second, "a run differs from the one before it");
    let said = processes.map(|process| {
        let (code, said) = process.join().expect("it was run");
        assert!(
            code == 0 && said.contains(first),
            "a process differs from `{first}`: {said}"
        );
        let end = said
            .lines()
            .find(|line| line.contains("after 50.0 s"))
            .map(str::to_owned);
        end.unwrap_or_else(|| panic!("10 000 steps end with a line: {said}"))
    });
    assert_eq!(said[0], said[1], "two processes differ");
}

/// What a scene prints in its first 2000 steps, is stopped, and prints when it is started again.
fn two_short_runs(scene: PathBuf) -> String {
    let transcript = Transcript::default();
    let mut sim = Simulator::with_console(Options::default(), Box::new(transcript.clone()));
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    sim.add_script(
        ScriptKind::Customization,
        "scene",
        &fs::read(&scene).expect("a scene is readable"),
    )
    .expect("a scene loads");
    for _ in 0..2 {
        sim.step(2001);
        sim.stop();
    }
    assert_eq!(sim.errors(), 0, "{}", transcript.text.borrow());
    transcript.text.take()
}

fn assert_same(first: &str, second: &str, scene: &Path) {
    let difference = first.lines().zip(second.lines()).find(|(a, b)| a != b);
    assert!(
        first == second,
        "{} differs between two runs, first at {difference:?}",
        scene.display()
    );
    assert!(!first.is_empty(), "{} says nothing", scene.display());
}

pub(super) fn on_a_large_stack<T: Send + 'static, R: Send + 'static>(
    run: fn(T) -> R,
    input: T,
) -> R {
    let thread = std::thread::Builder::new()
        .stack_size(Simulator::STACK_SIZE)
        .spawn(move || run(input));
    thread
        .expect("a thread can be made")
        .join()
        .expect("a simulator does not panic")
}

/// Everything a scene says, and where every object is before its last step.
fn record(scene: PathBuf) -> String {
    let transcript = Transcript::default();
    let options = Options {
        package_dirs: vec![scene.parent().expect("scenes lie in a folder").to_owned()],
        ..Options::default()
    };
    let mut sim = Simulator::with_console(options, Box::new(transcript.clone()));
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    let code = fs::read(&scene).expect("a scene is readable");
    sim.add_script(ScriptKind::Customization, "scene", &code)
        .expect("a scene loads");
    let mut poses = String::new();
    sim.start();
    while sim.state().is_advancing() {
        if sim.steps() >= LONGEST {
            sim.request_stop();
        }
        poses = poses_of(&sim);
        sim.iterate();
    }
    sim.stop();
    assert_eq!(
        sim.errors(),
        0,
        "{}: {}",
        scene.display(),
        transcript.text.borrow()
    );
    transcript.text.take() + &poses
}

/// The exact pose of every object, bit by bit.
fn poses_of(sim: &Simulator) -> String {
    let scene = sim.scene();
    let line = |object: &swanilda::scene::Object| {
        let pose = scene.world_pose(object.handle());
        format!(
            "{} {:x?}\n",
            object.handle().raw(),
            pose.map(|pose| pose_to_array(&pose).map(f64::to_bits))
        )
    };
    scene.objects().map(line).collect()
}

/// Keeps all lines.
#[derive(Clone, Default)]
struct Transcript {
    text: Rc<RefCell<String>>,
}

impl Console for Transcript {
    fn print(&mut self, line: &[u8], _: f64) {
        *self.text.borrow_mut() += &format!("{}\n", String::from_utf8_lossy(line));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        *self.text.borrow_mut() += &format!("{}\n", line.decorated());
    }
}
