//! The physics on scenes built by hand.

mod sleep;

use super::*;
use crate::scene::dummy::{Dummy, LinkType};
use crate::scene::force_sensor::ForceSensor;
use crate::scene::joint::Control;
use crate::scene::joint::JointType;
use crate::scene::mass::MassProperties;
use crate::scene::primitive::PrimitiveKind;
use crate::scene::shape::Shape;
use crate::scene::{Field, Kind, Pose};

const STEP: f64 = 0.05;

struct Bench {
    scene: Scene,
    dynamics: Dynamics,
}

impl Bench {
    fn new() -> Self {
        Self { scene: Scene::new(), dynamics: Dynamics::default() }
    }

    fn shape(&mut self, size: [f64; 3], at: [f64; 3], mass: f64, dynamic: bool, respondable: bool) -> Handle {
        let mut shape = Shape::primitive(PrimitiveKind::Cuboid, size, Default::default()).expect("a cuboid");
        shape.mass = MassProperties { mass, com: [0.0; 3], ..MassProperties::diagonal(mass, [0.01; 3]) };
        shape.dynamics.is_static = !dynamic;
        shape.dynamics.respondable = respondable;
        let handle = self.scene.add("body", Kind::Shape(Box::new(shape))).expect("room");
        self.scene.set_world_pose(handle, Pose::translation(at[0], at[1], at[2])).expect("exists");
        handle
    }

    fn ghost(&mut self, at: [f64; 3], dynamic: bool) -> Handle {
        self.shape([0.1; 3], at, 1.0, dynamic, false)
    }

    fn object(&mut self, kind: Kind, pose: Pose, parent: Handle) -> Handle {
        let handle = self.scene.add("link", kind).expect("room");
        self.scene.set_world_pose(handle, pose).expect("exists");
        self.scene.set_parent(handle, Some(parent), true).expect("no cycle");
        handle
    }

    fn hang(&mut self, child: Handle, parent: Handle) {
        self.scene.set_parent(child, Some(parent), true).expect("no cycle");
    }

    fn gravity(&mut self, z: f32) {
        self.scene.modify_settings(|settings| settings.dynamics.gravity = [0.0, 0.0, z]);
    }

    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            let Some(call) = self.dynamics.begin(&mut self.scene, STEP).expect("not busy") else { continue };
            for number in 1..=call.passes {
                self.dynamics.prepare(&self.scene, number);
                let mut pass =
                    self.dynamics.start_pass(&self.scene, number, Attention::default()).expect("there is a world");
                pass.run(None);
                self.dynamics.finish_pass(pass, &mut self.scene);
            }
            self.dynamics.end(&mut self.scene);
        }
    }

    fn height(&self, handle: Handle) -> f64 {
        self.scene.world_pose(handle).expect("exists").translation.z
    }

    /// Kinetic and potential, the engine's velocity being that of half a sub-step before.
    fn energy(&self, handle: Handle) -> f64 {
        let object = self.scene.object(handle).expect("exists");
        let shape = object.shape().expect("a shape");
        let pose = self.scene.world_pose(handle).expect("exists");
        let spin = pose.rotation.inverse() * nalgebra::Vector3::from(shape.velocity.angular);
        let speed = nalgebra::Vector3::from(shape.velocity.linear);
        let mass = &shape.mass;
        let kinetic = (speed.dot(&speed) + spin.dot(&(mass.inertia * spin))) * mass.mass / 2.0;
        kinetic + mass.mass * 9.81 * pose.translation.z
    }

    fn joint(&self, handle: Handle) -> &Joint {
        self.scene.object(handle).and_then(|object| object.joint()).expect("a joint")
    }

    /// Static base, joint along world +y at (0, 0, 1), arm of 1 kg whose centre is `reach` along x.
    fn arm(&mut self, own_inertia: f64, reach: f64, change: impl FnOnce(&mut Joint)) -> (Handle, Handle) {
        let base = self.ghost([0.0, 0.0, 1.0], false);
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        change(&mut joint);
        let joint = self.object(Kind::Joint(Box::new(joint)), along_y([0.0, 0.0, 1.0]), base);
        let arm = self.ghost([reach, 0.0, 1.0], true);
        let mass = MassProperties::diagonal(1.0, [own_inertia; 3]);
        self.scene
            .try_modify(arm, Field::Dynamics, |object| {
                object.shape_mut()?.mass = mass;
                Ok(())
            })
            .expect("a shape");
        self.hang(arm, joint);
        (joint, arm)
    }
}

/// Turned so that a joint's axis points along world +y.
fn along_y(at: [f64; 3]) -> Pose {
    let turn = nalgebra::UnitQuaternion::from_euler_angles(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
    Pose::from_parts(nalgebra::Translation3::from(at), turn)
}

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected}");
}

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
    let force: f64 = bench.dynamics.contacts().map(|contact| contact.seen_from(body).force[2]).sum();
    near(force / 10.0, 9.81, 0.01);
}

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
    near(bench.joint(joint).position, 0.1 * (1.0 - 0.9f64.powi(10)), 1e-5);
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
fn a_force_sensor_feels_force_and_lever() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, Pose::translation(0.0, 0.0, 2.0), base);
    let body = bench.ghost([0.1, 0.0, 1.9], true);
    bench.hang(body, sensor);
    bench.run(20);
    let object = bench.scene.object(sensor).expect("exists");
    let (force, torque) = object.force_sensor().expect("a sensor").filtered.expect("data");
    near(force[2], -9.81, 0.01);
    near(force[0].abs() + force[1].abs(), 0.0, 0.01);
    near(torque[1], 0.981, 2e-3);
    near(torque[0].abs() + torque[2].abs(), 0.0, 2e-3);
}

#[test]
fn welded_dummies_hold_a_body() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let body = bench.ghost([0.0, 0.0, 1.5], true);
    let dummy = |link_type| Kind::Dummy(Dummy { link_type, ..Dummy::new(0.01) });
    let ends = [base, body]
        .map(|parent| bench.object(dummy(LinkType::LoopClosure), Pose::translation(0.0, 0.0, 1.75), parent));
    for (end, partner) in [(ends[0], ends[1]), (ends[1], ends[0])] {
        let linked = bench.scene.try_modify(end, Field::Dynamics, |object| {
            object.dummy_mut()?.link = Some(partner);
            Ok(())
        });
        linked.expect("a dummy");
    }
    bench.run(20);
    near(bench.height(body), 1.5, 1e-3);
}

#[test]
fn two_joints_in_series_do_not_act() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let joint = || Kind::Joint(Box::new(Joint::new(JointType::Revolute, JointMode::Dynamic)));
    let first = bench.object(joint(), Pose::translation(0.0, 0.0, 2.0), base);
    let second = bench.object(joint(), Pose::translation(0.0, 0.0, 2.0), first);
    let body = bench.ghost([0.0, 0.0, 2.0], true);
    bench.hang(body, second);
    bench.run(1);
    assert!(!bench.dynamics.simulates(first) && !bench.dynamics.simulates(second));
    near(bench.height(body), 2.0 - 0.013_488_751, 1e-6);
}

#[test]
fn a_moving_platform_carries_a_box() {
    let mut bench = Bench::new();
    let platform = bench.shape([1.0, 1.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    for step in 1..=40 {
        bench.scene.set_world_pose(platform, Pose::translation(0.01 * f64::from(step), 0.0, -0.05)).expect("exists");
        bench.run(1);
    }
    near(bench.scene.world_pose(body).expect("exists").translation.x, 0.4, 0.02);
}

#[test]
fn a_call_within_a_call_is_refused() {
    let mut bench = Bench::new();
    bench.ghost([0.0, 0.0, 1.0], true);
    assert!(bench.dynamics.begin(&mut bench.scene, STEP).expect("free").is_some());
    assert_eq!(bench.dynamics.begin(&mut bench.scene, STEP), Err(Busy));
}

#[test]
fn a_long_arm_keeps_together_and_holds_its_pose() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 1.0], false);
    let mut joints = Vec::new();
    for i in 0..6 {
        let x = 0.2 * f64::from(i);
        let upright = nalgebra::UnitQuaternion::from_euler_angles(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        (joint.control, joint.target_force) = (Control::Position, 200.0);
        let pose = Pose::from_parts(nalgebra::Translation3::new(x, 0.0, 1.0), upright);
        let joint = bench.object(Kind::Joint(Box::new(joint)), pose, parent);
        parent = bench.shape([0.2, 0.05, 0.05], [x + 0.1, 0.0, 1.0], 1.0, true, false);
        bench.hang(parent, joint);
        joints.push(joint);
    }
    bench.run(20);
    for &handle in &joints {
        let joint = bench.joint(handle);
        near(joint.position, 0.0, 1e-6);
        near(joint.error.expect("simulated").translation.vector.norm(), 0.0, 1e-6);
    }
    // What the first joint carries: six links of 1 kg, 0.1 to 1.1 m away.
    near(bench.joint(joints[0]).force.expect("simulated"), 9.81 * 3.6, 1e-3);
}

#[test]
fn a_stack_stands_still() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let boxes: Vec<Handle> =
        (0..8).map(|i| bench.shape([0.1; 3], [0.0, 0.0, 0.05 + 0.102 * f64::from(i)], 1.0, true, true)).collect();
    bench.run(100);
    for (i, &handle) in boxes.iter().enumerate() {
        let pose = bench.scene.world_pose(handle).expect("exists");
        near(pose.translation.z, 0.05 + 0.1 * i as f64, 5e-3);
        near(pose.translation.x.hypot(pose.translation.y), 0.0, 1e-3);
    }
}

#[test]
fn a_swinging_chain_keeps_its_energy() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 1.0], false);
    let mut links = Vec::new();
    for i in 0..2 {
        let x = 0.2 * f64::from(i);
        let joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        let joint = bench.object(Kind::Joint(Box::new(joint)), along_y([x, 0.0, 1.0]), parent);
        parent = bench.shape([0.2, 0.05, 0.05], [x + 0.1, 0.0, 1.0], 1.0, true, false);
        bench.hang(parent, joint);
        links.push(parent);
    }
    let energy = |bench: &Bench| -> f64 { links.iter().map(|&link| bench.energy(link)).sum() };
    let before = energy(&bench);
    bench.run(100);
    near(energy(&bench), before, 0.05);
}

#[test]
fn a_screw_moves_along_while_it_turns() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 1.0], false);
    let mut screw = Joint::new(JointType::Revolute, JointMode::Dynamic);
    (screw.cyclic, screw.min, screw.range, screw.screw_lead) = (false, -100.0, 200.0, 0.01);
    (screw.control, screw.target_velocity, screw.target_force) = (Control::Velocity, std::f64::consts::TAU, 100.0);
    let screw = bench.object(Kind::Joint(Box::new(screw)), Pose::translation(0.0, 0.0, 1.0), base);
    let nut = bench.ghost([0.0, 0.0, 1.0], true);
    bench.hang(nut, screw);
    bench.run(40);
    near(bench.joint(screw).position, 2.0 * std::f64::consts::TAU, 1e-6);
    near(bench.height(nut), 1.02, 1e-6);
    // What the motor bears of the weight: mass, gravity, lead per radian.
    near(bench.joint(screw).force.expect("simulated"), -9.81 * 0.01 / std::f64::consts::TAU, 1e-6);
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
fn a_loop_with_more_ties_than_freedom_turns() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.25, 0.0, 1.0], false);
    let bar = |bench: &mut Bench, size: [f64; 3], at: [f64; 3], from: [f64; 3], parent: Handle, speed: Option<f64>| {
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        if let Some(speed) = speed {
            (joint.control, joint.target_velocity, joint.target_force) = (Control::Velocity, speed, 100.0);
        }
        let joint = bench.object(Kind::Joint(Box::new(joint)), along_y(from), parent);
        let bar = bench.shape(size, at, 0.2, true, false);
        bench.hang(bar, joint);
        (joint, bar)
    };
    let (crank, left) = bar(&mut bench, [0.02, 0.02, 0.2], [0.0, 0.0, 1.1], [0.0, 0.0, 1.0], base, Some(2.0));
    let (_, coupler) = bar(&mut bench, [0.5, 0.02, 0.02], [0.25, 0.0, 1.2], [0.0, 0.0, 1.2], left, None);
    let (rocker, right) = bar(&mut bench, [0.02, 0.02, 0.2], [0.5, 0.0, 1.1], [0.5, 0.0, 1.0], base, None);
    let corner = along_y([0.5, 0.0, 1.2]);
    let hinge =
        bench.object(Kind::Joint(Box::new(Joint::new(JointType::Revolute, JointMode::Dynamic))), corner, coupler);
    let tie = || Kind::Dummy(Dummy { link_type: LinkType::LoopClosure, ..Dummy::new(0.01) });
    let ties = [hinge, right].map(|parent| bench.object(tie(), corner, parent));
    bench.scene.link_dummies(ties[0], Some(ties[1])).expect("two dummies");
    bench.run(20);
    near(bench.joint(crank).position, 2.0, 1e-4);
    near(bench.joint(rocker).position, bench.joint(crank).position, 1e-9);
    near(bench.height(coupler) - 1.0, 0.2 * 2.0f64.cos(), 1e-3);
}

#[test]
fn a_propeller_makes_several_turns_in_a_sub_step() {
    let mut bench = Bench::new();
    for speed in [1000.0, 5000.0] {
        let (joint, _) = bench.arm(0.01, 0.0, |joint| {
            (joint.control, joint.target_velocity, joint.target_force) = (Control::Velocity, speed, 1e6);
        });
        bench.run(10);
        near(bench.joint(joint).velocity, speed, 1e-3);
    }
}

#[test]
fn a_chain_of_twenty_links_carries_a_load_a_hundred_times_as_heavy() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 3.0], false);
    for i in 0..20 {
        let z = 3.0 - 0.1 * f64::from(i);
        let joint = Kind::Joint(Box::new(Joint::new(JointType::Revolute, JointMode::Dynamic)));
        let joint = bench.object(joint, along_y([0.0, 0.0, z]), parent);
        let mass = if i == 19 { 100.0 } else { 1.0 };
        parent = bench.shape([0.02, 0.02, 0.1], [0.01, 0.0, z - 0.05], mass, true, false);
        bench.hang(parent, joint);
    }
    bench.run(100);
    near(bench.height(parent), 1.05, 0.01);
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
        bench.scene.set_local_pose(joint, Pose::from_parts(pose.translation, turn * pose.rotation)).expect("a place");
        bench.run(1);
    }
    let end = bench.scene.world_pose(body).expect("exists");
    near(start.rotation.angle_to(&end.rotation), 0.3, 1e-6);
    // The engine has this one joint only, not those of the places before.
    assert_eq!(bench.dynamics.world.as_ref().expect("a world").joints.len(), 1);
}
