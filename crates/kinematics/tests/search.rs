//! The search for a posture: every answer is checked by forward kinematics.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use kinematics::*;
use support::{Arm, random_chain};

/// Aims at a pose that the arm has in a random posture, and goes back.
fn aim_randomly(arm: &mut Arm, random: &mut Random) {
    let [start, goal] = [arm.config(), arm.random_config(random)];
    arm.set_config(&goal);
    arm.reach();
    arm.set_config(&start);
}

fn is_within_limits(arm: &Arm) -> bool {
    arm.joints.iter().all(|joint| {
        let joint = arm.env.joint(*joint).unwrap();
        joint
            .limits()
            .is_none_or(|[low, high]| joint.position >= low && joint.position <= high)
    })
}

#[test]
fn both_arms_reach_whatever_they_can_reach() {
    for mut arm in [Arm::ur5(), Arm::panda()] {
        let mut random = Random::new(1);
        for i in 0..300 {
            aim_randomly(&mut arm, &mut random);
            let mut iterations = 20_000;
            assert!(
                arm.env
                    .find_posture(arm.group, Start::Present, &mut iterations)
                    .unwrap(),
                "pose {i}"
            );
            let [distance, angle] = arm.gap();
            assert!(
                distance < 0.0005 && angle < 0.1_f64.to_radians() && is_within_limits(&arm),
                "{distance} {angle}"
            );
        }
    }
}

#[test]
fn random_chains_of_2_to_12_joints() {
    let mut random = Random::new(2);
    let (mut found, mut all) = (0, 0);
    for joints in 2..=12 {
        for _ in 0..10 {
            let mut arm = random_chain(&mut random, joints);
            aim_randomly(&mut arm, &mut random);
            let mut iterations = 20_000;
            all += 1;
            if arm
                .env
                .find_posture(arm.group, Start::Random, &mut iterations)
                .unwrap()
            {
                found += 1;
                let [distance, angle] = arm.gap();
                assert!(
                    distance < 0.0005 && angle < 0.1_f64.to_radians() && is_within_limits(&arm)
                );
            }
        }
    }
    assert!(found * 100 >= all * 98, "{found} of {all}");
}

#[test]
fn without_a_posture_the_joints_stay_and_the_iterations_are_used() {
    let mut arm = Arm::ur5();
    arm.aim(Pose::translation(3.0, 0.0, 0.0));
    let before = arm.config();
    let mut iterations = 5000;
    assert!(
        !arm.env
            .find_posture(arm.group, Start::Present, &mut iterations)
            .unwrap()
    );
    assert_eq!((arm.config(), iterations), (before, 0));
}

#[test]
fn postures_repeat_and_differ() {
    let find = |start| {
        let mut arm = Arm::panda();
        aim_randomly(&mut arm, &mut Random::new(9));
        let mut postures = Vec::new();
        for _ in 0..3 {
            assert!(arm.env.find_posture(arm.group, start, &mut 20_000).unwrap());
            postures.push(arm.config());
        }
        postures
    };
    assert_eq!(find(Start::Random), find(Start::Random));
    let postures = find(Start::Random);
    assert!(postures[0] != postures[1] && postures[1] != postures[2]);
}

#[test]
fn metric_distances() {
    let mut arm = Arm::planar();
    arm.aim(Pose::translation(0.3, 0.4, 0.0) * arm.tip_pose());
    let distance = arm.env.distance(arm.group, [1.0, 1.0, 1.0, 0.1]).unwrap();
    assert!((distance - 0.5).abs() < 1e-12);
    assert!((arm.env.distance(arm.group, [2.0, 0.0, 0.0, 0.1]).unwrap() - 0.6).abs() < 1e-12);
}
