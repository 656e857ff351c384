//! Joints of a URDF file.

use bounded_xml::Node;

use super::link::read_origin;
use crate::model::{Dynamics, Joint, JointKind, Limits, Pose};
use crate::xml::{Source, short};

/// A joint that names its links and the joint that it mimics.
pub struct JointText {
    pub joint: Joint,
    pub parent: String,
    pub child: String,
    pub mimic: Option<MimicText>,
}

/// A joint's relation to one that is named.
pub struct MimicText {
    pub master: String,
    pub multiplier: f64,
    pub offset: f64,
}

const KNOWN: &[&str] = &[
    "parent",
    "child",
    "origin",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "calibration",
    "safety_controller",
];

pub fn read_joint(source: &mut Source, node: Node) -> JointText {
    source.expect_children(node, KNOWN);
    let joint = Joint {
        name: source.required(node, "name"),
        kind: read_kind(source, node),
        parent: 0,
        child: 0,
        origin: read_origin(source, node),
        child_pose: Pose::identity(),
        axis: read_axis(source, node),
        limits: read_limits(source, node),
        dynamics: read_dynamics(source, node),
        mimic: None,
        reference: 0.0,
        line: source.line(node),
    };
    JointText {
        joint,
        parent: end(source, node, "parent"),
        child: end(source, node, "child"),
        mimic: read_mimic(source, node),
    }
}

fn end(source: &mut Source, node: Node, which: &str) -> String {
    match source.child(node, which) {
        Some(element) => source.required(element, "link"),
        None => String::new(),
    }
}

fn read_kind(source: &mut Source, node: Node) -> JointKind {
    match source.required(node, "type").as_str() {
        "revolute" => JointKind::Revolute,
        "continuous" => JointKind::Continuous,
        "prismatic" => JointKind::Prismatic,
        "fixed" => JointKind::Fixed,
        "spherical" | "ball" => JointKind::Spherical,
        "planar" => JointKind::Planar,
        "floating" => JointKind::Floating,
        other => {
            source.warn(
                node,
                format!(
                    "the type '{}' is not known; the joint is taken for a fixed one",
                    short(other)
                ),
            );
            JointKind::Fixed
        }
    }
}

fn read_axis(source: &mut Source, node: Node) -> [f64; 3] {
    const DEFAULT: [f64; 3] = [1.0, 0.0, 0.0];
    let Some(element) = source.child(node, "axis") else {
        return DEFAULT;
    };
    let axis = source.numbers(element, "xyz", DEFAULT);
    if axis == [0.0; 3] {
        if matches!(
            node.attribute("type"),
            Some("revolute" | "continuous" | "prismatic" | "planar")
        ) {
            source.warn(element, "has no direction; x is taken");
        }
        return DEFAULT;
    }
    axis
}

fn read_limits(source: &mut Source, node: Node) -> Limits {
    let Some(element) = source.child(node, "limit") else {
        return Limits::default();
    };
    let mut number = |name: &str| source.number(element, name);
    Limits {
        lower: number("lower"),
        upper: number("upper"),
        effort: number("effort"),
        velocity: number("velocity"),
    }
}

fn read_dynamics(source: &mut Source, node: Node) -> Dynamics {
    let Some(element) = source.child(node, "dynamics") else {
        return Dynamics::default();
    };
    let mut number = |name: &str| source.number(element, name).unwrap_or(0.0);
    Dynamics {
        damping: number("damping"),
        friction: number("friction"),
        ..Dynamics::default()
    }
}

fn read_mimic(source: &mut Source, node: Node) -> Option<MimicText> {
    let element = source.child(node, "mimic")?;
    let master = source.required(element, "joint");
    let multiplier = source.number(element, "multiplier").unwrap_or(1.0);
    Some(MimicText {
        master,
        multiplier,
        offset: source.number(element, "offset").unwrap_or(0.0),
    })
}
