//! Controllers of ros2_control, by their types and parameters.

use super::finish::finish;
use super::notes::Notes;
use super::tree::Tree;
use super::{Interface, Part, PartKind, yaml};
use crate::report::Parsed;
use crate::xml::short;

/// The controllers of a file of parameters for the controller manager.
pub fn of_yaml(bytes: &[u8]) -> Parsed<Interface> {
    let mut notes = Notes::default();
    let text = String::from_utf8_lossy(bytes);
    let file = yaml::parse(&text, &mut notes);
    let mut interface = Interface::default();
    let sections = sections(&file);
    let managers: Vec<&Tree> = named(&sections, "controller_manager").collect();
    for (name, controller) in managers.iter().flat_map(|manager| manager.entries()) {
        let Some(kind) = controller.get("type") else {
            continue;
        };
        let parameters = std::iter::once(controller).chain(named(&sections, name));
        let part = of_type(
            kind.text().unwrap_or_default(),
            name,
            controller.line,
            &mut notes,
        );
        interface
            .parts
            .extend(part.and_then(|part| with(part, parameters, &mut notes)));
    }
    if managers.is_empty() {
        notes.add(
            1,
            "controller_manager",
            "the file has no such section, and so no controllers",
        );
    }
    notes.finish(interface)
}

/// The sections with parameters of nodes, by the nodes' names without namespaces. A namespace may be a section around them.
fn sections(file: &Tree) -> Vec<(String, &Tree)> {
    let mut found = Vec::new();
    for (name, node) in file.entries() {
        match node.get("ros__parameters") {
            Some(parameters) => found.push((last(name), parameters)),
            None => {
                let inner = node.entries().iter();
                found.extend(
                    inner.filter_map(|(name, node)| {
                        Some((last(name), node.get("ros__parameters")?))
                    }),
                );
            }
        }
    }
    found
}

fn last(name: &str) -> String {
    name.rsplit('/').next().unwrap_or(name).to_owned()
}

fn named<'a>(
    sections: &'a [(String, &'a Tree)],
    name: &'a str,
) -> impl Iterator<Item = &'a Tree> + 'a {
    let of_name = sections.iter().filter(move |(section, _)| section == name);
    of_name.map(|(_, parameters)| *parameters)
}

/// A part with the parameters that trees have.
pub(super) fn with<'a>(
    mut part: Part,
    parameters: impl Iterator<Item = &'a Tree>,
    notes: &mut Notes,
) -> Option<Part> {
    for tree in parameters {
        for (key, value) in tree.flat() {
            let Some(form) = part.kind.form(&key) else {
                notes.add(
                    value.line,
                    &key,
                    format!(
                        "is no parameter of '{}' that is understood",
                        short(&part.name)
                    ),
                );
                continue;
            };
            match form.read(value) {
                Ok(Some(read)) => drop(part.values.insert(key, read)),
                Ok(None) => {}
                Err(needed) => notes.add(value.line, &key, needed),
            }
        }
    }
    if let Some(interface) = part.texts("command_interfaces").first().cloned() {
        part.set_text("interface_name", interface);
    }
    finish(part, notes)
}

/// The part that a type of controllers stands for: `package/Class`, or the package alone.
pub(super) fn of_type(kind: &str, name: &str, line: u32, notes: &mut Notes) -> Option<Part> {
    let (package, class) = kind.split_once('/').unwrap_or((kind, ""));
    let made = |kind| Part {
        kind,
        name: name.to_owned(),
        values: Default::default(),
        line,
    };
    let forward = |interface: Option<&str>| {
        let mut part = made(PartKind::Forward);
        if let Some(interface) = interface {
            part.set_text("interface_name", interface.to_owned());
        }
        part
    };
    let part = match (package, class) {
        (_, "JointTrajectoryController") | ("joint_trajectory_controller", _) => {
            made(PartKind::Trajectory)
        }
        ("diff_drive_controller", _) => made(PartKind::DiffDrive),
        ("forward_command_controller", "" | "ForwardCommandController") => forward(None),
        ("position_controllers", "" | "JointGroupPositionController") => forward(Some("position")),
        ("velocity_controllers", "" | "JointGroupVelocityController") => forward(Some("velocity")),
        ("effort_controllers", "" | "JointGroupEffortController") => forward(Some("effort")),
        ("joint_state_broadcaster", _) => made(PartKind::JointStates),
        ("imu_sensor_broadcaster", _) => made(PartKind::ImuBroadcaster),
        ("odometry", "") => made(PartKind::Odometry),
        _ => {
            let message = format!(
                "'{}': the type '{}' is not understood",
                short(name),
                short(kind)
            );
            notes.add(line, "controller", message);
            return None;
        }
    };
    Some(part)
}
