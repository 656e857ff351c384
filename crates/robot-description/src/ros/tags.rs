//! `<ros2_control>`, `<gazebo>` and `<transmission>` of URDF; sensors and plugins of SDF.

use bounded_xml::Node;

use super::notes::Notes;
use super::{Command, Interface, gazebo, plugins};
use crate::report::{Parsed, ReadError};
use crate::xml::{self, Source, elements, named, short};

/// What a URDF says about its sensors and controllers.
///
/// # Errors
/// If it is no XML, or exceeds a limit.
pub fn of_urdf(bytes: &[u8]) -> Result<Parsed<Interface>, ReadError> {
    with_root(bytes, |root, source, notes| {
        let mut interface = Interface::default();
        for node in elements(root) {
            match node.tag_name().name() {
                "ros2_control" => read_control(node, &mut interface, source, notes),
                "gazebo" => read_gazebo(node, &mut interface, source, notes),
                "transmission" => {
                    let message = "transmissions of ROS 1 are not read: <ros2_control> says what joints are told";
                    notes.add(source.line(node), "transmission", message);
                }
                _ => {}
            }
        }
        interface
    })
}

/// What an SDF says about sensors and plugins of its first model.
///
/// # Errors
/// If it is no XML, or exceeds a limit.
pub fn of_sdf(bytes: &[u8]) -> Result<Parsed<Interface>, ReadError> {
    with_root(bytes, |root, source, notes| {
        let mut interface = Interface::default();
        let mut models = root.descendants().filter(|node| node.has_tag_name("model"));
        let Some(model) = models.next() else {
            return interface;
        };
        for plugin in named(model, "plugin") {
            plugins::read(plugin, &mut interface, source, notes);
        }
        for link in named(model, "link") {
            let name = link.attribute("name").unwrap_or_default();
            for sensor in named(link, "sensor") {
                interface
                    .parts
                    .extend(gazebo::read(sensor, name, source, notes));
            }
        }
        interface
    })
}

fn with_root(
    bytes: &[u8],
    read: impl FnOnce(Node, &Source, &mut Notes) -> Interface,
) -> Result<Parsed<Interface>, ReadError> {
    let before = xml::lines_before(bytes);
    let text = xml::text_of(bytes)?;
    let document = xml::document(&text, before)?;
    let source = Source::new(&text, before);
    let mut notes = Notes::default();
    let interface = read(document.root_element(), &source, &mut notes);
    Ok(notes.finish(interface))
}

/// Physical parameters of links and joints that Gazebo has beside those of URDF.
const OF_PHYSICS: [&str; 22] = [
    "material",
    "mu1",
    "mu2",
    "mu",
    "kp",
    "kd",
    "fdir1",
    "minDepth",
    "maxVel",
    "maxContacts",
    "selfCollide",
    "turnGravityOff",
    "gravity",
    "static",
    "dampingFactor",
    "implicitSpringDamper",
    "provideFeedback",
    "preserveFixedJoint",
    "disableFixedJointLumping",
    "laserRetro",
    "visual",
    "collision",
];

fn read_gazebo(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    let link = node.attribute("reference").unwrap_or_default().trim();
    for child in elements(node) {
        let name = child.tag_name().name();
        match name {
            "sensor" => interface
                .parts
                .extend(gazebo::read(child, link, source, notes)),
            "plugin" => plugins::read(child, interface, source, notes),
            // They say how something is simulated, not what it publishes.
            name if OF_PHYSICS.contains(&name) => {}
            name => notes.add(
                source.line(child),
                name,
                "not understood inside of <gazebo>",
            ),
        }
    }
}

fn read_control(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    for child in elements(node) {
        let name = child.tag_name().name();
        match name {
            // Which hardware it is does not matter here, and its sensors are those of <gazebo>.
            "hardware" | "sensor" => {}
            "joint" => read_joint(child, interface, source, notes),
            name => notes.add(
                source.line(child),
                name,
                "not understood inside of <ros2_control>",
            ),
        }
    }
}

fn read_joint(node: Node, interface: &mut Interface, source: &Source, notes: &mut Notes) {
    let state = Command {
        joint: node.attribute("name").unwrap_or_default().trim().to_owned(),
        interface: String::new(),
        range: [None; 2],
        initial: initial_position(node),
        line: source.line(node),
    };
    let before = interface.commands.len();
    for child in elements(node) {
        let line = source.line(child);
        match child.tag_name().name() {
            "command_interface" => {
                let command = read_command(child, &state, source, notes);
                interface.commands.extend(command);
            }
            "state_interface" => {}
            "param" => {
                let name = short(child.attribute("name").unwrap_or_default());
                notes.add(
                    line,
                    "param",
                    format!("'{name}' of a joint is not understood"),
                );
            }
            name => notes.add(line, name, "not understood inside of <joint>"),
        }
    }
    if interface.commands.len() == before {
        interface.commands.push(state);
    }
}

/// What a joint may be told by one interface.
fn read_command(
    node: Node,
    state: &Command,
    source: &Source,
    notes: &mut Notes,
) -> Option<Command> {
    let interface = node.attribute("name").unwrap_or_default().trim();
    let line = source.line(node);
    if !matches!(interface, "position" | "velocity" | "effort") {
        let message = format!("'{}' is not understood", short(interface));
        notes.add(line, "command_interface", message);
        return None;
    }
    Some(Command {
        interface: interface.to_owned(),
        range: ["min", "max"].map(|name| number_param(node, name)),
        line,
        ..state.clone()
    })
}

fn number_param(node: Node, name: &str) -> Option<f64> {
    let param = named(node, "param").find(|param| param.attribute("name") == Some(name))?;
    let number: f64 = param.text()?.trim().parse().ok()?;
    number.is_finite().then_some(number)
}

fn initial_position(node: Node) -> Option<f64> {
    let state =
        named(node, "state_interface").find(|state| state.attribute("name") == Some("position"))?;
    number_param(state, "initial_value")
}
