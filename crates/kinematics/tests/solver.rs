//! The solver: numbers known from elsewhere, forward kinematics, priorities, limits, flags.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use kinematics::*;
use support::{Arm, random_chain};

#[track_caller]
fn close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    assert!(
        a.iter().zip(b).all(|(x, y)| (x - y).abs() < tolerance),
        "{a:?} is not {b:?}"
    );
}

/// The planar arm, with a target a little away from the tip.
fn planar(method: Method, damping: f64, iterations: u32) -> Arm {
    let mut arm = Arm::planar();
    arm.aim(Pose::translation(0.01, -0.02, 0.0) * arm.tip_pose());
    arm.set_element(|element| {
        element.constraints = Constraints(Constraints::X.0 | Constraints::Y.0);
    });
    arm.set_group(|group| {
        (group.method, group.damping, group.iterations) = (method, damping, iterations);
    });
    arm
}

#[test]
fn m11_one_iteration_of_each_method() {
    close(
        Arm::planar().tip_pose().translation.vector.as_slice(),
        &[0.788473229, 0.539423558, 0.0],
        1e-9,
    );
    for (method, damping, expected) in [
        (Method::DampedLeastSquares, 0.1, [0.272241117, 0.609748405]),
        (Method::PseudoInverse, 0.0, [0.266525938, 0.620570460]),
        (Method::JacobianTranspose, 0.0, [0.278836300, 0.589867266]),
    ] {
        let mut arm = planar(method, damping, 1);
        arm.handle();
        close(&arm.config(), &expected, 1e-9);
    }
}

#[test]
fn m11_many_iterations() {
    for method in [Method::PseudoInverse, Method::UndampedPseudoInverse] {
        let mut arm = planar(method, 0.0, 20);
        arm.set_element(|element| element.precision = [1e-9, 1e-9]);
        let outcome = arm.handle();
        close(&arm.config(), &[0.267466831, 0.618549038], 1e-9);
        assert!(outcome.is_success() && outcome.flags.is_empty() && outcome.precision[0] < 1e-9);
    }
}

#[test]
fn m12_out_of_reach() {
    for method in [
        Method::PseudoInverse,
        Method::DampedLeastSquares,
        Method::UndampedPseudoInverse,
    ] {
        let mut arm = planar(method, 0.1, 20);
        arm.aim(Pose::translation(1.2, 0.0, 0.0));
        let outcome = arm.handle();
        assert!(
            !outcome.is_success() && outcome.flags.contains(Flags::NOT_WITHIN_TOLERANCE),
            "{outcome:?}"
        );
        assert!(arm.config().iter().all(|q| q.is_finite()));
    }
}

#[test]
fn m13_already_there() {
    let mut arm = planar(Method::PseudoInverse, 0.0, 3);
    arm.reach();
    let outcome = arm.handle();
    assert!(outcome.flags.is_empty());
    close(&outcome.precision, &[0.0; 2], 1e-12);
    close(&arm.config(), &[0.3, 0.6], 1e-15);
}

#[test]
fn joints_return_when_the_precision_is_missed() {
    let mut arm = planar(Method::PseudoInverse, 0.0, 5);
    arm.aim(Pose::translation(1.2, 0.0, 0.0));
    arm.set_group(|group| group.flags.insert(GroupFlags::RESTORE_ON_BAD_LINEAR));
    let outcome = arm.handle();
    assert!(outcome.precision[0] > 0.1 && !outcome.is_success());
    close(&arm.config(), &[0.3, 0.6], 1e-15);
}

#[test]
fn steps_are_bounded_where_they_are_asked_to_be() {
    let mut arm = planar(Method::PseudoInverse, 0.0, 1);
    arm.aim(Pose::translation(0.3, 0.6, 0.0));
    let mut free = planar(Method::PseudoInverse, 0.0, 1);
    free.aim(Pose::translation(0.3, 0.6, 0.0));
    arm.set_group(|group| group.flags.remove(GroupFlags::IGNORE_MAX_STEPS));
    let outcome = arm.handle();
    assert!(outcome.flags.contains(Flags::STEPS_TOO_BIG));
    let largest = arm
        .config()
        .iter()
        .zip([0.3, 0.6])
        .map(|(q, before)| (q - before).abs())
        .fold(0.0, f64::max);
    close(&[largest], &[10_f64.to_radians() / 1.1], 1e-12);
    free.handle();
    assert!((free.config()[0] - 0.3).abs() > 0.2, "{:?}", free.config());
}

#[test]
fn limits_stop_joints_and_are_reported() {
    let mut arm = planar(Method::PseudoInverse, 0.0, 1);
    arm.limit(&[(0.29, 1.0), (0.0, 2.0)]);
    let outcome = arm.handle();
    assert!(outcome.flags.contains(Flags::LIMIT_HIT));
    assert_eq!(arm.config()[0], 0.29);
    let hits = arm.env.group(arm.group).unwrap().limit_hits().to_vec();
    assert_eq!(hits[0].joint, arm.joints[0]);
    close(&[hits[0].overshoot], &[0.266525938 - 0.29], 1e-9);

    let mut avoiding = planar(Method::PseudoInverse, 0.0, 30);
    avoiding.limit(&[(0.29, 1.0), (0.0, 2.0)]);
    avoiding.reach();
    avoiding.set_group(|group| group.flags.insert(GroupFlags::AVOID_LIMITS));
    avoiding
        .set_element(|element| (element.constraints, element.precision[0]) = (Constraints::X, 0.0));
    avoiding.handle();
    close(&[avoiding.config()[0]], &[0.29 + 5_f64.to_radians()], 1e-6);
}

#[test]
fn joints_with_a_weight_of_zero_stay() {
    let mut arm = Arm::panda();
    arm.set_config(&[0.1, -0.4, 0.2, -1.8, 0.3, 1.9, 0.4]);
    arm.aim(Pose::translation(0.01, 0.02, -0.01) * arm.tip_pose());
    arm.set_group(|group| group.iterations = 20);
    arm.env.joint_mut(arm.joints[2]).unwrap().weight = 0.0;
    assert!(arm.handle().is_success());
    assert_eq!(arm.config()[2], 0.2);
}

/// The Jacobian is the derivative of forward kinematics.
#[test]
fn jacobians_equal_differences() {
    let mut random = Random::new(5);
    for joints in 2..=12 {
        let mut arm = random_chain(&mut random, joints);
        let config: Vec<f64> = (0..joints).map(|_| random.uniform() - 0.5).collect();
        arm.set_config(&config);
        let tip = arm.tip_pose();
        let equations = arm.env.equations(arm.group).unwrap().unwrap();
        assert_eq!(
            equations
                .columns
                .iter()
                .map(|column| column.joint)
                .collect::<Vec<_>>(),
            arm.joints
        );
        for column in 0..joints {
            let step = 1e-7;
            let mut moved = config.clone();
            moved[column] += step;
            arm.set_config(&moved);
            let linear = (arm.tip_pose().translation.vector - tip.translation.vector) / step;
            let angular = (arm.tip_pose().rotation * tip.rotation.inverse()).scaled_axis() / step;
            let expected: Vec<f64> = linear.iter().chain(angular.iter()).copied().collect();
            let rows: Vec<f64> = (0..6)
                .map(|row| equations.jacobian[row * joints + column])
                .collect();
            close(&rows, &expected, 1e-5);
        }
    }
}

/// Whatever the solver says it has reached, forward kinematics says too.
#[test]
fn random_chains_of_2_to_12_joints_reach_near_targets() {
    let mut random = Random::new(11);
    let (mut solved, mut all) = (0, 0);
    for joints in 2..=12 {
        for _ in 0..20 {
            let mut arm = random_chain(&mut random, joints);
            let config: Vec<f64> = (0..joints).map(|_| random.uniform() - 0.5).collect();
            let near: Vec<f64> = config
                .iter()
                .map(|q| q + 0.1 * (random.uniform() - 0.5))
                .collect();
            arm.set_config(&near);
            arm.reach();
            arm.set_config(&config);
            arm.set_group(|group| {
                (group.method, group.damping, group.iterations) =
                    (Method::DampedLeastSquares, 0.01, 100);
            });
            let outcome = arm.handle();
            close(&outcome.precision, &arm.gap(), 1e-9);
            all += 1;
            if outcome.is_success() {
                solved += 1;
                assert!(arm.gap()[0] <= 0.0005 && arm.gap()[1] <= 0.1_f64.to_radians());
            }
        }
    }
    assert!(solved * 100 >= all * 95, "{solved} of {all}");
}

#[test]
fn partial_orientations() {
    for constraints in [
        Constraints::ALPHA_BETA,
        Constraints::GAMMA,
        Constraints(15),
        Constraints(23),
        Constraints(9),
    ] {
        let mut arm = Arm::panda();
        arm.set_config(&[0.3, -0.4, 0.5, -1.5, 0.2, 1.7, 0.1]);
        arm.reach();
        arm.set_config(&[0.2, -0.3, 0.4, -1.6, 0.3, 1.6, 0.9]);
        arm.set_element(|element| element.constraints = constraints);
        arm.set_group(|group| group.iterations = 50);
        let outcome = arm.handle();
        assert!(outcome.is_success(), "{constraints:?} {outcome:?}");
        let (tip, target) = (
            arm.tip_pose(),
            arm.env.pose(arm.target, Frame::World).unwrap(),
        );
        let z = [tip, target].map(|pose| pose.rotation * nalgebra::Vector3::z());
        if constraints.contains(Constraints::ALPHA_BETA) {
            assert!(z[0].angle(&z[1]) < 0.002);
        }
    }
}

#[test]
fn constraints_are_along_the_axes_of_their_base() {
    let mut arm = Arm::planar();
    let base = arm.env.create_dummy("base");
    let turn = nalgebra::UnitQuaternion::from_scaled_axis(nalgebra::Vector3::z() * 0.5);
    arm.env
        .set_pose(
            base,
            Pose::from_parts(Default::default(), turn),
            Frame::World,
        )
        .unwrap();
    arm.aim(Pose::translation(-0.1, 0.05, 0.0) * arm.tip_pose());
    arm.set_element(|element| {
        (element.constraints, element.constraint_base) = (Constraints::X, Some(base));
    });
    arm.set_group(|group| group.iterations = 20);
    assert!(arm.handle().is_success());
    let gap = arm
        .env
        .pose(arm.target, Frame::World)
        .unwrap()
        .translation
        .vector
        - arm.tip_pose().translation.vector;
    let along = turn.inverse() * gap;
    assert!(along.x.abs() < 5e-4 && along.y.abs() > 0.01, "{along}");
}

/// The second group only uses what the first leaves free.
#[test]
fn the_first_group_has_priority() {
    let mut arm = Arm::panda();
    arm.set_config(&[0.1, -0.4, 0.2, -1.8, 0.3, 1.9, 0.4]);
    arm.aim(Pose::translation(0.05, 0.02, -0.05) * arm.tip_pose());
    arm.set_element(|element| element.constraints = Constraints::POSITION);
    arm.set_group(|group| group.iterations = 50);
    // The elbow should be somewhere it cannot be.
    let (elbow, wish) = (arm.env.create_dummy("elbow"), arm.env.create_dummy("wish"));
    arm.env
        .set_parent(elbow, Some(arm.joints[3]), false)
        .unwrap();
    arm.env
        .set_pose(wish, Pose::translation(0.0, 0.6, 0.4), Frame::World)
        .unwrap();
    arm.env.set_partner(elbow, Some(wish)).unwrap();
    let second = arm.env.create_group("elbow");
    arm.env.add_element(second, elbow).unwrap();
    arm.env
        .group_mut(second)
        .unwrap()
        .flags
        .remove(GroupFlags::IGNORE_MAX_STEPS);
    arm.set_group(|group| group.flags.remove(GroupFlags::IGNORE_MAX_STEPS));
    let away = |arm: &Arm| {
        let [elbow, wish] =
            [elbow, wish].map(|id| arm.env.pose(id, Frame::World).unwrap().translation.vector);
        (elbow - wish).norm()
    };
    let before = away(&arm);
    let outcome = arm.env.handle(&[arm.group, second]).unwrap();
    assert!(outcome.flags.contains(Flags::NOT_WITHIN_TOLERANCE));
    assert!(
        arm.gap()[0] < 0.002 && away(&arm) < before - 0.02,
        "{:?} {} {before}",
        arm.gap(),
        away(&arm)
    );
}

#[test]
fn dependent_joints_are_part_of_the_jacobian() {
    for law in [
        Law::Linear {
            offset: 0.1,
            factor: -2.0,
        },
        Law::Function(std::rc::Rc::new(|q: f64| 0.3 + q * q)),
    ] {
        let mut arm = Arm::planar();
        let [shoulder, elbow] = [arm.joints[0], arm.joints[1]];
        arm.env
            .set_dependency(elbow, Some((shoulder, law.clone())))
            .unwrap();
        arm.set_config(&[0.5]);
        arm.reach();
        arm.set_config(&[0.4]);
        close(&[arm.config()[1]], &[law.position(0.4)], 1e-12);
        arm.set_element(|element| element.constraints = Constraints(3));
        arm.set_group(|group| group.iterations = 20);
        assert!(arm.handle().is_success());
        close(&arm.config(), &[0.5, law.position(0.5)], 2e-3);
        assert_eq!(arm.env.joints_of(arm.group).unwrap(), [shoulder]);
    }
}

#[test]
fn circles_of_dependencies_are_opened() {
    let mut arm = Arm::planar();
    let [a, b] = [arm.joints[0], arm.joints[1]];
    let law = Law::Linear {
        offset: 0.0,
        factor: 1.0,
    };
    arm.env.set_dependency(a, Some((b, law.clone()))).unwrap();
    arm.env.set_dependency(b, Some((a, law))).unwrap();
    assert!(arm.env.joint(a).unwrap().dependency.is_none());
    arm.set_config(&[0.7]);
    assert_eq!(arm.config(), [0.7, 0.7]);
}

#[test]
fn spherical_joints() {
    let reach = Pose::translation(0.5, 0.0, 0.0);
    let mut arm = Arm::new(
        &[
            (JointType::Spherical, Pose::identity()),
            (JointType::Revolute, reach),
        ],
        reach,
    );
    arm.set_element(|element| element.constraints = Constraints::POSITION);
    arm.set_group(|group| (group.method, group.iterations) = (Method::DampedLeastSquares, 100));
    arm.aim(Pose::translation(0.2, 0.4, 0.5));
    assert!(arm.handle().is_success(), "{:?}", arm.gap());
    assert!(arm.gap()[0] < 5e-4);
}

/// A loop of four bars, closed by one element whose target is on the other side.
#[test]
fn a_closed_chain() {
    let long = Pose::translation(0.5, 0.0, 0.0);
    let mut arm = Arm::new(
        &[
            (JointType::Revolute, Pose::identity()),
            (JointType::Revolute, long),
        ],
        long,
    );
    let crank = arm.env.create_joint("crank", JointType::Revolute);
    arm.env
        .set_pose(crank, Pose::translation(0.6, 0.0, 0.0), Frame::World)
        .unwrap();
    arm.env.joint_mut(crank).unwrap().mode = JointMode::Passive;
    arm.env.set_parent(arm.target, Some(crank), false).unwrap();
    arm.env
        .set_pose(arm.target, Pose::translation(0.2, 0.0, 0.0), Frame::Parent)
        .unwrap();
    arm.set_element(|element| element.constraints = Constraints(3));
    arm.set_group(|group| group.iterations = 30);
    arm.set_config(&[0.3, 0.3]);
    for i in 0..60 {
        arm.env
            .set_joint_position(crank, f64::from(i) * 0.1)
            .unwrap();
        assert!(arm.handle().is_success(), "{i} {:?}", arm.gap());
        assert!(arm.gap()[0] < 5e-4);
    }
}

#[test]
fn callbacks_may_replace_what_is_computed() {
    let run = |revision: Revision| {
        let mut arm = planar(Method::PseudoInverse, 0.0, 1);
        let group = arm.group;
        let outcome = arm
            .env
            .handle_with(&[group], &mut |equations, index, iteration| {
                assert_eq!(
                    (
                        equations.rows.len(),
                        equations.columns.len(),
                        index,
                        iteration
                    ),
                    (2, 2, 0, 0)
                );
                Ok(revision.clone())
            });
        outcome.map(|outcome| (outcome.flags, arm.config()))
    };
    let step = Revision {
        step: Some(vec![0.01, -0.02]),
        ..Revision::default()
    };
    close(&run(step).unwrap().1, &[0.31, 0.58], 1e-12);
    let errors = Revision {
        errors: Some(vec![0.0, 0.0]),
        ..Revision::default()
    };
    close(&run(errors).unwrap().1, &[0.3, 0.6], 1e-12);
    let inverse = Revision {
        inverse: Some(vec![1.0, 0.0, 0.0, 1.0]),
        ..Revision::default()
    };
    close(&run(inverse).unwrap().1, &[0.31, 0.58], 1e-12);
    let short = Revision {
        jacobian: Some(vec![1.0]),
        ..Revision::default()
    };
    assert_eq!(
        run(short).unwrap_err().to_string(),
        "the callback's 'jacobian' has a wrong size."
    );
    let bad = Revision {
        jacobian: Some(vec![f64::NAN; 4]),
        ..Revision::default()
    };
    let (flags, config) = run(bad).unwrap();
    assert!(flags.contains(Flags::CANNOT_INVERT) && flags.contains(Flags::INVALID_CALLBACK_DATA));
    assert_eq!(config, [0.3, 0.6]);
}
