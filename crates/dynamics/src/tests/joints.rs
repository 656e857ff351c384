//! Single joints: control, stops, readings.

use std::f64::consts::PI;

use super::*;
use scene::joint::JointSolver;

#[test]
fn position_control_decays_geometrically() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (joint, _) = bench.arm(0.01, 0.0, |joint| {
        joint.control = Control::Position;
        joint.target_force = 1000.0;
        joint.target_position = 0.1;
    });
    bench.run(1);
    near(
        bench.joint(joint).position,
        0.1 * (1.0 - 0.9f64.powi(10)),
        1e-5,
    );
}

#[test]
fn a_cyclic_joint_asked_for_half_a_turn_turns_the_way_of_its_sign() {
    for target in [PI, -PI] {
        let mut bench = Bench::new();
        bench.gravity(0.0);
        let (joint, _) = bench.arm(0.01, 0.0, |joint| {
            (joint.control, joint.target_force, joint.target_position) =
                (Control::Position, 1000.0, target);
        });
        bench.run(1);
        let turned = bench.joint(joint).position;
        assert!(
            turned / target > 0.05,
            "on the way to {target} it is at {turned}"
        );
    }
}

#[test]
fn a_held_arm_reads_the_torque_of_its_weight() {
    let mut bench = Bench::new();
    let (joint, arm) = bench.arm(0.01, 0.1, |joint| {
        joint.control = Control::Position;
        joint.target_force = 50.0;
    });
    bench.run(20);
    near(bench.joint(joint).force.expect("simulated"), 0.981, 1e-3);
    near(bench.height(arm), 1.0, 1e-4);
    assert!(bench.dynamics.simulates(joint));
}

#[test]
fn a_free_arm_swings() {
    let mut bench = Bench::new();
    let (joint, _) = bench.arm(0.02, 0.1, |_| {});
    bench.run(1);
    near(bench.joint(joint).velocity, 1.635, 5e-3);
}

#[test]
fn two_joints_in_series_do_not_act() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let joint = || {
        Kind::Joint(Box::new(Joint::new(
            JointType::Revolute,
            JointMode::Dynamic,
        )))
    };
    let first = bench.object(joint(), Pose::translation(0.0, 0.0, 2.0), base);
    let second = bench.object(joint(), Pose::translation(0.0, 0.0, 2.0), first);
    let body = bench.ghost([0.0, 0.0, 2.0], true);
    bench.hang(body, second);
    bench.run(1);
    assert!(!bench.dynamics.simulates(first) && !bench.dynamics.simulates(second));
    near(bench.height(body), 2.0 - 0.013_488_751, 1e-6);
}

#[test]
fn a_screw_moves_along_while_it_turns() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 1.0], false);
    let mut screw = Joint::new(JointType::Revolute, JointMode::Dynamic);
    (screw.cyclic, screw.min, screw.range, screw.screw_lead) = (false, -100.0, 200.0, 0.01);
    (screw.control, screw.target_velocity, screw.target_force) =
        (Control::Velocity, std::f64::consts::TAU, 100.0);
    let screw = bench.object(
        Kind::Joint(Box::new(screw)),
        Pose::translation(0.0, 0.0, 1.0),
        base,
    );
    let nut = bench.ghost([0.0, 0.0, 1.0], true);
    bench.hang(nut, screw);
    bench.run(40);
    near(
        bench.joint(screw).position,
        2.0 * std::f64::consts::TAU,
        1e-6,
    );
    near(bench.height(nut), 1.02, 1e-6);
    // Torque of the weight on the motor: mass, gravity, lead per radian.
    near(
        bench.joint(screw).force.expect("simulated"),
        -9.81 * 0.01 / std::f64::consts::TAU,
        1e-6,
    );
}

#[test]
fn a_stop_holds_what_the_motor_cannot_overcome() {
    let mut bench = Bench::new();
    let (joint, _) = bench.arm(0.01, 0.1, |joint| {
        (joint.cyclic, joint.min, joint.range) = (false, -0.5, 1.0);
        (joint.control, joint.target_velocity, joint.target_force) = (Control::Velocity, 1.0, 2.0);
    });
    bench.run(40);
    near(bench.joint(joint).position, 0.5, 1e-6);
    near(bench.joint(joint).force.expect("simulated"), -2.0, 1e-6);
}

#[test]
fn a_propeller_makes_several_turns_in_a_sub_step() {
    let mut bench = Bench::new();
    for speed in [1000.0, 5000.0] {
        let (joint, _) = bench.arm(0.01, 0.0, |joint| {
            (joint.control, joint.target_velocity, joint.target_force) =
                (Control::Velocity, speed, 1e6);
        });
        bench.run(10);
        near(bench.joint(joint).velocity, speed, 1e-3);
    }
}

#[test]
fn a_joint_that_is_placed_takes_its_body_along() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (joint, body) = bench.arm(0.01, 0.3, |joint| joint.control = Control::Free);
    bench.run(1);
    let turn = nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::z_axis(), 0.1);
    let start = bench.scene.world_pose(body).expect("exists");
    for _ in 0..3 {
        let pose = bench.scene.object(joint).expect("exists").pose();
        bench
            .scene
            .set_local_pose(
                joint,
                Pose::from_parts(pose.translation, turn * pose.rotation),
            )
            .expect("a place");
        bench.run(1);
    }
    let end = bench.scene.world_pose(body).expect("exists");
    near(start.rotation.angle_to(&end.rotation), 0.3, 1e-6);
    // The engine has this one joint only, not those of the places before.
    assert_eq!(
        bench.dynamics.world.as_ref().expect("a world").joints.len(),
        1
    );
}

#[test]
fn a_chain_of_which_a_joint_asks_for_it_is_left_to_rapier() {
    let mut bench = Bench::new();
    let (joint, arm) = bench.arm(0.01, 0.1, |joint| {
        (joint.control, joint.target_force, joint.solver) =
            (Control::Position, 50.0, JointSolver::Impulse);
    });
    let sensor = bench.object(
        Kind::ForceSensor(Box::<ForceSensor>::default()),
        Pose::translation(0.2, 0.0, 1.0),
        arm,
    );
    let tip = bench.ghost([0.3, 0.0, 1.0], true);
    bench.hang(tip, sensor);
    bench.run(40);
    assert!(bench.dynamics.mechanisms.is_empty());
    near(bench.height(arm), 1.0, 1e-2);
    near(
        bench.joint(joint).force.expect("simulated"),
        9.81 * (0.1 + 0.3),
        0.05,
    );
    let object = bench.scene.object(sensor).expect("exists");
    let (force, torque) = object
        .force_sensor()
        .expect("a sensor")
        .filtered
        .expect("data");
    near(force[2], -9.81, 0.05);
    near(torque[1], 0.981, 0.05);
    let changed = bench.scene.try_modify(joint, Field::Joint, |object| {
        object.joint_mut()?.solver = JointSolver::Exact;
        Ok(())
    });
    changed.expect("a joint");
    bench.run(20);
    assert!(!bench.dynamics.mechanisms.is_empty());
    near(bench.height(arm), 1.0, 1e-4);
}

#[test]
fn a_screw_keeps_its_chain_exact() {
    let mut bench = Bench::new();
    bench.arm(0.01, 0.1, |joint| {
        (joint.solver, joint.screw_lead) = (JointSolver::Impulse, 0.01);
    });
    bench.run(1);
    assert!(!bench.dynamics.mechanisms.is_empty());
}
