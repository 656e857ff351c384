//! `sim.*`: poses, matrices and angles, without objects. Yaw, pitch and roll are converted in Lua.

use api_macro::api;
use geometry::pose::euler;
use geometry::pose::{self, Pose};

use super::pose::checked;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::Source;
use script::{Args, FromScript};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    build_identity_matrix,
    build_matrix,
    build_matrix_q,
    build_pose,
    copy_matrix,
    multiply_matrices,
    multiply_poses,
    multiply_vector,
    get_matrix_inverse,
    get_pose_inverse,
    matrix_to_pose,
    pose_to_matrix,
    get_euler_angles_from_matrix,
    get_quaternion_from_matrix,
    interpolate_matrices,
    interpolate_poses,
    get_rotation_axis,
    rotate_around_axis,
];

/// The identity.
///
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.buildIdentityMatrix")]
fn build_identity_matrix(_cx: &Cx) -> Result<[f64; 12]> {
    Ok(pose::IDENTITY_MATRIX)
}

/// Matrix of a position and Euler angles.
///
/// @param position metres
/// @param eulerAngles alpha, beta, gamma, radians
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.buildMatrix")]
fn build_matrix(_cx: &Cx, position: [f64; 3], euler_angles: [f64; 3]) -> Result<[f64; 12]> {
    Ok(euler::build_matrix(
        &checked(position)?,
        &checked(euler_angles)?,
    ))
}

/// Matrix of a position and a quaternion.
///
/// @param position metres
/// @param quaternion qx, qy, qz, qw
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.buildMatrixQ")]
fn build_matrix_q(_cx: &Cx, position: [f64; 3], quaternion: [f64; 4]) -> Result<[f64; 12]> {
    let rotation = pose::quaternion_from_array(&checked(quaternion)?);
    Ok(pose::pose_to_matrix(&Pose::from_parts(
        checked(position)?.into(),
        rotation,
    )))
}

/// Pose of a position, and Euler angles or axes.
///
/// @param position metres
/// @param eulerAnglesOrAxis Euler angles (mode 0), or an axis
/// @param mode 0: Euler angles; 1 to 3: x, y or z axis; 4 to 6: also the next axis; 7 to 9: also the one after the next
/// @param axis2 where the second axis approximately points
/// @return pose x, y, z, qx, qy, qz, qw
#[api("sim.buildPose")]
fn build_pose(
    _cx: &Cx,
    position: [f64; 3],
    euler_angles_or_axis: [f64; 3],
    #[default(0)] mode: i64,
    #[default(None)] axis2: Option<[f64; 3]>,
) -> Result<[f64; 7]> {
    let pose = pose::build_pose(
        &checked(position)?,
        &checked(euler_angles_or_axis)?,
        mode,
        axis2.as_ref(),
    )?;
    Ok(pose::pose_to_array(&pose))
}

/// Copy of a matrix.
///
/// @param matrixIn 12 numbers
/// @return matrixOut the same
#[api("sim.copyMatrix")]
fn copy_matrix(_cx: &Cx, matrix_in: [f64; 12]) -> Result<[f64; 12]> {
    Ok(matrix_in)
}

/// Product of two matrices.
///
/// @param matrixIn1 left factor
/// @param matrixIn2 right factor
/// @return resultMatrix upper 3 by 4 block, row by row
#[api("sim.multiplyMatrices")]
fn multiply_matrices(_cx: &Cx, matrix_in1: [f64; 12], matrix_in2: [f64; 12]) -> Result<[f64; 12]> {
    Ok(pose::multiply_matrices(
        &checked(matrix_in1)?,
        &checked(matrix_in2)?,
    ))
}

/// Product of two poses.
///
/// @param poseIn1 left factor
/// @param poseIn2 right factor
/// @return resultPose x, y, z, qx, qy, qz, qw
#[api("sim.multiplyPoses")]
fn multiply_poses(_cx: &Cx, pose_in1: [f64; 7], pose_in2: [f64; 7]) -> Result<[f64; 7]> {
    Ok(pose::multiply_poses(
        &checked(pose_in1)?,
        &checked(pose_in2)?,
    ))
}

/// Transforms vectors. Nothing is normalised.
///
/// @param matrix matrix (12 numbers), pose (7) or quaternion (4)
/// @param inVectors three numbers for each vector
/// @return outVectors three numbers for each vector
#[api("sim.multiplyVector")]
fn multiply_vector(_cx: &Cx, matrix: Vec<f64>, in_vectors: Vec<f64>) -> Result<Vec<f64>> {
    if in_vectors.len() < 3 {
        return Err(ApiError::TableSize);
    }
    Ok(pose::multiply_vector(&matrix, &in_vectors)?)
}

/// Inverse of a matrix.
///
/// @param matrix upper 3 by 4 block, row by row
/// @return matrix its inverse
#[api("sim.getMatrixInverse")]
fn get_matrix_inverse(_cx: &Cx, matrix: [f64; 12]) -> Result<[f64; 12]> {
    Ok(pose::inverse_matrix(&checked(matrix)?))
}

/// Inverse of a pose.
///
/// @param pose x, y, z, qx, qy, qz, qw
/// @return pose its inverse
#[api("sim.getPoseInverse")]
fn get_pose_inverse(_cx: &Cx, pose: [f64; 7]) -> Result<[f64; 7]> {
    Ok(pose::inverse_pose(&checked(pose)?))
}

/// Pose of a matrix.
///
/// @param matrix upper 3 by 4 block, row by row
/// @return pose x, y, z, qx, qy, qz, qw
#[api("sim.matrixToPose")]
fn matrix_to_pose(_cx: &Cx, matrix: [f64; 12]) -> Result<[f64; 7]> {
    Ok(pose::pose_to_array(&pose::pose_from_matrix(&checked(
        matrix,
    )?)))
}

/// Matrix of a pose.
///
/// @param pose x, y, z, qx, qy, qz, qw
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.poseToMatrix")]
fn pose_to_matrix(_cx: &Cx, pose: [f64; 7]) -> Result<[f64; 12]> {
    Ok(pose::pose_to_matrix(&pose::pose_from_array(&checked(
        pose,
    )?)))
}

/// Euler angles of a matrix.
///
/// @param matrix upper 3 by 4 block, row by row
/// @return eulerAngles alpha, beta, gamma, radians
#[api("sim.getEulerAnglesFromMatrix")]
fn get_euler_angles_from_matrix(_cx: &Cx, matrix: [f64; 12]) -> Result<[f64; 3]> {
    Ok(euler::matrix_to_euler(&checked(matrix)?))
}

/// Rotation of a matrix.
///
/// @param matrix upper 3 by 4 block, row by row
/// @return quaternion qx, qy, qz, qw
#[api("sim.getQuaternionFromMatrix")]
fn get_quaternion_from_matrix(_cx: &Cx, matrix: [f64; 12]) -> Result<[f64; 4]> {
    Ok(pose::quaternion_to_array(
        &pose::pose_from_matrix(&checked(matrix)?).rotation,
    ))
}

/// Matrix between two others: positions on the line, rotations on the shortest arc.
///
/// @param matrixIn1 at 0
/// @param matrixIn2 at 1
/// @param interpolFactor not limited to 0 to 1
/// @return resultMatrix upper 3 by 4 block, row by row
#[api("sim.interpolateMatrices")]
fn interpolate_matrices(
    _cx: &Cx,
    matrix_in1: [f64; 12],
    matrix_in2: [f64; 12],
    interpol_factor: f64,
) -> Result<[f64; 12]> {
    let (a, b) = (
        pose::pose_from_matrix(&checked(matrix_in1)?),
        pose::pose_from_matrix(&checked(matrix_in2)?),
    );
    Ok(pose::pose_to_matrix(&pose::interpolate(
        &a,
        &b,
        interpol_factor,
    )))
}

/// Pose between two others: positions on the line, rotations on the shortest arc.
///
/// @param poseIn1 at 0
/// @param poseIn2 at 1
/// @param interpolFactor not limited to 0 to 1
/// @return resultPose x, y, z, qx, qy, qz, qw
#[api("sim.interpolatePoses")]
fn interpolate_poses(
    _cx: &Cx,
    pose_in1: [f64; 7],
    pose_in2: [f64; 7],
    interpol_factor: f64,
) -> Result<[f64; 7]> {
    let (a, b) = (
        pose::pose_from_array(&checked(pose_in1)?),
        pose::pose_from_array(&checked(pose_in2)?),
    );
    Ok(pose::pose_to_array(&pose::interpolate(
        &a,
        &b,
        interpol_factor,
    )))
}

/// Axis and angle that turn one orientation into another.
///
/// @param matrixStart matrix or pose
/// @param matrixGoal matrix or pose
/// @return axis in the frame both are expressed in
/// @return angle 0 to pi, radians
#[api("sim.getRotationAxis")]
fn get_rotation_axis(
    _cx: &Cx,
    matrix_start: Transform,
    matrix_goal: Transform,
) -> Result<([f64; 3], f64)> {
    Ok(pose::rotation_axis(
        &matrix_start.pose(),
        &matrix_goal.pose(),
    ))
}

/// Turns a matrix or pose around an axis.
///
/// @param matrixIn matrix or pose
/// @param axis direction, any length
/// @param axisPos a point on the axis, metres
/// @param angle radians, right-handed
/// @return matrixOut of the same kind
#[api("sim.rotateAroundAxis")]
fn rotate_around_axis(
    _cx: &Cx,
    matrix_in: Transform,
    axis: [f64; 3],
    axis_pos: [f64; 3],
    angle: f64,
) -> Result<Vec<f64>> {
    let turned = pose::rotate_around_axis(
        &matrix_in.pose(),
        &checked(axis)?,
        &checked(axis_pos)?,
        angle,
    );
    Ok(match matrix_in {
        Transform::Matrix(_) => pose::pose_to_matrix(&turned).to_vec(),
        Transform::Pose(_) => pose::pose_to_array(&turned).to_vec(),
    })
}

/// A matrix or a pose, distinguished by the number of values.
enum Transform {
    Matrix([f64; 12]),
    Pose([f64; 7]),
}

impl Transform {
    fn pose(&self) -> Pose {
        match self {
            Self::Matrix(matrix) => pose::pose_from_matrix(matrix),
            Self::Pose(pose) => pose::pose_from_array(pose),
        }
    }
}

impl FromScript for Transform {
    const TYPE: &'static str = "float[]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        match <[f64; 12]>::from_script(args) {
            Ok(matrix) => Ok(Self::Matrix(checked(matrix)?)),
            Err(ApiError::TableSize) => Ok(Self::Pose(checked(<[f64; 7]>::from_script(args)?)?)),
            Err(error) => Err(error),
        }
    }
}
