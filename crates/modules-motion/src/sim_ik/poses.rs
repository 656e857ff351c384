//! `simIK.*`: poses of objects, as poses, matrices, or positions with orientations.

use api_macro::api;
use geometry::pose::euler::rotation_to_euler;
use geometry::pose::{
    pose_from_array, pose_from_matrix, pose_to_array, pose_to_matrix, quaternion_to_array,
};
use kinematics::Pose;

use super::{ApiFn, Cx, Result, finite, frame, functions, object, rotation, with};
use scene::special;
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_object_pose,
    set_object_pose,
    get_object_matrix,
    set_object_matrix,
    get_object_transformation,
    set_object_transformation,
    get_joint_pose,
    get_joint_matrix,
    get_joint_transformation,
];

fn pose_of(cx: &Cx, environment: Number, handle: Number, relative_to: Number) -> Result<Pose> {
    with(cx, environment.0, |held| {
        held.env.pose(object(handle.0)?, frame(relative_to.0)?)
    })
}

fn place(
    cx: &Cx,
    environment: Number,
    handle: Number,
    pose: Pose,
    relative_to: Number,
) -> Result<()> {
    with(cx, environment.0, |held| {
        held.env
            .set_pose(object(handle.0)?, pose, frame(relative_to.0)?)
    })
}

/// From the resting to the moving side of a joint.
fn motion(cx: &Cx, environment: Number, joint: Number) -> Result<Pose> {
    with(cx, environment.0, |held| {
        Ok(held.env.joint(object(joint.0)?)?.motion())
    })
}

type Transformation = ([f64; 3], [f64; 4], [f64; 3]);

fn transformation(pose: &Pose) -> Transformation {
    (
        pose.translation.vector.into(),
        quaternion_to_array(&pose.rotation),
        rotation_to_euler(&pose.rotation),
    )
}

/// Pose of an object.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param relativeToObjectHandle the frame: simIK.handle_world, simIK.handle_parent or an object; of a joint, its moving side
/// @return pose x, y, z, qx, qy, qz, qw
#[api("simIK.getObjectPose")]
fn get_object_pose(
    cx: &Cx,
    environment_handle: Number,
    object_handle: Number,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<[f64; 7]> {
    pose_of(
        cx,
        environment_handle,
        object_handle,
        relative_to_object_handle,
    )
    .map(|pose| pose_to_array(&pose))
}

/// Moves an object; its children move along.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param pose x, y, z, qx, qy, qz, qw
/// @param relativeToObjectHandle as in simIK.getObjectPose
#[api("simIK.setObjectPose")]
fn set_object_pose(
    cx: &mut Cx,
    environment_handle: Number,
    object_handle: Number,
    pose: [f64; 7],
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<()> {
    let pose = pose_from_array(&finite(pose)?);
    place(
        cx,
        environment_handle,
        object_handle,
        pose,
        relative_to_object_handle,
    )
}

/// Pose of an object as a matrix.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param relativeToObjectHandle as in simIK.getObjectPose
/// @return matrix 3 rows of 4
#[api("simIK.getObjectMatrix")]
fn get_object_matrix(
    cx: &Cx,
    environment_handle: Number,
    object_handle: Number,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<[f64; 12]> {
    pose_of(
        cx,
        environment_handle,
        object_handle,
        relative_to_object_handle,
    )
    .map(|pose| pose_to_matrix(&pose))
}

/// Moves an object to where a matrix says.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param matrix 3 rows of 4
/// @param relativeToObjectHandle as in simIK.getObjectPose
#[api("simIK.setObjectMatrix")]
fn set_object_matrix(
    cx: &mut Cx,
    environment_handle: Number,
    object_handle: Number,
    matrix: [f64; 12],
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<()> {
    let pose = pose_from_matrix(&finite(matrix)?);
    place(
        cx,
        environment_handle,
        object_handle,
        pose,
        relative_to_object_handle,
    )
}

/// Position and orientation of an object.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param relativeToObjectHandle as in simIK.getObjectPose
/// @return position metres
/// @return quaternion qx, qy, qz, qw
/// @return euler alpha, beta, gamma
#[api("simIK.getObjectTransformation")]
fn get_object_transformation(
    cx: &Cx,
    environment_handle: Number,
    object_handle: Number,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<([f64; 3], [f64; 4], [f64; 3])> {
    pose_of(
        cx,
        environment_handle,
        object_handle,
        relative_to_object_handle,
    )
    .map(|pose| transformation(&pose))
}

/// Moves an object to a position and an orientation.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param position metres
/// @param eulerOrQuaternion alpha, beta, gamma, or qx, qy, qz, qw
/// @param relativeToObjectHandle as in simIK.getObjectPose
#[api("simIK.setObjectTransformation")]
fn set_object_transformation(
    cx: &mut Cx,
    environment_handle: Number,
    object_handle: Number,
    position: [f64; 3],
    euler_or_quaternion: Vec<f64>,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Number,
) -> Result<()> {
    let pose = Pose::from_parts(finite(position)?.into(), rotation(&euler_or_quaternion)?);
    place(
        cx,
        environment_handle,
        object_handle,
        pose,
        relative_to_object_handle,
    )
}

/// From the resting to the moving side of a joint.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return pose x, y, z, qx, qy, qz, qw
#[api("simIK.getJointPose")]
fn get_joint_pose(cx: &Cx, environment_handle: Number, joint_handle: Number) -> Result<[f64; 7]> {
    motion(cx, environment_handle, joint_handle).map(|pose| pose_to_array(&pose))
}

/// The same as a matrix.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return matrix 3 rows of 4
#[api("simIK.getJointMatrix")]
fn get_joint_matrix(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<[f64; 12]> {
    motion(cx, environment_handle, joint_handle).map(|pose| pose_to_matrix(&pose))
}

/// The same as position and orientation.
///
/// @param environmentHandle the environment
/// @param jointHandle the joint
/// @return position metres
/// @return quaternion qx, qy, qz, qw
/// @return euler alpha, beta, gamma
#[api("simIK.getJointTransformation")]
fn get_joint_transformation(
    cx: &Cx,
    environment_handle: Number,
    joint_handle: Number,
) -> Result<([f64; 3], [f64; 4], [f64; 3])> {
    motion(cx, environment_handle, joint_handle).map(|pose| transformation(&pose))
}
