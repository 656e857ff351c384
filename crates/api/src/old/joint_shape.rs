//! `sim.*`: deprecated functions of joints and shapes that have no alias with the same arguments.

use api_macro::api;
use geometry::MassProperties;
use geometry::pose::{pose_from_matrix, pose_to_matrix};

use crate::{ApiFn, Cx, Result, functions};
use scene::{Field, Handle, Pose, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_joint_matrix,
    set_spherical_joint_matrix,
    get_joint_max_force,
    set_joint_max_force,
    get_shape_mass_and_inertia,
    set_shape_mass_and_inertia,
    reorient_shape_bounding_box,
];

/// The moving side of a joint in the joint's frame.
///
/// @param objectHandle the joint
/// @return matrix rows of rotation and position
#[api("sim.getJointMatrix")]
fn get_joint_matrix(cx: &Cx, object_handle: Handle) -> Result<[f64; 12]> {
    Ok(pose_to_matrix(
        &cx.scene().object(object_handle)?.joint()?.intrinsic_pose(),
    ))
}

/// Turns a spherical joint.
///
/// @param objectHandle the joint
/// @param matrix rows of rotation and position; the rotation counts
#[api("sim.setSphericalJointMatrix")]
fn set_spherical_joint_matrix(cx: &mut Cx, object_handle: Handle, matrix: [f64; 12]) -> Result<()> {
    let rotation = pose_from_matrix(&matrix).rotation;
    Ok(cx
        .scene_mut()
        .try_modify(object_handle, Field::JointPosition, |object| {
            let joint = object.joint_mut()?;
            if joint.single_axis().is_ok() {
                return Err(SceneError::WrongType("spherical joint"));
            }
            joint.spherical = rotation;
            Ok(())
        })?)
}

/// Target force of a joint.
///
/// @param jointHandle the joint
/// @return forceOrTorque N or N m
#[api("sim.getJointMaxForce")]
fn get_joint_max_force(cx: &Cx, joint_handle: Handle) -> Result<f64> {
    Ok(cx.scene().object(joint_handle)?.joint()?.target_force)
}

/// Sets the target force of a joint; its sign follows the target velocity.
///
/// @param jointHandle the joint
/// @param forceOrTorque N or N m
#[api("sim.setJointMaxForce")]
fn set_joint_max_force(cx: &mut Cx, joint_handle: Handle, force_or_torque: f64) -> Result<()> {
    if force_or_torque.is_nan() {
        return Err(SceneError::InvalidData.into());
    }
    Ok(cx.scene_mut().control_joint(joint_handle, |joint| {
        joint.set_target_force(force_or_torque, false);
    })?)
}

/// Pose of a shape in the requested frame: the world unless a matrix is passed.
fn pose_in(cx: &Cx, shape: Handle, frame: Option<[f64; 12]>) -> Result<Pose> {
    let frame = frame.map_or_else(Pose::identity, |matrix| pose_from_matrix(&matrix));
    Ok(frame.inverse() * cx.scene().world_pose(shape)?)
}

/// Mass, inertia and centre of mass of a shape.
///
/// @param shapeHandle the shape
/// @param transformation frame of the results, in the world; the world if missing
/// @return mass kg
/// @return inertiaMatrix kg m2, about the centre of mass
/// @return centerOfMass metres
#[api("sim.getShapeMassAndInertia")]
fn get_shape_mass_and_inertia(
    cx: &Cx,
    shape_handle: Handle,
    #[default(None)] transformation: Option<[f64; 12]>,
) -> Result<(f64, Vec<f64>, [f64; 3])> {
    let mass = cx.scene().object(shape_handle)?.shape()?.mass;
    let seen = mass.reexpressed(&pose_in(cx, shape_handle, transformation)?);
    Ok((seen.mass, seen.absolute_inertia().to_vec(), seen.com))
}

/// Changes mass, inertia and centre of mass of a shape.
///
/// @param shapeHandle the shape
/// @param mass kg
/// @param inertiaMatrix kg m2, about the centre of mass
/// @param centerOfMass metres
/// @param transformation frame of the values, in the world; the world if missing
#[api("sim.setShapeMassAndInertia")]
fn set_shape_mass_and_inertia(
    cx: &mut Cx,
    shape_handle: Handle,
    mass: f64,
    inertia_matrix: [f64; 9],
    center_of_mass: [f64; 3],
    #[default(None)] transformation: Option<[f64; 12]>,
) -> Result<()> {
    let [x, y, z] = center_of_mass;
    let placed = pose_in(cx, shape_handle, transformation)?;
    let mut given = MassProperties::default();
    given.set_mass(mass);
    given.set_absolute_inertia(
        &inertia_matrix,
        &pose_to_matrix(&Pose::translation(x, y, z)),
    );
    let own = given.reexpressed(&placed.inverse());
    Ok(cx.scene_mut().reshape(shape_handle, |shape| {
        shape.mass = own;
        Ok(())
    })?)
}

/// Turns the bounding box of a shape to the axes of another object.
///
/// @param shapeHandle the shape
/// @param relativeToHandle the object, -1 for the world
/// @return result 1, or 0 for a single primitive, which keeps its box
#[api("sim.reorientShapeBoundingBox")]
fn reorient_shape_bounding_box(
    cx: &mut Cx,
    shape_handle: Handle,
    relative_to_handle: Number,
) -> Result<i64> {
    let frame = match relative_to_handle.0 {
        ..0 => Pose::identity(),
        raw => cx
            .scene()
            .world_pose(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)?,
    };
    Ok(i64::from(
        cx.scene_mut()
            .align_shape_box(shape_handle, Some(frame.rotation))?,
    ))
}
