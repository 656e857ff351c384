//! Properties common to all objects.

use geometry::pose::{pose_from_array, pose_to_array};

use super::access::{Accessor, object_properties, pair, placed_properties, refused};
use super::table::object_class;
use super::{Long, PoseArray, Text, Vector3};
use crate::scene::{Handle, Movement, NOT_MODEL, Object, Scene, SceneResult, clean_alias};
use crate::script::Bytes;

/// Bits of the special properties.
mod special {
    pub const COLLIDABLE: i64 = 0x1;
    pub const MEASURABLE: i64 = 0x2;
    pub const DETECTABLE: i64 = 0x1f0;
}

/// Model flag: everything below is invisible.
const NOT_VISIBLE: i64 = 0x100;

pub(super) const OWN: &[Accessor] = object_properties! {
    "layer": i64, |o| o.layer, Layer |o, layer| o.layer = layer & 0xffff;
    "objectUid": Long, |o| Long(o.uid());
    "parentHandle": i64, |o| o.parent().map_or(-1, Handle::raw);
    "calcLinearVelocity": Vector3, |o| Vector3(o.measured.linear);
    "calcRotationAxis": Vector3, |o| Vector3(rotation(o).0);
    "calcRotationVelocity": f64, |o| rotation(o).1;
    "hierarchyColor": i64, |o| o.hierarchy_colour, Inert |o, colour| o.hierarchy_colour = colour;
    "collectionSelfCollisionIndicator": i64, |o| o.self_collision_indicator,
        Inert |o, indicator| o.self_collision_indicator = indicator;
    "persistentUid": String, |o| o.persistent_uid.clone();
    "dna": Bytes, |o| Bytes(o.dna.clone());
    "bbPose": PoseArray, |o| PoseArray(pose_to_array(&o.bounding_box().pose));
    "bbHSize": Vector3, |o| Vector3(o.bounding_box().size.map(|extent| extent / 2.0));
    "dynamicFlag": i64, |o| o.dynamic_flag;
    "objectType": String, |o| object_class(&o.kind).word.to_owned();
};

pub(super) const PLACED: &[Accessor] = placed_properties! {
    "alias": Text, |scene, h| Text(scene.object(h)?.alias().into()),
        |scene, h, alias| if clean_alias(&alias.0).as_bytes() == alias.0 { scene.set_alias(h, &alias.0)? };
    "pose": PoseArray, |scene, h| PoseArray(pose_to_array(&scene.object(h)?.pose())),
        |scene, h, pose| scene.set_local_pose(h, pose_from_array(&pose.0))?;
    "childOrder": i64, |scene, h| scene.child_order(h)?.map_or(-1, |order| order as i64);
    "parentUid": Long, |scene, h| {
        let parent = scene.object(h)?.parent();
        Long(parent.map_or(Ok(-1), |parent| scene.object(parent).map(Object::uid))?)
    };
    "modelInvisible": bool, |scene, h| scene.calculated_model_property(h) & NOT_VISIBLE != 0;
    "visible": bool, |scene, h| scene.is_visible(h)?;
    "selected": bool, |scene, h| scene.selection().contains(&h), |scene, h, on| select(&mut scene, h, on);
};

/// Rows of properties that are a bit of a field of the object.
macro_rules! bits {
    ($($name:literal: $flags:ident $field:ident $bits:expr;)*) => { object_properties! { $(
        $name: bool, |o| o.$flags & $bits != 0, $field |o, on| set_bits(&mut o.$flags, $bits, on);
    )* } };
}

pub(super) const FLAGS: &[Accessor] = bits! {
    "collidable": special_property SpecialProperty special::COLLIDABLE;
    "measurable": special_property SpecialProperty special::MEASURABLE;
    "detectable": special_property SpecialProperty special::DETECTABLE;
    "ignoreViewFitting": object_property ObjectProperty 0x1;
    "collapsed": object_property ObjectProperty 0x10;
    "selectable": object_property ObjectProperty 0x20;
    "selectModel": object_property ObjectProperty 0x80;
    "hideFromModelBB": object_property ObjectProperty 0x100;
    "selectInvisible": object_property ObjectProperty 0x800;
    "depthInvisible": object_property ObjectProperty 0x1000;
    "cannotDelete": object_property ObjectProperty 0x2000;
    "cannotDeleteInSim": object_property ObjectProperty 0x4000;
    "model.notCollidable": model_property ModelProperty 0x1;
    "model.notMeasurable": model_property ModelProperty 0x2;
    "model.notDetectable": model_property ModelProperty 0x8;
    "model.notDynamic": model_property ModelProperty 0x20;
    "model.notRespondable": model_property ModelProperty 0x40;
    "model.notVisible": model_property ModelProperty 0x100;
    "model.scriptsNotActive": model_property ModelProperty 0x200;
    "model.notInParentBB": model_property ModelProperty 0x400;
};

pub(super) const FLAG_SETS: &[Accessor] = object_properties! {
    "objectPropertyFlags": i64, |o| o.object_property, ObjectProperty |o, flags| o.object_property = flags;
    "model.propertyFlags": i64, |o| o.model_property, ModelProperty |o, flags| o.set_model_property(flags);
    "modelBase": bool, |o| o.is_model(), ModelProperty |o, on| {
        if on != o.is_model() {
            o.model_property = if on { 0 } else { NOT_MODEL };
        }
    };
};

/// Rows of how a hand may move the object.
macro_rules! movement {
    ($($name:literal: $ty:ty, $field:ident, |$v:ident| $set:expr, |$read:ident| $get:expr;)*) => { object_properties! { $(
        $name: $ty, |o| { let $read = o.movement.$field; $get }, Inert |o, $v| o.movement.$field = $set;
    )* } };
}

pub(super) const MOVEMENT: &[Accessor] = movement! {
    "mov.optionsFlags": i64, options, |bits| bits, |bits| bits;
    "mov.stepSize": Vec<f64>, step, |steps| pair(&steps)?, |steps| steps.to_vec();
    "mov.relativity": Vec<i64>, relativity, |frames| int_pair(&frames)?, |frames| frames.to_vec();
    "mov.preferredAxesFlags": i64, preferred_axes, |bits| bits & 0x3f, |bits| bits;
};

/// Rows of properties that are a bit of the movement; `!` for bits that forbid what the property allows.
macro_rules! movement_bits {
    ($($name:literal: $flags:ident $(! $forbid:path)? $(= $allow:literal)?;)*) => { object_properties! { $(
        $name: bool, |o| movement_bits!(@get o.movement.$flags, $(! $forbid)? $(= $allow)?),
            Inert |o, on| movement_bits!(@set o.movement.$flags, on, $(! $forbid)? $(= $allow)?);
    )* } };
    (@get $flags:expr, ! $forbid:path) => { $flags & $forbid == 0 };
    (@get $flags:expr, = $allow:literal) => { $flags & $allow != 0 };
    (@set $flags:expr, $on:ident, ! $forbid:path) => { set_bits(&mut $flags, $forbid, !$on) };
    (@set $flags:expr, $on:ident, = $allow:literal) => { set_bits(&mut $flags, $allow, $on) };
}

pub(super) const MOVEMENT_FLAGS: &[Accessor] = movement_bits! {
    "mov.translNoSim": options !Movement::TRANSLATION_STOPPED;
    "mov.translInSim": options !Movement::TRANSLATION_RUNNING;
    "mov.rotNoSim": options !Movement::ROTATION_STOPPED;
    "mov.rotInSim": options !Movement::ROTATION_RUNNING;
    "mov.altTransl": options !Movement::OTHER_TRANSLATIONS;
    "mov.altRot": options !Movement::OTHER_ROTATIONS;
    "mov.prefTranslX": preferred_axes = 0x1;
    "mov.prefTranslY": preferred_axes = 0x2;
    "mov.prefTranslZ": preferred_axes = 0x4;
    "mov.prefRotX": preferred_axes = 0x8;
    "mov.prefRotY": preferred_axes = 0x10;
    "mov.prefRotZ": preferred_axes = 0x20;
};

/// Axis and speed (rad/s) of the measured rotation, world axes; zeros for an object that does not turn.
fn rotation(object: &Object) -> ([f64; 3], f64) {
    let angular = nalgebra::Vector3::from(object.measured.angular);
    let axis = angular.try_normalize(0.0).unwrap_or_default();
    (axis.into(), angular.norm())
}

fn int_pair(values: &[i64]) -> SceneResult<[i64; 2]> {
    values.first_chunk().copied().ok_or_else(refused)
}

fn set_bits(flags: &mut i64, bits: i64, on: bool) {
    if on { *flags |= bits } else { *flags &= !bits }
}

fn select(scene: &mut Scene, handle: Handle, on: bool) {
    let mut selection: Vec<Handle> = scene.selection().iter().copied().filter(|&h| h != handle).collect();
    if on {
        selection.push(handle);
    }
    scene.select(&selection);
}
