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

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Vector;
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder, RigidBodySet};

    use super::*;

    const STEP: f64 = 0.01;

    /// Of a body with a ball of 0.1 m whose centre is 0.3 m from its origin.
    fn with_ball() -> Reach {
        let (mut bodies, mut colliders) = (RigidBodySet::new(), ColliderSet::new());
        let body = bodies.insert(RigidBodyBuilder::dynamic().build());
        let ball = ColliderBuilder::ball(0.1).translation(Vector::X * 0.3);
        let ball = colliders.insert_with_parent(ball.build(), body, &mut bodies);
        Reach::of(&[ball], &colliders)
    }

    #[test]
    fn a_body_without_shapes_is_not_solid() {
        assert!(!Reach::default().is_solid());
        assert!(with_ball().is_solid());
    }

    #[test]
    fn a_body_goes_too_far_with_half_of_its_thickness() {
        let reach = with_ball();
        // The tip of the ball is 0.4 m from the origin.
        let exceeded = |linear: f64, angular: f64| {
            let velocity = Vector6::new(0.0, linear, 0.0, 0.0, 0.0, angular);
            reach.is_exceeded(&velocity, STEP)
        };
        for (linear, angular, expected) in [
            (4.9, 0.0, false),
            (5.1, 0.0, true),
            (0.0, 12.4, false),
            (0.0, 12.6, true),
            (2.5, 6.2, false),
            (2.5, 6.3, true),
            (f64::NAN, 0.0, true),
        ] {
            assert_eq!(exceeded(linear, angular), expected, "{linear} {angular}");
        }
        let empty = Reach::default();
        let fast = |speed: f64| empty.is_exceeded(&Vector6::repeat(speed), 1e-12);
        assert!(!fast(1e8) && fast(1e10));
    }
}
