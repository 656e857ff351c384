//! `simEigen.quat*`: quaternions, listed as x, y, z, w. Vectors are columns of three numbers, rotations are matrices of 3 by 3.

use api_macro::api;
use geometry::pose::euler::{rotation_from_euler, rotation_to_euler};
use nalgebra::{DMatrix, Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use super::store::{add, finish, get, refused, remove, replace};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    quat_new,
    quat_copy,
    quat_destroy,
    quat_get_data,
    quat_set_data,
    quat_inv,
    quat_mul_quat,
    quat_mul_vec,
    quat_slerp,
    quat_from_axis_angle,
    quat_to_axis_angle,
    quat_from_euler,
    quat_to_euler,
    quat_from_ypr,
    quat_to_ypr,
    quat_from_rotation,
    quat_to_rotation,
    quat_from_two_vectors,
];

/// A vector or quaternion with a smaller norm has no direction.
const MIN_NORM: f64 = 1e-12;

fn quaternion(cx: &Cx, handle: &str) -> Result<Quaternion<f64>> {
    Ok(*get(cx, handle)?)
}

fn rotation(cx: &Cx, handle: &str) -> Result<UnitQuaternion<f64>> {
    let rotation = UnitQuaternion::try_new(quaternion(cx, handle)?, MIN_NORM);
    rotation
        .filter(|q| q.coords.iter().all(|c| c.is_finite()))
        .ok_or_else(|| refused("the quaternion is no rotation"))
}

fn vector(cx: &Cx, handle: &str) -> Result<Vector3<f64>> {
    let matrix = get::<DMatrix<f64>>(cx, handle)?;
    let numbers: [f64; 3] = matrix
        .as_slice()
        .try_into()
        .map_err(|_| refused("a vector of 3 numbers is needed"))?;
    if numbers.iter().all(|x| x.is_finite()) {
        Ok(numbers.into())
    } else {
        Err(refused("a number is not finite"))
    }
}

fn add_vector(cx: &Cx, vector: [f64; 3]) -> Result<String> {
    add(cx, DMatrix::from_column_slice(3, 1, &vector))
}

/// A new quaternion.
///
/// @param initialData x, y, z, w; no rotation without
/// @return handle
#[api("simEigen.quatNew")]
fn quat_new(cx: &Cx, #[default([0.0, 0.0, 0.0, 1.0])] initial_data: [f64; 4]) -> Result<String> {
    add(cx, Quaternion::from_vector(initial_data.into()))
}

/// A copy.
///
/// @param handle the quaternion
/// @return handle
#[api("simEigen.quatCopy")]
fn quat_copy(cx: &Cx, handle: String) -> Result<String> {
    add(cx, quaternion(cx, &handle)?)
}

/// Ends a quaternion.
///
/// @param handle the quaternion
#[api("simEigen.quatDestroy")]
fn quat_destroy(cx: &Cx, handle: String) -> Result<()> {
    remove::<Quaternion<f64>>(cx, &handle)
}

/// Its numbers.
///
/// @param handle the quaternion
/// @return data x, y, z, w
#[api("simEigen.quatGetData")]
fn quat_get_data(cx: &Cx, handle: String) -> Result<[f64; 4]> {
    Ok(quaternion(cx, &handle)?.coords.into())
}

/// Sets its numbers.
///
/// @param handle the quaternion
/// @param data x, y, z, w
#[api("simEigen.quatSetData")]
fn quat_set_data(cx: &Cx, handle: String, data: [f64; 4]) -> Result<()> {
    replace(cx, &handle, Quaternion::from_vector(data.into()))
}

/// The inverse.
///
/// @param handle the quaternion
/// @return handle
#[api("simEigen.quatInv")]
fn quat_inv(cx: &Cx, handle: String) -> Result<String> {
    let inverse = quaternion(cx, &handle)?.try_inverse();
    add(
        cx,
        inverse.ok_or_else(|| refused("the quaternion has no inverse"))?,
    )
}

/// The product of two quaternions.
///
/// @param handle the first
/// @param handle2 the second
/// @param inplace changes the first instead of making a new one
/// @return handle nothing if it was changed
#[api("simEigen.quatMulQuat")]
fn quat_mul_quat(
    cx: &Cx,
    handle: String,
    handle2: String,
    #[default(true)] inplace: bool,
) -> Result<Option<String>> {
    let result = quaternion(cx, &handle)? * quaternion(cx, &handle2)?;
    finish(cx, &handle, result, inplace)
}

/// A rotated vector.
///
/// @param handle the quaternion
/// @param vectorHandle the vector
/// @return handle of a vector
#[api("simEigen.quatMulVec")]
fn quat_mul_vec(cx: &Cx, handle: String, vector_handle: String) -> Result<String> {
    let rotated = rotation(cx, &handle)? * vector(cx, &vector_handle)?;
    add_vector(cx, rotated.into())
}

/// A rotation between two, on the shortest way.
///
/// @param handle at t = 0
/// @param handle2 at t = 1
/// @param t from 0 to 1
/// @return handle
#[api("simEigen.quatSLERP")]
fn quat_slerp(cx: &Cx, handle: String, handle2: String, t: f64) -> Result<String> {
    let (a, b) = (rotation(cx, &handle)?, rotation(cx, &handle2)?);
    // Opposite rotations have no shortest path between them: the result is the first.
    add(cx, a.try_slerp(&b, t, MIN_NORM).unwrap_or(a).into_inner())
}

/// A rotation around an axis.
///
/// @param axisHandle vector along the axis
/// @param angle radians
/// @return handle
#[api("simEigen.quatFromAxisAngle")]
fn quat_from_axis_angle(cx: &Cx, axis_handle: String, angle: f64) -> Result<String> {
    let axis = Unit::try_new(vector(cx, &axis_handle)?, MIN_NORM)
        .ok_or_else(|| refused("the axis has no length"))?;
    add(
        cx,
        UnitQuaternion::from_axis_angle(&axis, angle).into_inner(),
    )
}

/// The axis and angle of a rotation; x and 0 of none.
///
/// @param handle the quaternion
/// @return axisHandle a vector of length 1
/// @return angle radians
#[api("simEigen.quatToAxisAngle")]
fn quat_to_axis_angle(cx: &Cx, handle: String) -> Result<(String, f64)> {
    let found = rotation(cx, &handle)?.axis_angle();
    let (axis, angle) = found.map_or(([1.0, 0.0, 0.0], 0.0), |(axis, angle)| {
        (axis.into_inner().into(), angle)
    });
    Ok((add_vector(cx, axis)?, angle))
}

/// From Euler angles as those of `sim`: around x, then the new y, then the new z.
///
/// @param handle vector of the angles, radians
/// @return handle
#[api("simEigen.quatFromEuler")]
fn quat_from_euler(cx: &Cx, handle: String) -> Result<String> {
    add(
        cx,
        rotation_from_euler(&vector(cx, &handle)?.into()).into_inner(),
    )
}

/// Euler angles as those of `sim`.
///
/// @param handle the quaternion
/// @return handle of a vector, radians
#[api("simEigen.quatToEuler")]
fn quat_to_euler(cx: &Cx, handle: String) -> Result<String> {
    add_vector(cx, rotation_to_euler(&rotation(cx, &handle)?))
}

/// From yaw, pitch and roll: around z, then the new y, then the new x.
///
/// @param handle vector of the angles, radians
/// @return handle
#[api("simEigen.quatFromYPR")]
fn quat_from_ypr(cx: &Cx, handle: String) -> Result<String> {
    let ypr = vector(cx, &handle)?;
    add(
        cx,
        UnitQuaternion::from_euler_angles(ypr.z, ypr.y, ypr.x).into_inner(),
    )
}

/// Yaw, pitch and roll.
///
/// @param handle the quaternion
/// @return handle of a vector, radians
#[api("simEigen.quatToYPR")]
fn quat_to_ypr(cx: &Cx, handle: String) -> Result<String> {
    let (roll, pitch, yaw) = rotation(cx, &handle)?.euler_angles();
    add_vector(cx, [yaw, pitch, roll])
}

/// From a matrix of 3 by 3.
///
/// @param handle the matrix
/// @return handle
#[api("simEigen.quatFromRotation")]
fn quat_from_rotation(cx: &Cx, handle: String) -> Result<String> {
    let matrix = get::<DMatrix<f64>>(cx, &handle)?;
    if matrix.shape() != (3, 3) || !matrix.iter().all(|x| x.is_finite()) {
        return Err(refused("a matrix of 3 by 3 finite numbers is needed"));
    }
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_column_slice(matrix.as_slice()));
    let q = UnitQuaternion::from_rotation_matrix(&rotation).into_inner();
    if !q.coords.iter().all(|c| c.is_finite()) {
        return Err(refused("the matrix is no rotation"));
    }
    add(cx, q)
}

/// A matrix of 3 by 3.
///
/// @param handle the quaternion
/// @return handle of a matrix
#[api("simEigen.quatToRotation")]
fn quat_to_rotation(cx: &Cx, handle: String) -> Result<String> {
    let rotation = rotation(cx, &handle)?.to_rotation_matrix();
    add(
        cx,
        DMatrix::from_column_slice(3, 3, rotation.matrix().as_slice()),
    )
}

/// The shortest rotation from one direction to another.
///
/// @param handle the vector to turn
/// @param handle2 the vector it is turned to
/// @return handle
#[api("simEigen.quatFromTwoVectors")]
fn quat_from_two_vectors(cx: &Cx, handle: String, handle2: String) -> Result<String> {
    let (a, b) = (vector(cx, &handle)?, vector(cx, &handle2)?);
    if a.norm() < MIN_NORM || b.norm() < MIN_NORM {
        return Err(refused("a vector has no length"));
    }
    // Of opposite directions there are many: half a turn around some axis across.
    let aside = if a.x.abs() < 0.9 * a.norm() {
        Vector3::x_axis()
    } else {
        Vector3::y_axis()
    };
    let across = a.cross(&aside);
    let half_turn =
        || UnitQuaternion::from_axis_angle(&Unit::new_normalize(across), std::f64::consts::PI);
    add(
        cx,
        UnitQuaternion::rotation_between(&a, &b)
            .unwrap_or_else(half_turn)
            .into_inner(),
    )
}
