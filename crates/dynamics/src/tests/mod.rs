//! The physics on scenes built by hand.

mod bench;
mod chains;
mod contacts;
mod driven;
mod first_contacts;
mod free_bodies;
mod joints;
mod loops;
mod masses;
mod mujoco;
mod particles;
mod random_trees;
mod roles;
mod sleep;
mod soft_bodies;
mod surfaces;
mod tumbling;

use bench::{Bench, STEP, along_y, near};

use super::*;
use scene::joint::Control;
use scene::joint::JointType;
use scene::object::dummy::{Dummy, LinkType};
use scene::sensor::force_sensor::ForceSensor;
use scene::{Field, Kind, Pose};

#[test]
fn free_fall_is_semi_implicit_euler() {
    let mut bench = Bench::new();
    let body = bench.ghost([0.0, 0.0, 10.0], true);
    bench.run(1);
    near(10.0 - bench.height(body), 0.013_488_751, 1e-7);
    bench.run(19);
    near(10.0 - bench.height(body), 4.929_525_2, 1e-5);
}

#[test]
fn a_box_rests_on_a_box() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.055], 1.0, true, true);
    bench.run(60);
    near(bench.height(body), 0.05, 5e-4);
    let force: f64 = bench
        .dynamics
        .contacts()
        .map(|contact| contact.seen_from(body).force[2])
        .sum();
    near(force / 10.0, 9.81, 0.01);
}

#[test]
fn a_force_sensor_feels_force_and_lever() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, Pose::translation(0.0, 0.0, 2.0), base);
    let body = bench.ghost([0.1, 0.0, 1.9], true);
    bench.hang(body, sensor);
    bench.run(20);
    let object = bench.scene.object(sensor).expect("exists");
    let (force, torque) = object
        .force_sensor()
        .expect("a sensor")
        .filtered
        .expect("data");
    near(force[2], -9.81, 0.01);
    near(force[0].abs() + force[1].abs(), 0.0, 0.01);
    near(torque[1], 0.981, 2e-3);
    near(torque[0].abs() + torque[2].abs(), 0.0, 2e-3);
}

#[test]
fn a_moving_platform_carries_a_box() {
    let mut bench = Bench::new();
    let platform = bench.shape([1.0, 1.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    for step in 1..=40 {
        bench
            .scene
            .set_world_pose(
                platform,
                Pose::translation(0.01 * f64::from(step), 0.0, -0.05),
            )
            .expect("exists");
        bench.run(1);
    }
    near(
        bench.scene.world_pose(body).expect("exists").translation.x,
        0.4,
        0.02,
    );
}

#[test]
fn a_call_within_a_call_is_refused() {
    let mut bench = Bench::new();
    bench.ghost([0.0, 0.0, 1.0], true);
    assert!(
        bench
            .dynamics
            .begin(&mut bench.scene, STEP)
            .expect("free")
            .is_some()
    );
    assert_eq!(bench.dynamics.begin(&mut bench.scene, STEP), Err(Busy));
}

#[test]
fn a_stack_stands_still() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let boxes: Vec<Handle> = (0..8)
        .map(|i| {
            bench.shape(
                [0.1; 3],
                [0.0, 0.0, 0.05 + 0.102 * f64::from(i)],
                1.0,
                true,
                true,
            )
        })
        .collect();
    bench.run(100);
    for (i, &handle) in boxes.iter().enumerate() {
        let pose = bench.scene.world_pose(handle).expect("exists");
        near(pose.translation.z, 0.05 + 0.1 * i as f64, 5e-3);
        near(pose.translation.x.hypot(pose.translation.y), 0.0, 1e-3);
    }
}
