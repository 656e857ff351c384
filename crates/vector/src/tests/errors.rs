//! What goes wrong in one world is said of that one, and the others go on.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::{SCENE, bits, declared, seeds, step, vector};
use crate::{Failure, Quantity, Reset, Vector};

/// Why no worlds can be made.
fn refusal(declaration: &crate::Declaration) -> String {
    match Vector::new(declaration.clone(), 1, 1, Box::new(|| false)) {
        Ok(_) => panic!("it was made"),
        Err(Failure { world, reason }) => {
            assert_eq!(world, 0);
            reason
        }
    }
}

#[test]
fn a_script_that_fails_is_named_with_its_world_and_the_others_go_on() {
    let (_folder, declaration) = declared(SCENE);
    let mut all = vector(&declaration, 3, 2);
    assert_eq!(all.begin(&seeds(3, 1)), []);
    for world in 0..3 {
        all.arrays()
            .actions
            .set(world, if world == 1 { 13.0 } else { 1.0 });
    }
    let failures = all.step().expect("actions are finite");
    assert_eq!(failures.len(), 1);
    assert_eq!(failures[0].world, 1);
    assert!(failures[0].reason.contains("thirteen"), "{}", failures[0]);
    assert!(failures[0].reason.contains("scene.lua"), "{}", failures[0]);
    let failed: Vec<u8> = (0..3).map(|world| all.arrays().failed.get(world)).collect();
    assert_eq!(failed, [0, 1, 0]);
    let (ball, stuck) = (bits(&all, 0), bits(&all, 1));
    let seen = step(&mut all, &[1.0; 3]);
    assert_ne!(seen[0], ball);
    assert_eq!(seen[1], stuck, "it waits for its next episode");
    assert_eq!(all.begin(&[(1, None)]), []);
    let seen = step(&mut all, &[1.0; 3]);
    assert_ne!(seen[1], stuck);
}

#[test]
fn an_action_that_is_no_number_is_refused_before_anything_steps() {
    let (_folder, declaration) = declared(SCENE);
    let mut all = vector(&declaration, 2, 1);
    assert_eq!(all.begin(&seeds(2, 1)), []);
    let before = bits(&all, 0);
    all.arrays().actions.set(1, f64::NAN);
    assert_eq!(all.step(), Err((1, 0)));
    assert_eq!(bits(&all, 0), before);
}

#[test]
fn what_is_not_in_the_scene_is_named() {
    let (_folder, declaration) = declared(SCENE);
    let with = |change: &dyn Fn(&mut crate::Declaration)| {
        let mut changed = declaration.clone();
        change(&mut changed);
        refusal(&changed)
    };
    let reason = with(&|d| d.observations = vec![Quantity::JointPosition("/arm".into())]);
    assert!(reason.contains("'/arm'"), "{reason}");
    let reason =
        with(&|d| d.observations = vec![Quantity::Property("/ball".into(), "weight".into())]);
    assert!(reason.contains("property 'weight' of '/ball'"), "{reason}");
    let reason = with(&|d| d.observations = vec![Quantity::Expression("1 +".into())]);
    assert!(reason.contains("expression 1 +"), "{reason}");
    let reason = with(&|d| d.observations = vec![Quantity::Expression("'a'".into())]);
    assert!(reason.contains("numbers are needed"), "{reason}");
    let reason = with(&|d| d.actions = vec![crate::Action::Function("/ball".into(), "f".into())]);
    assert!(reason.contains("'/ball' is no script"), "{reason}");
    let reason = with(&|d| d.reward = Some("o[".into()));
    assert!(reason.contains("the reward"), "{reason}");
    let reason = with(&|d| d.scene = "nowhere.ttt".into());
    assert!(reason.contains("nowhere.ttt"), "{reason}");
}

#[test]
fn a_scene_whose_script_fails_at_once_makes_no_worlds() {
    let (_folder, mut declaration) = declared("function sysCall_init() error('no arm') end");
    declaration.observations.clear();
    declaration.actions.clear();
    assert!(refusal(&declaration).contains("no arm"));
}

#[test]
fn rewards_that_are_no_numbers_fail_in_their_world() {
    let (_folder, mut declaration) = declared(SCENE);
    declaration.reward = Some("a[1] == 3 and 'much' or 1".into());
    let mut all = vector(&declaration, 2, 1);
    assert_eq!(all.begin(&seeds(2, 1)), []);
    all.arrays().actions.set(1, 3.0);
    let failures = all.step().expect("actions are finite");
    assert_eq!(failures.len(), 1);
    assert_eq!(failures[0].world, 1);
    assert!(
        failures[0]
            .reason
            .contains("the reward is no finite number"),
        "{}",
        failures[0]
    );
    assert_eq!(all.arrays().rewards.get(0), 1.0);
}

/// A ball, and a script that never ends once it is pushed that hard.
const ENDLESS: &str = "
sim = require 'sim'
function sysCall_init()
    ball = sim.createDummy(0.1)
    sim.setObjectAlias(ball, 'ball')
    push = 0
end
function push_by(x) push = x end
function sysCall_actuation()
    while push > 2 do end
end
";

#[test]
fn what_never_ends_is_interrupted_and_the_others_are_there() {
    for reset in [Reset::Snapshot, Reset::Start] {
        let (_folder, declaration) = declared(ENDLESS);
        let declaration = crate::Declaration {
            reset,
            ..declaration
        };
        let asked = Arc::new(AtomicU32::new(0));
        let asking = Arc::clone(&asked);
        let wants_end = move || asking.fetch_add(1, Ordering::Relaxed) > 1;
        let made = Vector::new(declaration, 3, 3, Box::new(wants_end));
        let mut all = made.unwrap_or_else(|failure| panic!("{failure}"));
        assert_eq!(all.begin(&seeds(3, 1)), []);
        // Making worlds may have asked.
        asked.store(0, Ordering::Relaxed);
        all.arrays().actions.set(1, 3.0);
        let failures = all.step().expect("actions are finite");
        assert!(
            failures.len() == 1 && failures[0].world == 1,
            "{failures:?}"
        );
        assert!(failures[0].reason.contains("interrupted"), "{failures:?}");
        assert!(asked.load(Ordering::Relaxed) > 1);
        asked.store(0, Ordering::Relaxed);
        assert_eq!(all.begin(&[(1, None)]), []);
        step(&mut all, &[1.0; 3]);
    }
}

#[test]
fn scripts_that_have_failed_are_there_in_the_next_episode() {
    for reset in [Reset::Snapshot, Reset::Start] {
        let (_folder, declaration) = declared(SCENE);
        let declaration = crate::Declaration {
            reset,
            ..declaration
        };
        let run = |fails: bool| {
            let mut all = vector(&declaration, 2, 1);
            assert_eq!(all.begin(&seeds(2, 1)), []);
            all.arrays().actions.set(1, if fails { 13.0 } else { 1.0 });
            let failures = all.step().expect("actions are finite");
            assert_eq!(failures.len(), usize::from(fails));
            assert_eq!(all.begin(&[(0, None), (1, None)]), []);
            [step(&mut all, &[1.0; 2]), step(&mut all, &[1.0; 2])]
        };
        assert_eq!(run(true), run(false));
    }
}

#[test]
fn an_action_of_many_steps_is_interrupted_between_them() {
    let (_folder, declaration) = declared(SCENE);
    let declaration = crate::Declaration {
        steps_per_action: u64::MAX,
        ..declaration
    };
    let mut asked = 0;
    let wants_end = move || {
        asked += 1;
        asked > 1
    };
    let made = Vector::new(declaration, 1, 1, Box::new(wants_end));
    let mut all = made.unwrap_or_else(|failure| panic!("{failure}"));
    let mut failures = all.begin(&seeds(1, 1));
    failures.extend(all.step().expect("actions are finite"));
    assert!(
        failures
            .iter()
            .any(|failure| failure.reason.contains("interrupted")),
        "{failures:?}"
    );
}
