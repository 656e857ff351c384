//! Joints that scripts or other joints drive, stops, screws of mechanisms, and what joints and force sensors read.

use super::*;
use nalgebra::UnitQuaternion;
use scene::joint::{JointDependency, JointSolver};

/// An arm about an axis through its centre of mass, 0.01 kg m2, without gravity.
fn rotor(change: impl FnOnce(&mut Joint)) -> (Bench, Handle) {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (joint, _) = bench.arm(0.01, 0.0, change);
    (bench, joint)
}

#[test]
fn a_script_is_told_where_the_joint_is_and_its_answer_drives_it() {
    let (mut bench, joint) = rotor(|joint| {
        joint.control = Control::Callback;
        joint.target_position = 0.3;
    });
    let mut requests = Vec::new();
    bench.run_with(2, None, |request| {
        requests.push(request.clone());
        (Some(1.0), Some(100.0))
    });
    let first = &requests[0];
    assert_eq!(
        (first.joint, first.first, requests.len()),
        (joint, true, 20)
    );
    assert_eq!(
        (first.position, first.velocity, first.error),
        (0.0, 0.0, 0.3)
    );
    let last = &requests[19];
    near(last.position, 19.0 * 0.005, 1e-6);
    near(last.velocity, 1.0, 1e-6);
    near(last.error, 0.3 - last.position, 1e-12);
    assert!(requests[1..].iter().all(|request| !request.first));
    // 1 rad/s in one sub-step takes 2 N m; the reading is what the parent feels.
    near(requests[1].effort, -2.0, 1e-6);
    near(bench.joint(joint).position, 0.1, 1e-6);
}

#[test]
fn a_script_that_gives_a_force_only_pushes_with_it() {
    let (mut bench, joint) = rotor(|joint| joint.control = Control::Callback);
    bench.run_with(1, None, |_| (None, Some(-0.1)));
    near(bench.joint(joint).velocity, -0.5, 1e-6);
    near(bench.joint(joint).force.expect("simulated"), 0.1, 1e-9);
    bench.run_with(1, None, |_| (None, None));
    near(bench.joint(joint).velocity, -0.5, 1e-6);
}

/// Beside the rotor another one, which follows a joint.
fn follower(bench: &mut Bench, master: Handle) -> Handle {
    let mut joint = Joint::new(JointType::Revolute, JointMode::Dependent);
    joint.dependency = Some(JointDependency {
        master,
        offset: 0.1,
        coefficient: 2.0,
    });
    let base = bench.ghost([1.0, 0.0, 1.0], false);
    let joint = bench.object(Kind::Joint(Box::new(joint)), along_y([1.0, 0.0, 1.0]), base);
    let body = bench.ghost([1.0, 0.0, 1.0], true);
    bench.hang(body, joint);
    joint
}

#[test]
fn a_joint_follows_another_one_of_the_physics() {
    let (mut bench, master) = rotor(|joint| {
        (joint.control, joint.target_velocity, joint.target_force) =
            (Control::Velocity, 0.5, 100.0);
    });
    let follower = follower(&mut bench, master);
    bench.run(20);
    near(bench.joint(master).position, 0.5, 1e-6);
    near(bench.joint(follower).position, 0.1 + 2.0 * 0.5, 1e-3);
    near(bench.joint(follower).velocity, 1.0, 1e-3);
}

#[test]
fn a_joint_follows_one_that_holds_nothing() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let mut master = Joint::new(JointType::Prismatic, JointMode::Dynamic);
    master.position = 0.3;
    let base = bench.ghost([0.0; 3], false);
    let master = bench.object(Kind::Joint(Box::new(master)), Pose::identity(), base);
    let follower = follower(&mut bench, master);
    bench.run(2);
    near(bench.joint(follower).position, 0.7, 1e-6);
}

#[test]
fn a_slider_falls_onto_its_stop() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 1.0], false);
    let mut slider = Joint::new(JointType::Prismatic, JointMode::Dynamic);
    (slider.min, slider.range) = (-0.1, 0.3);
    let joint = bench.object(
        Kind::Joint(Box::new(slider)),
        Pose::translation(0.0, 0.0, 1.0),
        base,
    );
    let body = bench.ghost([0.0, 0.0, 1.0], true);
    bench.hang(body, joint);
    bench.run(2);
    // Free fall for 20 sub-steps.
    near(
        bench.joint(joint).position,
        -9.81 * 0.005 * 0.005 * 210.0,
        1e-6,
    );
    bench.run(18);
    near(bench.joint(joint).position, -0.1, 1e-4);
    near(bench.height(body), 0.9, 1e-4);
    near(bench.joint(joint).force.expect("simulated"), 0.0, 1e-9);
    bench.gravity(9.81);
    bench.run(20);
    near(bench.joint(joint).position, 0.2, 1e-4);
}

#[test]
fn a_hinge_has_stops_unless_its_range_is_a_full_turn_or_it_is_cyclic() {
    let turn = std::f64::consts::TAU;
    let cases = [
        (false, 358.0, f64::to_radians(179.0)),
        (false, 359.5, 4.0),
        (true, 20.0, 4.0 - turn),
    ];
    for (cyclic, range, expected) in cases {
        let (mut bench, joint) = rotor(|joint| {
            joint.cyclic = cyclic;
            (joint.min, joint.range) = (-f64::to_radians(range) / 2.0, f64::to_radians(range));
            (joint.control, joint.target_velocity, joint.target_force) =
                (Control::Velocity, 4.0, 1e3);
        });
        bench.run(20);
        near(bench.joint(joint).position, expected, 1e-6);
    }
}

#[test]
fn positions_that_are_shown_keep_to_enforced_limits() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let shown = [false, true].map(|enforced| {
        let (joint, _) = bench.arm(0.01, 0.0, |joint| {
            (joint.cyclic, joint.min, joint.range) = (false, -0.5, 7.0);
            joint.enforce_limits = enforced;
            (joint.control, joint.target_velocity, joint.target_force) =
                (Control::Velocity, -4.0, 1e3);
        });
        joint
    });
    bench.run(4);
    let positions = shown.map(|joint| bench.joint(joint).position);
    near(positions[0], -0.8, 1e-6);
    near(positions[1], -0.5, 1e-12);
}

/// Sensors in a row on a bracket that is turned: each bears what is beyond it.
fn turned_sensors(solver: JointSolver) -> (Bench, [Handle; 2]) {
    let mut bench = Bench::new();
    let turn = UnitQuaternion::from_euler_angles(0.4, -0.3, 0.8);
    let at = |x: f64| Pose::from_parts(nalgebra::Translation3::new(x, 0.0, 2.0), turn);
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let mut hinge = Joint::new(JointType::Revolute, JointMode::Dynamic);
    (hinge.solver, hinge.control, hinge.target_force) = (solver, Control::Position, 1e3);
    let hinge = bench.object(Kind::Joint(Box::new(hinge)), at(0.0), base);
    let mut last = bench.ghost([0.1, 0.0, 2.0], true);
    bench.hang(last, hinge);
    let sensors = [0.2, 0.4].map(|x| {
        let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
        let sensor = bench.object(sensor, at(x), last);
        last = bench.ghost([x + 0.1, 0.05, 2.0], true);
        bench.hang(last, sensor);
        sensor
    });
    (bench, sensors)
}

#[test]
fn turned_sensors_read_force_and_lever_in_their_frames() {
    for (solver, steps, tolerance) in [
        (JointSolver::Exact, 10, 1e-3),
        (JointSolver::Impulse, 60, 0.1),
    ] {
        let (mut bench, sensors) = turned_sensors(solver);
        bench.run(steps);
        // Bodies of 1 kg, 0.1 m and 0.3 m beyond the first sensor, 0.1 m beyond the second one.
        for (sensor, mass, moment) in [(sensors[0], 2.0, 0.4), (sensors[1], 1.0, 0.1)] {
            let object = bench.scene.object(sensor).expect("exists");
            let read = object.force_sensor().expect("a sensor").filtered;
            let (force, torque) = read.expect("data");
            let turn = bench.pose(sensor).rotation;
            let [force, torque] = [force, torque].map(|v| turn * nalgebra::Vector3::from(v));
            let weight = nalgebra::Vector3::new(0.0, 0.0, -9.81 * mass);
            near((force - weight).norm(), 0.0, tolerance);
            let lever = nalgebra::Vector3::new(-0.05 * mass, moment, 0.0) * 9.81;
            near((torque - lever).norm(), 0.0, tolerance);
        }
    }
}

#[test]
fn a_damped_body_slows_its_joint_down() {
    let (mut bench, joint) = rotor(|joint| joint.control = Control::Free);
    let arm = bench.scene.object(joint).expect("exists").children()[0];
    bench.change(arm, |shape| {
        shape.dynamics.initial_velocity.angular = [0.0, 3.0, 0.0];
        shape.material.angular_damping = 0.5;
    });
    bench.run(20);
    near(bench.joint(joint).velocity, 3.0 * (-0.5f64).exp(), 0.01);
}
