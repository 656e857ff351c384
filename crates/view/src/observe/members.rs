//! The members that objects of each type have.

use std::sync::Arc;

use geometry::pose::pose_to_array;
use serde_json::{Value, json};

use super::ScriptError;
use super::meshes::Meshes;
use crate::blobs::{Blob, Hash};
use scene::appearance::colour::Colour;
use scene::appearance::texture_mapping::{ApplyMode, TextureMapping};
use scene::joint::{Joint, JointType};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::sensor::{Light, LightType, ProximitySensor, View};
use scene::shape::Part;
use scene::{Kind, Object, Scene};

type Blobs = Vec<Arc<Blob>>;

/// The members of an object's type; what they refer to is added to `blobs`.
pub(super) fn of_kind(
    scene: &Scene,
    object: &Object,
    error: Option<&ScriptError>,
    meshes: &mut Meshes,
    blobs: &mut Blobs,
) -> Value {
    let color = object.colour.ambient_diffuse;
    match &object.kind {
        Kind::Shape(shape) => {
            let parts = shape
                .parts
                .iter()
                .map(|part| mesh(scene, part, meshes, blobs));
            json!({ "meshes": parts.collect::<Vec<_>>() })
        }
        Kind::Joint(joint) => of_joint(joint, color),
        Kind::Dummy(dummy) => match dummy.link {
            Some(linked) => {
                json!({ "size": dummy.size, "color": color, "linkedDummy": linked.raw() })
            }
            None => json!({ "size": dummy.size, "color": color }),
        },
        Kind::ForceSensor(sensor) => json!({ "size": sensor.size, "color": color }),
        Kind::Camera(camera) => of_view(&camera.view, camera.size, color),
        Kind::VisionSensor(sensor) => {
            let mut value = of_view(&sensor.view, sensor.size, color);
            value["resolution"] = json!(sensor.view.resolution);
            value
        }
        Kind::Light(light) => of_light(light),
        Kind::ProximitySensor(sensor) => of_proximity_sensor(sensor, color),
        Kind::OcTree(octree) => {
            let voxels: Vec<_> = octree
                .voxels()
                .map(|(centre, voxel)| (centre, voxel.colour))
                .collect();
            let size = if octree.shows_points {
                octree.point_size
            } else {
                octree.voxel_size()
            };
            of_points(
                Blob::points(&voxels),
                size,
                &object.colour,
                octree.shows_points,
                blobs,
            )
        }
        Kind::PointCloud(cloud) => {
            let points: Vec<_> = cloud
                .points
                .iter()
                .map(|point| (point.position, point.colour))
                .collect();
            of_points(
                Blob::points(&points),
                cloud.point_size as f64,
                &object.colour,
                true,
                blobs,
            )
        }
        Kind::Path(_) => json!({ "color": color }),
        Kind::Graph(graph) => json!({ "size": graph.size, "color": color }),
        Kind::Script(script) => of_script(script, error),
    }
}

fn colours(colour: &Colour) -> Value {
    json!({ "diffuse": colour.ambient_diffuse, "specular": colour.specular, "emission": colour.emission })
}

fn mesh(scene: &Scene, part: &Part, meshes: &mut Meshes, blobs: &mut Blobs) -> Value {
    let blob = meshes.mesh(part);
    let appearance = &part.appearance;
    let texture = part
        .texture
        .as_deref()
        .and_then(|mapping| texture(scene, mapping, meshes, blobs));
    let value = json!({
        "blob": blob.hash.to_string(),
        "color": colours(&appearance.colour),
        "transparency": 1.0 - appearance.colour.opacity.clamp(0.0, 1.0),
        "showEdges": appearance.edges,
        "edgeColor": [0.0, 0.0, 0.0],
        "culling": appearance.culling,
        "wireframe": appearance.wireframe,
        "texture": texture,
    });
    blobs.push(blob);
    value
}

fn texture(
    scene: &Scene,
    mapping: &TextureMapping,
    meshes: &mut Meshes,
    blobs: &mut Blobs,
) -> Option<Value> {
    let blob = meshes.image(scene, mapping.source)?;
    let value = json!({
        "blob": blob.hash.to_string(),
        "interpolate": mapping.interpolate,
        "decal": mapping.apply_mode == ApplyMode::DECAL,
        "repeat": mapping.repeat,
    });
    blobs.push(blob);
    Some(value)
}

fn of_joint(joint: &Joint, color: [f32; 3]) -> Value {
    let joint_type = match joint.joint_type {
        JointType::Revolute => "revolute",
        JointType::Prismatic => "prismatic",
        JointType::Spherical => "spherical",
    };
    let [length, diameter] = joint.size;
    json!({
        "jointType": joint_type,
        "jointPosition": joint.position,
        "cyclic": joint.cyclic,
        "interval": [joint.min, joint.min + joint.range],
        "intrinsicPose": pose_to_array(&joint.intrinsic_pose()),
        "jointLength": length,
        "jointDiameter": diameter,
        "color": color,
    })
}

fn of_view(view: &View, size: f64, color: [f32; 3]) -> Value {
    json!({
        "perspective": view.perspective,
        "viewAngle": view.angle,
        "orthoSize": view.ortho_size,
        "clippingPlanes": view.clipping,
        "showFrustum": view.show_frustum,
        "size": size,
        "color": color,
    })
}

fn of_light(light: &Light) -> Value {
    let light_type = match light.light_type {
        LightType::Omnidirectional => "omni",
        LightType::Spot => "spot",
        LightType::Directional => "directional",
    };
    json!({
        "lightType": light_type,
        "enabled": light.enabled,
        "diffuse": light.colour.ambient_diffuse,
        "specular": light.colour.specular,
        "spotAngle": light.spot_cutoff,
        "spotExponent": light.spot_exponent,
        "attenuation": light.attenuation,
        "size": light.size,
    })
}

fn of_proximity_sensor(sensor: &ProximitySensor, color: [f32; 3]) -> Value {
    let volume: Vec<f32> = sensor
        .volume
        .edges()
        .iter()
        .flatten()
        .flatten()
        .map(|number| *number as f32)
        .collect();
    let detection = sensor.detection.map(|detection| {
        json!({ "point": detection.point, "distance": detection.distance(), "object": detection.object.raw() })
    });
    json!({
        "volume": volume, "showVolume": sensor.show_volume, "size": sensor.size, "color": color, "detection": detection,
    })
}

fn of_points(
    blob: Arc<Blob>,
    size: f64,
    colour: &Colour,
    as_points: bool,
    blobs: &mut Blobs,
) -> Value {
    let value = json!({ "blob": blob.hash.to_string(), "size": size, "points": as_points, "color": colour.ambient_diffuse });
    blobs.push(blob);
    value
}

fn of_script(script: &ScriptObject, error: Option<&ScriptError>) -> Value {
    let script_type = match script.script_type {
        ScriptType::Main => "main",
        ScriptType::Simulation => "simulation",
        ScriptType::AddOn => "addon",
        ScriptType::Customization => "customization",
        ScriptType::Sandbox => "sandbox",
        ScriptType::Passive => "passive",
    };
    json!({
        "scriptType": script_type,
        "language": script.language,
        "enabled": !script.disabled,
        "version": Hash::of(&script.code).to_string(),
        "error": error.map(|error| json!({ "line": error.line, "message": error.message })),
    })
}
