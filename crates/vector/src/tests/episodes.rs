//! What worlds do in their episodes.

use super::{SCENE, bits, declared, seeds, step, vector};
use crate::{Distribution, Quantity, Recorded, Recording, Reset, Scale, Target, Variation};

fn mass_variation() -> Variation {
    Variation {
        target: Target::Mass("/ball".into()),
        low: vec![0.5],
        high: vec![2.0],
        scale: Scale::Factor,
        distribution: Distribution::LogUniform,
    }
}

/// Two episodes of four steps: the bits of all observations of each world.
fn two_episodes(
    declaration: &crate::Declaration,
    worlds: std::ops::Range<usize>,
    threads: usize,
) -> Vec<Vec<u64>> {
    let mut all = vector(declaration, worlds.len(), threads);
    let seeds = seeds(worlds.len(), 100 + worlds.start as u32);
    let mut seen = vec![Vec::new(); worlds.len()];
    for episode in 0..2 {
        let seeds: Vec<_> = match episode {
            0 => seeds.clone(),
            _ => seeds.iter().map(|(world, _)| (*world, None)).collect(),
        };
        assert_eq!(all.begin(&seeds), []);
        for count in 0..4 {
            let actions: Vec<f64> = worlds.clone().map(|world| (world + count) as f64).collect();
            for (seen, bits) in seen.iter_mut().zip(step(&mut all, &actions)) {
                seen.extend(bits);
            }
        }
    }
    seen
}

#[test]
fn a_world_of_many_is_the_same_as_one_alone_for_any_number_of_threads() {
    for reset in [Reset::Snapshot, Reset::Start] {
        let (_folder, mut declaration) = declared(SCENE);
        declaration.variations = vec![mass_variation()];
        declaration.reset = reset;
        let together = two_episodes(&declaration, 0..5, 1);
        assert_eq!(together, two_episodes(&declaration, 0..5, 3), "{reset:?}");
        for (world, seen) in together.iter().enumerate() {
            let alone = two_episodes(&declaration, world..world + 1, 1);
            assert_eq!(seen, &alone[0], "{reset:?}, world {world}");
        }
        assert_ne!(together[0], together[1]);
    }
}

#[test]
fn episodes_differ_and_come_again_with_their_seed() {
    let (_folder, declaration) = declared(SCENE);
    let mut all = vector(&declaration, 1, 1);
    let mut episode = |seed: Option<u32>| {
        assert_eq!(all.begin(&[(0, seed)]), []);
        let first = bits(&all, 0);
        step(&mut all, &[1.0]);
        (first, step(&mut all, &[1.0]))
    };
    let (one, two, again) = (episode(Some(7)), episode(None), episode(Some(7)));
    assert_eq!(one, again);
    assert_eq!(one.0, two.0, "the scene begins as it was");
    assert_ne!(one.1, two.1, "its random numbers do not");
}

#[test]
fn rewards_ends_and_limits_are_those_declared() {
    let (_folder, mut declaration) = declared(SCENE);
    declaration.reward = Some("2 * o[3] + a[1]".into());
    declaration.terminated = Some("o[3] < 0.47".into());
    declaration.max_steps = 2;
    let mut all = vector(&declaration, 2, 2);
    assert_eq!(all.begin(&seeds(2, 1)), []);
    let arrays = std::sync::Arc::clone(all.arrays());
    step(&mut all, &[0.5, 0.0]);
    let height = arrays.observations.read(0)[2];
    assert_eq!(arrays.rewards.get(0), 2.0 * height + 0.5);
    assert_eq!((arrays.terminated.get(0), arrays.truncated.get(0)), (0, 0));
    step(&mut all, &[0.5, 0.0]);
    assert!(arrays.observations.read(1)[2] < 0.47);
    assert_eq!((arrays.terminated.get(1), arrays.truncated.get(1)), (1, 1));
}

#[test]
fn worlds_that_are_to_begin_do_not_step() {
    let (_folder, declaration) = declared(SCENE);
    let mut all = vector(&declaration, 2, 1);
    assert_eq!(all.begin(&seeds(2, 1)), []);
    let first = bits(&all, 0);
    step(&mut all, &[1.0, 1.0]);
    all.arrays().resets.set(0, 1);
    let seen = step(&mut all, &[f64::NAN, 1.0]);
    assert_eq!(seen[0], first);
    assert_ne!(seen[1], first);
}

#[test]
fn delayed_actions_act_later() {
    let (_folder, mut declaration) = declared(SCENE);
    declaration.infos = vec![Quantity::Expression("pushed or 0".into())];
    declaration.actions = vec![crate::Action::Statement("pushed = x".into())];
    declaration.variations = vec![Variation {
        target: Target::ActionDelay,
        low: vec![2.0],
        high: vec![2.0],
        scale: Scale::Absolute,
        distribution: Distribution::Uniform,
    }];
    let mut all = vector(&declaration, 1, 1);
    assert_eq!(all.begin(&seeds(1, 1)), []);
    let mut seen = Vec::new();
    for action in [5.0, 6.0, 7.0, 8.0] {
        step(&mut all, &[action]);
        seen.push(all.arrays().infos.get(0));
    }
    assert_eq!(seen, [0.0, 0.0, 5.0, 6.0]);
}

#[test]
fn what_varies_is_relative_to_the_scene_in_each_episode() {
    for reset in [Reset::Snapshot, Reset::Start] {
        let (_folder, mut declaration) = declared(SCENE);
        declaration.reset = reset;
        declaration.infos = vec![
            Quantity::Property("/ball".into(), "mass".into()),
            Quantity::Property("/ball".into(), "bullet.friction".into()),
        ];
        let base = {
            let mut all = vector(&declaration, 1, 1);
            assert_eq!(all.begin(&seeds(1, 1)), []);
            all.arrays().infos.read(0)
        };
        let friction = Variation {
            target: Target::Friction("/ball".into()),
            low: vec![0.1],
            high: vec![0.2],
            scale: Scale::Offset,
            distribution: Distribution::Uniform,
        };
        declaration.variations = vec![mass_variation(), friction];
        let mut all = vector(&declaration, 20, 2);
        let mut masses = Vec::new();
        for _ in 0..3 {
            all.begin(
                &seeds(20, 1)
                    .iter()
                    .map(|(world, _)| (*world, None))
                    .collect::<Vec<_>>(),
            );
            for world in 0..20 {
                let seen = all.arrays().infos.read(world);
                let (factor, offset) = (seen[0] / base[0], seen[1] - base[1]);
                assert!((0.499..=2.001).contains(&factor), "{factor}");
                assert!((0.099..=0.201).contains(&offset), "{offset}");
                masses.push(factor);
            }
        }
        assert!(
            masses.iter().any(|&factor| factor < 0.7) && masses.iter().any(|&factor| factor > 1.4)
        );
    }
}

#[test]
fn pictures_are_those_of_each_world_the_highest_row_first() {
    let scene = format!(
        "{SCENE}
local init = sysCall_init
function sysCall_init()
    init()
    local camera = sim.createVisionSensor(2, {{16, 16, 0, 0}}, {{0.01, 5, 0.6, 0.1, 0, 0, 0, 0, 0, 0, 0}})
    sim.setObjectAlias(camera, 'camera')
    sim.setObjectPose(camera, {{0, -0.4, 0.45, 0, 0.7071068, 0.7071068, 0}})
end"
    );
    let (_folder, mut declaration) = declared(&scene);
    declaration.cameras = vec![crate::Camera {
        path: "/camera".into(),
        resolution: None,
        each_step: true,
    }];
    let mut all = vector(&declaration, 2, 2);
    assert_eq!(all.layout().images, [[16, 16]]);
    assert_eq!(all.begin(&seeds(2, 1)), []);
    let picture = |all: &crate::Vector, world| all.arrays().images[0].read(world);
    let (one, other) = (picture(&all, 0), picture(&all, 1));
    assert_eq!(one, other);
    // The ball is above the middle, in front of the background.
    let half = |picture: &[u8], rows: std::ops::Range<usize>| {
        let part = &picture[rows.start * 48..rows.end * 48];
        part.iter()
            .copied()
            .collect::<std::collections::BTreeSet<_>>()
            .len()
    };
    assert!(half(&one, 0..8) > half(&one, 8..16), "{one:?}");
    for _ in 0..4 {
        step(&mut all, &[0.0, 50.0]);
    }
    assert_ne!(picture(&all, 0), picture(&all, 1));
}

/// A recorded world does what it does unrecorded, and each file can be played from its beginning to its end.
#[test]
fn episodes_are_recorded() {
    for reset in [Reset::Snapshot, Reset::Start] {
        let (folder, declaration) = declared(SCENE);
        let declaration = crate::Declaration {
            reset,
            ..declaration
        };
        let path = |name: &str| folder.path().join(name);
        let recording = |world: usize, name: &str| Recording {
            world,
            path: path(name),
            recorded: Recorded::Scene,
        };
        let run = |names: &[(usize, &str)]| {
            let mut all = vector(&declaration, 3, 2);
            let wanted: Vec<_> = names
                .iter()
                .map(|(world, name)| recording(*world, name))
                .collect();
            assert_eq!(all.record(&wanted), []);
            assert_eq!(all.begin(&seeds(3, 5)), []);
            let mut seen: Vec<_> = (0..4).map(|_| step(&mut all, &[1.0; 3])).collect();
            assert_eq!(all.finish_recordings(&[0]), []);
            seen.extend((0..3).map(|_| step(&mut all, &[1.0; 3])));
            assert_eq!(all.begin(&[(0, None), (1, None), (2, None)]), []);
            seen.push(step(&mut all, &[0.0; 3]));
            seen
        };
        assert_eq!(run(&[(0, "first.swr"), (2, "third.swr")]), run(&[]));
        for (name, end) in [("first.swr", 0.2), ("third.swr", 0.35)] {
            let file = std::fs::File::open(path(name)).expect("it was written");
            let recording = view::recording::Recording::open(std::io::BufReader::new(file));
            let recording = recording.unwrap_or_else(|error| panic!("{error}"));
            let (begin, last) = (recording.index().start, recording.index().end);
            assert!(begin == 0.0 && (last - end).abs() < 1e-9, "{name}: {last}");
        }
    }
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let (folder, declaration) = declared(SCENE);
    let mut all = vector(&declaration, 2, 2);
    let path = folder.path().join("nowhere/a.swr");
    let failures = all.record(&[Recording {
        world: 1,
        path,
        recorded: Recorded::Scene,
    }]);
    assert!(
        failures.len() == 1 && failures[0].world == 1,
        "{failures:?}"
    );
    assert!(failures[0].reason.contains("nowhere/a.swr"), "{failures:?}");
    assert_eq!(all.begin(&seeds(2, 1)), []);
}
