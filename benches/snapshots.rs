//! What snapshots cost: one that nothing has changed since, one after a step, and a restore after a step; with their memory.
#![allow(clippy::disallowed_methods, reason = "a benchmark asks for the time")]

use std::path::PathBuf;
use std::time::{Duration, Instant};

use swanilda::{Options, ScriptKind, Simulator};

#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;

/// Of so many times the least counts: all others had to wait for something.
const TIMES: usize = 50;
/// Steps before the first snapshot.
const STEPS: u64 = 40;

const SCENES: [&str; 4] = [
    "inverted_pendulum",
    "arm_7dof",
    "falling_boxes",
    "line_follower",
];

/// Objects with a script each, which counts.
const SCRIPTS: &str = "
sim = require 'sim'
local code = 'local n = 0 function sysCall_init() end function sysCall_actuation() n = n + 1 end'
for _ = 1, 20 do
    local script = sim.createScript(sim.scripttype_simulation, code)
    sim.setObjectParent(script, sim.createDummy(0.1), true)
end
";

fn main() {
    let thread = std::thread::Builder::new().stack_size(Simulator::STACK_SIZE);
    let run = thread.spawn(run).expect("the system has a thread");
    run.join().expect("no scene fails");
}

fn run() {
    println!("microseconds, least of {TIMES}; kB of a snapshot, of one a step later besides");
    for name in SCENES {
        report(name, of_scene(name));
    }
    report("20 scripts", of_scripts());
}

fn of_scene(name: &str) -> Simulator {
    let scenes = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let options = Options {
        package_dirs: vec![scenes.clone()],
        ..Options::default()
    };
    let mut sim = Simulator::new(options);
    let scene = scenes.join(name).with_extension("lua");
    sim.open(&scene, ScriptKind::Customization)
        .expect("the scene loads");
    sim
}

fn of_scripts() -> Simulator {
    let mut sim = Simulator::new(Options::default());
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    sim.add_script(ScriptKind::Sandbox, "bench", SCRIPTS.as_bytes())
        .expect("the scene loads");
    sim
}

fn report(name: &str, mut sim: Simulator) {
    sim.step(STEPS);
    let whole = sim.snapshot().expect("nothing is open").own_bytes();
    sim.iterate();
    let first = sim.snapshot().expect("nothing is open");
    sim.iterate();
    let own = sim.snapshot().expect("nothing is open").own_bytes();
    let unchanged = least(&mut sim, |_| {}, snapshot);
    let stepped = least(&mut sim, Simulator::iterate, snapshot);
    let restored = least(&mut sim, Simulator::iterate, |sim| {
        sim.restore(&first).expect("nothing is open");
    });
    println!(
        "{name:>20}  snapshot {unchanged:4.0}, after a step {stepped:4.0}, restore {restored:4.0}; {:6.0} and {:4.0}",
        whole as f64 / 1e3,
        own as f64 / 1e3,
    );
}

/// The snapshot is dropped at once: the simulator itself knows what it shares with the next.
fn snapshot(sim: &mut Simulator) {
    sim.snapshot().expect("nothing is open");
}

/// Microseconds of `work`, each time after `before`.
fn least(
    sim: &mut Simulator,
    before: impl Fn(&mut Simulator),
    work: impl Fn(&mut Simulator),
) -> f64 {
    let time = || {
        before(sim);
        let begun = Instant::now();
        work(sim);
        begun.elapsed()
    };
    let times = std::iter::repeat_with(time).take(TIMES);
    times
        .min()
        .map_or(0.0, |least: Duration| 1e6 * least.as_secs_f64())
}
