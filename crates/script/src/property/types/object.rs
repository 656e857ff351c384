//! Properties common to all objects.

use geometry::pose::{pose_from_array, pose_to_array};

use super::access::{Accessor, object_properties, pair, placed_properties, refused};
use super::table::object_class;
use super::{Long, PoseArray, Text, Vector3};
use crate::binding::args::Bytes;
use scene::object::movement::MovementFrame;
use scene::{
    ForbiddenMovements, Handle, Layers, ModelFlags, Object, ObjectFlags, PreferredAxes, Scene,
    SceneResult, SpecialFlags, clean_alias,
};

pub(in crate::property) const OWN: &[Accessor] = object_properties! {
    "layer": i64, |o| o.layer.number(), Layer |o, layer| o.layer = Layers::from_number(layer);
    "objectUid": Long, |o| Long(o.uid());
    "parentHandle": i64, |o| o.parent().map_or(-1, Handle::raw);
    "calcLinearVelocity": Vector3, |o| Vector3(o.measured.linear());
    "calcRotationAxis": Vector3, |o| Vector3(rotation(o).0);
    "calcRotationVelocity": f64, |o| rotation(o).1;
    "hierarchyColor": i64, |o| o.hierarchy_colour, Inert |o, colour| o.hierarchy_colour = colour;
    "collectionSelfCollisionIndicator": i64, |o| o.self_collision_indicator,
        Inert |o, indicator| o.self_collision_indicator = indicator;
    "persistentUid": String, |o| o.persistent_uid.clone();
    "dna": Bytes, |o| Bytes(o.dna.clone());
    "bbPose": PoseArray, |o| PoseArray(pose_to_array(&o.bounding_box().pose));
    "bbHSize": Vector3, |o| Vector3(o.bounding_box().size.map(|extent| extent / 2.0));
    "dynamicFlag": i64, |o| o.dynamic_flag.bits();
    "objectType": String, |o| object_class(&o.kind).word.to_owned();
};

pub(in crate::property) const PLACED: &[Accessor] = placed_properties! {
    "alias": Text, |scene, h| Text(scene.object(h)?.alias().into()),
        |scene, h, alias| if clean_alias(&alias.0).as_bytes() == alias.0 { scene.set_alias(h, &alias.0)? };
    "pose": PoseArray, |scene, h| PoseArray(pose_to_array(&scene.object(h)?.pose())),
        |scene, h, pose| scene.set_local_pose(h, pose_from_array(&pose.0))?;
    "childOrder": i64, |scene, h| scene.child_order(h)?.map_or(-1, numbers::count);
    "parentUid": Long, |scene, h| {
        let parent = scene.object(h)?.parent();
        Long(parent.map_or(Ok(-1), |parent| scene.object(parent).map(Object::uid))?)
    };
    "modelInvisible": bool, |scene, h| scene.calculated_model_property(h).contains(ModelFlags::NOT_VISIBLE);
    "visible": bool, |scene, h| scene.is_visible(h)?;
    "selected": bool, |scene, h| scene.selection().contains(&h), |scene, h, on| select(&mut scene, h, on);
};

/// Rows of properties that are a bit of a field of the object.
macro_rules! bits {
    ($($name:literal: $flags:ident $field:ident $bits:expr;)*) => { object_properties! { $(
        $name: bool, |o| o.$flags.intersects($bits), $field |o, on| o.$flags.set($bits, on);
    )* } };
}

pub(in crate::property) const FLAGS: &[Accessor] = bits! {
    "collidable": special_property SpecialProperty SpecialFlags::COLLIDABLE;
    "measurable": special_property SpecialProperty SpecialFlags::MEASURABLE;
    "detectable": special_property SpecialProperty SpecialFlags::DETECTABLE;
    "ignoreViewFitting": object_property ObjectProperty ObjectFlags::IGNORE_VIEW_FITTING;
    "collapsed": object_property ObjectProperty ObjectFlags::COLLAPSED;
    "selectable": object_property ObjectProperty ObjectFlags::SELECTABLE;
    "selectModel": object_property ObjectProperty ObjectFlags::SELECT_MODEL;
    "hideFromModelBB": object_property ObjectProperty ObjectFlags::HIDE_FROM_MODEL_BOX;
    "selectInvisible": object_property ObjectProperty ObjectFlags::SELECT_INVISIBLE;
    "depthInvisible": object_property ObjectProperty ObjectFlags::DEPTH_INVISIBLE;
    "cannotDelete": object_property ObjectProperty ObjectFlags::CANNOT_DELETE;
    "cannotDeleteInSim": object_property ObjectProperty ObjectFlags::CANNOT_DELETE_IN_SIMULATION;
    "model.notCollidable": model_property ModelProperty ModelFlags::NOT_COLLIDABLE;
    "model.notMeasurable": model_property ModelProperty ModelFlags::NOT_MEASURABLE;
    "model.notDetectable": model_property ModelProperty ModelFlags::NOT_DETECTABLE;
    "model.notDynamic": model_property ModelProperty ModelFlags::NOT_DYNAMIC;
    "model.notRespondable": model_property ModelProperty ModelFlags::NOT_RESPONDABLE;
    "model.notVisible": model_property ModelProperty ModelFlags::NOT_VISIBLE;
    "model.scriptsNotActive": model_property ModelProperty ModelFlags::SCRIPTS_INACTIVE;
    "model.notInParentBB": model_property ModelProperty ModelFlags::NOT_IN_PARENT_BOX;
};

pub(in crate::property) const FLAG_SETS: &[Accessor] = object_properties! {
    "objectPropertyFlags": i64, |o| o.object_property.bits(),
        ObjectProperty |o, bits| o.object_property = ObjectFlags::from_bits_retain(bits);
    "model.propertyFlags": i64, |o| o.model_property.bits(),
        ModelProperty |o, bits| o.set_model_property(ModelFlags::from_bits_retain(bits));
    "modelBase": bool, |o| o.is_model(), ModelProperty |o, on| {
        if on != o.is_model() {
            o.model_property = if on { ModelFlags::empty() } else { ModelFlags::NOT_MODEL };
        }
    };
};

/// Rows of how a hand may move the object.
macro_rules! movement {
    ($($name:literal: $ty:ty, $field:ident, |$v:ident| $set:expr, |$read:ident| $get:expr;)*) => { object_properties! { $(
        $name: $ty, |o| { let $read = o.movement.$field; $get }, Inert |o, $v| o.movement.$field = $set;
    )* } };
}

pub(in crate::property) const MOVEMENT: &[Accessor] = movement! {
    "mov.optionsFlags": i64, forbidden, |bits| ForbiddenMovements::from_bits_retain(bits), |flags| flags.bits();
    "mov.stepSize": Vec<f64>, step, |steps| pair(&steps)?, |steps| steps.to_vec();
    "mov.relativity": Vec<i64>, relativity,
        |frames| int_pair(&frames)?.map(MovementFrame), |frames| frames.map(|frame| frame.0).to_vec();
    "mov.preferredAxesFlags": i64, preferred_axes,
        |bits| PreferredAxes::from_bits_retain(bits) & PreferredAxes::ALL_AXES, |axes| axes.bits();
};

/// Rows of properties that are a bit of the movement; `!` for bits that forbid what the property allows.
macro_rules! movement_bits {
    ($($name:literal: $flags:ident $(! $forbid:path)? $(= $allow:path)?;)*) => { object_properties! { $(
        $name: bool, |o| movement_bits!(@get o.movement.$flags, $(! $forbid)? $(= $allow)?),
            Inert |o, on| movement_bits!(@set o.movement.$flags, on, $(! $forbid)? $(= $allow)?);
    )* } };
    (@get $flags:expr, ! $forbid:path) => { !$flags.contains($forbid) };
    (@get $flags:expr, = $allow:path) => { $flags.contains($allow) };
    (@set $flags:expr, $on:ident, ! $forbid:path) => { $flags.set($forbid, !$on) };
    (@set $flags:expr, $on:ident, = $allow:path) => { $flags.set($allow, $on) };
}

pub(in crate::property) const MOVEMENT_FLAGS: &[Accessor] = movement_bits! {
    "mov.translNoSim": forbidden !ForbiddenMovements::TRANSLATION_STOPPED;
    "mov.translInSim": forbidden !ForbiddenMovements::TRANSLATION_RUNNING;
    "mov.rotNoSim": forbidden !ForbiddenMovements::ROTATION_STOPPED;
    "mov.rotInSim": forbidden !ForbiddenMovements::ROTATION_RUNNING;
    "mov.altTransl": forbidden !ForbiddenMovements::OTHER_TRANSLATIONS;
    "mov.altRot": forbidden !ForbiddenMovements::OTHER_ROTATIONS;
    "mov.prefTranslX": preferred_axes = PreferredAxes::TRANSLATION_X;
    "mov.prefTranslY": preferred_axes = PreferredAxes::TRANSLATION_Y;
    "mov.prefTranslZ": preferred_axes = PreferredAxes::TRANSLATION_Z;
    "mov.prefRotX": preferred_axes = PreferredAxes::ROTATION_X;
    "mov.prefRotY": preferred_axes = PreferredAxes::ROTATION_Y;
    "mov.prefRotZ": preferred_axes = PreferredAxes::ROTATION_Z;
};

/// Axis and speed (rad/s) of the measured rotation, world axes; zeros for an object that does not turn.
fn rotation(object: &Object) -> ([f64; 3], f64) {
    let angular = nalgebra::Vector3::from(object.measured.angular());
    let axis = angular.try_normalize(0.0).unwrap_or_default();
    (axis.into(), angular.norm())
}

fn int_pair(values: &[i64]) -> SceneResult<[i64; 2]> {
    values.first_chunk().copied().ok_or_else(refused)
}

fn select(scene: &mut Scene, handle: Handle, on: bool) {
    let mut selection: Vec<Handle> = scene
        .selection()
        .iter()
        .copied()
        .filter(|&h| h != handle)
        .collect();
    if on {
        selection.push(handle);
    }
    scene.select(&selection);
}
