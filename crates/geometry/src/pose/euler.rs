//! Angles: pure maths, in radians.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::{orthonormal_block, quaternion_from_array, rotation_matrix, to_matrix};

/// The same angle within -pi to pi; both ends are unchanged.
pub fn wrap_angle(angle: f64) -> f64 {
    if angle.abs() <= PI {
        angle
    } else {
        angle - TAU * ((angle + PI) / TAU).floor()
    }
}

/// Rotation from Euler angles: `Rx(alpha) Ry(beta) Rz(gamma)`.
pub fn rotation_from_euler(e: &[f64; 3]) -> UnitQuaternion<f64> {
    let q = axis_quaternion(0, e[0]) * axis_quaternion(1, e[1]) * axis_quaternion(2, e[2]);
    quaternion_from_array(&[q.i, q.j, q.k, q.w])
}

/// Euler angles of a rotation, beta in [-pi/2, pi/2]; in gimbal lock alpha is 0.
pub fn rotation_to_euler(q: &UnitQuaternion<f64>) -> [f64; 3] {
    euler_of(&rotation_matrix(q))
}

/// Matrix from a position and Euler angles, `sim.buildMatrix`.
pub fn build_matrix(position: &[f64; 3], euler: &[f64; 3]) -> [f64; 12] {
    to_matrix(
        &rotation_matrix(&rotation_from_euler(euler)),
        &Vector3::from(*position),
    )
}

/// Euler angles of a matrix, which is orthonormalised first: `sim.getEulerAnglesFromMatrix`.
pub fn matrix_to_euler(m: &[f64; 12]) -> [f64; 3] {
    euler_of(&orthonormal_block(m))
}

fn axis_quaternion(axis: usize, angle: f64) -> Quaternion<f64> {
    let mut imaginary = Vector3::zeros();
    imaginary[axis] = libm::sin(0.5 * angle);
    Quaternion::from_parts(libm::cos(0.5 * angle), imaginary)
}

fn euler_of(r: &Matrix3<f64>) -> [f64; 3] {
    let beta = libm::asin(r[(0, 2)].clamp(-1.0, 1.0));
    if r[(0, 2)].abs() < 0.999995 {
        [
            libm::atan2(-r[(1, 2)], r[(2, 2)]),
            beta,
            libm::atan2(-r[(0, 1)], r[(0, 0)]),
        ]
    } else {
        [0.0, beta, libm::atan2(r[(1, 0)], r[(1, 1)])]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::pose::tests::close;

    #[test]
    fn both_ends_of_a_turn_stay() {
        assert_eq!((wrap_angle(PI), wrap_angle(-PI)), (PI, -PI));
        assert!((wrap_angle(4.0) - (4.0 - TAU)).abs() < 1e-12);
        assert!((wrap_angle(-4.0) - (TAU - 4.0)).abs() < 1e-12);
    }

    #[test]
    fn euler_angles_p1_to_p3() {
        let m = build_matrix(&[0.; 3], &[0.1, 0.2, 0.3]);
        close(&m[..3], &[0.936293364, -0.289629478, 0.198669331]);
        close(&m[4..7], &[0.312991826, 0.944702486, -0.097843395]);
        close(&matrix_to_euler(&m), &[0.1, 0.2, 0.3]);
        for (sign, gamma) in [(1.0, 0.7), (-1.0, -0.1)] {
            let m = build_matrix(&[0.; 3], &[0.4, sign * FRAC_PI_2, 0.3]);
            let e = matrix_to_euler(&m);
            assert!(
                e[0] == 0.0
                    && (e[1] - sign * FRAC_PI_2).abs() < 1e-6
                    && (e[2] - gamma).abs() < 1e-6
            );
        }
        let folded = matrix_to_euler(&build_matrix(&[0.; 3], &[0.1, 2.0, 0.3]));
        close(&folded, &[-3.041592654, 1.141592654, -2.841592654]);
    }
}
