//! Objects as JSON: what all have, then the members of each type.

use serde_json::{Value, json};

use super::meshes::Meshes;
use super::{ObservedObject, ScriptError, members};
use scene::{Handle, Kind, Object, ObjectFlags, Scene};
use script::property_table::object_class;

/// An object as pages show it; `place` is that among its siblings.
pub(super) fn object(
    scene: &Scene,
    object: &Object,
    place: usize,
    error: Option<&ScriptError>,
    meshes: &mut Meshes,
) -> ObservedObject {
    let mut value = json!({
        "handle": object.handle().raw(),
        "uid": object.uid(),
        "alias": object.alias(),
        "parent": object.parent().map_or(-1, scene::Handle::raw),
        "childOrder": place,
        "objectType": object_class(&object.kind).word,
        "visible": scene.is_visible(object.handle()).unwrap_or(false) && !holds_only_lights(scene, object),
        "layer": object.layer.bits(),
        "modelBase": object.is_model(),
        "selectable": object.object_property.contains(ObjectFlags::SELECTABLE),
        "modelSelectable": object.object_property.contains(ObjectFlags::SELECT_MODEL),
    });
    let (low, high) = object.extent();
    if low != high && low.iter().chain(high.iter()).all(|x| x.is_finite()) {
        value["boundingBox"] = json!([[low.x, low.y, low.z], [high.x, high.y, high.z]]);
    }
    let mut blobs = Vec::new();
    let own = members::of_kind(scene, object, error, meshes, &mut blobs);
    if let (Value::Object(all), Value::Object(own)) = (&mut value, own) {
        all.extend(own);
    }
    ObservedObject {
        text: value.to_string().into(),
        blobs,
    }
}

/// A dummy that only keeps the lights of a scene together would stand large in the middle of small robots.
fn holds_only_lights(scene: &Scene, object: &Object) -> bool {
    let is_light = |child: &Handle| {
        scene
            .object(*child)
            .is_ok_and(|child| matches!(child.kind, Kind::Light(_)))
    };
    matches!(object.kind, Kind::Dummy(_))
        && !object.children().is_empty()
        && object.children().iter().all(is_light)
}
