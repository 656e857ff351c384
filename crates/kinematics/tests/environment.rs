//! The tree: parents, poses, removal, bad input, bytes.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use kinematics::*;
use support::{Arm, random_chain};

#[test]
fn parents_keep_poses_and_make_no_circles() {
    let mut env = Environment::new(0);
    let [a, b, c] = ["a", "b", "c"].map(|name| env.create_dummy(name));
    env.set_pose(a, Pose::translation(1.0, 0.0, 0.0), Frame::World)
        .unwrap();
    env.set_pose(b, Pose::translation(0.0, 2.0, 0.0), Frame::World)
        .unwrap();
    env.set_parent(b, Some(a), true).unwrap();
    assert_eq!(
        env.pose(b, Frame::World).unwrap(),
        Pose::translation(0.0, 2.0, 0.0)
    );
    assert_eq!(
        env.pose(b, Frame::Parent).unwrap(),
        Pose::translation(-1.0, 2.0, 0.0)
    );
    env.set_parent(c, Some(b), false).unwrap();
    assert_eq!(
        env.pose(c, Frame::Object(a)).unwrap(),
        Pose::translation(-1.0, 2.0, 0.0)
    );
    assert_eq!(
        env.set_parent(a, Some(c), true),
        Err(KinematicsError::Circle)
    );
    assert_eq!(
        env.set_parent(a, Some(a), true),
        Err(KinematicsError::Circle)
    );
    env.erase(b).unwrap();
    assert_eq!(env.object(c).unwrap().parent(), Some(a));
    assert_eq!(
        env.pose(c, Frame::World).unwrap(),
        Pose::translation(0.0, 2.0, 0.0)
    );
    assert_eq!(
        env.pose(b, Frame::World),
        Err(KinematicsError::NoSuchObject)
    );
    assert_eq!((env.named("c"), env.named("b")), (Some(c), None));
    assert_ne!(env.create_dummy("d"), b);
}

#[test]
fn what_is_removed_is_no_longer_used() {
    let mut arm = Arm::planar();
    arm.env.erase(arm.target).unwrap();
    assert_eq!(arm.handle().flags, Flags::NOT_PERFORMED);
    let mut arm = Arm::planar();
    arm.env.erase(arm.tip).unwrap();
    assert_eq!(arm.handle().flags, Flags::NOT_PERFORMED);
    assert!(arm.env.element(arm.group, arm.element).is_err());
    let mut arm = Arm::planar();
    arm.joints
        .iter()
        .for_each(|joint| arm.env.erase(*joint).unwrap());
    assert_eq!(arm.handle().flags, Flags::NOT_PERFORMED);
    let mut iterations = 1000;
    assert_eq!(
        arm.env
            .find_posture(arm.group, Start::Random, &mut iterations),
        Ok(false)
    );
    assert_eq!(arm.env.equations(arm.group), Ok(None));
}

#[test]
fn disabled_and_empty_groups_are_not_performed() {
    let mut arm = Arm::planar();
    arm.set_group(|group| group.flags.remove(GroupFlags::ENABLED));
    assert_eq!(arm.handle().flags, Flags::NOT_PERFORMED);
    let empty = arm.env.create_group("");
    assert_eq!(
        arm.env.handle(&[empty]).unwrap().flags,
        Flags::NOT_PERFORMED
    );
    assert_eq!(arm.env.handle(&[]).unwrap().flags, Flags::NOT_PERFORMED);
    assert!(arm.env.handle(&[GroupId::from_raw(77).unwrap()]).is_err());
    let mut passive = Arm::planar();
    for joint in passive.joints.clone() {
        passive.env.joint_mut(joint).unwrap().mode = JointMode::Passive;
    }
    assert_eq!(passive.handle().flags, Flags::NOT_PERFORMED);
}

#[test]
fn numbers_that_are_not_finite_are_refused_or_end_the_calculation() {
    let mut arm = Arm::ur5();
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        assert_eq!(
            arm.env.set_joint_position(arm.joints[0], bad),
            Err(KinematicsError::NotFinite)
        );
        let pose = Pose::translation(bad, 0.0, 0.0);
        assert_eq!(
            arm.env.set_pose(arm.target, pose, Frame::World),
            Err(KinematicsError::NotFinite)
        );
    }
    for method in [
        Method::PseudoInverse,
        Method::JacobianTranspose,
        Method::DampedLeastSquares,
        Method::UndampedPseudoInverse,
    ] {
        let mut arm = Arm::ur5();
        arm.aim(Pose::translation(1e300, 0.0, 0.0));
        arm.set_group(|group| (group.method, group.iterations) = (method, 100));
        let outcome = arm.handle();
        assert!(
            !outcome.is_success() && arm.config().iter().all(|q| q.is_finite()),
            "{outcome:?}"
        );
        let mut iterations = 2000;
        assert_eq!(
            arm.env
                .find_posture(arm.group, Start::Present, &mut iterations),
            Ok(false)
        );
        assert_eq!(iterations, 0);
    }
}

/// The stretched arm cannot move towards its shoulder in first order.
#[test]
fn singular_postures() {
    for method in [
        Method::PseudoInverse,
        Method::JacobianTranspose,
        Method::DampedLeastSquares,
        Method::UndampedPseudoInverse,
    ] {
        let mut arm = Arm::planar();
        arm.set_config(&[0.0, 0.0]);
        arm.aim(Pose::translation(0.8, 0.0, 0.0));
        arm.set_group(|group| (group.method, group.iterations) = (method, 20));
        arm.set_element(|element| element.constraints = Constraints::POSITION);
        let outcome = arm.handle();
        assert!(
            outcome
                .precision
                .iter()
                .chain(&arm.config())
                .all(|x| x.is_finite()),
            "{method:?}"
        );
    }
}

#[test]
fn environments_come_back_from_bytes() {
    let mut random = Random::new(3);
    let mut arm = random_chain(&mut random, 6);
    let law = Law::Linear {
        offset: 0.1,
        factor: 0.5,
    };
    arm.env
        .set_dependency(arm.joints[3], Some((arm.joints[1], law)))
        .unwrap();
    let gone = arm.env.create_dummy("gone");
    arm.env.erase(gone).unwrap();
    arm.set_group(|group| (group.method, group.damping) = (Method::DampedLeastSquares, 0.05));
    arm.aim(Pose::translation(0.02, 0.01, 0.0) * arm.tip_pose());
    let bytes = arm.env.to_bytes().unwrap();
    let mut copy = Environment::new(0);
    copy.read_bytes(&bytes).unwrap();
    assert_eq!(copy.to_bytes().unwrap(), bytes);
    assert_eq!(copy.handle(&[arm.group]).unwrap(), arm.handle());
    assert_eq!(copy.pose(arm.tip, Frame::World).unwrap(), arm.tip_pose());
    assert!(copy.erase(arm.joints[0]).is_ok());
}

#[test]
fn damaged_bytes_are_refused_or_read() {
    let mut random = Random::new(4);
    let bytes = random_chain(&mut random, 3).env.to_bytes().unwrap();
    let mut env = Environment::new(0);
    for end in 0..bytes.len() {
        assert_eq!(env.read_bytes(&bytes[..end]), Err(KinematicsError::Damaged));
    }
    for i in 0..bytes.len() {
        for value in [0, 1, 2, 127, 255] {
            let mut damaged = bytes.clone();
            damaged[i] = value;
            if env.read_bytes(&damaged).is_ok() {
                let groups: Vec<GroupId> = env.groups().map(|(id, _)| id).collect();
                let _ = env.handle(&groups);
            }
        }
    }
}
