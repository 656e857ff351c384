//! `sim.*`: flags of objects and models, explicit handling, sizes, referenced handles.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::values::extension_string;
use scene::{
    Field, Handle, Kind, ModelFlags, Object, ObjectFlags, References, Scene, SceneError,
    SpecialFlags, flag, special,
};
use script::{Handles, Number, ObjectRef};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object_property,
    set_object_property,
    get_object_special_property,
    set_object_special_property,
    get_model_property,
    set_model_property,
    get_extension_string,
    get_explicit_handling,
    set_explicit_handling,
    get_object_size_factor,
    get_object_size_values,
    set_object_size_values,
    get_referenced_handles,
    set_referenced_handles,
    get_referenced_handles_tags,
];

/// Flags of an object.
///
/// @param objectHandle the object
/// @return property sim.objectproperty_* bits
#[api("sim.getObjectProperty")]
fn get_object_property(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx.scene().object(object_handle)?.object_property.bits())
}

/// Sets the flags of an object.
///
/// @param objectHandle the object
/// @param property sim.objectproperty_* bits
/// @return result 1
#[api("sim.setObjectProperty")]
fn set_object_property(cx: &mut Cx, object_handle: Handle, property: Number) -> Result<i64> {
    cx.scene_mut()
        .modify(object_handle, Field::ObjectProperty, |object| {
            object.object_property = ObjectFlags::from_bits_retain(property.0);
        })?;
    Ok(1)
}

/// Special properties of an object: collidable, measurable, detectable; its own flags, without those of models.
///
/// @param objectHandle the object
/// @return property sim.objectspecialproperty_* bits
#[api("sim.getObjectSpecialProperty")]
fn get_object_special_property(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx.scene().object(object_handle)?.special_property.bits())
}

/// Sets what an object can be to sensors and checks.
///
/// @param objectHandle the object
/// @param property sim.objectspecialproperty_* bits
/// @return result 1
#[api("sim.setObjectSpecialProperty")]
fn set_object_special_property(
    cx: &mut Cx,
    object_handle: Handle,
    property: Number,
) -> Result<i64> {
    cx.scene_mut()
        .set_special_property(object_handle, SpecialFlags::from_bits_retain(property.0))?;
    Ok(1)
}

/// Flags of a model.
///
/// @param objectHandle the object
/// @return property sim.modelproperty_* bits; sim.modelproperty_not_model if it is no model base
#[api("sim.getModelProperty")]
fn get_model_property(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx.scene().object(object_handle)?.model_property.bits())
}

/// Makes an object a model base with these flags, or with sim.modelproperty_not_model no model base.
///
/// @param objectHandle the object
/// @param property sim.modelproperty_* bits
/// @return result 1
#[api("sim.setModelProperty")]
fn set_model_property(cx: &mut Cx, object_handle: Handle, property: Number) -> Result<i64> {
    let change =
        |object: &mut Object| object.set_model_property(ModelFlags::from_bits_retain(property.0));
    cx.scene_mut()
        .modify(object_handle, Field::ModelProperty, change)?;
    Ok(1)
}

fn explicit_flag(object: &mut Object) -> std::result::Result<&mut bool, SceneError> {
    match &mut object.kind {
        Kind::ProximitySensor(sensor) => Ok(&mut sensor.explicit),
        Kind::VisionSensor(sensor) => Ok(&mut sensor.explicit),
        Kind::Graph(graph) => Ok(&mut graph.explicit),
        Kind::Path(path) => Ok(&mut path.explicit),
        Kind::Joint(joint) => Ok(&mut joint.explicit),
        _ => Err(SceneError::InvalidArgument),
    }
}

/// The extension string of an object or the scene, for renderers: `povray {focalBlur {true}} openGL3 {...}`.
///
/// @param objectHandle the object, or sim.handle_scene
/// @param index -1: of the object itself; from 0: of the colour of a mesh, of another object only 0
/// @param key one entry, the innermost name first: `focalBlur@povray`; nothing or an empty text for the whole string
/// @return theString nothing when there is no such entry
#[api("sim.getExtensionString")]
fn get_extension_string(
    cx: &Cx,
    object_handle: Number,
    index: Number,
    #[default(None)] key: Option<String>,
) -> Result<Option<String>> {
    let scene = cx.scene();
    let text = match (object_handle.0, usize::try_from(index.0)) {
        (special::SCENE, _) => &scene.settings().environment.extension_string,
        (raw, Err(_)) => &object(&scene, raw)?.extension_string,
        (raw, Ok(index)) => {
            colour_extension(object(&scene, raw)?, index).ok_or(SceneError::InvalidArgument)?
        }
    };
    Ok(match key.filter(|key| !key.is_empty()) {
        None => Some(text.clone()),
        Some(key) => extension_string::entry(text, &key).map(str::to_owned),
    })
}

fn object(scene: &Scene, raw: i64) -> Result<&Object> {
    Ok(scene.object(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)?)
}

fn colour_extension(object: &Object, index: usize) -> Option<&String> {
    match &object.kind {
        Kind::Shape(shape) => shape
            .parts
            .get(index)
            .map(|part| &part.appearance.colour_extension),
        _ => (index == 0).then_some(&object.colour_extension),
    }
}

/// The object with a handle. Negative numbers are none.
fn handled(scene: &Scene, raw: i64) -> Result<&Object> {
    if raw < 0 {
        Err(SceneError::InvalidArgument.into())
    } else {
        object(scene, raw)
    }
}

/// The tag of a collision or distance object or IK group of an old scene.
fn explicit_calculation(scene: &mut Scene, handle: i64) -> Option<&mut bool> {
    if scene.collision_objects().get(handle).is_some() {
        return scene
            .collision_objects_mut()
            .get_mut(handle)
            .map(|object| &mut object.explicit);
    }
    if scene.distance_objects().get(handle).is_some() {
        return scene
            .distance_objects_mut()
            .get_mut(handle)
            .map(|object| &mut object.explicit);
    }
    scene
        .ik_groups_mut()
        .get_mut(handle)
        .map(|group| &mut group.explicit)
}

/// Whether an object is handled explicitly, so that handling all leaves it out.
///
/// @param objectHandle proximity sensor, vision sensor, graph, joint or path of V-REP; collision or distance object or IK group of an old scene
/// @return explicitHandlingFlags 1 if so
#[api("sim.getExplicitHandling")]
fn get_explicit_handling(cx: &Cx, object_handle: Number) -> Result<i64> {
    let scene = cx.scene();
    let of_collision = scene
        .collision_objects()
        .get(object_handle.0)
        .map(|object| object.explicit);
    let of_distance = scene
        .distance_objects()
        .get(object_handle.0)
        .map(|object| object.explicit);
    let of_group = scene
        .ik_groups()
        .get(object_handle.0)
        .map(|group| group.explicit);
    if let Some(explicit) = of_collision.or(of_distance).or(of_group) {
        return Ok(i64::from(explicit));
    }
    let explicit = match &handled(&scene, object_handle.0)?.kind {
        Kind::ProximitySensor(sensor) => sensor.explicit,
        Kind::VisionSensor(sensor) => sensor.explicit,
        Kind::Graph(graph) => graph.explicit,
        Kind::Path(path) => path.explicit,
        Kind::Joint(joint) => joint.explicit,
        _ => return Err(SceneError::InvalidArgument.into()),
    };
    Ok(i64::from(explicit))
}

/// Sets whether an object is left out when all are handled. That of a joint counts for simHandleJoint and simResetJoint.
///
/// @param objectHandle proximity sensor, vision sensor, graph, joint or path of V-REP; collision or distance object or IK group of an old scene
/// @param explicitHandlingFlags 1 if so
/// @return result 1
#[api("sim.setExplicitHandling")]
fn set_explicit_handling(
    cx: &mut Cx,
    object_handle: Number,
    explicit_handling_flags: Number,
) -> Result<i64> {
    let explicit = explicit_handling_flags.0 & 1 != 0;
    let mut scene = cx.scene_mut();
    if let Some(flag) = explicit_calculation(&mut scene, object_handle.0) {
        *flag = explicit;
        return Ok(1);
    }
    let handle = handled(&scene, object_handle.0)?.handle();
    scene.try_modify(handle, Field::Sensor, |object| {
        *explicit_flag(object)? = explicit;
        Ok(())
    })?;
    Ok(1)
}

/// Product of all factors an object was scaled by.
///
/// @param objectHandle the object
/// @return sizeFactor the product
#[api("sim.getObjectSizeFactor")]
fn get_object_size_factor(cx: &Cx, object_handle: Handle) -> Result<f64> {
    Ok(cx.scene().object(object_handle)?.size_factor)
}

/// Three numbers that are multiplied by every scaling of an object along its axes.
///
/// @param objectHandle the object
/// @return sizeValues initially 1, 1, 1
#[api("sim.getObjectSizeValues")]
fn get_object_size_values(cx: &Cx, object_handle: Handle) -> Result<[f64; 3]> {
    Ok(cx.scene().object(object_handle)?.size_values)
}

/// Sets the three numbers that are multiplied by every scaling of an object.
///
/// @param objectHandle the object
/// @param sizeValues one for each axis
/// @return result 1
#[api("sim.setObjectSizeValues")]
fn set_object_size_values(
    cx: &mut Cx,
    object_handle: Handle,
    size_values: [f64; 3],
) -> Result<i64> {
    cx.scene_mut()
        .modify(object_handle, Field::Other, |object| {
            object.size_values = size_values;
        })?;
    Ok(1)
}

/// Handles an object refers to.
///
/// @param objectHandle the object; with sim.handleflag_keeporiginal: what its copies refer to, too
/// @param tag name of the list
/// @return referencedHandles -1 for objects that are gone
#[api("sim.getReferencedHandles")]
fn get_referenced_handles(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default("")] tag: String,
) -> Result<Vec<i64>> {
    Ok(cx
        .scene()
        .object(object_handle.handle)?
        .referenced(references(object_handle), &tag)
        .to_vec())
}

/// Makes an object refer to others; copies then refer to the copies.
///
/// @param objectHandle the object; with sim.handleflag_keeporiginal: its copies refer to the same objects
/// @param referencedHandles empty to remove the list
/// @param tag name of the list
/// @return result 1
#[api("sim.setReferencedHandles")]
fn set_referenced_handles(
    cx: &mut Cx,
    object_handle: ObjectRef,
    referenced_handles: Handles,
    #[default("")] tag: String,
) -> Result<i64> {
    let kind = references(object_handle);
    cx.scene_mut()
        .set_references(object_handle.handle, kind, &tag, &referenced_handles.0)?;
    Ok(1)
}

/// Names of the lists of handles an object refers to.
///
/// @param objectHandle the object; with sim.handleflag_keeporiginal: the lists that copies keep
/// @return tags in the order they were made
#[api("sim.getReferencedHandlesTags")]
fn get_referenced_handles_tags(cx: &Cx, object_handle: ObjectRef) -> Result<Vec<String>> {
    let scene = cx.scene();
    let lists = scene
        .object(object_handle.handle)?
        .reference_lists(references(object_handle));
    Ok(lists.iter().map(|(tag, _)| tag.clone()).collect())
}

fn references(object: ObjectRef) -> References {
    if object.has(flag::KEEP_ORIGINAL) {
        References::Original
    } else {
        References::Following
    }
}
