//! Links that close a loop or hold a body alone, and an arm.

use super::*;

#[test]
fn welded_dummies_hold_a_body() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.0, 0.0, 2.0], false);
    let body = bench.ghost([0.0, 0.0, 1.5], true);
    let dummy = |link_type| {
        Kind::Dummy(Dummy {
            link_type,
            ..Dummy::new(0.01)
        })
    };
    let ends = [base, body].map(|parent| {
        bench.object(
            dummy(LinkType::LoopClosure),
            Pose::translation(0.0, 0.0, 1.75),
            parent,
        )
    });
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
fn a_long_arm_keeps_together_and_holds_its_pose() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 1.0], false);
    let mut joints = Vec::new();
    for i in 0..6 {
        let x = 0.2 * f64::from(i);
        let upright =
            nalgebra::UnitQuaternion::from_euler_angles(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
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
        near(
            joint.error.expect("simulated").translation.vector.norm(),
            0.0,
            1e-6,
        );
    }
    // Load of the first joint: six links of 1 kg, 0.1 to 1.1 m away.
    near(
        bench.joint(joints[0]).force.expect("simulated"),
        9.81 * 3.6,
        1e-3,
    );
}

#[test]
fn a_loop_with_more_ties_than_freedom_turns() {
    let mut bench = Bench::new();
    let base = bench.ghost([0.25, 0.0, 1.0], false);
    let bar = |bench: &mut Bench,
               size: [f64; 3],
               at: [f64; 3],
               from: [f64; 3],
               parent: Handle,
               speed: Option<f64>| {
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        if let Some(speed) = speed {
            (joint.control, joint.target_velocity, joint.target_force) =
                (Control::Velocity, speed, 100.0);
        }
        let joint = bench.object(Kind::Joint(Box::new(joint)), along_y(from), parent);
        let bar = bench.shape(size, at, 0.2, true, false);
        bench.hang(bar, joint);
        (joint, bar)
    };
    let (crank, left) = bar(
        &mut bench,
        [0.02, 0.02, 0.2],
        [0.0, 0.0, 1.1],
        [0.0, 0.0, 1.0],
        base,
        Some(2.0),
    );
    let (_, coupler) = bar(
        &mut bench,
        [0.5, 0.02, 0.02],
        [0.25, 0.0, 1.2],
        [0.0, 0.0, 1.2],
        left,
        None,
    );
    let (rocker, right) = bar(
        &mut bench,
        [0.02, 0.02, 0.2],
        [0.5, 0.0, 1.1],
        [0.5, 0.0, 1.0],
        base,
        None,
    );
    let corner = along_y([0.5, 0.0, 1.2]);
    let hinge = bench.object(
        Kind::Joint(Box::new(Joint::new(
            JointType::Revolute,
            JointMode::Dynamic,
        ))),
        corner,
        coupler,
    );
    let tie = || {
        Kind::Dummy(Dummy {
            link_type: LinkType::LoopClosure,
            ..Dummy::new(0.01)
        })
    };
    let ties = [hinge, right].map(|parent| bench.object(tie(), corner, parent));
    bench
        .scene
        .link_dummies(ties[0], Some(ties[1]))
        .expect("two dummies");
    bench.run(20);
    near(bench.joint(crank).position, 2.0, 1e-4);
    near(
        bench.joint(rocker).position,
        bench.joint(crank).position,
        1e-9,
    );
    near(bench.height(coupler) - 1.0, 0.2 * 2.0f64.cos(), 1e-3);
}

/// Two bars of 0.2 m between bases 0.5 m apart.
#[test]
fn a_loop_that_is_too_short_rests_open() {
    let mut bench = Bench::new();
    let [base, far] = [0.0, 0.5].map(|x| bench.ghost([x, 0.0, 1.0], false));
    let hinge = || {
        Kind::Joint(Box::new(Joint::new(
            JointType::Revolute,
            JointMode::Dynamic,
        )))
    };
    let mut last = base;
    for x in [0.0, 0.2] {
        let joint = bench.object(hinge(), along_y([x, 0.0, 1.0]), last);
        last = bench.shape([0.2, 0.02, 0.02], [x + 0.1, 0.0, 1.0], 0.5, true, false);
        bench.hang(last, joint);
    }
    let end = bench.object(hinge(), along_y([0.4, 0.0, 1.0]), last);
    let tie = || {
        Kind::Dummy(Dummy {
            link_type: LinkType::LoopClosure,
            ..Dummy::new(0.01)
        })
    };
    let ties = [(end, 0.4), (far, 0.5)]
        .map(|(parent, x)| bench.object(tie(), along_y([x, 0.0, 1.0]), parent));
    bench
        .scene
        .link_dummies(ties[0], Some(ties[1]))
        .expect("two dummies");
    bench.run(40);
    near(bench.height(last), 1.0, 0.01);
}
