//! Which objects take part in the physics, and what scripts read about that.

use scene::DynamicFlags;
use scene::sensor::force_sensor::ForceSensor;

use super::*;

fn flags(bench: &Bench, object: Handle) -> DynamicFlags {
    bench.scene.object(object).expect("exists").dynamic_flag
}

#[test]
fn shapes_joints_and_sensors_say_whether_they_take_part() {
    let mut bench = Bench::new();
    let base = bench.shape([0.1; 3], [0.0, 0.0, 5.0], 1.0, false, true);
    let joint = |mode| Kind::Joint(Box::new(Joint::new(JointType::Revolute, mode)));
    let at = Pose::translation(0.0, 0.0, 5.0);
    let hinge = bench.object(joint(JointMode::Dynamic), at, base);
    let arm = bench.shape([0.1; 3], [0.0, 0.0, 4.0], 1.0, true, true);
    bench.hang(arm, hinge);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, at, arm);
    let tip = bench.ghost([0.0, 0.0, 3.0], true);
    bench.hang(tip, sensor);
    let kinematic = bench.object(joint(JointMode::Kinematic), at, base);
    let loose = bench.ghost([2.0, 0.0, 5.0], true);
    bench.hang(loose, kinematic);
    bench.run(1);
    let both = DynamicFlags::RESPONDABLE | DynamicFlags::DYNAMIC;
    for (object, expected) in [
        (base, DynamicFlags::RESPONDABLE),
        (arm, both),
        (tip, DynamicFlags::DYNAMIC),
        (hinge, DynamicFlags::JOINT),
        (sensor, DynamicFlags::FORCE_SENSOR),
        (kinematic, DynamicFlags::empty()),
        (loose, DynamicFlags::DYNAMIC),
    ] {
        assert_eq!(flags(&bench, object), expected);
    }
    // A joint that the physics does not move holds nothing.
    near(bench.height(loose), 5.0 - 0.013_488_75, 1e-6);
}

/// Two dummies on a body and on what it hangs on, linked with each other.
fn linked(link_type: LinkType) -> (Bench, Handle, [Handle; 2]) {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let body = bench.ghost([0.0, 0.0, 1.5], true);
    let ends = [base, body].map(|parent| {
        let dummy = Dummy {
            link_type,
            ..Dummy::new(0.01)
        };
        let at = Pose::translation(0.0, 0.0, 1.75);
        bench.object(Kind::Dummy(dummy), at, parent)
    });
    for (end, partner) in [(ends[0], ends[1]), (ends[1], ends[0])] {
        let linked = bench.scene.try_modify(end, Field::Dynamics, |object| {
            object.dummy_mut()?.link = Some(partner);
            Ok(())
        });
        linked.expect("a dummy");
    }
    (bench, body, ends)
}

#[test]
fn dummies_hold_a_body_where_they_close_a_loop() {
    let (mut bench, body, ends) = linked(LinkType::LoopClosure);
    bench.run(4);
    near(bench.height(body), 1.5, 1e-3);
    assert_eq!(ends.map(|end| flags(&bench, end)), [DynamicFlags::DUMMY; 2]);
    let (mut bench, body, ends) = linked(LinkType::Default);
    bench.run(1);
    near(bench.height(body), 1.5 - 0.013_488_75, 1e-6);
    let none = DynamicFlags::empty();
    assert_eq!(ends.map(|end| flags(&bench, end)), [none; 2]);
}
