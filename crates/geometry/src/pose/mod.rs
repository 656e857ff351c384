//! Poses and matrices: pure maths, no scene. Angles are in `euler`.
//!
//! Positions are in metres, angles in radians. At the scripting edge a pose is
//! `[x, y, z, qx, qy, qz, qw]`, a matrix the upper 3x4 block in row-major order, an
//! orientation the triple alpha, beta, gamma with `R = Rx(alpha) Ry(beta) Rz(gamma)`.
//! Quaternions have no canonical sign.

pub mod euler;
pub mod velocity;

use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;

use euler::rotation_from_euler;

/// A rigid transform; the translation is in metres.
pub type Pose = Isometry3<f64>;

/// The identity as a 3x4 row-major matrix.
pub const IDENTITY_MATRIX: [f64; 12] = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0.];

/// Errors of the pose functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PoseError {
    /// `build_pose` modes 4 to 9 need the approximate second axis.
    #[error("the function requires more arguments.")]
    MissingAxis2,
    /// `build_pose` has the modes 0 to 9.
    #[error("invalid mode {0}: expected 0 to 9.")]
    UnknownMode(i64),
    /// A transform has 12, 7 or 4 numbers.
    #[error("incorrect table size.")]
    TransformSize(usize),
}

/// Pose from `[x, y, z, qx, qy, qz, qw]`; the quaternion is normalised, see [`quaternion_from_array`].
pub fn pose_from_array(p: &[f64; 7]) -> Pose {
    let rotation = quaternion_from_array(&[p[3], p[4], p[5], p[6]]);
    Pose::from_parts(Translation3::new(p[0], p[1], p[2]), rotation)
}

/// `[x, y, z, qx, qy, qz, qw]` of a pose; the inverse of [`pose_from_array`].
pub fn pose_to_array(pose: &Pose) -> [f64; 7] {
    let (t, q) = (pose.translation.vector, quaternion_to_array(&pose.rotation));
    [t.x, t.y, t.z, q[0], q[1], q[2], q[3]]
}

/// Rotation from `[qx, qy, qz, qw]`.
///
/// A quaternion that cannot be normalised (zero, not finite) becomes the identity. One that is
/// already of unit length keeps its bits, so that get/set loops do not drift.
pub fn quaternion_from_array(q: &[f64; 4]) -> UnitQuaternion<f64> {
    let largest = q.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if !q.iter().all(|c| c.is_finite()) || largest == 0.0 {
        return UnitQuaternion::identity();
    }
    let raw = Quaternion::new(q[3], q[0], q[1], q[2]);
    if (raw.norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
        return UnitQuaternion::new_unchecked(raw);
    }
    UnitQuaternion::new_normalize(raw / largest)
}

/// `[qx, qy, qz, qw]` of a rotation.
pub fn quaternion_to_array(q: &UnitQuaternion<f64>) -> [f64; 4] {
    [q.i, q.j, q.k, q.w]
}

/// Pose from a 3x4 row-major matrix, orthonormalised with the Z axis as reference.
pub fn pose_from_matrix(m: &[f64; 12]) -> Pose {
    let rotation = rotation_from_columns(&orthonormal_block(m));
    Pose::from_parts(Translation3::new(m[3], m[7], m[11]), rotation)
}

/// 3x4 row-major matrix of a pose.
pub fn pose_to_matrix(pose: &Pose) -> [f64; 12] {
    to_matrix(&rotation_matrix(&pose.rotation), &pose.translation.vector)
}

/// The matrix with its rotation block made orthonormal: z is unchanged, y = z x x, x = y x z, each normalised.
/// A block without three directions becomes the identity.
pub fn orthonormalize(m: &[f64; 12]) -> [f64; 12] {
    to_matrix(&orthonormal_block(m), &Vector3::new(m[3], m[7], m[11]))
}

/// Product of two matrices, `sim.multiplyMatrices`; both are orthonormalised first.
pub fn multiply_matrices(a: &[f64; 12], b: &[f64; 12]) -> [f64; 12] {
    let (ra, rb) = (orthonormal_block(a), orthonormal_block(b));
    let t = ra * Vector3::new(b[3], b[7], b[11]) + Vector3::new(a[3], a[7], a[11]);
    to_matrix(&(ra * rb), &t)
}

/// Product of two poses, `sim.multiplyPoses`; both quaternions are normalised first.
pub fn multiply_poses(a: &[f64; 7], b: &[f64; 7]) -> [f64; 7] {
    pose_to_array(&(pose_from_array(a) * pose_from_array(b)))
}

/// Inverse of a matrix whose rotation block is taken as orthonormal (not checked).
pub fn inverse_matrix(m: &[f64; 12]) -> [f64; 12] {
    let r = rotation_block(m).transpose();
    to_matrix(&r, &-(r * Vector3::new(m[3], m[7], m[11])))
}

/// Inverse of a pose array by the conjugate quaternion, without normalising.
pub fn inverse_pose(p: &[f64; 7]) -> [f64; 7] {
    let q = [-p[3], -p[4], -p[5], p[6]];
    let t = -sandwich(&q, &Vector3::new(p[0], p[1], p[2]));
    [t.x, t.y, t.z, q[0], q[1], q[2], q[3]]
}

/// Pose at fraction `t` from `a` to `b`: position on the line, rotation on the shortest arc.
/// `t` outside 0..1 extrapolates.
pub fn interpolate(a: &Pose, b: &Pose, t: f64) -> Pose {
    let (pa, pb) = (a.translation.vector, b.translation.vector);
    let position = pa + (pb - pa) * t;
    let turn = shortest(a.rotation.inverse() * b.rotation).scaled_axis() * t;
    let rotation = a.rotation * UnitQuaternion::from_scaled_axis(turn);
    Pose::from_parts(
        position.into(),
        quaternion_from_array(&quaternion_to_array(&rotation)),
    )
}

/// Axis and angle (rad, in [0, pi]) that turn `a` into `b`, the axis in the frame of `a` and `b`.
/// Below about 1e-4 rad there is no direction and the axis is not of unit length.
pub fn rotation_axis(a: &Pose, b: &Pose) -> ([f64; 3], f64) {
    let q = shortest(b.rotation * a.rotation.inverse());
    let sine = q.imag().norm();
    let axis = if sine < 5e-5 {
        q.imag()
    } else {
        q.imag() / sine
    };
    (axis.into(), 2.0 * libm::atan2(sine, q.w))
}

/// `t` turned by `angle` (right-handed) about the line through `axis_pos` along `axis`.
/// An axis without direction turns nothing.
pub fn rotate_around_axis(t: &Pose, axis: &[f64; 3], axis_pos: &[f64; 3], angle: f64) -> Pose {
    let Some(direction) = unit(Vector3::from(*axis)) else {
        return *t;
    };
    let half = direction * libm::sin(0.5 * angle);
    let turn = quaternion_from_array(&[half.x, half.y, half.z, libm::cos(0.5 * angle)]);
    let centre = Vector3::from(*axis_pos);
    let position = turn * (t.translation.vector - centre) + centre;
    Pose::from_parts(position.into(), turn * t.rotation)
}

/// `sim.buildPose`: mode 0 reads `v` as Euler angles, 1 to 3 as the x, y or z axis, 4 to 9 as that axis
/// with `axis2` near the next one (4 to 6) or the one after (7 to 9).
///
/// # Errors
/// [`PoseError::MissingAxis2`] for modes 4 to 9 without `axis2`, [`PoseError::UnknownMode`] outside 0..=9.
pub fn build_pose(
    position: &[f64; 3],
    v: &[f64; 3],
    mode: i64,
    axis2: Option<&[f64; 3]>,
) -> Result<Pose, PoseError> {
    let rotation = match mode {
        0 => rotation_from_euler(v),
        1..=3 => axes_rotation(v, None, (mode - 1) as usize, false),
        4..=9 => {
            let second = axis2.ok_or(PoseError::MissingAxis2)?;
            axes_rotation(v, Some(second), ((mode - 4) % 3) as usize, mode >= 7)
        }
        _ => return Err(PoseError::UnknownMode(mode)),
    };
    Ok(Pose::from_parts(Translation3::from(*position), rotation))
}

/// `sim.multiplyVector`: transforms `v`, a list of points x, y, z, by a matrix (12 numbers), a pose (7) or
/// a quaternion (4, rotates only). Nothing is normalised; surplus numbers of both lists are ignored.
///
/// # Errors
/// [`PoseError::TransformSize`] when the transform has fewer than 4 numbers.
pub fn multiply_vector(transform: &[f64], v: &[f64]) -> Result<Vec<f64>, PoseError> {
    let rotate = |q: &[f64], p: &Vector3<f64>| sandwich(&[q[0], q[1], q[2], q[3]], p);
    let apply = |p: Vector3<f64>| match *transform {
        [r00, r01, r02, x, r10, r11, r12, y, r20, r21, r22, z, ..] => {
            Matrix3::new(r00, r01, r02, r10, r11, r12, r20, r21, r22) * p + Vector3::new(x, y, z)
        }
        [x, y, z, _, _, _, _, ..] => rotate(&transform[3..7], &p) + Vector3::new(x, y, z),
        _ => rotate(transform, &p),
    };
    if transform.len() < 4 {
        return Err(PoseError::TransformSize(transform.len()));
    }
    let points = v.chunks_exact(3).map(|c| Vector3::new(c[0], c[1], c[2]));
    Ok(points.flat_map(|p| <[f64; 3]>::from(apply(p))).collect())
}

pub(crate) fn shortest(q: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    if q.w < 0.0 {
        UnitQuaternion::new_unchecked(-q.into_inner())
    } else {
        q
    }
}

/// `q v q*`, which scales by the squared length of `q` (`[x, y, z, w]`).
fn sandwich(q: &[f64; 4], v: &Vector3<f64>) -> Vector3<f64> {
    let q = Quaternion::new(q[3], q[0], q[1], q[2]);
    (q * Quaternion::from_imag(*v) * q.conjugate()).imag()
}

pub(crate) fn rotation_matrix(q: &UnitQuaternion<f64>) -> Matrix3<f64> {
    q.to_rotation_matrix().into_inner()
}

fn rotation_block(m: &[f64; 12]) -> Matrix3<f64> {
    Matrix3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10])
}

pub(crate) fn to_matrix(r: &Matrix3<f64>, t: &Vector3<f64>) -> [f64; 12] {
    let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)], t[i]];
    let mut m = [0.0; 12];
    (0..3).for_each(|i| m[4 * i..4 * i + 4].copy_from_slice(&row(i)));
    m
}

fn unit(v: Vector3<f64>) -> Option<Vector3<f64>> {
    let largest = v.amax();
    (v.iter().all(|c| c.is_finite()) && largest > 0.0).then(|| (v / largest).normalize())
}

pub(crate) fn orthonormal_block(m: &[f64; 12]) -> Matrix3<f64> {
    let r = rotation_block(m);
    let axes = || {
        let z = unit(r.column(2).into())?;
        let y = unit(z.cross(&unit(r.column(0).into())?))?;
        Some(Matrix3::from_columns(&[y.cross(&z), y, z]))
    };
    axes().unwrap_or_else(Matrix3::identity)
}

fn rotation_from_columns(r: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*r));
    quaternion_from_array(&quaternion_to_array(&q))
}

/// Rotation whose axis `i` is `v`. `second` approximates the next axis, or the one after when `after`;
/// without it world z (or x when v points up) takes its part. Parallel axes fall back to any normal.
fn axes_rotation(
    v: &[f64; 3],
    second: Option<&[f64; 3]>,
    i: usize,
    after: bool,
) -> UnitQuaternion<f64> {
    let Some(first) = unit(Vector3::from(*v)) else {
        return UnitQuaternion::identity();
    };
    let up = if first.z < 0.8 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let near = second.map_or(Some(up), |s| unit(Vector3::from(*s)));
    let spare = Vector3::ith(first.iamin(), 1.0);
    let cross = near
        .and_then(|n| unit(first.cross(&n)))
        .unwrap_or_else(|| first.cross(&spare).normalize());
    let (j, k) = if after {
        (-cross, first.cross(&-cross))
    } else {
        (cross.cross(&first), cross)
    };
    let mut columns = [first; 3];
    (columns[(i + 1) % 3], columns[(i + 2) % 3]) = (j, k);
    rotation_from_columns(&Matrix3::from_columns(&columns))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::euler::build_matrix;
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2 as S, FRAC_PI_2, PI};

    #[track_caller]
    pub fn close(a: &[f64], b: &[f64]) {
        assert_eq!(a.len(), b.len());
        assert!(
            a.iter().zip(b).all(|(x, y)| (x - y).abs() < 2e-9),
            "{a:?} is not {b:?}"
        );
    }

    #[track_caller]
    fn same_pose(pose: &Pose, b: &[f64; 7]) {
        let mut a = pose_to_array(pose);
        let dot: f64 = a[3..].iter().zip(&b[3..]).map(|(x, y)| x * y).sum();
        a[3..].iter_mut().for_each(|c| *c *= dot.signum());
        close(&a, b);
    }

    #[test]
    fn products_and_inverses_p4_p5() {
        let p = multiply_poses(
            &[1., 2., 3., 0., 0., 2., 2.],
            &[0.5, 0., 0., 3., 0., 0., 3.],
        );
        close(&p, &[1., 2.5, 3., 0.5, 0.5, 0.5, 0.5]);
        close(
            &inverse_pose(&[1., 2., 3., 0., 0., S, S]),
            &[-2., 1., -3., 0., 0., -S, S],
        );
        let sheared = [1., 0.3, 0., 1., 0., 1., 0.2, 2., 0., 0., 1., 3.];
        let c = [
            1.,
            0.,
            0.,
            1.,
            0.,
            0.980580676,
            0.196116135,
            2.,
            0.,
            -0.196116135,
            0.980580676,
            3.,
        ];
        close(&multiply_matrices(&sheared, &IDENTITY_MATRIX), &c);
        let m = build_matrix(&[1., 2., 3.], &[0., 0., FRAC_PI_2]);
        close(
            &inverse_matrix(&m),
            &[0., 1., 0., -2., -1., 0., 0., 1., 0., 0., 1., -3.],
        );
    }

    #[test]
    fn interpolation_p6_extrapolates_on_the_shortest_arc() {
        let (a, b) = (
            Pose::identity(),
            pose_from_array(&[1., 2., 3., 0., 0., S, S]),
        );
        same_pose(
            &interpolate(&a, &b, 0.25),
            &[0.25, 0.5, 0.75, 0., 0., 0.195090322, 0.980785280],
        );
        same_pose(&interpolate(&a, &b, 2.0), &[2., 4., 6., 0., 0., 1., 0.]);
        let flipped = pose_from_array(&[0., 0., 0., 0., 0., -S, -S]);
        same_pose(
            &interpolate(&a, &flipped, 0.5),
            &[0., 0., 0., 0., 0., 0.382683432, 0.923879533],
        );
    }

    #[test]
    fn axes_p7_p12_p13() {
        let a = pose_from_matrix(&build_matrix(&[0.; 3], &[0., 0., FRAC_PI_2]));
        let b = a * pose_from_matrix(&build_matrix(&[5., 0., 0.], &[PI / 3., 0., 0.]));
        let (axis, angle) = rotation_axis(&a, &b);
        close(&axis, &[0., 1., 0.]);
        close(&[angle], &[PI / 3.0]);
        assert_eq!(rotation_axis(&a, &a).1, 0.0);
        let build = |v: [f64; 3], mode, w: [f64; 3]| {
            build_pose(&[0.; 3], &v, mode, Some(&w)).expect("known mode")
        };
        same_pose(
            &build([1., 0., 0.], 1, [0.; 3]),
            &[0., 0., 0., S, 0., 0., S],
        );
        same_pose(
            &build([0., 0., 1.], 3, [0.; 3]),
            &[0., 0., 0., 0., 0., 0., 1.],
        );
        same_pose(
            &build([0., 1., 0.], 4, [0., 0., 1.]),
            &[0., 0., 0., 0.5, 0.5, 0.5, 0.5],
        );
        let q9 = [
            0.,
            0.,
            0.,
            -0.306155995,
            -0.545123437,
            -0.779552472,
            0.037508519,
        ];
        same_pose(&build([1., 2., 0.5], 9, [0.3, -1., 1.]), &q9);
        assert_eq!(
            build_pose(&[0.; 3], &[0., 1., 0.], 4, None),
            Err(PoseError::MissingAxis2)
        );
        assert_eq!(
            build_pose(&[0.; 3], &[0., 1., 0.], 10, None),
            Err(PoseError::UnknownMode(10))
        );
        let start = pose_from_array(&[1., 0., 0., 0., 0., 0., 1.]);
        let turned = rotate_around_axis(&start, &[0., 0., 2.], &[1., 1., 0.], FRAC_PI_2);
        same_pose(&turned, &[2., 1., 0., 0., 0., S, S]);
    }

    #[test]
    fn vectors_p11_are_not_normalised() {
        let pose = [1., 2., 3., 0., 0., 0., 1.];
        close(
            &multiply_vector(&pose, &[1., 1., 1., 0., 0., 0., 9.]).expect("pose"),
            &[2., 3., 4., 1., 2., 3.],
        );
        close(
            &multiply_vector(&[0., 0., 2., 2.], &[1., 0., 0.]).expect("quaternion"),
            &[0., 8., 0.],
        );
        let scaled = [2., 0., 0., 1., 0., 2., 0., 2., 0., 0., 2., 3.];
        close(
            &multiply_vector(&scaled, &[1., 1., 1.]).expect("matrix"),
            &[3., 4., 5.],
        );
        assert_eq!(
            multiply_vector(&[1., 2.], &[]),
            Err(PoseError::TransformSize(2))
        );
    }

    #[test]
    fn round_trips_keep_bits_and_bad_numbers_give_identity() {
        let p = pose_to_array(&pose_from_array(&[
            123.456789, -1e-6, 1e4, 0.1, 0.3, 0.4, 0.5,
        ]));
        assert_eq!(pose_to_array(&pose_from_array(&p)), p);
        for q in [
            [0.0; 4],
            [f64::NAN, 0., 0., 1.],
            [f64::INFINITY, 0., 0., 1.],
        ] {
            assert_eq!(quaternion_from_array(&q), UnitQuaternion::identity());
        }
        for bad in [0.0, f64::NAN, f64::INFINITY] {
            let rotation = pose_from_matrix(&[bad; 12]).rotation;
            assert!(rotation.coords.iter().all(|c| c.is_finite()));
            assert!((0..10).all(|m| build_pose(&[bad; 3], &[bad; 3], m, Some(&[bad; 3])).is_ok()));
        }
        assert!(
            build_pose(&[0.; 3], &[0., 0., -1.], 1, None).is_ok_and(|p| p.rotation.w.is_finite())
        );
    }
}
