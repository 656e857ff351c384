//! Joints of an SDF model.

use bounded_xml::Node;

use super::value::{PoseText, child_numbers, is_true, limit, number, pose, text};
use crate::model::{Dynamics, JointKind, Limits, Pose};
use crate::xml::{Source, short};

/// A joint that names its links and frames.
#[derive(Debug, Clone)]
pub struct JointText {
    pub name: String,
    pub kind: JointKind,
    pub parent: String,
    pub child: String,
    /// In the child's frame, if it says nothing else.
    pub pose: PoseText,
    /// One, or two of joints that turn about two axes one after the other.
    pub axes: Vec<AxisText>,
    pub line: u32,
}

/// An axis of a joint.
#[derive(Debug, Clone)]
pub struct AxisText {
    pub xyz: [f64; 3],
    /// The frame it is in: empty for the joint's.
    pub expressed_in: String,
    pub limits: Limits,
    pub dynamics: Dynamics,
    /// Joint, multiplier, offset.
    pub mimic: Option<(String, f64, f64)>,
}

pub fn read_joint(source: &mut Source, node: Node, version: f64) -> JointText {
    let kind_name = source.required(node, "type");
    let kind = match kind_name.as_str() {
        "revolute" | "revolute2" | "universal" => JointKind::Revolute,
        "continuous" => JointKind::Continuous,
        "prismatic" => JointKind::Prismatic,
        "fixed" => JointKind::Fixed,
        "ball" => JointKind::Spherical,
        other => {
            source.warn(
                node,
                format!(
                    "the type '{}' is not read; the joint is taken for a fixed one",
                    short(other)
                ),
            );
            JointKind::Fixed
        }
    };
    let axes = ["axis", "axis2"]
        .iter()
        .filter_map(|name| source.child(node, name))
        .collect::<Vec<Node>>();
    let mut axes: Vec<AxisText> = axes
        .into_iter()
        .map(|axis| read_axis(source, axis, version))
        .collect();
    let most = if matches!(kind_name.as_str(), "revolute2" | "universal") {
        2
    } else {
        1
    };
    axes.truncate(most);
    if axes.is_empty()
        && matches!(
            kind,
            JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic
        )
    {
        source.warn(node, "has no axis; z is taken");
    }
    let ends = ["parent", "child"].map(|name| text(source, node, name));
    let [parent, child] = ends.map(Option::unwrap_or_default);
    let pose = pose(source, node).unwrap_or(PoseText {
        pose: Pose::identity(),
        relative_to: String::new(),
    });
    JointText {
        name: source.required(node, "name"),
        kind,
        parent,
        child,
        pose,
        axes,
        line: source.line(node),
    }
}

fn read_axis(source: &mut Source, node: Node, version: f64) -> AxisText {
    let mut expressed_in = source
        .child(node, "xyz")
        .and_then(|xyz| xyz.attribute("expressed_in"))
        .unwrap_or_default()
        .to_owned();
    // Up to 1.4, axes are in the frame of the model; from 1.5, they can say so.
    if expressed_in.is_empty()
        && (version < 1.45 || is_true(source, node, "use_parent_model_frame"))
    {
        expressed_in = super::frames::MODEL.to_owned();
    }
    let xyz = child_numbers(source, node, "xyz", [0.0, 0.0, 1.0]);
    let mut limits = Limits::default();
    if let Some(element) = source.child(node, "limit") {
        let positive = |number: Option<f64>| number.filter(|number| *number >= 0.0);
        limits = Limits {
            lower: limit(source, element, "lower"),
            upper: limit(source, element, "upper"),
            effort: positive(limit(source, element, "effort")),
            velocity: positive(limit(source, element, "velocity")),
        };
    }
    let mut dynamics = Dynamics::default();
    if let Some(element) = source.child(node, "dynamics") {
        let mut value = |name: &str| number(source, element, name).unwrap_or(0.0);
        dynamics = Dynamics {
            damping: value("damping"),
            friction: value("friction"),
            stiffness: value("spring_stiffness"),
            rest: value("spring_reference"),
            armature: 0.0,
        };
    }
    let mimic = source.child(node, "mimic").map(|mimic| {
        let master = source.required(mimic, "joint");
        let multiplier = number(source, mimic, "multiplier").unwrap_or(1.0);
        (
            master,
            multiplier,
            number(source, mimic, "offset").unwrap_or(0.0),
        )
    });
    AxisText {
        xyz,
        expressed_in,
        limits,
        dynamics,
        mimic,
    }
}
