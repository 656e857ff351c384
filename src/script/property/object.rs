//! Properties all objects have.

use super::access::{Accessor, object_properties, placed_properties};
use super::table::object_class;
use super::{Long, PoseArray, Text, Vector3};
use crate::scene::pose::{pose_from_array, pose_to_array};
use crate::scene::{Handle, NOT_MODEL, Object, Scene, clean_alias};

/// Bits of the special properties.
mod special {
    pub const COLLIDABLE: i64 = 0x1;
    pub const MEASURABLE: i64 = 0x2;
    pub const DETECTABLE: i64 = 0x1f0;
}

/// Model flag: everything below is invisible.
const NOT_VISIBLE: i64 = 0x100;

pub(super) const OWN: &[Accessor] = object_properties! {
    "layer": i64, |o| o.layer, Layer |o, layer| o.layer = layer;
    "objectUid": Long, |o| Long(o.uid());
    "parentHandle": i64, |o| o.parent().map_or(-1, Handle::raw);
    "calcLinearVelocity": Vector3, |o| Vector3(o.measured.linear);
    "dynamicFlag": i64, |o| o.dynamic_flag;
    "objectType": String, |o| object_class(&o.kind).word.to_owned();
};

pub(super) const PLACED: &[Accessor] = placed_properties! {
    "alias": Text, |scene, h| Text(scene.object(h)?.alias().into()),
        |scene, h, alias| if clean_alias(&alias.0).as_bytes() == alias.0 { scene.set_alias(h, &alias.0)? };
    "pose": PoseArray, |scene, h| PoseArray(pose_to_array(&scene.object(h)?.pose())),
        |scene, h, pose| scene.set_local_pose(h, pose_from_array(&pose.0))?;
    "childOrder": i64, |scene, h| scene.child_order(h)? as i64;
    "parentUid": Long, |scene, h| {
        let parent = scene.object(h)?.parent();
        Long(parent.map_or(Ok(-1), |parent| scene.object(parent).map(Object::uid))?)
    };
    "modelInvisible": bool, |scene, h| scene.calculated_model_property(h) & NOT_VISIBLE != 0;
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
    "model.propertyFlags": i64, |o| o.model_property, ModelProperty |o, flags| o.model_property = flags;
    "modelPropertyFlags": i64, |o| o.model_property, ModelProperty |o, flags| o.model_property = flags;
    "modelBase": bool, |o| o.is_model(), ModelProperty |o, on| {
        if on != o.is_model() {
            o.model_property = if on { 0 } else { NOT_MODEL };
        }
    };
};

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
