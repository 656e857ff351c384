//! Runs against files of themselves and of others, and damaged files.

use super::compare::Presence;
use super::write::HashWriter;
use super::{Comparison, Difference, HashFileError, Verdict};
use crate::{Options, ScriptKind, Simulator};

/// A box that moves by steps of a centimetre, and what the script does besides in step `at`.
fn simulator(besides: &str, at: u64) -> Simulator {
    let mut sim = Simulator::new(Options::default());
    let code = format!(
        "sim = require 'sim'
         function sysCall_init()
             box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {{0.1, 0.1, 0.1}})
             sim.setObjectAlias(box, 'box')
             count = 0
         end
         function sysCall_actuation()
             count = count + 1
             sim.setObjectPosition(box, {{0.01 * count, 0, 0}})
             if count == {at} then {besides} end
         end"
    );
    sim.add_script(ScriptKind::Customization, "script", code.as_bytes())
        .expect("the script loads");
    sim
}

fn recorded(sim: &mut Simulator, steps: u64, limit: usize) -> String {
    let mut writer = HashWriter::with_limit(Vec::new(), limit).expect("there is memory");
    for _ in 0..steps {
        sim.step(1);
        writer.add(sim).expect("there is memory");
    }
    let file = writer.finish().expect("there is memory");
    String::from_utf8(file).expect("it is text")
}

fn plain(steps: u64) -> String {
    recorded(&mut simulator("", 0), steps, super::MAX_VALUES)
}

/// The steps that were equal, and the end of the comparison.
fn compared(file: &str, sim: &mut Simulator, steps: u64) -> (u64, Result<Verdict, HashFileError>) {
    let mut comparison = match Comparison::new(file.as_bytes()) {
        Ok(comparison) => comparison,
        Err(error) => return (0, Err(error)),
    };
    for _ in 0..steps {
        sim.step(1);
        match comparison.compare(sim) {
            Ok(Verdict::Equal) => {}
            other => return (comparison.equal_steps(), other),
        }
    }
    (comparison.equal_steps(), Ok(Verdict::Equal))
}

fn difference(besides: &str) -> Difference {
    match compared(&plain(10), &mut simulator(besides, 4), 10) {
        (3, Ok(Verdict::Differs(difference))) => difference,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_same_run_is_equal_and_a_longer_one_reaches_the_end() {
    let file = plain(10);
    let (equal, verdict) = compared(&file, &mut simulator("", 0), 10);
    assert!(matches!((equal, verdict), (10, Ok(Verdict::Equal))));
    let (equal, verdict) = compared(&file, &mut simulator("", 0), 12);
    assert!(matches!((equal, verdict), (10, Ok(Verdict::EndOfFile))));
}

#[test]
fn a_difference_is_named() {
    let moved = difference("sim.setObjectPosition(box, {0.04, 1e-16, 0})");
    assert_eq!(moved.step, 4);
    assert_eq!(
        moved.to_string(),
        "the state after step 4 is another one: pose of /box, calcLinearVelocity of /box"
    );
    let signal = difference("sim.setStringProperty(box, 'signal.seen', 'yes')");
    assert_eq!(signal.values.len(), 1);
    assert_eq!(signal.values[0].presence, Presence::Here);
    assert!(
        signal
            .to_string()
            .ends_with(": signal.seen of /box (only here)")
    );
    let removed = difference("sim.removeObjects({box})");
    assert_eq!(removed.values[0].presence, Presence::File);
    assert!(removed.more > 50, "{removed}");
    let drawn = difference("math.random()");
    assert_eq!(
        drawn.to_string(),
        "the state after step 4 is another one: state and random numbers of the script of /Script"
    );
}

#[test]
fn beyond_the_limit_only_hashes_are_left() {
    let short = recorded(&mut simulator("", 0), 10, 100);
    assert_eq!(short.lines().nth(1), Some("e"));
    assert_eq!(short.lines().count(), 12);
    let (equal, verdict) = compared(&short, &mut simulator("math.random()", 4), 10);
    let Ok(Verdict::Differs(difference)) = verdict else {
        panic!("{verdict:?}")
    };
    assert_eq!((equal, difference.values.len()), (3, 0));
    assert!(difference.to_string().contains("does not say"));
}

#[test]
fn damaged_files_are_refused_with_the_line() {
    let no_hashes = [
        "",
        "x",
        "swanilda state hashes 2\n",
        "swanilda state hashes 1",
    ];
    for text in no_hashes {
        let error = Comparison::new(text.as_bytes())
            .err()
            .map(|e| e.to_string());
        assert!(error.is_some(), "{text}");
    }
    let lines = [
        "x\n",
        "t\t1\n",
        "t\tx\t/box\n",
        "p\t\n",
        "p\n",
        "s\n",
        "s\t1\t0.05\n",
        "s\t1\t0.05\t123\n",
        "s\t1\t0.05\t+123456789abcdef\n",
        "s\tx\t0.05\t0123456789abcdef\n",
        "s\t1\t0.05\t0123456789abcdef\t0.0=12345678\n",
        "t\t1\t/box\np\tpose\ns\t1\t0.05\t0123456789abcdef\t0.1=12345678\n",
        "t\t1\t/box\np\tpose\ns\t1\t0.05\t0123456789abcdef\t0.0=1234567\n",
        "t\t1\t/box\np\tpose\ns\t1\t0.05\t0123456789abcdef\t00=12345678\n",
        "t\t1\t/box\np\tpose\ns\t1\t0.05\t0123456789abcdef\t\n",
        "s\t1\t0.05\t0123456789abcdef",
    ];
    for text in lines {
        let file = format!("{}\n{text}", super::HEAD);
        let (_, verdict) = compared(&file, &mut simulator("", 0), 1);
        assert!(
            matches!(verdict, Err(HashFileError::Damaged { line, .. }) if line > 1),
            "{text:?}: {verdict:?}"
        );
    }
}

#[test]
fn cut_and_changed_files_never_panic() {
    let file = plain(2).into_bytes();
    let mut random = test_support::random::Random::new(3);
    for _ in 0..200 {
        let mut changed = file[..random.below(file.len())].to_vec();
        for _ in 0..3 {
            let at = random.below(changed.len().max(1));
            if let Some(byte) = changed.get_mut(at) {
                *byte = random.byte();
            }
        }
        if let Ok(mut comparison) = Comparison::new(&changed[..]) {
            while comparison.has_more().unwrap_or(false) {}
        }
    }
}
