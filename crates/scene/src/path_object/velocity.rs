//! The relative velocities at the points of a path: those of the points, or an automatic profile (spec: vrep-era 3.4).

use geometry::pose::rotation_axis;
use nalgebra::Vector3;

use super::{PathAttributes, PathObject};

/// Rotation axes with a smaller dot product count as a change of axis.
const COSINE_OF_AXIS_CHANGE: f64 = 0.5;
/// Smaller rotations, in radians, count as none.
const MIN_ROTATION: f64 = 0.001;

impl PathObject {
    /// One for each of the lengths.
    pub(super) fn relative_velocities(&self, closed: bool) -> Vec<f64> {
        let profile = PathAttributes::TRANSLATION_PROFILE | PathAttributes::ROTATION_PROFILE;
        let is_automatic = self.attributes.intersects(profile);
        let count = self.line.len();
        let mut velocities: Vec<f64> = self
            .line
            .iter()
            .map(|point| if is_automatic { 1.0 } else { point.velocity })
            .collect();
        if !closed && self.attributes.contains(PathAttributes::REST_AT_ENDS) {
            velocities
                .first_mut()
                .into_iter()
                .for_each(|velocity| *velocity = 0.0);
            velocities
                .last_mut()
                .into_iter()
                .for_each(|velocity| *velocity = 0.0);
        }
        let inner = if closed {
            0..count
        } else {
            1..count.saturating_sub(1).max(1)
        };
        for at in inner.filter(|_| count > 2) {
            if self
                .attributes
                .contains(PathAttributes::TRANSLATION_PROFILE)
            {
                velocities[at] = velocities[at].min(self.velocity_of_bend(at));
            }
            if self.attributes.contains(PathAttributes::ROTATION_PROFILE)
                && self.rotation_changes(at)
            {
                velocities[at] = velocities[at].min(self.profile.axis_change);
            }
        }
        velocities.extend(velocities.first().copied().filter(|_| closed));
        if is_automatic {
            self.limit_changes(&mut velocities, closed);
        }
        velocities
    }

    /// The bend at a point, as part of a circle: the shorter way beside it, by the angle.
    fn velocity_of_bend(&self, at: usize) -> f64 {
        let [into, out] = self.ways(at);
        let angle = into.angle(&out);
        if angle <= MIN_ROTATION {
            return 1.0;
        }
        into.norm().min(out.norm()) / angle / (2.0 * self.profile.radius.max(f64::MIN_POSITIVE))
    }

    fn ways(&self, at: usize) -> [Vector3<f64>; 2] {
        let count = self.line.len();
        let [a, b, c] = [at + count - 1, at, at + 1]
            .map(|place| self.line[place % count].pose.translation.vector);
        [b - a, c - b]
    }

    /// Whether a rotation begins or ends here, or changes its axis.
    fn rotation_changes(&self, at: usize) -> bool {
        let count = self.line.len();
        let [a, b, c] = [at + count - 1, at, at + 1].map(|place| &self.line[place % count].pose);
        let (first, second) = (rotation_axis(a, b), rotation_axis(b, c));
        let turns = [first.1 > MIN_ROTATION, second.1 > MIN_ROTATION];
        let axes = Vector3::from(first.0).dot(&Vector3::from(second.0));
        turns[0] != turns[1] || turns[0] && axes < COSINE_OF_AXIS_CHANGE
    }

    /// No point is passed faster than the acceleration allows from any other.
    fn limit_changes(&self, velocities: &mut [f64], closed: bool) {
        // Twice around: what limits the end of a closed path limits its beginning.
        for _ in 0..if closed { 2 } else { 1 } {
            for at in 1..velocities.len() {
                self.limit(velocities, at, at - 1);
            }
            for at in (1..velocities.len()).rev() {
                self.limit(velocities, at - 1, at);
            }
            if let (true, [first, .., last]) = (closed, &mut *velocities) {
                let lower = first.min(*last);
                (*first, *last) = (lower, lower);
            }
        }
    }

    fn limit(&self, velocities: &mut [f64], at: usize, other: usize) {
        let distance = (self.lengths[at] - self.lengths[other]).abs();
        let reachable = (2.0 * self.profile.acceleration.max(0.0) * distance
            + velocities[other].powi(2))
        .sqrt();
        velocities[at] = velocities[at].min(reachable);
    }
}
