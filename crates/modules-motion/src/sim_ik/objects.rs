//! `simIK.*`: joints and dummies, their names, parents and targets.

use api_macro::api;
use kinematics::KinematicsError;

use super::{ApiFn, Cx, Result, functions, object, optional, raw, refused, with};
use scene::joint::JointType;
use script::{Number, Results};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create_dummy,
    create_joint,
    erase_object,
    does_object_exist,
    get_object_handle,
    get_object_type,
    get_objects,
    get_object_parent,
    set_object_parent,
    get_target_dummy,
    set_target_dummy,
];

/// A new dummy at the origin of the world.
///
/// @param environmentHandle the environment
/// @param dummyName its name
/// @return dummyHandle the dummy
#[api("simIK.createDummy")]
fn create_dummy(
    cx: &mut Cx,
    environment_handle: Number,
    #[default(String::new())] dummy_name: String,
) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        Ok(held.env.create_dummy(&dummy_name).raw())
    })
}

/// A new joint at the origin of the world; its axis is z. It belongs to the calculations until its mode is changed.
///
/// @param environmentHandle the environment
/// @param jointType simIK.jointtype_*
/// @param jointName its name
/// @return jointHandle the joint
#[api("simIK.createJoint")]
fn create_joint(
    cx: &mut Cx,
    environment_handle: Number,
    joint_type: Number,
    #[default(String::new())] joint_name: String,
) -> Result<i64> {
    let joint_type =
        JointType::from_code(joint_type.0).ok_or_else(|| refused("invalid joint type."))?;
    let joint_type = ik::joint_type(joint_type);
    with(cx, environment_handle.0, |held| {
        Ok(held.env.create_joint(&joint_name, joint_type).raw())
    })
}

/// Removes an object. Its children stay where they are; elements that need it are removed.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
#[api("simIK.eraseObject")]
fn erase_object(cx: &mut Cx, environment_handle: Number, object_handle: Number) -> Result<()> {
    with(cx, environment_handle.0, |held| {
        held.env.erase(object(object_handle.0)?)
    })
}

/// Whether there is an object with that name.
///
/// @param environmentHandle the environment
/// @param objectName the name
/// @return result
#[api("simIK.doesObjectExist")]
fn does_object_exist(cx: &Cx, environment_handle: Number, object_name: String) -> Result<bool> {
    with(cx, environment_handle.0, |held| {
        Ok(held.env.named(&object_name).is_some())
    })
}

/// The object with that name.
///
/// @param environmentHandle the environment
/// @param objectName the name
/// @return objectHandle the object
#[api("simIK.getObjectHandle")]
fn get_object_handle(cx: &Cx, environment_handle: Number, object_name: String) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        held.env
            .named(&object_name)
            .map(kinematics::ObjectId::raw)
            .ok_or(KinematicsError::NoSuchObject)
    })
}

/// What an object is.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @return objectType simIK.objecttype_joint or simIK.objecttype_dummy
#[api("simIK.getObjectType")]
fn get_object_type(cx: &Cx, environment_handle: Number, object_handle: Number) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        let is_joint = held.env.object(object(object_handle.0)?)?.joint().is_some();
        Ok(if is_joint { 1 } else { 4 })
    })
}

/// All objects, one after the other.
///
/// @param environmentHandle the environment
/// @param index from 0
/// @return objectHandle, objectName, isJoint, jointType the object, its name, whether it is a joint, of which type (0: none); one value -1 where there are no more
#[api("simIK.getObjects")]
fn get_objects(cx: &Cx, environment_handle: Number, index: Number) -> Result<Results> {
    with(cx, environment_handle.0, |held| {
        let found = usize::try_from(index.0)
            .ok()
            .and_then(|index| held.env.objects().nth(index));
        let Some((id, found)) = found else {
            return Ok(Results(vec![(-1).into()]));
        };
        let joint_type = found.joint().map(|joint| joint.joint_type as i64);
        let name = scene::Data::text(&found.name);
        Ok(Results(vec![
            id.raw().into(),
            name,
            joint_type.is_some().into(),
            joint_type.unwrap_or(0).into(),
        ]))
    })
}

/// What an object is attached to.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @return parentObjectHandle -1 for the world
#[api("simIK.getObjectParent")]
fn get_object_parent(cx: &Cx, environment_handle: Number, object_handle: Number) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        Ok(raw(held.env.object(object(object_handle.0)?)?.parent()))
    })
}

/// Attaches an object to another one.
///
/// @param environmentHandle the environment
/// @param objectHandle the object
/// @param parentObjectHandle -1 for the world
/// @param keepInPlace whether it stays where it is in the world, or at the same place as seen from its parent
#[api("simIK.setObjectParent")]
fn set_object_parent(
    cx: &mut Cx,
    environment_handle: Number,
    object_handle: Number,
    parent_object_handle: Number,
    #[default(true)] keep_in_place: bool,
) -> Result<()> {
    with(cx, environment_handle.0, |held| {
        held.env.set_parent(
            object(object_handle.0)?,
            optional(parent_object_handle.0)?,
            keep_in_place,
        )
    })
}

/// The target of a tip, or the tip of a target.
///
/// @param environmentHandle the environment
/// @param dummyHandle the dummy
/// @return targetDummyHandle -1 if there is none
#[api("simIK.getTargetDummy")]
fn get_target_dummy(cx: &Cx, environment_handle: Number, dummy_handle: Number) -> Result<i64> {
    with(cx, environment_handle.0, |held| {
        held.env.partner(object(dummy_handle.0)?).map(raw)
    })
}

/// Makes two dummies tip and target of each other. Both lose other partners.
///
/// @param environmentHandle the environment
/// @param dummyHandle the tip
/// @param targetDummyHandle its target, -1 for none
#[api("simIK.setTargetDummy")]
fn set_target_dummy(
    cx: &mut Cx,
    environment_handle: Number,
    dummy_handle: Number,
    target_dummy_handle: Number,
) -> Result<()> {
    with(cx, environment_handle.0, |held| {
        held.env
            .set_partner(object(dummy_handle.0)?, optional(target_dummy_handle.0)?)
    })
}
