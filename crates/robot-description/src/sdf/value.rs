//! Values that stand as text inside of elements.

use bounded_xml::Node;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};

use crate::model::Pose;
use crate::positions::from_rpy;
use crate::xml::Source;

/// The text of a child, without blanks around it.
pub fn text(source: &mut Source, node: Node, name: &str) -> Option<String> {
    let child = source.child(node, name)?;
    child
        .text()
        .map(|text| text.trim().to_owned())
        .filter(|text| !text.is_empty())
}

/// The number of a child.
pub fn number(source: &mut Source, node: Node, name: &str) -> Option<f64> {
    let child = source.child(node, name)?;
    let [number] = numbers(source, child, [f64::NAN]);
    Some(number).filter(|number| number.is_finite())
}

/// A limit: those that are infinite, or so large that they are meant to be, are none.
pub fn limit(source: &mut Source, node: Node, name: &str) -> Option<f64> {
    const ENDLESS: f64 = 1e15;
    if text(source, node, name)
        .is_some_and(|text| text.trim_start_matches(['-', '+']).starts_with("inf"))
    {
        return None;
    }
    number(source, node, name).filter(|number| number.abs() < ENDLESS)
}

pub fn is_true(source: &mut Source, node: Node, name: &str) -> bool {
    text(source, node, name).is_some_and(|text| text == "1" || text.eq_ignore_ascii_case("true"))
}

/// The numbers that an element consists of.
pub fn numbers<const N: usize>(source: &mut Source, node: Node, otherwise: [f64; N]) -> [f64; N] {
    source.numbers_of(node, "the text", node.text().unwrap_or_default(), otherwise)
}

/// The numbers of a child; those given if there is none.
pub fn child_numbers<const N: usize>(
    source: &mut Source,
    node: Node,
    name: &str,
    otherwise: [f64; N],
) -> [f64; N] {
    match source.child(node, name) {
        Some(child) => numbers(source, child, otherwise),
        None => otherwise,
    }
}

/// A pose, and the name of the frame it is in; empty for the default one.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseText {
    pub pose: Pose,
    pub relative_to: String,
}

/// The `<pose>` of an element.
pub fn pose(source: &mut Source, node: Node) -> Option<PoseText> {
    let child = source.child(node, "pose")?;
    let relative_to = child
        .attribute("relative_to")
        .or(child.attribute("frame"))
        .unwrap_or_default()
        .trim()
        .to_owned();
    let text = child.text().unwrap_or_default();
    let pose = if child.attribute("rotation_format") == Some("quat_xyzw") {
        let [x, y, z, qx, qy, qz, qw] =
            source.numbers_of(child, "the pose", text, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let rotation =
            UnitQuaternion::try_new(Quaternion::new(qw, qx, qy, qz), 1e-9).unwrap_or_default();
        Pose::from_parts(Translation3::new(x, y, z), rotation)
    } else {
        let [x, y, z, angles @ ..] = source.numbers_of(child, "the pose", text, [0.0; 6]);
        let degrees = matches!(child.attribute("degrees"), Some("true" | "1"));
        let rpy: [f64; 3] = if degrees {
            angles.map(f64::to_radians)
        } else {
            angles
        };
        Pose::from_parts(Translation3::new(x, y, z), from_rpy(rpy))
    };
    Some(PoseText { pose, relative_to })
}
