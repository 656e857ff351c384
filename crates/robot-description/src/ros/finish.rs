//! What a part has that its file does not say; and whether it can be.

use super::notes::Notes;
use super::{Part, PartKind, Value};
use crate::xml::short;

/// The most rays or pixels of a picture.
const MAX_POINTS: f64 = 4e6;
/// Seconds without a command after which a robot stands still, as diff_drive_controller has it.
const COMMAND_TIMEOUT: f64 = 0.5;

/// The part with what it has by default; None, with a note, for one that cannot be.
pub(super) fn finish(mut part: Part, notes: &mut Notes) -> Option<Part> {
    match part.kind {
        PartKind::Lidar => of_lidar(&mut part),
        PartKind::Camera => of_camera(&mut part),
        PartKind::Imu => of_imu(&mut part),
        PartKind::DiffDrive => of_drive(&mut part),
        PartKind::Trajectory | PartKind::Forward => of_joints(&mut part),
        PartKind::JointStates => of_joint_states(&mut part),
        PartKind::ImuBroadcaster => of_broadcaster(&mut part),
        PartKind::Odometry => part.set_default_text("odom_topic", || "odom".to_owned()),
    }
    let Some(problem) = problem_of(&part) else {
        return Some(part);
    };
    let message = format!("'{}': {problem}; it is left out", short(&part.name));
    notes.add(part.line, part.kind.as_str(), message);
    None
}

fn set_numbers(part: &mut Part, defaults: &[(&str, f64)]) {
    for (key, number) in defaults {
        let entry = part.values.entry((*key).to_owned());
        entry.or_insert(Value::Number(*number));
    }
}

fn of_lidar(part: &mut Part) {
    use std::f64::consts::PI;
    set_numbers(
        part,
        &[
            ("rate", 0.0),
            ("samples", 360.0),
            ("min_angle", -PI),
            ("max_angle", PI),
            ("vertical_samples", 1.0),
            ("min_vertical_angle", 0.0),
            ("max_vertical_angle", 0.0),
            ("min_range", 0.0),
            ("max_range", 10.0),
            ("noise", 0.0),
        ],
    );
    let name = part.name.clone();
    part.set_default_text("topic", || format!("{name}/scan"));
    let topic = part.text("topic").unwrap_or_default().to_owned();
    let is_cloud = part
        .text("output")
        .is_some_and(|output| output.contains("PointCloud2"));
    let points = if is_cloud {
        topic
    } else {
        format!("{topic}/points")
    };
    part.set_default_text("points_topic", || points);
}

fn flag(part: &Part, key: &str) -> Option<bool> {
    match part.values.get(key) {
        Some(Value::Flag(flag)) => Some(*flag),
        _ => None,
    }
}

fn of_camera(part: &mut Part) {
    if part.text("object").is_none() {
        let defaults = [
            ("width", 320.0),
            ("height", 240.0),
            ("fov", 1.047),
            ("near", 0.1),
            ("far", 100.0),
        ];
        set_numbers(part, &defaults);
    }
    set_numbers(part, &[("rate", 0.0)]);
    let has_depth = flag(part, "depth").unwrap_or(false);
    let has_color = flag(part, "color").unwrap_or(!has_depth);
    let defaults = [
        ("depth", has_depth),
        ("color", has_color),
        ("points", has_depth),
    ];
    for (key, value) in defaults {
        part.values.entry(key.into()).or_insert(Value::Flag(value));
    }
    let name = part.name.clone();
    let said = part.text("topic").map(str::to_owned);
    // As Gazebo names them: with colours and depths the topic is what comes before both.
    if has_color && has_depth {
        let before = said.clone().unwrap_or(name);
        let is_classic = part.text("depth_topic").is_some();
        if !is_classic {
            part.set_text("topic", format!("{before}/image"));
        }
        part.set_default_text("depth_topic", || format!("{before}/depth_image"));
        part.set_default_text("points_topic", || format!("{before}/points"));
        part.set_default_text("info_topic", || format!("{before}/camera_info"));
    } else if has_depth {
        let depth = said.unwrap_or_else(|| format!("{name}/depth_image"));
        part.set_default_text("points_topic", || format!("{depth}/points"));
        part.set_default_text("depth_topic", || depth);
    } else {
        part.set_default_text("topic", || format!("{name}/image"));
    }
    let key = if has_color { "topic" } else { "depth_topic" };
    let beside = beside(part.text(key).unwrap_or_default(), "camera_info");
    part.set_default_text("info_topic", || beside);
}

/// The topic of that name beside another one.
fn beside(topic: &str, name: &str) -> String {
    match topic.rsplit_once('/') {
        Some((before, _)) => format!("{before}/{name}"),
        None => name.to_owned(),
    }
}

fn of_imu(part: &mut Part) {
    set_numbers(
        part,
        &[
            ("rate", 0.0),
            ("rotation_noise", 0.0),
            ("acceleration_noise", 0.0),
        ],
    );
    let name = part.name.clone();
    part.set_default_text("topic", || format!("{name}/imu"));
}

fn of_drive(part: &mut Part) {
    set_numbers(
        part,
        &[("cmd_vel_timeout", COMMAND_TIMEOUT), ("publish_rate", 0.0)],
    );
    let name = part.name.clone();
    part.set_default_text("topic", || format!("{name}/cmd_vel"));
    part.set_default_text("odom_topic", || format!("{name}/odom"));
    part.set_default_text("odom_frame_id", || "odom".to_owned());
}

fn of_joints(part: &mut Part) {
    let name = part.name.clone();
    part.set_default_text("interface_name", || "position".to_owned());
    if part.kind == PartKind::Forward {
        part.set_default_text("topic", || format!("{name}/commands"));
    } else {
        part.set_text("topic", format!("{name}/joint_trajectory"));
    }
}

fn of_joint_states(part: &mut Part) {
    set_numbers(part, &[("rate", 0.0)]);
    let name = part.name.clone();
    let is_local = flag(part, "use_local_topics") == Some(true);
    part.set_default_text("topic", || {
        if is_local {
            format!("{name}/joint_states")
        } else {
            "joint_states".into()
        }
    });
}

fn of_broadcaster(part: &mut Part) {
    let name = part.name.clone();
    part.set_default_text("sensor_name", || name.clone());
    part.set_default_text("topic", || format!("{name}/imu"));
}

/// Why a part cannot be.
fn problem_of(part: &Part) -> Option<String> {
    let number = |key| part.number(key).unwrap_or(0.0);
    let missing = |keys: &[&'static str]| {
        let key = keys.iter().find(|key| !part.values.contains_key(**key))?;
        Some(format!("has no {key}"))
    };
    match part.kind {
        PartKind::Lidar => lidar_problem(part),
        PartKind::Camera if part.text("object").is_none() && number("near") >= number("far") => {
            Some("its far plane is not behind the near one".to_owned())
        }
        PartKind::Camera if number("width") * number("height") > MAX_POINTS => {
            Some("it has too many pixels".to_owned())
        }
        PartKind::DiffDrive => missing(&[
            "left_wheel_names",
            "right_wheel_names",
            "wheel_separation",
            "wheel_radius",
        ]),
        PartKind::Trajectory | PartKind::Forward => {
            missing(&["joints"]).or_else(|| interface_problem(part))
        }
        _ => None,
    }
}

fn lidar_problem(part: &Part) -> Option<String> {
    let number = |key| part.number(key).unwrap_or(0.0);
    if number("samples") * number("vertical_samples") > MAX_POINTS {
        return Some("it has too many rays".to_owned());
    }
    for (low, high) in [
        ("min_angle", "max_angle"),
        ("min_vertical_angle", "max_vertical_angle"),
    ] {
        if number(low) > number(high) {
            return Some(format!("{low} is above {high}"));
        }
    }
    let steep = number("min_vertical_angle")
        .abs()
        .max(number("max_vertical_angle").abs());
    if steep > 1.4 {
        return Some("its vertical angles are beyond 1.4 radians".to_owned());
    }
    (number("min_range") >= number("max_range"))
        .then(|| "max_range is not above min_range".to_owned())
}

fn interface_problem(part: &Part) -> Option<String> {
    let name = part.text("interface_name").unwrap_or_default();
    let is_known = matches!(name, "position" | "velocity" | "effort");
    (!is_known).then(|| format!("the interface '{}' is not understood", short(name)))
}
