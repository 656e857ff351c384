//! One body on one joint on a base that rests.

#![allow(dead_code, reason = "each program uses a part")]

use articulation::*;
use geometry::Pose;
use nalgebra::{Matrix3, UnitQuaternion, Vector3, Vector6};

pub const STEP: f64 = 0.005;
pub const MASS: f64 = 2.0;
/// About the centre of mass, equal for all axes.
pub const INERTIA: f64 = 0.1;

/// A body on a base that rests.
pub struct Rig {
    pub mechanism: Mechanism,
    pub body: BodyState,
    pub joint: JointState,
}

pub fn body(com: Vector3<f64>) -> BodyProperties {
    BodyProperties::dynamic(MASS, Matrix3::from_diagonal_element(INERTIA), com)
}

pub fn base() -> BodyProperties {
    BodyProperties::immovable(Vector3::zeros())
}

/// Between two bodies whose frames are where that of the joint is, but for its rotation.
pub fn joint(
    kind: JointKind,
    bodies: [usize; 2],
    axis: Vector3<f64>,
    pitch: f64,
) -> JointProperties {
    let along = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap();
    let frame = Pose::from_parts(Vector3::zeros().into(), along);
    let (base, tip) = (frame, frame);
    JointProperties {
        kind,
        bodies,
        base,
        tip,
        pitch,
    }
}

pub fn free_joint() -> JointState {
    JointState {
        position: 0.0,
        velocity: 0.0,
        motor: None,
        limits: None,
        passive: Passive::default(),
    }
}

/// The body's frame is that of the world, the joint is at the origin and its axis in direction `axis`, the centre of mass at `com`.
pub fn rig(kind: JointKind, axis: Vector3<f64>, pitch: f64, com: Vector3<f64>) -> Rig {
    let joint = joint(kind, [0, 1], axis, pitch);
    Rig {
        mechanism: Mechanism::new(vec![base(), body(com)], vec![joint]),
        body: resting(),
        joint: free_joint(),
    }
}

pub fn resting() -> BodyState {
    moving(Vector3::zeros(), Vector3::zeros())
}

/// A body at the origin without forces.
pub fn moving(linear: Vector3<f64>, angular: Vector3<f64>) -> BodyState {
    BodyState {
        motion: BodyMotion {
            pose: Pose::identity(),
            velocity: spatial(linear, angular),
        },
        force: Vector6::zeros(),
        gyroscopic_velocity: angular,
        target: None,
    }
}

pub fn halves(velocity: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (
        velocity.fixed_rows::<3>(0).into(),
        velocity.fixed_rows::<3>(3).into(),
    )
}

impl Rig {
    pub fn begin(&mut self, gravity: Vector3<f64>) {
        let (bodies, joints) = ([resting(), self.body], [self.joint]);
        self.mechanism.begin(&bodies, &joints, gravity.into(), STEP);
    }

    /// Linear and angular velocity of the body after the step.
    pub fn velocity(&mut self) -> (Vector3<f64>, Vector3<f64>) {
        assert!(self.mechanism.solve());
        halves(self.mechanism.velocities().nth(1).unwrap())
    }
}

/// Where two bodies touch at a point, without friction.
pub fn contact(bodies: [Option<usize>; 2], point: [f64; 3], normal: [f64; 3]) -> Contact {
    Contact {
        bodies,
        base: None,
        point,
        normal,
        distance: 0.0,
        friction: 0.0,
        restitution: 0.0,
        velocity: [0.0; 3],
        impulse: [0.0; 3],
    }
}

#[track_caller]
pub fn close(found: Vector3<f64>, expected: Vector3<f64>) {
    assert!(
        (found - expected).norm() < 1e-6 * expected.norm().max(1e-3),
        "{found} is not {expected}"
    );
}

#[track_caller]
pub fn nearly(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-4, "{found} is not {expected}");
}
