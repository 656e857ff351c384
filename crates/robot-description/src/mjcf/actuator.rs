//! Actuators of joints.

use super::attributes::{Attributes, MAIN};
use super::document::Document;
use super::element::{Element, Report};
use super::{Actuator, Drive};
use crate::model::{Names, Robot};
use crate::xml::short;

pub fn read(
    root: &Element,
    document: &Document,
    robot: &Robot,
    report: &mut Report,
) -> Vec<Actuator> {
    let joints = Names::new(robot.joints.iter().map(|joint| joint.name.as_str()));
    let mut actuators = Vec::new();
    for element in root.named("actuator").flat_map(|part| &part.children) {
        let attributes = document.defaults.of(element, MAIN, report);
        match actuator(&attributes, document, (robot, &joints), report) {
            Ok(actuator) => actuators.push(actuator),
            Err(reason) => report.leave_out(element, reason),
        }
    }
    actuators
}

fn actuator(
    attributes: &Attributes,
    document: &Document,
    (robot, joints): (&Robot, &Names),
    report: &mut Report,
) -> Result<Actuator, String> {
    let target = attributes.first_of(&["joint", "jointinparent"]);
    let (_, name) = target.ok_or("an actuator that moves no joint is not read")?;
    let joint = joints
        .get(name)
        .ok_or_else(|| format!("there is no joint '{}'", short(name)))?;
    let kind = attributes.element.name.as_str();
    let (drive, gain) = drive(kind, attributes, report)?;
    let gear = attributes.numbers(report, "gear", [1.0]).map(f64::abs)[0];
    let limits_by_range = document.settings.limits_by_range;
    let mut largest = |flag: &str, range: &str| {
        let is_limited = attributes
            .is_true(flag)
            .unwrap_or(limits_by_range && attributes.get(range).is_some());
        let numbers = attributes.numbers(report, range, [0.0; 2]);
        is_limited.then(|| numbers[0].abs().max(numbers[1].abs()) * gear)
    };
    let force = largest("forcelimited", "forcerange");
    // What a motor is told is a force.
    let control = if drive == Drive::Force {
        largest("ctrllimited", "ctrlrange").map(|control| control * gain)
    } else {
        None
    };
    let effort = [force, control, robot.joints[joint].limits.effort]
        .into_iter()
        .flatten()
        .reduce(f64::min);
    let name = attributes.get("name").unwrap_or(name).to_owned();
    Ok(Actuator {
        name,
        joint,
        drive,
        effort,
        line: attributes.element.line,
    })
}

/// What an actuator does, and the force per unit of what it is told.
fn drive(kind: &str, attributes: &Attributes, report: &mut Report) -> Result<(Drive, f64), String> {
    let mut number =
        |name: &str, otherwise: f64| attributes.number(report, name).unwrap_or(otherwise);
    match kind {
        "motor" => Ok((Drive::Force, 1.0)),
        "position" => {
            let (stiffness, damping) = (number("kp", 1.0), number("kv", 0.0));
            Ok((Drive::Position { stiffness, damping }, 1.0))
        }
        "velocity" => Ok((
            Drive::Velocity {
                damping: number("kv", 1.0),
            },
            1.0,
        )),
        "general" => Ok(general(attributes, report)),
        other => Err(format!(
            "an actuator of type '{}' is not read",
            short(other)
        )),
    }
}

/// A general actuator: its bias says what it is.
fn general(attributes: &Attributes, report: &mut Report) -> (Drive, f64) {
    let gain = attributes.numbers(report, "gainprm", [1.0])[0];
    let [_, position, velocity] = attributes.numbers(report, "biasprm", [0.0; 3]);
    let is_affine = attributes.get("biastype") == Some("affine");
    let drive = match (is_affine, position != 0.0, velocity != 0.0) {
        (true, true, _) => Drive::Position {
            stiffness: -position,
            damping: -velocity,
        },
        (true, false, true) => Drive::Velocity { damping: -velocity },
        _ => Drive::Force,
    };
    (drive, gain.abs())
}
