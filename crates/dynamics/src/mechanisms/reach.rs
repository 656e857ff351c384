//! How far a body may move in a sub-step before it could pass through something: rapier stops such bodies at what they hit.

use nalgebra::Vector6;
use rapier3d_f64::prelude::{ColliderHandle, ColliderSet, RigidBodyCcd};

/// Speed from which a body counts as out of range, m/s and rad/s: rapier stops such bodies.
const MAX_SPEED: f64 = 1e9;

/// The size of a body as far as it matters for fast motion.
pub(super) struct Reach {
    /// The smallest extent of its shapes, metres; the largest number without any.
    thickness: f64,
    /// Largest distance of a point of them from the origin of the body, metres.
    extent: f64,
}

impl Default for Reach {
    fn default() -> Self {
        Self {
            thickness: f64::MAX,
            extent: 0.0,
        }
    }
}

impl Reach {
    pub(super) fn of(colliders: &[ColliderHandle], all: &ColliderSet) -> Self {
        let mut reach = Self::default();
        for collider in colliders.iter().filter_map(|&handle| all.get(handle)) {
            let sphere = collider.shape().compute_local_bounding_sphere();
            let offset = collider
                .position_wrt_parent()
                .map_or(0.0, |pose| (*pose * sphere.center).length());
            reach.thickness = reach.thickness.min(collider.shape().ccd_thickness());
            reach.extent = reach.extent.max(offset + sphere.radius);
        }
        reach
    }

    /// Whether the body has shapes that touch others.
    pub(super) fn is_solid(&self) -> bool {
        self.extent > 0.0
    }

    /// Whether the body moves so far in a sub-step of `step` seconds that rapier would look for what is in its way.
    pub(super) fn is_exceeded(&self, velocity: &Vector6<f64>, step: f64) -> bool {
        let [linear, angular] = [0, 3].map(|first| velocity.fixed_rows::<3>(first).norm());
        let is_in_range = linear < MAX_SPEED && angular < MAX_SPEED;
        !is_in_range
            || (linear + angular * self.extent) * step
                > RigidBodyCcd::FAST_BODY_SAFETY_FACTOR * self.thickness
    }
}
