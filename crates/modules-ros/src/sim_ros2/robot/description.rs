//! A robot's description as a table.

use std::path::Path;

use api_macro::api;
use format::robot_file::RosRobot;
use robot_description::ros::{Command, Part, Value};
use robot_description::{Joint, JointKind, Pose, Robot};

use crate::sim_ros2::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Data, Key, clean_alias};

pub(super) const FUNCTIONS: &[ApiFn] = functions![describe];

/// What a robot's files say: links, joints, sensors and controllers, and what was not understood.
///
/// @param file a description, or a scene
/// @param settings a TOML file; nil for the one beside the file
/// @return robot a table; nil where no file says something about ROS 2
#[api("remote.ros2.robots.describe")]
fn describe(cx: &Cx, file: String, #[default(None)] settings: Option<String>) -> Result<Data> {
    let settings = settings.as_deref().map(Path::new);
    let read = RosRobot::read(Path::new(&file), settings, cx.permissions());
    let read = read.map_err(ApiError::Other)?;
    Ok(if read.is_described {
        to_data(&read)
    } else {
        Data::Nil
    })
}

fn to_data(read: &RosRobot) -> Data {
    let interface = &read.interface;
    let optional = |text: &Option<String>| text.as_deref().map_or(Data::Nil, Data::text);
    let (links, joints) = read.robot.as_ref().map(structure).unwrap_or_default();
    Data::map([
        ("namespace", optional(&interface.namespace)),
        ("model", optional(&interface.model)),
        ("urdf", read.urdf.clone().map_or(Data::Nil, Data::Text)),
        ("links", Data::Array(links)),
        ("joints", Data::Array(joints)),
        (
            "parts",
            Data::Array(interface.parts.iter().map(part).collect()),
        ),
        (
            "commands",
            Data::Array(interface.commands.iter().map(command).collect()),
        ),
        (
            "problems",
            Data::Array(read.problems.iter().map(|line| Data::text(line)).collect()),
        ),
    ])
}

/// Links and joints, the roots first. Joints that close loops are left out.
fn structure(robot: &Robot) -> (Vec<Data>, Vec<Data>) {
    let parents = robot.parent_joints();
    let mut joints = Vec::new();
    for link in robot.links_from_the_roots() {
        joints.extend(parents[link].map(|index| joint(robot, &robot.joints[index])));
    }
    let link = |name: &String| Data::map([("name", Data::text(name)), ("alias", alias(name))]);
    let order = robot.links_from_the_roots().into_iter();
    let links = order.map(|index| link(&robot.links[index].name)).collect();
    (links, joints)
}

fn alias(name: &str) -> Data {
    Data::text(&clean_alias(name.as_bytes()))
}

fn joint(robot: &Robot, joint: &Joint) -> Data {
    let kind = match joint.kind {
        JointKind::Fixed => "fixed",
        JointKind::Revolute | JointKind::Continuous => "revolute",
        JointKind::Prismatic => "prismatic",
        JointKind::Spherical | JointKind::Planar | JointKind::Floating => "other",
    };
    let name = |link: usize| Data::text(&robot.links[link].name);
    Data::map([
        ("name", Data::text(&joint.name)),
        ("alias", alias(&joint.name)),
        ("kind", Data::text(kind)),
        ("parent", name(joint.parent)),
        ("child", name(joint.child)),
        ("origin", pose(&joint.origin)),
        ("childPose", pose(&joint.child_pose)),
        ("axis", numbers(joint.unit_axis().iter().copied())),
    ])
}

fn pose(pose: &Pose) -> Data {
    let (place, turn) = (pose.translation.vector, pose.rotation.coords);
    numbers(place.iter().chain(turn.iter()).copied())
}

fn numbers(numbers: impl Iterator<Item = f64>) -> Data {
    Data::Array(numbers.map(Data::Float).collect())
}

fn part(part: &Part) -> Data {
    let entry =
        |(name, value): (&String, &Value)| (Key::Text(name.clone().into_bytes()), of_value(value));
    let values = Data::Map(part.values.iter().map(entry).collect());
    Data::map([
        ("kind", Data::text(part.kind.as_str())),
        ("name", Data::text(&part.name)),
        ("values", values),
    ])
}

fn of_value(value: &Value) -> Data {
    match value {
        Value::Number(number) => Data::Float(*number),
        Value::Text(text) => Data::text(text),
        Value::Flag(flag) => Data::Bool(*flag),
        Value::Texts(texts) => Data::Array(texts.iter().map(|text| Data::text(text)).collect()),
        Value::Numbers(all) => numbers(all.iter().copied()),
    }
}

fn command(command: &Command) -> Data {
    let optional = |number: Option<f64>| number.map_or(Data::Nil, Data::Float);
    let [low, high] = command.range;
    Data::map([
        ("joint", Data::text(&command.joint)),
        ("interface", Data::text(&command.interface)),
        ("min", optional(low)),
        ("max", optional(high)),
        ("initial", optional(command.initial)),
    ])
}
