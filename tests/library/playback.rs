//! Playing a capture: any moment of it is the same as the first time.

use std::path::{Path, PathBuf};

use capture::{Header, Tape, Verdict};
use simulator::{Loop, Options, Playback, ScriptKind, Simulator};

use super::determinism::on_a_large_stack;

/// Moves by random numbers and the time, and has tables as keys.
const SCENE: &[u8] = b"
local sim = require 'sim'
function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}, 0)
    seen = {}
end
function sysCall_actuation()
    seen[{}] = math.random()
    local sum = 0
    for _, value in pairs(seen) do sum = sum * 0.9 + value end
    sim.setObjectPosition(ball, {sum, sim.getSystemTime() % 1, 5})
end
";

#[derive(Clone)]
struct Steps(u64);

impl Loop for Steps {
    fn iterate(&mut self, sim: &mut Simulator) -> bool {
        let goes_on = self.0 > 0;
        if goes_on {
            self.0 -= 1;
            sim.iterate();
        }
        goes_on
    }
}

fn simulator(tape: &Tape) -> Simulator {
    let permissions = Options::default().permissions.on_tape(tape);
    let mut sim = Simulator::new(Options {
        permissions,
        ..Options::default()
    });
    let added = sim.add_script(ScriptKind::Customization, "scene", SCENE);
    added.expect("the scene can be made");
    sim.start();
    sim
}

fn capture(steps: u64) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("run.swc");
    let tape = Tape::capturing(&file, &Header::default()).expect("the file is written");
    let mut sim = simulator(&tape);
    let mut run = Steps(steps);
    while run.iterate(&mut sim) {}
    tape.finish().expect("the file is written");
    (folder, file)
}

fn played(file: &Path, steps: u64) -> Playback<Steps> {
    let (tape, _) = Tape::replaying(file).expect("the file can be read");
    let sim = simulator(&tape);
    Playback::new(sim, Steps(steps))
}

#[test]
fn all_moments_are_reached_in_any_order() {
    let run = |()| {
        let (_folder, file) = capture(60);
        let mut playback = played(&file, 60);
        let mut hashes = vec![playback.sim().state_hash()];
        while playback.advance().expect("it goes on") {
            hashes.push(playback.sim().state_hash());
            if playback.turn().is_multiple_of(7) {
                playback.add_checkpoint().expect("there are snapshots");
            }
        }
        assert_eq!(playback.end(), Some(&Verdict::Same { steps: 60 }));
        assert_eq!((playback.turn(), playback.moments().len()), (60, 61));
        for turn in [60, 3, 59, 0, 41, 42, 20, 60, 35] {
            playback.go_to(turn).expect("it is reached");
            assert_eq!(playback.turn(), turn);
            assert_eq!(playback.sim().steps(), turn as u64);
            assert_eq!(playback.sim().state_hash(), hashes[turn], "{turn}");
        }
        assert!(!playback.is_at_end());
        playback.go_to(1000).expect("the end is reached");
        assert!(playback.is_at_end());
    };
    on_a_large_stack(run, ());
}

#[test]
fn what_was_cut_ends_with_the_last_whole_iteration() {
    let run = |()| {
        let (_folder, file) = capture(20);
        let bytes = std::fs::read(&file).expect("it is there");
        std::fs::write(&file, &bytes[..bytes.len() - 1]).expect("the file is written");
        let mut playback = played(&file, 30);
        while playback.advance().expect("it goes on") {}
        let cut = matches!(playback.end(), Some(Verdict::Cut { .. }));
        assert!(cut, "{:?}", playback.end());
        let turn = playback.turn();
        assert_eq!(playback.sim().steps(), turn as u64);
        playback.go_to(0).expect("the beginning is there");
        playback.go_to(30).expect("the end is there");
        assert!(playback.is_at_end());
        assert_eq!(playback.turn(), turn);
    };
    on_a_large_stack(run, ());
}

#[test]
fn a_live_simulator_goes_on_from_the_moment() {
    let run = |()| {
        let (_folder, file) = capture(20);
        let mut playback = played(&file, 20);
        playback.go_to(15).expect("it is there");
        playback.go_to(10).expect("it is there");
        let mut sim = playback.go_live();
        sim.step(30);
        assert_eq!((sim.steps(), sim.errors()), (40, 0));
    };
    on_a_large_stack(run, ());
}
