//! Nodes, and the cameras and lights they hold.

use serde_json::{Value, json};

use crate::gltf::asset::{Camera, Extent, Light, LightKind, Node};

/// Nodes name cameras and lights by their order of use.
pub(super) fn nodes(nodes: &[Node]) -> Vec<Value> {
    let mut children = vec![Vec::new(); nodes.len()];
    for (number, node) in nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            children[parent].push(number);
        }
    }
    let (mut cameras, mut lights) = (0.., 0..);
    let with_numbers = nodes.iter().zip(children).map(|(node, children)| {
        let mut value = frame(node, &children);
        if node.camera.is_some() {
            value["camera"] = json!(cameras.next());
        }
        if node.light.is_some() {
            value["extensions"] = json!({ "KHR_lights_punctual": { "light": lights.next() } });
        }
        value
    });
    with_numbers.collect()
}

/// What is as usual is left out.
fn frame(node: &Node, children: &[usize]) -> Value {
    let mut value = json!({});
    if !node.name.is_empty() {
        value["name"] = json!(node.name);
    }
    if node.translation != [0.0; 3] {
        value["translation"] = json!(node.translation);
    }
    if node.rotation != [0.0, 0.0, 0.0, 1.0] {
        value["rotation"] = json!(node.rotation);
    }
    if let Some(mesh) = node.mesh {
        value["mesh"] = json!(mesh);
    }
    if !children.is_empty() {
        value["children"] = json!(children);
    }
    value
}

pub(super) fn cameras_and_lights(nodes: &[Node]) -> (Vec<Value>, Vec<Value>) {
    let cameras = nodes
        .iter()
        .filter_map(|node| node.camera.as_ref())
        .map(camera);
    let lights = nodes
        .iter()
        .filter_map(|node| node.light.as_ref())
        .map(light);
    (cameras.collect(), lights.collect())
}

fn camera(camera: &Camera) -> Value {
    let [near, far] = camera.clipping;
    match camera.extent {
        Extent::Angle(angle) => json!({ "type": "perspective", "perspective":
            { "yfov": angle, "aspectRatio": camera.aspect_ratio, "znear": near, "zfar": far } }),
        Extent::Height(height) => json!({ "type": "orthographic", "orthographic":
            { "xmag": height / 2.0 * camera.aspect_ratio, "ymag": height / 2.0, "znear": near, "zfar": far } }),
    }
}

fn light(light: &Light) -> Value {
    let kind = match light.kind {
        LightKind::Point => "point",
        LightKind::Directional => "directional",
        LightKind::Spot(_) => "spot",
    };
    let mut value = json!({ "type": kind, "color": light.color, "intensity": light.intensity });
    if let LightKind::Spot(angle) = light.kind {
        value["spot"] = json!({ "outerConeAngle": angle });
    }
    value
}
