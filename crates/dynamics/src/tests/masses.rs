//! Bodies answer forces with the mass that their shape says, wherever its parts are, and whatever changes.

use geometry::MassProperties;
use nalgebra::{UnitQuaternion, Vector3};
use scene::sensor::force_sensor::ForceSensor;

use super::*;

/// Poses of the parts of a shape: beside its origin, turned, and several of them.
fn part_poses() -> Vec<Vec<Pose>> {
    let beside = Pose::translation(0.3, 0.2, -0.1);
    let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 0.5);
    let turned = Pose::from_parts(Vector3::new(-0.2, 0.1, 0.4).into(), turn);
    vec![
        vec![beside],
        vec![turned],
        vec![beside, turned],
        vec![turned, Pose::identity()],
        vec![turned, turned * beside],
        vec![beside, Pose::identity()],
    ]
}

/// Light plates too, of which the moments about two axes are the same, and small.
#[test]
fn forces_and_torques_are_answered_by_mass_and_moments() {
    let bodies = [(2.0, [0.02, 0.04, 0.05]), (0.001, [0.002, 0.001, 0.001])];
    for poses in part_poses() {
        for (mass, moments) in bodies {
            let mut bench = Bench::new();
            bench.gravity(0.0);
            let body = bench.shape([0.1; 3], [0.0; 3], mass, true, true);
            let [force, torque] =
                [1.0, -0.5].map(|size| Vector3::new(1.0, 2.0, -1.0) * size * mass);
            let torque = torque * 0.01;
            bench.change(body, |shape| {
                let part = shape.parts[0].clone();
                shape.parts = poses
                    .iter()
                    .map(|pose| scene::shape::Part {
                        pose: *pose,
                        ..part.clone()
                    })
                    .collect();
                shape.mass = MassProperties::diagonal(mass, moments);
                shape.mass.com = [0.1, -0.2, 0.05];
                (shape.force, shape.torque) = (force.into(), torque.into());
            });
            bench.run(1);
            let velocity = bench.shape_of(body).velocity;
            let pushed = Vector3::from(velocity.linear) - force * STEP / mass;
            near(pushed.norm(), 0.0, 1e-9);
            let expected = torque.component_div(&Vector3::from(moments)) * STEP / mass;
            let turned = Vector3::from(velocity.angular) - expected;
            near(turned.norm(), 0.0, 0.02 * expected.norm());
        }
    }
}

#[test]
fn a_sensor_reads_what_the_body_on_its_plate_weighs_now() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 0.5], false);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, Pose::translation(0.0, 0.0, 0.9), base);
    let plate = bench.shape([1.0, 1.0, 0.1], [0.0, 0.0, 0.95], 1.0, true, true);
    bench.hang(plate, sensor);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 1.05], 1.0, true, true);
    for mass in [1.0, 3.0, 0.5] {
        bench.change(body, |shape| shape.mass.mass = mass);
        bench.run(20);
        let object = bench.scene.object(sensor).expect("exists");
        let read = object.force_sensor().expect("a sensor").filtered;
        let (force, _) = read.expect("data");
        near(force[2], -9.81 * (1.0 + mass), 0.01);
    }
}

/// With the exact solution, and by the joints of the engine alone.
#[test]
fn a_propeller_is_read_as_fast_as_it_turns() {
    use scene::joint::JointSolver::{Exact, Impulse};
    for (speed, solver) in [(2000.0, Exact), (-2000.0, Exact), (1000.0, Impulse)] {
        let mut bench = Bench::new();
        bench.gravity(0.0);
        let (joint, _) = bench.arm(0.01, 0.0, |joint| {
            (joint.control, joint.target_velocity, joint.target_force) =
                (Control::Velocity, speed, 1e6);
            joint.solver = solver;
        });
        bench.run(4);
        for _ in 0..3 {
            bench.run(1);
            near(bench.joint(joint).velocity, speed, 1e-3 * speed.abs());
        }
    }
}
