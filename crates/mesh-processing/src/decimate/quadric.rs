//! Quadrics: the sum of squared distances from weighted planes, as a function of a point.

use nalgebra::{Matrix3, Vector3};

/// x'Ax + 2b'x + c, and the weight of the planes in it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Quadric {
    a: Matrix3<f64>,
    b: Vector3<f64>,
    c: f64,
    weight: f64,
}

impl Quadric {
    /// Of the plane through a point with a unit normal.
    pub(super) fn plane(normal: &Vector3<f64>, point: &Vector3<f64>, weight: f64) -> Self {
        let offset = -normal.dot(point);
        Self {
            a: normal * normal.transpose() * weight,
            b: normal * (offset * weight),
            c: offset * offset * weight,
            weight,
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.a += other.a;
        self.b += other.b;
        self.c += other.c;
        self.weight += other.weight;
    }

    /// The mean squared distance of a point from the planes.
    pub(super) fn error(&self, point: &Vector3<f64>) -> f64 {
        let sum = point.dot(&(self.a * point)) + 2.0 * self.b.dot(point) + self.c;
        if self.weight > 0.0 {
            (sum / self.weight).max(0.0)
        } else {
            0.0
        }
    }

    /// The point with the smallest error, if there is one: not for planes that meet in a line or not at all.
    pub(super) fn minimum(&self) -> Option<Vector3<f64>> {
        let scale = self.a.trace();
        let is_sound = self.a.determinant() > 1e-6 * scale * scale * scale;
        is_sound
            .then(|| self.a.try_inverse())
            .flatten()
            .map(|inverse| inverse * -self.b)
    }
}
