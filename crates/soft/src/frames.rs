//! Frames along a rod: how a direction across the rod is carried from one tangent to another without turning about either.

use crate::V3;

/// A vector carried along by the smallest rotation that takes one unit tangent to another.
pub(crate) fn transport(vector: &V3, from: &V3, to: &V3) -> V3 {
    let axis = from.cross(to);
    let cosine = from.dot(to);
    if cosine < -1.0 + 1e-9 {
        // Half a turn has no axis of its own; any one across does.
        return -vector;
    }
    cosine * vector + axis.cross(vector) + axis * (axis.dot(vector) / (1.0 + cosine))
}

/// The angle by which a direction has to be turned about the unit axis to become the other one.
pub(crate) fn angle_about(axis: &V3, from: &V3, to: &V3) -> f64 {
    libm::atan2(axis.dot(&from.cross(to)), from.dot(to))
}

/// The angle nearest to `near` that differs from `angle` by whole turns.
pub(crate) fn unwrap(angle: f64, near: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    angle + turn * libm::rint((near - angle) / turn)
}

/// A unit vector across a unit tangent.
pub(crate) fn across(tangent: &V3) -> V3 {
    let axis = tangent.iamin();
    let mut helper = V3::zeros();
    helper[axis] = 1.0;
    tangent.cross(&helper).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_stay_across_and_do_not_turn() {
        let (from, to) = (V3::x(), V3::new(0.6, 0.8, 0.0));
        let carried = transport(&V3::y(), &from, &to);
        assert!((carried - V3::new(-0.8, 0.6, 0.0)).norm() < 1e-15);
        assert_eq!(transport(&V3::z(), &from, &to), V3::z());
    }

    #[test]
    fn whole_turns_are_counted() {
        let angle = angle_about(&V3::z(), &V3::x(), &V3::new(0.0, -1.0, 0.0));
        assert!((angle + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert!((unwrap(angle, 11.0) - angle - 4.0 * std::f64::consts::PI).abs() < 1e-12);
    }
}
