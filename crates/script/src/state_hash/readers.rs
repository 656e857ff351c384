//! Values of objects that are read directly: those that change in nearly every step, large ones, and those that are no properties.

use super::bytes::Bytes;
use geometry::pose::{pose_to_array, quaternion_to_array};
use scene::graph::Graph;
use scene::joint::Joint;
use scene::sensor::force_sensor::ForceSensor;
use scene::sensor::{ProximitySensor, VisionSensor};
use scene::shape::{Part, Shape};
use scene::{Field, Handle, Kind, Object, Pose, Topic, Topics};

/// A value of an object that is read directly.
pub(super) struct Direct {
    /// The property it stands for, or what it is.
    pub name: &'static str,
    /// Further properties that follow from the same values.
    pub also: &'static [&'static str],
    /// The kinds of objects that have it.
    pub of: fn(&Kind) -> bool,
    /// What frequent changes concern it.
    pub topics: Topics,
    /// Concerned by these only, not by other changes of the object.
    pub large: bool,
    /// Writes the value.
    pub read: fn(&Object, &mut Bytes),
}

/// Where an object is in the tree: its parent and the order of its children. Removals of others change that as well.
pub(super) const TREE: usize = 2;

/// All of them; the first [`TREE`] are about the tree.
pub(super) const DIRECT: &[Direct] = &[
    direct("parentHandle", &["parentUid"], any, &[], |o, b| {
        b.int(o.parent().map_or(-1, Handle::raw));
    }),
    direct("children", &["childOrder"], any, &[], |o, b| {
        o.children().iter().for_each(|child| b.int(child.raw()));
    }),
    direct("pose", &[], any, &[Field::Pose], |o, b| pose(&o.pose(), b)),
    direct(
        "calcLinearVelocity",
        &[],
        any,
        &[Field::Measured],
        |o, b| b.floats(&o.measured.linear()),
    ),
    direct(
        "calcRotationVelocity",
        &["calcRotationAxis"],
        any,
        &[Field::Measured],
        |o, b| {
            b.floats(&o.measured.angular());
            b.floats(&o.measured.euler_rate());
        },
    ),
    direct("dynamicFlag", &[], any, &[Field::Measured], |o, b| {
        b.int(o.dynamic_flag.bits());
    }),
    direct("alias", &[], any, &[Field::Alias], |o, b| {
        b.text(o.alias().as_bytes());
        b.text(o.old_name().as_bytes());
    }),
    direct("attributes", &[], any, &[], attributes),
    direct(
        "dynLinearVelocity",
        &[],
        is_shape,
        &[Field::Measured],
        |o, b| with(o.shape(), |s| b.floats(&s.velocity.linear)),
    ),
    direct(
        "dynAngularVelocity",
        &[],
        is_shape,
        &[Field::Measured],
        |o, b| with(o.shape(), |s| b.floats(&s.velocity.angular)),
    ),
    large(
        "mesh geometry",
        &["meshes", "convex", "primitive"],
        is_shape,
        Field::Geometry,
        |o, b| with(o.shape(), |s| geometry_of(s, b)),
    ),
    large("mesh texture", &[], is_shape, Field::Texture, |o, b| {
        with(o.shape(), |s| {
            s.parts.iter().for_each(|part| b.debug(&part.texture));
        });
    }),
    direct("mesh appearance", &[], is_shape, &[], |o, b| {
        with(o.shape(), |s| {
            s.parts.iter().for_each(|part| b.debug(&part.appearance));
        });
    }),
    direct(
        "jointPosition",
        &["quaternion", "intrinsicPose"],
        is_joint,
        &[Field::JointPosition],
        |o, b| with(o.joint(), |j| position(j, b)),
    ),
    direct(
        "calcVelocity",
        &[],
        is_joint,
        &[Field::JointPosition],
        |o, b| with(o.joint(), |j| b.floats(&[j.velocity])),
    ),
    direct(
        "intrinsicError",
        &[],
        |kind| is_joint(kind) || is_force_sensor(kind),
        &[Field::JointPosition],
        error,
    ),
    direct(
        "jointForce",
        &["averageJointForce"],
        is_joint,
        &[Field::JointPosition],
        |o, b| {
            with(o.joint(), |j| {
                optional(j.raw_force, b);
                optional(j.force, b);
            });
        },
    ),
    direct(
        "targetPos",
        &[],
        is_joint,
        &[Field::JointControl],
        |o, b| with(o.joint(), |j| b.float(j.target_position)),
    ),
    direct(
        "targetVel",
        &[],
        is_joint,
        &[Field::JointControl],
        |o, b| with(o.joint(), |j| b.float(j.target_velocity)),
    ),
    direct(
        "targetForce",
        &[],
        is_joint,
        &[Field::JointControl],
        |o, b| with(o.joint(), |j| b.float(j.target_force)),
    ),
    direct(
        "joint control",
        &[
            "dynCtrlMode",
            "dynVelMode",
            "dynPosMode",
            "maxVelAccelJerk",
            "springDamperParams",
        ],
        is_joint,
        &[Field::JointControl],
        |o, b| with(o.joint(), |j| control(j, b)),
    ),
    direct(
        "detectedPoint",
        &["detectedObjectHandle", "detectedNormal"],
        |kind| matches!(kind, Kind::ProximitySensor(_)),
        &[Field::Measured],
        |o, b| with(o.proximity_sensor(), |s| detection(s, b)),
    ),
    direct(
        "sensorForce",
        &["sensorTorque", "filterSensorForce", "filterSensorTorque"],
        is_force_sensor,
        &[Field::Measured],
        |o, b| with(o.force_sensor(), |s| readings(s, b)),
    ),
    large(
        "imageBuffer",
        &[],
        is_vision_sensor,
        Field::Measured,
        |o, b| with(o.vision_sensor(), |s| b.text(&s.image)),
    ),
    large(
        "depthBuffer",
        &[],
        is_vision_sensor,
        Field::Measured,
        |o, b| with(o.vision_sensor(), |s| singles(&s.depth, b)),
    ),
    direct(
        "vision reading",
        &[],
        is_vision_sensor,
        &[Field::Measured],
        |o, b| with(o.vision_sensor(), |s| vision(s, b)),
    ),
    direct(
        "graph streams",
        &[],
        |kind| matches!(kind, Kind::Graph(_)),
        &[Field::Measured],
        |o, b| with(o.graph(), |g| graph(g, b)),
    ),
    direct(
        "path",
        &[],
        |kind| matches!(kind, Kind::Path(_)),
        &[],
        |o, b| with(o.path(), |path| b.debug(path)),
    ),
];

const fn direct(
    name: &'static str,
    also: &'static [&'static str],
    of: fn(&Kind) -> bool,
    fields: &'static [Field],
    read: fn(&Object, &mut Bytes),
) -> Direct {
    Direct {
        name,
        also,
        of,
        topics: Topics::NONE.with_fields(fields),
        large: false,
        read,
    }
}

const fn large(
    name: &'static str,
    also: &'static [&'static str],
    of: fn(&Kind) -> bool,
    field: Field,
    read: fn(&Object, &mut Bytes),
) -> Direct {
    Direct {
        name,
        also,
        of,
        topics: Topics::NONE.with(Topic::Field(field)),
        large: true,
        read,
    }
}

fn any(_: &Kind) -> bool {
    true
}

fn is_shape(kind: &Kind) -> bool {
    matches!(kind, Kind::Shape(_))
}

fn is_joint(kind: &Kind) -> bool {
    matches!(kind, Kind::Joint(_))
}

fn is_force_sensor(kind: &Kind) -> bool {
    matches!(kind, Kind::ForceSensor(_))
}

fn is_vision_sensor(kind: &Kind) -> bool {
    matches!(kind, Kind::VisionSensor(_))
}

/// What kind an object is of was asked before.
fn with<T>(part: scene::SceneResult<&T>, write: impl FnOnce(&T)) {
    if let Ok(part) = part {
        write(part);
    }
}

fn pose(pose: &Pose, b: &mut Bytes) {
    b.floats(&pose_to_array(pose));
}

fn optional(value: Option<f64>, b: &mut Bytes) {
    b.int(i64::from(value.is_some()));
    b.float(value.unwrap_or_default());
}

/// What all objects have and no property shows.
fn attributes(object: &Object, b: &mut Bytes) {
    b.debug(&(
        &object.references,
        &object.original_references,
        &object.user_params,
        &object.assembly,
        &object.extension_string,
        &object.colour_extension,
        &object.viewers,
        object.size_factor,
        object.size_values,
    ));
}

fn geometry_of(shape: &Shape, b: &mut Bytes) {
    shape.parts.iter().for_each(|part| part_of(part, b));
}

fn part_of(part: &Part, b: &mut Bytes) {
    b.int(part.uid);
    pose(&part.pose, b);
    b.int(i64::from(part.convex));
    b.debug(&part.primitive);
    b.list(part.mesh.vertices.as_flattened());
    b.count(part.mesh.triangles.len());
    for corner in part.mesh.triangles.as_flattened() {
        b.int(i64::from(*corner));
    }
    b.list(part.mesh.normals.as_flattened());
}

fn position(joint: &Joint, b: &mut Bytes) {
    b.float(joint.position);
    b.floats(&quaternion_to_array(&joint.spherical));
}

fn error(object: &Object, b: &mut Bytes) {
    let joint = object.joint().ok().and_then(|joint| joint.error);
    let error = joint.or_else(|| object.force_sensor().ok()?.error);
    pose(&error.unwrap_or_else(Pose::identity), b);
}

fn control(joint: &Joint, b: &mut Bytes) {
    b.int(joint.control as i64);
    b.int(i64::from(joint.velocity_profile));
    b.int(i64::from(joint.position_profile));
    b.floats(&[joint.max_vel, joint.max_accel, joint.max_jerk]);
    b.floats(&joint.spring);
    b.floats(joint.gains.as_flattened());
}

fn detection(sensor: &ProximitySensor, b: &mut Bytes) {
    b.int(i64::from(sensor.handled));
    if let Some(found) = &sensor.detection {
        b.int(found.object.raw());
        b.floats(&found.point);
        b.floats(&found.normal);
    }
}

fn readings(sensor: &ForceSensor, b: &mut Bytes) {
    for (force, torque) in [sensor.raw, sensor.filtered].into_iter().flatten() {
        b.floats(&force);
        b.floats(&torque);
    }
}

fn singles(values: &[f32], b: &mut Bytes) {
    b.count(values.len());
    values.iter().for_each(|value| b.float(f64::from(*value)));
}

fn vision(sensor: &VisionSensor, b: &mut Bytes) {
    if let Some(reading) = &sensor.reading {
        b.int(i64::from(reading.triggered));
        reading.packets.iter().for_each(|packet| singles(packet, b));
    }
}

/// The recorded values grow step by step: they are the same when their number and the last ones are.
fn graph(graph: &Graph, b: &mut Bytes) {
    b.count(graph.times().len());
    optional(graph.times().next_back(), b);
    for stream in graph.streams() {
        b.text(stream.style.name.as_bytes());
        b.count(stream.samples.len());
        let last = stream.samples.back().copied().unwrap_or_default();
        for value in [stream.next, last.raw, last.transformed] {
            optional(value, b);
        }
        b.count(stream.fixed.as_ref().map_or(0, Vec::len));
    }
    for curve in &graph.curves {
        b.text(curve.style.name.as_bytes());
    }
}
