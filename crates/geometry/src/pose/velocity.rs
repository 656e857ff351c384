//! Velocities measured between two poses.

use super::euler::rotation_to_euler;
use super::{Pose, shortest};

/// Mean linear velocity (m/s) between two poses `dt` seconds apart; zero unless `dt` is positive.
pub fn linear_velocity(previous: &Pose, now: &Pose, dt: f64) -> [f64; 3] {
    per_second(
        (now.translation.vector - previous.translation.vector).into(),
        dt,
    )
}

/// Measured angular velocity without `handleflag_axis`: the Euler angles of the turn, seen from the
/// previous frame, per second. Not a vector in world axes. Zero unless `dt` is positive.
pub fn angular_velocity_euler(previous: &Pose, now: &Pose, dt: f64) -> [f64; 3] {
    per_second(
        rotation_to_euler(&(previous.rotation.inverse() * now.rotation)),
        dt,
    )
}

/// Measured angular velocity with `handleflag_axis`: mean angular velocity (rad/s) in world axes.
/// Zero unless `dt` is positive.
pub fn angular_velocity_axis(previous: &Pose, now: &Pose, dt: f64) -> [f64; 3] {
    let turn = shortest(now.rotation * previous.rotation.inverse());
    per_second(turn.scaled_axis().into(), dt)
}

fn per_second(v: [f64; 3], dt: f64) -> [f64; 3] {
    if dt > 0.0 {
        v.map(|c| c / dt)
    } else {
        [0.0; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::euler::build_matrix;
    use crate::pose::pose_from_matrix;
    use crate::pose::tests::close;

    #[test]
    fn measured_velocities_of_both_kinds() {
        let a = pose_from_matrix(&build_matrix(&[0.; 3], &[1., 0., 0.]));
        let b = pose_from_matrix(&build_matrix(&[0.02, 0., 0.], &[1., 0., 0.1]));
        close(&linear_velocity(&a, &b, 0.05), &[0.4, 0., 0.]);
        close(&angular_velocity_euler(&a, &b, 0.05), &[0., 0., 2.]);
        close(
            &angular_velocity_axis(&a, &b, 0.05),
            &[0., -2.0 * 1_f64.sin(), 2.0 * 1_f64.cos()],
        );
        assert_eq!(linear_velocity(&a, &b, 0.0), [0.0; 3]);
    }
}
