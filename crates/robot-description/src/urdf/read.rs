//! Robots from URDF.

use bounded_xml::Node;

use super::joint::{JointText, MimicText, read_joint};
use super::link::{read_link, read_material, read_sensor};
use crate::model::{Joint, Mimic, Names, Robot};
use crate::report::{Parsed, ReadError};
use crate::xml::{self, Source, elements, short};

/// Reads a URDF file.
///
/// # Errors
///
/// If it is no XML, has no `<robot>`, is a xacro file, or exceeds a limit.
pub fn read(bytes: &[u8]) -> Result<Parsed<Robot>, ReadError> {
    let before = xml::lines_before(bytes);
    let text = xml::text_of(bytes)?;
    let document = xml::document(&text, before).map_err(|error| {
        if uses_xacro(&text) {
            xacro_at(&text, before)
        } else {
            error
        }
    })?;
    let mut source = Source::new(&text, before);
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        let found = short(root.tag_name().name());
        return Err(ReadError::WrongRoot {
            line: source.line(root),
            found,
            expected: "robot",
        });
    }
    if let Some(node) = root.descendants().find(needs_xacro) {
        return Err(ReadError::Xacro {
            line: source.line(node),
        });
    }
    let robot = read_robot(&mut source, root);
    Ok(source.finish(robot))
}

/// A macro, or a value that is an expression.
fn needs_xacro(node: &Node) -> bool {
    let is_macro = node
        .tag_name()
        .namespace()
        .is_some_and(|namespace| namespace.contains("xacro"));
    is_macro
        || node
            .attributes()
            .any(|attribute| attribute.value().contains("${"))
}

fn uses_xacro(text: &str) -> bool {
    text.contains("<xacro:")
}

fn xacro_at(text: &str, before: u32) -> ReadError {
    let line = text
        .lines()
        .position(|line| line.contains("<xacro:"))
        .unwrap_or(0);
    ReadError::Xacro {
        line: line as u32 + 1 + before,
    }
}

const KNOWN: &[&str] = &[
    "link",
    "joint",
    "material",
    "sensor",
    "gazebo",
    "ros2_control",
    "transmission",
];

fn read_robot(source: &mut Source, root: Node) -> Robot {
    let mut robot = Robot {
        name: source.required(root, "name"),
        ..Robot::default()
    };
    source.expect_children(root, KNOWN);
    let mut joints = Vec::new();
    for node in elements(root) {
        match node.tag_name().name() {
            "link" => robot.links.push(read_link(source, node)),
            "joint" => joints.push((node, read_joint(source, node))),
            "material" => robot.materials.extend(read_material(source, node)),
            _ => {}
        }
    }
    let links = Names::new(robot.links.iter().map(|link| link.name.as_str()));
    report_equal_names(source, root, &links);
    add_joints(source, joints, &links, &mut robot);
    for node in elements(root) {
        match node.tag_name().name() {
            "sensor" => robot
                .sensors
                .extend(read_sensor(source, node, |name| links.get(name))),
            "gazebo" => report_gazebo(source, node),
            _ => {}
        }
    }
    if robot.links.is_empty() {
        source.warn(root, "has no link");
    }
    robot
}

/// Joints and sensors mean the first link of a name.
fn report_equal_names(source: &mut Source, root: Node, links: &Names) {
    for (index, node) in xml::named(root, "link").enumerate() {
        let name = node.attribute("name").unwrap_or_default().trim();
        if links.get(name) != Some(index) {
            source.warn(
                node,
                format!(
                    "there is a link '{}' before it, which joints mean",
                    short(name)
                ),
            );
        }
    }
}

fn add_joints(
    source: &mut Source,
    joints: Vec<(Node, JointText)>,
    links: &Names,
    robot: &mut Robot,
) {
    let (mut nodes, mut mimics) = (Vec::new(), Vec::new());
    for (node, text) in joints {
        let link = |source: &mut Source, name: &str, which| {
            let found = links.get(name);
            if found.is_none() {
                source.warn(
                    node,
                    format!(
                        "joint '{}' has no {which} link '{}'; it is left out",
                        short(&text.joint.name),
                        short(name)
                    ),
                );
            }
            found
        };
        let ends = (
            link(source, &text.parent, "parent"),
            link(source, &text.child, "child"),
        );
        let (Some(parent), Some(child)) = ends else {
            continue;
        };
        robot.joints.push(Joint {
            parent,
            child,
            ..text.joint
        });
        nodes.push(node);
        mimics.push(text.mimic);
    }
    let names = Names::new(robot.joints.iter().map(|joint| joint.name.as_str()));
    for (index, mimic) in mimics.iter().enumerate() {
        let Some(MimicText {
            master,
            multiplier,
            offset,
        }) = mimic
        else {
            continue;
        };
        match names.get(master) {
            Some(joint) if joint != index => {
                robot.joints[index].mimic = Some(Mimic {
                    joint,
                    multiplier: *multiplier,
                    offset: *offset,
                });
            }
            _ => source.warn(
                nodes[index],
                format!(
                    "there is no other joint '{}' that it could mimic",
                    short(master)
                ),
            ),
        }
    }
    report_structure(source, &nodes, robot);
}

/// Loops of joints, and of joints that mimic each other.
fn report_structure(source: &mut Source, nodes: &[Node], robot: &mut Robot) {
    for index in robot.loop_joints() {
        let child = short(&robot.links[robot.joints[index].child].name);
        source.warn(
            nodes[index],
            format!("closes a loop: link '{child}' is connected already; the joint moves nothing"),
        );
    }
    for (index, node) in nodes.iter().enumerate() {
        if let Err(reason) = robot.whole_mimic(index) {
            robot.joints[index].mimic = None;
            source.warn(*node, format!("{reason}; it moves by itself"));
        }
    }
}

/// What is said of a sensor of Gazebo.
pub const OF_GAZEBO: &str = "a sensor in Gazebo's format, which only --ros2 makes";

/// Sensors of Gazebo are another format, which [`crate::ros`] reads, and the rest of it is for Gazebo only.
fn report_gazebo(source: &mut Source, node: Node) {
    for sensor in elements(node).filter(|child| child.tag_name().name() == "sensor") {
        source.leave_out(sensor, OF_GAZEBO);
    }
}
