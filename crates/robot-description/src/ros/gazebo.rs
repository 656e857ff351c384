//! Sensors as Gazebo's `<sensor>` has them, in URDF and SDF.

use bounded_xml::Node;

use super::finish::finish;
use super::notes::Notes;
use super::rules::{Rule, To, apply};
use super::{Part, PartKind, Value};
use crate::xml::{Source, elements, named, short};

use To::{Key, Nothing, Remapping, Zero};

const SENSOR: &[Rule] = &[
    ("always_on", Nothing),
    ("camera", Nothing),
    ("enable_metrics", Nothing),
    ("gz_frame_id", Key("frame")),
    ("ignition_frame_id", Key("frame")),
    ("imu", Nothing),
    ("lidar", Nothing),
    ("plugin", Nothing),
    ("pose", Key("pose")),
    ("ray", Nothing),
    ("topic", Key("topic")),
    ("update_rate", Key("rate")),
    ("visualize", Nothing),
];
const LIDAR: &[Rule] = &[
    ("noise/mean", Zero),
    ("noise/stddev", Key("noise")),
    ("noise/type", Nothing),
    ("range/max", Key("max_range")),
    ("range/min", Key("min_range")),
    ("range/resolution", Nothing),
    ("scan/horizontal/max_angle", Key("max_angle")),
    ("scan/horizontal/min_angle", Key("min_angle")),
    ("scan/horizontal/resolution", Nothing),
    ("scan/horizontal/samples", Key("samples")),
    ("scan/vertical/max_angle", Key("max_vertical_angle")),
    ("scan/vertical/min_angle", Key("min_vertical_angle")),
    ("scan/vertical/resolution", Nothing),
    ("scan/vertical/samples", Key("vertical_samples")),
    ("visibility_mask", Nothing),
];
const CAMERA: &[Rule] = &[
    ("camera_info_topic", Key("info_topic")),
    ("clip/far", Key("far")),
    ("clip/near", Key("near")),
    ("depth_camera/clip/far", Nothing),
    ("depth_camera/clip/near", Nothing),
    ("depth_camera/output", Nothing),
    ("horizontal_fov", Key("fov")),
    ("image/anti_aliasing", Nothing),
    ("image/format", Key("format")),
    ("image/height", Key("height")),
    ("image/width", Key("width")),
    ("optical_frame_id", Key("frame")),
    ("visibility_mask", Nothing),
];
const IMU: &[Rule] = &[
    ("angular_velocity/x/noise/stddev", Key("rotation_noise")),
    ("angular_velocity/y/noise/stddev", Key("rotation_noise")),
    ("angular_velocity/z/noise/stddev", Key("rotation_noise")),
    ("enable_orientation", Nothing),
    (
        "linear_acceleration/x/noise/stddev",
        Key("acceleration_noise"),
    ),
    (
        "linear_acceleration/y/noise/stddev",
        Key("acceleration_noise"),
    ),
    (
        "linear_acceleration/z/noise/stddev",
        Key("acceleration_noise"),
    ),
    ("topic", Key("topic")),
];
/// What further elements of noise are called; they have to be zero.
const OF_NOISE: [&str; 6] = [
    "type",
    "mean",
    "bias_mean",
    "bias_stddev",
    "dynamic_bias_stddev",
    "dynamic_bias_correlation_time",
];
const PLUGIN: &[Rule] = &[
    ("alwaysOn", Nothing),
    ("always_on", Nothing),
    ("camera_info_topic_name", Key("info_topic")),
    ("camera_name", Key("camera_name")),
    ("distortion_k1", Zero),
    ("distortion_k2", Zero),
    ("distortion_k3", Zero),
    ("distortion_t1", Zero),
    ("distortion_t2", Zero),
    ("frameName", Key("frame")),
    ("frame_name", Key("frame")),
    ("hack_baseline", Zero),
    ("image_topic_name", Key("topic")),
    ("initial_orientation_as_reference", Zero),
    ("max_depth", Nothing),
    ("min_depth", Nothing),
    ("output_type", Key("output")),
    ("ros/namespace", Key("namespace")),
    ("ros/remapping", Remapping(TOPICS)),
    ("topicName", Key("topic")),
    ("topic_name", Key("topic")),
    ("updateRate", Key("rate")),
    ("update_rate", Key("rate")),
];
const TOPICS: &[(&str, &str)] = &[
    ("camera_info", "info_topic"),
    ("depth/camera_info", "depth_info_topic"),
    ("depth/image_raw", "depth_topic"),
    ("image_raw", "topic"),
    ("out", "topic"),
    ("points", "points_topic"),
];

/// What a type of sensors is: colours, depths.
fn kind_of(sensor_type: &str) -> Option<(PartKind, bool, bool)> {
    match sensor_type {
        "ray" | "gpu_ray" | "lidar" | "gpu_lidar" => Some((PartKind::Lidar, false, false)),
        "camera" => Some((PartKind::Camera, true, false)),
        "depth" | "depth_camera" => Some((PartKind::Camera, false, true)),
        "rgbd" | "rgbd_camera" => Some((PartKind::Camera, true, true)),
        "imu" => Some((PartKind::Imu, false, false)),
        _ => None,
    }
}

/// The part that a name of a type stands for, with what such a part does.
pub(super) fn sensor_of(sensor_type: &str, name: &str, line: u32) -> Option<Part> {
    let (kind, has_colors, has_depths) = kind_of(sensor_type)?;
    let mut part = Part {
        kind,
        name: name.to_owned(),
        values: Default::default(),
        line,
    };
    if kind == PartKind::Camera {
        part.values.insert("color".into(), Value::Flag(has_colors));
        part.values.insert("depth".into(), Value::Flag(has_depths));
    }
    Some(part)
}

/// Reads a sensor on a link.
pub(super) fn read(node: Node, link: &str, source: &Source, notes: &mut Notes) -> Option<Part> {
    let sensor_type = node.attribute("type").unwrap_or_default().trim();
    let name = node.attribute("name").unwrap_or(sensor_type).trim();
    let line = source.line(node);
    let Some(mut part) = sensor_of(sensor_type, name, line) else {
        let message = format!(
            "a sensor of type '{}' is not understood",
            short(sensor_type)
        );
        notes.add(line, "sensor", message);
        return None;
    };
    part.set_text("link", link.to_owned());
    apply(&mut part, node, &[SENSOR], source, notes);
    for inner in elements(node) {
        match inner.tag_name().name() {
            "ray" | "lidar" => apply(&mut part, inner, &[LIDAR], source, notes),
            "camera" => apply(&mut part, inner, &[CAMERA], source, notes),
            "imu" => read_imu(&mut part, inner, source, notes),
            _ => {}
        }
    }
    for plugin in named(node, "plugin") {
        read_plugin(&mut part, plugin, source, notes);
    }
    finish(part, notes)
}

fn read_imu(part: &mut Part, node: Node, source: &Source, notes: &mut Notes) {
    let mut paths = Vec::new();
    for what in ["angular_velocity", "linear_acceleration"] {
        for axis in ["x", "y", "z"] {
            paths.extend(OF_NOISE.map(|name| format!("{what}/{axis}/noise/{name}")));
        }
    }
    let to = |path: &str| {
        if path.ends_with("type") {
            Nothing
        } else {
            Zero
        }
    };
    let of_noise: Vec<_> = paths.iter().map(|path| (path.as_str(), to(path))).collect();
    apply(part, node, &[IMU, &of_noise], source, notes);
}

/// A plugin of Gazebo Classic that passes what is measured to ROS.
fn read_plugin(part: &mut Part, plugin: Node, source: &Source, notes: &mut Notes) {
    let file = plugin.attribute("filename").unwrap_or_default();
    if !file.contains("gazebo_ros") {
        let message = format!("the plugin '{}' is not understood", short(file));
        return notes.add(source.line(plugin), "plugin", message);
    }
    apply(part, plugin, &[PLUGIN], source, notes);
    let camera = part.text("camera_name").unwrap_or(&part.name).to_owned();
    if part.kind != PartKind::Camera {
        let name = plugin
            .attribute("name")
            .unwrap_or(&part.name)
            .trim()
            .to_owned();
        return part.set_default_text("topic", || format!("{name}/out"));
    }
    if file.contains("gazebo_ros_camera") {
        part.values.insert("color".into(), Value::Flag(true));
    }
    for (key, end) in [
        ("topic", "image_raw"),
        ("info_topic", "camera_info"),
        ("depth_topic", "depth/image_raw"),
        ("depth_info_topic", "depth/camera_info"),
        ("points_topic", "points"),
    ] {
        part.set_default_text(key, || format!("{camera}/{end}"));
    }
}
