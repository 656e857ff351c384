//! Equality constraints between joints, and between bodies.

use super::attributes::{Attributes, Defaults, MAIN};
use super::element::{Element, Report};
use super::{Equality, Model};
use crate::model::{Names, Pose};
use crate::xml::short;

pub fn read(root: &Element, model: &Model, report: &mut Report) -> Vec<Equality> {
    let defaults = Defaults::new(root, &mut Report::default());
    let index = Index::new(model);
    let mut equalities = Vec::new();
    for element in root.named("equality").flat_map(|part| &part.children) {
        let attributes = defaults.of(element, MAIN, &mut Report::default());
        if attributes.is_true("active") == Some(false) {
            report.leave_out(element, "it is not active");
            continue;
        }
        let read = match element.name.as_str() {
            "joint" => joint(&attributes, &index, report),
            "connect" => connect(&attributes, &index, report),
            "weld" => weld(&attributes, &index, report),
            other => Err(format!("<{}> is not read", short(other))),
        };
        match read {
            Ok(equality) => equalities.push(equality),
            Err(reason) => report.leave_out(element, reason),
        }
    }
    equalities
}

/// A model, and where its parts are found.
struct Index<'a> {
    model: &'a Model,
    /// The frames of the links where all joints are at first.
    poses: Vec<Pose>,
    links: Names,
    joints: Names,
    sites: Names,
}

impl<'a> Index<'a> {
    fn new(model: &'a Model) -> Self {
        Self {
            model,
            poses: first_poses(model),
            links: Names::new(model.robot.links.iter().map(|link| link.name.as_str())),
            joints: Names::new(model.robot.joints.iter().map(|joint| joint.name.as_str())),
            sites: Names::new(model.sites.iter().map(|site| site.name.as_str())),
        }
    }
}

fn first_poses(model: &Model) -> Vec<Pose> {
    let mut positions = model.robot.zero_positions();
    let mut start = 0;
    for joint in &model.robot.joints {
        if joint.kind.numbers() == 1 {
            positions[start] = joint.reference;
        }
        start += joint.kind.numbers();
    }
    model.robot.link_poses(&positions).unwrap_or_default()
}

fn joint(attributes: &Attributes, index: &Index, report: &mut Report) -> Result<Equality, String> {
    let find = |name: &str| {
        index
            .joints
            .get(name)
            .ok_or_else(|| format!("there is no joint '{}'", short(name)))
    };
    let joint = find(attributes.get("joint1").ok_or("it names no joint")?)?;
    let master = attributes.get("joint2").map(find).transpose()?;
    let polynomial = attributes.numbers(report, "polycoef", [0.0, 1.0, 0.0, 0.0, 0.0]);
    if master == Some(joint) {
        return Err("a joint cannot be equal to itself".into());
    }
    Ok(Equality::Joint {
        joint,
        master,
        polynomial,
        line: attributes.element.line,
    })
}

/// The two links of a constraint between bodies; without a second one: the world. Those of sites have frames.
fn links(
    attributes: &Attributes,
    index: &Index,
) -> Result<([usize; 2], Option<[Pose; 2]>), String> {
    let site = |name: &str| {
        let site = index.sites.get(name).map(|site| &index.model.sites[site]);
        site.ok_or_else(|| format!("there is no site '{}'", short(name)))
    };
    if let (Some(first), Some(second)) = (attributes.get("site1"), attributes.get("site2")) {
        let (first, second) = (site(first)?, site(second)?);
        return Ok(([first.link, second.link], Some([first.pose, second.pose])));
    }
    let body = |name: &str| {
        index
            .links
            .get(name)
            .ok_or_else(|| format!("there is no body '{}'", short(name)))
    };
    let first = body(attributes.get("body1").ok_or("it names no body")?)?;
    let second = attributes.get("body2").map(body).transpose()?.unwrap_or(0);
    Ok(([first, second], None))
}

fn connect(
    attributes: &Attributes,
    index: &Index,
    report: &mut Report,
) -> Result<Equality, String> {
    let ([first, second], sites) = links(attributes, index)?;
    let poses = &index.poses;
    let line = attributes.element.line;
    if let Some(frames) = sites {
        let points = frames.map(|frame| frame.translation.vector.into());
        return Ok(Equality::Connect {
            links: [first, second],
            points,
            line,
        });
    }
    let anchor = attributes.numbers(report, "anchor", [0.0; 3]);
    let between = poses[second].inverse() * poses[first];
    let there = between.transform_point(&anchor.into()).coords.into();
    Ok(Equality::Connect {
        links: [first, second],
        points: [anchor, there],
        line,
    })
}

fn weld(attributes: &Attributes, index: &Index, report: &mut Report) -> Result<Equality, String> {
    let ([first, second], sites) = links(attributes, index)?;
    let poses = &index.poses;
    let line = attributes.element.line;
    if let Some(frames) = sites {
        return Ok(Equality::Weld {
            links: [first, second],
            frames,
            line,
        });
    }
    // The pose of the second body in the first one's frame; a rotation of zeros: as they are at first.
    let [x, y, z, w, qx, qy, qz] = attributes.numbers(report, "relpose", [0.0; 7]);
    let rotation =
        nalgebra::UnitQuaternion::try_new(nalgebra::Quaternion::new(w, qx, qy, qz), 1e-9);
    let relative = match rotation {
        Some(rotation) => Pose::from_parts(nalgebra::Translation3::new(x, y, z), rotation),
        None => poses[first].inverse() * poses[second],
    };
    Ok(Equality::Weld {
        links: [first, second],
        frames: [relative, Pose::identity()],
        line,
    })
}
