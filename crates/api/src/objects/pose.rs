//! `sim.*`: poses and velocities of objects.
//!
//! Setters also accept the argument order of releases before 4.3: object, frame, data.

use api_macro::api;
use geometry::pose::euler;
use geometry::pose::{self, Pose};

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Data, Frame, Handle, Placement, SceneError, flag, special};
use script::Source;
use script::{Args, FromScript, ObjectRef, Operand, arranged};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object_position,
    set_object_position,
    get_object_quaternion,
    set_object_quaternion,
    get_object_orientation,
    set_object_orientation,
    get_object_pose,
    set_object_pose,
    get_object_matrix,
    set_object_matrix,
    get_object_child_pose,
    set_object_child_pose,
    get_joint_matrix,
    set_spherical_joint_matrix,
    get_object_velocity,
];

/// Position of an object.
///
/// @param objectHandle the object
/// @param relativeToObjectHandle the frame to express it in
/// @return position metres
#[api("sim.getObjectPosition")]
fn get_object_position(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: PositionFrame,
) -> Result<[f64; 3]> {
    Ok(pose_in(cx, object_handle, relative_to_object_handle)?
        .translation
        .vector
        .into())
}

/// Moves an object; its orientation stays.
///
/// @param objectHandle the object
/// @param position metres
/// @param relativeToObjectHandle the frame it is expressed in
#[api("sim.setObjectPosition")]
fn set_object_position(
    cx: &mut Cx,
    object_handle: ObjectRef,
    position: Operand<3, LegacyFrame>,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: Operand<
        3,
        StrictFrame,
    >,
) -> Result<()> {
    let (position, frame) = arrange(position, relative_to_object_handle)?;
    if frame == Frame::Inverse {
        return Err(SceneError::NoSuchObject.into());
    }
    place(
        cx,
        object_handle,
        Placement::Position(position.into()),
        frame,
    )
}

/// Rotation of an object.
///
/// @param objectHandle the object; sim.handleflag_wxyzquat puts w first
/// @param relativeToObjectHandle the frame to express it in
/// @return quaternion qx, qy, qz, qw
#[api("sim.getObjectQuaternion")]
fn get_object_quaternion(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: StrictFrame,
) -> Result<[f64; 4]> {
    let pose = pose_in(cx, object_handle, relative_to_object_handle)?;
    let mut quaternion = pose::quaternion_to_array(&pose.rotation);
    if object_handle.has(flag::WXYZ_QUATERNION) {
        quaternion.rotate_right(1);
    }
    Ok(quaternion)
}

/// Turns an object; its position stays.
///
/// @param objectHandle the object; sim.handleflag_wxyzquat: w comes first
/// @param quaternion qx, qy, qz, qw
/// @param relativeToObjectHandle the frame it is expressed in
#[api("sim.setObjectQuaternion")]
fn set_object_quaternion(
    cx: &mut Cx,
    object_handle: ObjectRef,
    quaternion: Operand<4, LegacyFrame>,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: Operand<
        4,
        StrictFrame,
    >,
) -> Result<()> {
    let (mut quaternion, frame) = arrange(quaternion, relative_to_object_handle)?;
    if object_handle.has(flag::WXYZ_QUATERNION) {
        quaternion.rotate_left(1);
    }
    place(
        cx,
        object_handle,
        Placement::Rotation(pose::quaternion_from_array(&quaternion)),
        frame,
    )
}

/// Euler angles of an object.
///
/// @param objectHandle the object
/// @param relativeToObjectHandle the frame to express them in
/// @return eulerAngles alpha, beta, gamma, radians
#[api("sim.getObjectOrientation")]
fn get_object_orientation(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: StrictFrame,
) -> Result<[f64; 3]> {
    Ok(euler::rotation_to_euler(
        &pose_in(cx, object_handle, relative_to_object_handle)?.rotation,
    ))
}

/// Turns an object; its position stays.
///
/// @param objectHandle the object
/// @param eulerAngles alpha, beta, gamma, radians
/// @param relativeToObjectHandle the frame they are expressed in
#[api("sim.setObjectOrientation")]
fn set_object_orientation(
    cx: &mut Cx,
    object_handle: ObjectRef,
    euler_angles: Operand<3, LegacyFrame>,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: Operand<
        3,
        StrictFrame,
    >,
) -> Result<()> {
    let (euler, frame) = arrange(euler_angles, relative_to_object_handle)?;
    place(
        cx,
        object_handle,
        Placement::Rotation(euler::rotation_from_euler(&euler)),
        frame,
    )
}

/// Pose of an object.
///
/// @param objectHandle the object; sim.handleflag_wxyzquat puts w first
/// @param relativeToObjectHandle the frame to express it in
/// @return pose x, y, z, qx, qy, qz, qw
#[api("sim.getObjectPose")]
fn get_object_pose(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: StrictFrame,
) -> Result<[f64; 7]> {
    let mut pose = pose::pose_to_array(&pose_in(cx, object_handle, relative_to_object_handle)?);
    if object_handle.has(flag::WXYZ_QUATERNION) {
        pose[3..].rotate_right(1);
    }
    Ok(pose)
}

/// Places an object.
///
/// @param objectHandle the object; sim.handleflag_wxyzquat: w comes first
/// @param pose x, y, z, qx, qy, qz, qw
/// @param relativeToObjectHandle the frame it is expressed in
#[api("sim.setObjectPose")]
fn set_object_pose(
    cx: &mut Cx,
    object_handle: ObjectRef,
    pose: Operand<7, LegacyFrame>,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: Operand<
        7,
        StrictFrame,
    >,
) -> Result<()> {
    let (mut pose, frame) = arrange(pose, relative_to_object_handle)?;
    if object_handle.has(flag::WXYZ_QUATERNION) {
        pose[3..].rotate_left(1);
    }
    place(
        cx,
        object_handle,
        Placement::Pose(pose::pose_from_array(&pose)),
        frame,
    )
}

/// Pose of an object as a matrix.
///
/// @param objectHandle the object
/// @param relativeToObjectHandle the frame to express it in
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.getObjectMatrix")]
fn get_object_matrix(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: StrictFrame,
) -> Result<[f64; 12]> {
    Ok(pose::pose_to_matrix(&pose_in(
        cx,
        object_handle,
        relative_to_object_handle,
    )?))
}

/// Places an object.
///
/// @param objectHandle the object
/// @param matrix upper 3 by 4 block, row by row
/// @param relativeToObjectHandle the frame it is expressed in
#[api("sim.setObjectMatrix")]
fn set_object_matrix(
    cx: &mut Cx,
    object_handle: ObjectRef,
    matrix: Operand<12, LegacyFrame>,
    #[default(special::WORLD, "sim.handle_world")] relative_to_object_handle: Operand<
        12,
        StrictFrame,
    >,
) -> Result<()> {
    let (matrix, frame) = arrange(matrix, relative_to_object_handle)?;
    place(
        cx,
        object_handle,
        Placement::Pose(pose::pose_from_matrix(&matrix)),
        frame,
    )
}

/// From an object to the frame its children live in: the motion of a joint, the identity for most others.
///
/// @param objectHandle the object
/// @return pose x, y, z, qx, qy, qz, qw
#[api("sim.getObjectChildPose")]
fn get_object_child_pose(cx: &Cx, object_handle: Handle) -> Result<[f64; 7]> {
    let intrinsic = cx.scene().object(object_handle)?.intrinsic_pose();
    Ok(pose::pose_to_array(
        &intrinsic.unwrap_or_else(Pose::identity),
    ))
}

/// Turns the moving side of a spherical joint. Other objects are left as they are.
///
/// @param objectHandle the joint
/// @param pose of which the rotation is taken
#[api("sim.setObjectChildPose")]
fn set_object_child_pose(cx: &mut Cx, object_handle: Handle, pose: [f64; 7]) -> Result<()> {
    let pose = pose::pose_from_array(&checked(pose)?);
    cx.scene_mut()
        .set_spherical_rotation(object_handle, pose.rotation)?;
    Ok(())
}

/// From a joint to its moving side.
///
/// @param objectHandle the joint
/// @return matrix upper 3 by 4 block, row by row
#[api("sim.getJointMatrix")]
fn get_joint_matrix(cx: &Cx, object_handle: Handle) -> Result<[f64; 12]> {
    Ok(pose::pose_to_matrix(
        &cx.scene().object(object_handle)?.joint()?.intrinsic_pose(),
    ))
}

/// Turns the moving side of a spherical joint.
///
/// @param objectHandle the joint
/// @param matrix of which the rotation is taken
#[api("sim.setSphericalJointMatrix")]
fn set_spherical_joint_matrix(
    cx: &mut Cx,
    object_handle: Handle,
    matrix: [f64; 12],
) -> Result<i64> {
    let pose = pose::pose_from_matrix(&checked(matrix)?);
    Ok(
        if cx
            .scene_mut()
            .set_spherical_rotation(object_handle, pose.rotation)?
        {
            1
        } else {
            -1
        },
    )
}

/// Measured velocity of an object, between the last two simulation steps, world axes.
///
/// @param objectHandle the object; with sim.handleflag_axis the angular velocity is axis times angle
/// @return linearVelocity m/s
/// @return angularVelocity Euler angles of the step in the object's previous frame, rad/s
#[api("sim.getObjectVelocity")]
fn get_object_velocity(cx: &Cx, object_handle: ObjectRef) -> Result<([f64; 3], [f64; 3])> {
    let scene = cx.scene();
    let measured = &scene.object(object_handle.handle)?.measured;
    let angular = if object_handle.has(flag::AXIS) {
        measured.angular()
    } else {
        measured.euler_rate()
    };
    Ok((measured.linear(), angular))
}

fn pose_in(cx: &Cx, object: ObjectRef, frame: impl Into<Frame>) -> Result<Pose> {
    Ok(cx.scene().pose_in(
        object.handle,
        frame.into(),
        object.has(flag::REL_JOINT_BASE_FRAME),
    )?)
}

fn place(cx: &mut Cx, object: ObjectRef, placement: Placement, frame: Frame) -> Result<()> {
    Ok(cx.scene_mut().place(
        object.handle,
        placement,
        frame,
        object.has(flag::REL_JOINT_BASE_FRAME),
    )?)
}

/// The numbers and the frame, whichever came first.
fn arrange<const N: usize>(
    first: Operand<N, impl Into<Frame>>,
    second: Operand<N, impl Into<Frame>>,
) -> Result<([f64; N], Frame)> {
    let (numbers, frame) = arranged(first, second)?;
    Ok((checked(numbers)?, frame))
}

/// Refuses what is not a number; infinity passes.
pub(crate) fn checked<const N: usize>(numbers: [f64; N]) -> Result<[f64; N]> {
    if numbers.iter().any(|number| number.is_nan()) {
        Err(SceneError::InvalidData.into())
    } else {
        Ok(numbers)
    }
}

/// A frame, as sim.getObjectPosition reads it: a float is the world, and the inverse is not known to them.
struct PositionFrame(Frame);
/// A frame, as the other functions read it: it must be an integer.
struct StrictFrame(Frame);
/// A frame in the place of the data: any number, and the data must follow.
struct LegacyFrame(Frame);

macro_rules! frames {
    ($($name:ident |$args:ident| $decode:expr;)*) => { $(
        impl FromScript for $name {
            const TYPE: &'static str = "int";

            fn from_script<'a, S: Source<'a>>($args: &Args<'a, S>) -> Result<Self> {
                $decode.map($name)
            }
        }

        impl From<$name> for Frame {
            fn from(frame: $name) -> Self {
                frame.0
            }
        }

        impl From<$name> for Data {
            fn from(frame: $name) -> Self {
                frame.0.into()
            }
        }

        /// For defaults, which are `sim.handle_world`.
        impl From<i64> for $name {
            fn from(_: i64) -> Self {
                Self(Frame::World)
            }
        }
    )* };
}

frames! {
    PositionFrame |args| match i64::from_script(args) {
        Ok(special::INVERSE) => Err(SceneError::NoSuchObject.into()),
        Ok(raw) => Ok(Frame::from_raw(raw)?),
        Err(_) => f64::from_script(args).map(|_| Frame::World),
    };
    StrictFrame |args| Ok::<_, ApiError>(Frame::from_raw(i64::from_script(args)?)?);
    LegacyFrame |args| {
        args.require(3)?;
        Frame::from_script(args)
    };
}
