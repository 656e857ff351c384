//! Capturing, replaying, and what makes a difference.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self) -> PathBuf {
        self.0.path().join("run.swc")
    }

    /// Captures what `run` does.
    fn capture(&self, run: impl FnOnce(&Tape)) {
        let tape = Tape::capturing(&self.path(), &Header::default()).unwrap();
        run(&tape);
        tape.finish().unwrap();
    }

    /// Replays it; how that ends.
    fn replay(&self, run: impl FnOnce(&Tape)) -> Verdict {
        let (tape, _) = Tape::replaying(&self.path()).unwrap();
        run(&tape);
        tape.finish().unwrap().expect("a replay has a verdict")
    }
}

/// A value that cannot be read, as in a replay.
fn never<T>() -> T {
    panic!("a replay reads nothing")
}

#[test]
fn a_tape_that_is_off_reads_what_is_there() {
    let tape = Tape::default();
    assert_eq!(tape.input("clock", || 3.5), Ok(3.5));
    assert_eq!(tape.poll("news", 1, || None::<u64>), None);
    assert!(tape.signal("end", || true));
    tape.turn();
    tape.step(never);
    assert_eq!(tape.finish().unwrap(), None);
}

#[test]
fn a_replay_gets_what_was_captured_and_reads_nothing() {
    let folder = Folder::new();
    let large = vec![9; (3 << 20) + 5];
    folder.capture(|tape| {
        assert_eq!(tape.input("clock", || 1.25), Ok(1.25));
        for _ in 0..2 {
            let read = tape.content("file", || Ok(large.clone()));
            assert_eq!(read.unwrap(), large);
        }
        let failed = tape.content("file", || Err(io::Error::from_raw_os_error(2)));
        assert_eq!(failed.unwrap_err().raw_os_error(), Some(2));
        tape.step(|| 7);
    });
    assert!(
        std::fs::metadata(folder.path()).unwrap().len() < 4 << 20,
        "equal contents are written once"
    );
    let verdict = folder.replay(|tape| {
        assert!(tape.is_replaying() && !tape.is_capturing());
        assert_eq!(tape.input("clock", never::<f64>), Ok(1.25));
        for _ in 0..2 {
            assert_eq!(tape.content("file", never).unwrap(), large);
        }
        let failed = tape.content("file", never).unwrap_err();
        assert_eq!(failed.kind(), io::ErrorKind::NotFound);
        tape.step(|| 7);
    });
    assert_eq!(verdict, Verdict::Same { steps: 1 });
}

#[test]
fn what_may_happen_happens_in_the_same_iteration() {
    let folder = Folder::new();
    let happens = |at: u64, key: u64| (at == 3 && key == 1).then_some(at);
    folder.capture(|tape| {
        for at in 0..5 {
            tape.turn();
            (0..3).for_each(|key| {
                assert_eq!(
                    tape.poll("news", key, || happens(at, key)),
                    happens(at, key)
                );
            });
            assert_eq!(tape.signal("end", || at == 4), at == 4);
        }
    });
    let verdict = folder.replay(|tape| {
        for at in 0..5 {
            tape.turn();
            (0..3).for_each(|key| assert_eq!(tape.poll("news", key, never), happens(at, key)));
            assert_eq!(tape.signal("end", never), at == 4);
        }
    });
    assert_eq!(verdict, Verdict::Same { steps: 0 });
}

#[test]
fn what_is_asked_for_within_an_input_is_part_of_it() {
    let folder = Folder::new();
    folder.capture(|tape| {
        let outer = tape.input("outer", || {
            tape.turn();
            tape.input("inner", || 1_u64).unwrap() + 1
        });
        assert_eq!(outer, Ok(2));
        let panics = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            tape.input("outer", || -> u64 { panic!("as a device may") })
        }));
        assert!(panics.is_err());
        assert_eq!(tape.input("after", || 5_u64), Ok(5));
    });
    let verdict = folder.replay(|tape| {
        assert_eq!(tape.input("outer", never::<u64>), Ok(2));
        assert_eq!(tape.input("after", never::<u64>), Ok(5));
    });
    assert_eq!(verdict, Verdict::Same { steps: 0 });
}

#[test]
fn the_first_difference_is_named_and_noted_once() {
    let folder = Folder::new();
    folder.capture(|tape| {
        tape.step(|| 1);
        tape.input("clock", || 1.0).unwrap();
        tape.step(|| 2);
    });
    let differs = |step, what: &str| Verdict::Differs {
        step,
        what: what.into(),
    };
    let count = Arc::new(AtomicUsize::new(0));
    let counted = Arc::clone(&count);
    let verdict = folder.replay(|tape| {
        tape.on_end(move |_| {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        tape.step(|| 1);
        let other = tape.input_for("serial", || "script '/a'".into(), never::<f64>);
        assert_eq!(other, Err(Lost));
        assert_eq!(tape.input("clock", never::<f64>), Err(Lost), "it is over");
        tape.step(|| 2);
    });
    assert_eq!(
        verdict,
        differs(
            2,
            "script '/a' asks for serial, where the capture has clock"
        )
    );
    assert_eq!(count.load(Ordering::Relaxed), 1);
    let verdict = folder.replay(|tape| tape.step(|| 5));
    let what = "the state has the hash 0000000000000005, where the capture has 0000000000000001";
    assert_eq!(verdict, differs(1, what));
    assert_eq!(
        folder.replay(|_| ()),
        differs(
            1,
            "the run has ended, where the capture has the end of a step"
        )
    );
    let verdict = folder.replay(|tape| {
        tape.step(|| 1);
        assert_eq!(tape.input("clock", never::<(f64, f64)>), Err(Lost));
    });
    assert_eq!(
        verdict,
        differs(2, "the value of clock in the capture is none")
    );
}

#[test]
fn a_capture_that_was_cut_ends_with_its_last_step() {
    let folder = Folder::new();
    folder.capture(|tape| {
        tape.step(|| 1);
    });
    let bytes = std::fs::read(folder.path()).unwrap();
    // Without the record of the end, as a process that was killed leaves it.
    let tape = Tape::capturing(&folder.path(), &Header::default()).unwrap();
    tape.step(|| 1);
    drop(tape);
    assert_ne!(std::fs::read(folder.path()).unwrap(), bytes);
    let verdict = folder.replay(|tape| {
        tape.step(|| 1);
        assert_eq!(tape.input("clock", never::<f64>), Err(Lost));
    });
    assert_eq!(verdict, Verdict::Cut { steps: 1 });
}

#[test]
fn what_is_not_captured_is_said_and_no_part_of_the_run() {
    let folder = Folder::new();
    let said = Arc::new(AtomicUsize::new(0));
    let noted = Arc::clone(&said);
    folder.capture(|tape| {
        tape.on_lack(move |what| {
            noted.fetch_add(what.len(), Ordering::Relaxed);
        });
        tape.lacks("a plugin");
        tape.step(|| 1);
    });
    assert_eq!(said.load(Ordering::Relaxed), "a plugin".len());
    let verdict = folder.replay(|tape| {
        tape.lacks("a plugin");
        tape.step(|| 1);
    });
    assert_eq!(verdict, Verdict::Same { steps: 1 });
}

#[test]
fn tapes_are_equal_to_themselves() {
    let folder = Folder::new();
    let tape = Tape::capturing(&folder.path(), &Header::default()).unwrap();
    assert_eq!(tape, tape.clone());
    assert_ne!(tape, Tape::default());
    assert_eq!(Tape::default(), Tape::default());
    assert_eq!(
        format!("{tape:?} {:?}", Tape::default()),
        "Tape(capturing) Tape(off)"
    );
}

#[test]
fn a_replay_goes_back_and_ahead() {
    let folder = Folder::new();
    let contents = [vec![1; 100], vec![2; 3 << 20]];
    let run = |tape: &Tape, turns: std::ops::Range<usize>| {
        for turn in turns {
            tape.turn();
            // Kinds and contents that come later must not change the numbers of earlier ones.
            let clock = tape.input(&format!("clock {turn}"), || turn as u64);
            assert_eq!(clock, Ok(turn as u64));
            let wanted = &contents[turn % 2];
            let read = tape.content("file", || Ok(wanted.clone()));
            assert!(read.unwrap() == *wanted, "content {turn}");
            tape.step(|| turn as u64);
        }
    };
    folder.capture(|tape| run(tape, 0..6));
    let verdict = folder.replay(|tape| {
        let beginning = tape.mark().unwrap();
        run(tape, 0..3);
        let third = tape.mark().unwrap();
        run(tape, 3..5);
        tape.go_to(&beginning).unwrap();
        run(tape, 0..2);
        tape.go_to(&third).unwrap();
        assert_eq!(tape.steps(), 3);
        run(tape, 3..6);
        // What differs is forgotten when an earlier moment is brought back.
        tape.go_to(&third).unwrap();
        tape.turn();
        tape.step(|| 99);
        assert!(matches!(tape.verdict(), Some(Verdict::Differs { .. })));
        tape.go_to(&third).unwrap();
        assert_eq!(tape.verdict(), None);
        tape.suspend(true);
        assert_eq!(tape.input("clock 3", || 3_u64), Err(Lost));
        tape.suspend(false);
        run(tape, 3..6);
    });
    assert_eq!(verdict, Verdict::Same { steps: 6 });
}

#[test]
fn a_replay_that_has_gone_live_reads_what_is_there() {
    let folder = Folder::new();
    folder.capture(|tape| {
        let _ = tape.input("clock", || 1_u64);
    });
    let (tape, _) = Tape::replaying(&folder.path()).unwrap();
    tape.go_live();
    assert_eq!(tape.input("other", || 5_u64), Ok(5));
    assert!(!tape.is_replaying() && !tape.is_capturing());
    assert_eq!(tape.finish().unwrap(), None);
}
