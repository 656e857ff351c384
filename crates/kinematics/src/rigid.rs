//! A rigid transform as a matrix and a vector: cheaper to compose with rotations about z than a quaternion.

use geometry::Pose;
use nalgebra::{Matrix3, Vector3};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rigid {
    pub rotation: Matrix3<f64>,
    pub translation: Vector3<f64>,
}

impl Rigid {
    pub fn identity() -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    pub fn after(&self, other: &Self) -> Self {
        Self {
            rotation: self.rotation * other.rotation,
            translation: self.rotation * other.translation + self.translation,
        }
    }

    pub fn z(&self) -> Vector3<f64> {
        self.rotation.column(2).into()
    }

    /// Turned about its own z axis.
    pub fn turn(&mut self, angle: f64) {
        let (sine, cosine) = libm::sincos(angle);
        let (x, y) = (
            self.rotation.column(0).into_owned(),
            self.rotation.column(1).into_owned(),
        );
        self.rotation.set_column(0, &(x * cosine + y * sine));
        self.rotation.set_column(1, &(y * cosine - x * sine));
    }

    /// Shifted along its own z axis.
    pub fn shift(&mut self, distance: f64) {
        self.translation += self.z() * distance;
    }
}

impl From<&Pose> for Rigid {
    fn from(pose: &Pose) -> Self {
        Self {
            rotation: pose.rotation.to_rotation_matrix().into_inner(),
            translation: pose.translation.vector,
        }
    }
}
