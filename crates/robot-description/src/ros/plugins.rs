//! Plugins of models, of Gazebo and of Gazebo Classic.

use bounded_xml::Node;

use super::finish::finish;
use super::notes::Notes;
use super::rules::{Rule, To, apply};
use super::{Interface, Part, PartKind};
use crate::xml::{Source, elements, short};

use To::{Key, Nothing, Remapping, Scaled, Zero};

const DIFF_DRIVE: &[Rule] = &[
    ("child_frame_id", Key("base_frame_id")),
    ("command_topic", Key("topic")),
    ("commandTopic", Key("topic")),
    ("frame_id", Key("odom_frame_id")),
    ("leftJoint", Key("left_wheel_names")),
    ("left_joint", Key("left_wheel_names")),
    ("max_acceleration", Key("linear.x.max_acceleration")),
    (
        "max_angular_acceleration",
        Key("angular.z.max_acceleration"),
    ),
    ("max_angular_velocity", Key("angular.z.max_velocity")),
    ("max_linear_acceleration", Key("linear.x.max_acceleration")),
    ("max_linear_velocity", Key("linear.x.max_velocity")),
    ("max_wheel_acceleration", Nothing),
    ("max_wheel_torque", Nothing),
    ("min_acceleration", Key("linear.x.min_acceleration")),
    (
        "min_angular_acceleration",
        Key("angular.z.min_acceleration"),
    ),
    ("min_angular_velocity", Key("angular.z.min_velocity")),
    ("min_linear_acceleration", Key("linear.x.min_acceleration")),
    ("min_linear_velocity", Key("linear.x.min_velocity")),
    ("num_wheel_pairs", Nothing),
    ("odom_publish_frequency", Key("publish_rate")),
    ("odom_topic", Key("odom_topic")),
    ("odometryFrame", Key("odom_frame_id")),
    ("odometryTopic", Key("odom_topic")),
    ("odometry_frame", Key("odom_frame_id")),
    ("odometry_source", Key("ground_truth")),
    ("odometry_topic", Key("odom_topic")),
    ("publishTf", Key("enable_odom_tf")),
    ("publishWheelTF", Nothing),
    ("publish_odom", Nothing),
    ("publish_odom_tf", Key("enable_odom_tf")),
    ("publish_wheel_tf", Nothing),
    ("rightJoint", Key("right_wheel_names")),
    ("right_joint", Key("right_wheel_names")),
    ("robotBaseFrame", Key("base_frame_id")),
    ("robot_base_frame", Key("base_frame_id")),
    ("ros/namespace", Key("namespace")),
    (
        "ros/remapping",
        Remapping(&[("cmd_vel", "topic"), ("odom", "odom_topic")]),
    ),
    ("tf_topic", Nothing),
    ("topic", Key("topic")),
    ("update_rate", Key("publish_rate")),
    ("updateRate", Key("publish_rate")),
    ("wheelDiameter", Scaled("wheel_radius", 0.5)),
    ("wheelSeparation", Key("wheel_separation")),
    ("wheel_diameter", Scaled("wheel_radius", 0.5)),
    ("wheel_radius", Key("wheel_radius")),
    ("wheel_separation", Key("wheel_separation")),
];
const JOINT_STATES: &[Rule] = &[
    ("joint_name", Key("joints")),
    ("ros/namespace", Key("namespace")),
    ("ros/remapping", Remapping(&[("joint_states", "topic")])),
    ("topic", Key("topic")),
    ("update_rate", Key("rate")),
];
const ODOMETRY: &[Rule] = &[
    ("body_name", Nothing),
    ("dimensions", Nothing),
    ("frame_name", Key("odom_frame_id")),
    ("gaussian_noise", Zero),
    ("odom_frame", Key("odom_frame_id")),
    ("odom_publish_frequency", Key("publish_rate")),
    ("odom_topic", Key("odom_topic")),
    ("robot_base_frame", Key("base_frame_id")),
    ("ros/namespace", Key("namespace")),
    ("ros/remapping", Remapping(&[("odom", "odom_topic")])),
    ("tf_topic", Nothing),
    ("update_rate", Key("publish_rate")),
];
/// Systems of Gazebo for what is always there.
const ALWAYS_THERE: [&str; 8] = [
    "physics-system",
    "sensors-system",
    "imu-system",
    "user-commands-system",
    "scene-broadcaster-system",
    "pose-publisher-system",
    "contact-system",
    "ros_state",
];

/// Reads a plugin of a model.
pub(super) fn read(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    let file = node.attribute("filename").unwrap_or_default();
    let name = node.attribute("name").unwrap_or_default();
    let line = source.line(node);
    let has = |words: &[&str]| words.iter().any(|word| file.contains(word));
    if has(&["diff_drive", "diff-drive"]) {
        let part = made(
            PartKind::DiffDrive,
            name,
            line,
            &[("topic", "cmd_vel"), ("odom_topic", "odom")],
        );
        read_part(part, node, DIFF_DRIVE, interface, source, notes);
    } else if has(&["joint_state_publisher", "joint-state-publisher"]) {
        let part = made(PartKind::JointStates, name, line, &[]);
        read_part(part, node, JOINT_STATES, interface, source, notes);
    } else if has(&["odometry-publisher", "odometry_publisher", "gazebo_ros_p3d"]) {
        let part = made(PartKind::Odometry, name, line, &[]);
        read_part(part, node, ODOMETRY, interface, source, notes);
    } else if has(&["ros2_control", "ros_control"]) {
        read_control(node, interface, source, notes);
    } else if !has(&ALWAYS_THERE) {
        let shown = if file.is_empty() { name } else { file };
        notes.add(
            line,
            "plugin",
            format!("the plugin '{}' is not understood", short(shown)),
        );
    }
}

fn made(kind: PartKind, name: &str, line: u32, texts: &[(&str, &str)]) -> Part {
    let mut part = Part {
        kind,
        name: name.trim().to_owned(),
        values: Default::default(),
        line,
    };
    for (key, text) in texts {
        part.set_text(key, (*text).to_owned());
    }
    part
}

fn read_part(
    mut part: Part,
    node: Node,
    rules: &[Rule],
    interface: &mut Interface,
    source: &Source,
    notes: &mut Notes,
) {
    apply(&mut part, node, &[rules], source, notes);
    interface.parts.extend(finish(part, notes));
}

/// gz_ros2_control: files of parameters.
fn read_control(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    for child in elements(node) {
        let text = child.text().unwrap_or_default().trim();
        let line = source.line(child);
        match child.tag_name().name() {
            "parameters" if !text.is_empty() => {
                interface.parameter_files.push((text.to_owned(), line));
            }
            "ros" => read_ros(child, interface, source, notes),
            "robot_param"
            | "robot_param_node"
            | "robotSimType"
            | "controller_manager_name"
            | "controller_manager_prefix_node_name"
            | "hold_joints"
            | "position_proportional_gain" => {}
            "robotNamespace" if !text.is_empty() => interface.namespace = Some(text.to_owned()),
            name => notes.add(line, name, "not understood inside of <plugin>"),
        }
    }
}

fn read_ros(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    for child in elements(node) {
        let text = child.text().unwrap_or_default().trim();
        match child.tag_name().name() {
            "namespace" if !text.is_empty() => interface.namespace = Some(text.to_owned()),
            name => notes.add(
                source.line(child),
                name,
                format!("'{}' is not understood", short(text)),
            ),
        }
    }
}
