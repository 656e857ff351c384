//! The weights of an element are factors of its errors (spec: kinematics 3).

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use kinematics::*;
use nalgebra::{UnitQuaternion, Vector3};
use support::Arm;

/// How far the joints go in one iteration towards a target beside the tip. With the transpose of the Jacobian it is a linear function of the errors.
fn step(constraints: Constraints, weights: [f64; 3]) -> Vec<f64> {
    let mut arm = Arm::planar();
    let turn = UnitQuaternion::from_scaled_axis(0.05 * Vector3::z());
    let tip = arm.tip_pose();
    arm.aim(Pose::translation(0.01, -0.02, 0.0) * tip * turn);
    arm.set_element(|element| (element.constraints, element.weights) = (constraints, weights));
    arm.set_group(|group| (group.method, group.iterations) = (Method::JacobianTranspose, 1));
    let before = arm.config();
    arm.handle();
    let after = arm.config();
    after.iter().zip(before).map(|(q, old)| q - old).collect()
}

#[track_caller]
fn has_factor(constraints: Constraints, weights: [f64; 3], factor: f64) {
    let (whole, part) = (step(constraints, [1.0; 3]), step(constraints, weights));
    assert!(whole.iter().all(|dq| dq.abs() > 1e-3), "{whole:?}");
    for (whole, part) in whole.iter().zip(part) {
        assert!(
            (part - factor * whole).abs() < 1e-12,
            "{part} is not {factor} of {whole}"
        );
    }
}

#[test]
fn the_first_weight_is_that_of_linear_errors() {
    has_factor(Constraints::POSITION, [0.5, 1.0, 1.0], 0.5);
    has_factor(Constraints::ORIENTATION, [0.5, 1.0, 1.0], 1.0);
}

#[test]
fn the_second_weight_is_that_of_angular_errors() {
    has_factor(Constraints::POSITION, [1.0, 0.25, 1.0], 1.0);
    has_factor(Constraints::ORIENTATION, [1.0, 0.25, 1.0], 0.25);
}

#[test]
fn the_third_weight_is_that_of_both() {
    has_factor(Constraints::POSITION, [1.0, 1.0, 0.25], 0.25);
    has_factor(Constraints::ORIENTATION, [1.0, 1.0, 0.25], 0.25);
    has_factor(Constraints::POSE, [1.0, 1.0, 0.25], 0.25);
    has_factor(Constraints::POSE, [0.5, 0.5, 0.5], 0.25);
}
