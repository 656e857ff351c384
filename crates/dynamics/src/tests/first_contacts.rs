//! When bodies begin to touch, what counts as touching, and what they bear together.

use nalgebra::Vector3;
use scene::sensor::force_sensor::ForceSensor;

use super::*;

/// So many boxes on a floor, in a square half a metre apart, at that height above it.
fn boxes(count: u32, gap: f64) -> (Bench, Vec<Handle>) {
    let mut bench = Bench::new();
    bench.floor();
    let at = |i: u32| {
        let [x, y] = [i % 10, i / 10].map(|i| 0.5 * f64::from(i) - 2.0);
        [x, y, 0.05 + gap]
    };
    let boxes = (0..count).map(|i| bench.shape([0.1; 3], at(i), 1.0, true, true));
    let boxes = boxes.collect();
    (bench, boxes)
}

#[test]
fn new_bodies_touch_from_the_first_sub_step_on() {
    for count in [1, 100] {
        let (mut bench, boxes) = boxes(count, 0.0);
        bench.run(1);
        let first = bench.dynamics.contacts().filter(|c| c.sub_step == 0);
        let force: f64 = first.map(|c| c.force[2].abs()).sum();
        near(force / f64::from(count), 9.81, 0.5);
        near(bench.height(boxes[0]), 0.05, 1e-5);
    }
}

#[test]
fn bodies_that_are_near_do_not_touch() {
    // They fall by 2.5 mm in the sub-steps of half a call, towards a floor that is 9 mm away.
    for count in [1, 100] {
        let (mut bench, boxes) = boxes(count, 0.009);
        let call = bench.dynamics.begin(&mut bench.scene, 0.02);
        assert_eq!(
            call.map(|call| call.map(|call| call.sub_steps)),
            Ok(Some(4))
        );
        bench.sub_steps(4);
        assert_eq!(bench.dynamics.contacts().count(), 0, "{count}");
        assert!(bench.dynamics.touching().is_empty());
        // In steps of 5 ms, or in parts of them.
        let fallen = 0.059 - bench.height(boxes[0]);
        let in_steps = 9.81 * 0.005 * 0.005 * 10.0;
        assert!(
            (0.8 * in_steps..1.001 * in_steps).contains(&fallen),
            "{fallen}"
        );
    }
}

/// A plate of 1 kg that a force sensor holds, and boxes of 1 kg on it: up to a dozen are solved with it, more by the engine.
#[test]
fn a_sensor_reads_the_weight_of_what_lies_on_its_plate() {
    for count in [4_u32, 9, 25] {
        let mut bench = Bench::new();
        let base = bench.ghost([0.0, 0.0, 0.5], false);
        let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
        let sensor = bench.object(sensor, Pose::translation(0.0, 0.0, 0.9), base);
        let plate = bench.shape([2.0, 2.0, 0.1], [0.0, 0.0, 0.95], 1.0, true, true);
        bench.hang(plate, sensor);
        let side = f64::from(count).sqrt();
        for i in 0..count {
            let [x, y] = [i % side as u32, i / side as u32].map(|i| 0.2 * f64::from(i));
            bench.shape([0.1; 3], [x, y, 1.05], 1.0, true, true);
        }
        bench.run(20);
        // Of many that the engine solves the mean, since they tremble.
        let (force, torque) = mean_load(&mut bench, sensor, 40);
        let weight = 9.81 * f64::from(count + 1);
        near(force.z, -weight, 0.03 * weight);
        // The middle of the boxes is beside that of the plate along x and y.
        let lever = 0.1 * (side - 1.0) * 9.81 * f64::from(count);
        near(torque.x, -lever, 0.08 * lever);
        near(torque.y, lever, 0.08 * lever);
    }
}

/// The mean of what a sensor reads in so many calls.
fn mean_load(bench: &mut Bench, sensor: Handle, calls: usize) -> (Vector3<f64>, Vector3<f64>) {
    let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
    for _ in 0..calls {
        bench.run(1);
        let object = bench.scene.object(sensor).expect("exists");
        let read = object.force_sensor().expect("a sensor").filtered;
        let (its_force, its_torque) = read.expect("data");
        force += Vector3::from(its_force) / calls as f64;
        torque += Vector3::from(its_torque) / calls as f64;
    }
    (force, torque)
}

#[test]
fn a_body_that_starts_asleep_waits_unless_it_has_a_velocity() {
    let mut bench = Bench::new();
    let bodies = [0.0, 1.0, 2.0].map(|x| bench.ghost([x, 0.0, 5.0], true));
    for (at, &body) in bodies.iter().enumerate() {
        bench.change(body, |shape| {
            shape.dynamics.start_asleep = at < 2;
            shape.dynamics.initial_velocity.linear[0] = if at == 1 { 0.5 } else { 0.0 };
        });
    }
    bench.run(1);
    let drop = 0.013_488_75;
    near(bench.height(bodies[0]), 5.0, 1e-12);
    near(bench.height(bodies[1]), 5.0 - drop, 1e-6);
    near(bench.at(bodies[1])[0], 1.025, 1e-9);
    near(bench.height(bodies[2]), 5.0 - drop, 1e-6);
}

#[test]
fn answers_of_scripts_that_are_no_numbers_drive_nothing() {
    for answer in [(1.0, f64::NAN), (f64::INFINITY, 1.0), (1.0, f64::INFINITY)] {
        let mut bench = Bench::new();
        bench.gravity(0.0);
        let (joint, _) = bench.arm(0.01, 0.0, |joint| joint.control = Control::Callback);
        bench.run_with(2, None, |_| (Some(answer.0), Some(answer.1)));
        near(bench.joint(joint).position, 0.0, 1e-9);
    }
}
