//! `simIK.*`: poses of objects, as poses, matrices, or positions with orientations.
//!
//! Setters also accept the argument order of releases before 4.3: the frame before the data.

use api_macro::api;
use geometry::pose::euler::rotation_to_euler;
use geometry::pose::{
    pose_from_array, pose_from_matrix, pose_to_array, pose_to_matrix, quaternion_to_array,
};
use kinematics::Pose;

use super::{ApiFn, Cx, Result, finite, frame, functions, object, rotation, with};
use scene::{Data, special};
use script::{ApiError, Args, FromScript, Number, Operand, Source, arranged};

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
    pose: Operand<7, Number>,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Operand<7, Number>,
) -> Result<()> {
    let (pose, frame) = arranged(pose, relative_to_object_handle)?;
    let pose = pose_from_array(&finite(pose)?);
    place(cx, environment_handle, object_handle, pose, frame)
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
    matrix: Operand<12, Number>,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: Operand<12, Number>,
) -> Result<()> {
    let (matrix, frame) = arranged(matrix, relative_to_object_handle)?;
    let pose = pose_from_matrix(&finite(matrix)?);
    place(cx, environment_handle, object_handle, pose, frame)
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
    position: Operand<3, Number>,
    euler_or_quaternion: Vec<f64>,
    #[default(special::WORLD, "simIK.handle_world")] relative_to_object_handle: FrameOrRotation,
) -> Result<()> {
    let (position, turn, frame) = match (position, relative_to_object_handle) {
        (Operand::Numbers(position), FrameOrRotation::Frame(frame)) => {
            (position, euler_or_quaternion, frame)
        }
        (Operand::Frame(frame), FrameOrRotation::Rotation(turn)) => {
            let position = euler_or_quaternion.first_chunk();
            (*position.ok_or(ApiError::TableSize)?, turn, frame)
        }
        _ => return Err(ApiError::ArgumentType),
    };
    let pose = Pose::from_parts(finite(position)?.into(), rotation(&turn)?);
    place(cx, environment_handle, object_handle, pose, frame)
}

/// The last argument of `simIK.setObjectTransformation`: the frame, or, where the frame came first, the orientation.
enum FrameOrRotation {
    Frame(Number),
    Rotation(Vec<f64>),
}

impl FromScript for FrameOrRotation {
    const TYPE: &'static str = "int";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        if args.is_table(args.position()) {
            Vec::from_script(args).map(Self::Rotation)
        } else {
            Number::from_script(args).map(Self::Frame)
        }
    }
}

impl From<i64> for FrameOrRotation {
    fn from(raw: i64) -> Self {
        Self::Frame(raw.into())
    }
}

impl From<FrameOrRotation> for Data {
    fn from(operand: FrameOrRotation) -> Self {
        match operand {
            FrameOrRotation::Frame(frame) => frame.into(),
            FrameOrRotation::Rotation(turn) => turn.into(),
        }
    }
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
