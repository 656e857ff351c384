//! Contacts: scripts that look on, mechanisms on the ground and with guests, speeds.

use super::super::bodies::Tag;
use super::bench::ask;
use super::*;

/// A tower that does not stand exactly upright, and a box that is thrown at it.
fn tower() -> (Bench, Vec<Handle>) {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let at = |i: i32| [0.01 * f64::from(i % 2), 0.0, 0.05 + 0.1 * f64::from(i)];
    let mut boxes: Vec<Handle> = (0..10)
        .map(|i| bench.shape([0.1; 3], at(i), 1.0, true, true))
        .collect();
    let thrown = bench.shape([0.1; 3], [-3.0, 0.02, 0.7], 1.0, true, true);
    let change = |object: &mut scene::Object| {
        object.shape_mut()?.dynamics.initial_velocity.linear = [6.0, 0.0, 0.5];
        Ok(())
    };
    bench
        .scene
        .try_modify(thrown, Field::Dynamics, change)
        .expect("a shape");
    boxes.push(thrown);
    (bench, boxes)
}

#[test]
fn a_callback_that_decides_nothing_changes_no_bit() {
    let (mut alone, boxes) = tower();
    let (mut observed, _) = tower();
    let calls = std::cell::Cell::new(0);
    let callback = |_, _| {
        calls.set(calls.get() + 1);
        ContactResponse::Default
    };
    alone.run(40);
    observed.run_asking(40, Some(&callback));
    for &handle in &boxes {
        let [a, b] =
            [&alone, &observed].map(|bench| bench.scene.world_pose(handle).expect("exists"));
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
    assert!(calls.get() > 4000, "{}", calls.get());
}

#[test]
fn bodies_of_large_groups_are_solved_in_parts() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let falling = bench.shape([0.1; 3], [0.0, 0.0, 3.0], 1.0, true, true);
    let alone = bench.shape([0.1; 3], [-1.0, 0.0, 0.05], 1.0, true, true);
    let tower = |level: u32| {
        let z = 0.05 + 0.1 * f64::from(level);
        bench.shape([0.1; 3], [1.0, 0.0, z], 1.0, true, true)
    };
    let tower: Vec<Handle> = (0..20).map(tower).collect();
    bench.run(2);
    let world = bench.dynamics.world.as_ref().expect("there is a world");
    let parts = [falling, alone, tower[0], tower[19]]
        .map(|shape| world.parts_of(bench.dynamics.bodies.get(shape).expect("is").rigid));
    assert_eq!(parts, [1, 1, 4, 4]);
    near(bench.height(alone), 0.05, 1e-5);
}

#[test]
fn answers_of_scripts_about_pairs_are_found_again() {
    let pairs: Vec<(Handle, Handle)> = [(3, 1), (2, 9), (1, 3), (2, 4)]
        .map(|(a, b)| (Handle(a), Handle(b)))
        .into();
    let refuse = |_, second| {
        if second == Handle(9) {
            ContactResponse::NoCollision
        } else {
            ContactResponse::Default
        }
    };
    let verdicts = ask(pairs, &refuse);
    let tag = |shape| Tag {
        shape: Handle(shape),
        root: Handle(shape),
        mask: u16::MAX,
        further_bits: 0,
    };
    let response = |a, b| verdicts.response(tag(a), tag(b));
    assert_eq!(response(2, 9), ContactResponse::NoCollision);
    assert_eq!(
        response(9, 2),
        ContactResponse::Default,
        "the other way round was not asked about"
    );
    assert_eq!(response(3, 1), ContactResponse::Default);
}

#[test]
fn further_bits_count_within_a_tree_alone() {
    let tag = |shape, root, further_bits| {
        let tag = Tag {
            shape: Handle(shape),
            root: Handle(root),
            mask: 0xff00 | shape as u16,
            further_bits,
        };
        Tag::unpack(tag.pack())
    };
    let touch = |a, b| Verdicts::default().response(a, b) == ContactResponse::Default;
    let last = 1 << 47;
    assert!(touch(tag(1, 9, last), tag(2, 9, last)));
    assert!(!touch(tag(1, 9, last), tag(2, 9, 1)));
    assert!(touch(tag(1, 9, 0), tag(3, 9, 0)));
    let other_tree = Tag {
        mask: 0,
        ..tag(2, 8, last)
    };
    assert!(!touch(tag(1, 9, last), other_tree));
}

/// A trunk of `mass` on a foot of 0.1 kg, tied by a force sensor.
fn on_a_light_foot(bench: &mut Bench, mass: f64, z: f64) -> (Handle, Handle) {
    let trunk = bench.shape([0.2, 0.2, 0.6], [0.0, 0.0, z + 0.4], mass, true, false);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, Pose::translation(0.0, 0.0, z + 0.1), trunk);
    let foot = bench.shape([0.2, 0.1, 0.1], [0.0, 0.0, z + 0.05], 0.1, true, true);
    bench.hang(foot, sensor);
    (foot, sensor)
}

#[test]
fn a_light_foot_bears_a_heavy_trunk_and_its_contacts_are_logged() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let (foot, sensor) = on_a_light_foot(&mut bench, 100.0, 0.0);
    bench.run(40);
    near(bench.height(foot), 0.05, 2e-5);
    let force: f64 = bench
        .dynamics
        .contacts()
        .map(|contact| contact.seen_from(foot).force[2])
        .sum();
    near(force / 10.0, 100.1 * 9.81, 0.01);
    let object = bench.scene.object(sensor).expect("exists");
    let (force, _) = object
        .force_sensor()
        .expect("a sensor")
        .filtered
        .expect("data");
    near(force[2].abs(), 100.0 * 9.81, 0.01);
}

#[test]
fn a_guest_bears_a_mechanism_on_the_ground() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let below = bench.shape([0.3, 0.3, 0.1], [0.0, 0.0, 0.05], 0.5, true, true);
    let (foot, _) = on_a_light_foot(&mut bench, 100.0, 0.1);
    bench.run(40);
    near(bench.height(below), 0.05, 1e-4);
    near(bench.height(foot), 0.15, 5e-4);
}

#[test]
fn a_mechanism_that_falls_from_afar_lands_on_the_ground() {
    let mut bench = Bench::new();
    bench.floor();
    let (foot, _) = on_a_light_foot(&mut bench, 10.0, 3.0);
    bench.run(40);
    near(bench.height(foot), 0.05, 1e-3);
}

#[test]
fn a_script_takes_the_ground_from_a_mechanism() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let (foot, _) = on_a_light_foot(&mut bench, 10.0, 0.0);
    bench.run(10);
    bench.run_asking(10, Some(&|_, _| ContactResponse::NoCollision));
    near(bench.height(foot), 0.05 - 9.81 * 0.5 * 0.5 / 2.0, 0.03);
}

#[test]
fn two_mechanisms_push_each_other() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let (lower, _) = on_a_light_foot(&mut bench, 10.0, 0.0);
    let table = bench.shape([0.3, 0.3, 0.1], [0.0, 0.0, 0.75], 1.0, true, true);
    let sensor = bench.object(
        Kind::ForceSensor(Box::default()),
        Pose::translation(0.0, 0.0, 0.75),
        table,
    );
    let weight = bench.ghost([0.0, 0.0, 0.9], true);
    bench.hang(weight, sensor);
    bench.run(20);
    assert!(bench.height(lower).is_finite() && bench.height(table).is_finite());
}
