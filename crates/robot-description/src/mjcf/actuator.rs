//! Actuators of joints and tendons.

use super::attributes::{Attributes, MAIN};
use super::document::Document;
use super::element::{Element, Report};
use super::{Actuator, Drive, Model, Target};
use crate::model::{Limits, Names};
use crate::report::Warning;
use crate::xml::short;

pub fn read(
    root: &Element,
    document: &Document,
    model: &Model,
    report: &mut Report,
) -> Vec<Actuator> {
    let targets = Targets::of(model);
    let mut actuators = Vec::new();
    let elements = root.named("actuator").flat_map(|part| &part.children);
    // Those of bodies are read elsewhere.
    for element in elements.filter(|element| element.name != "adhesion") {
        let attributes = document.defaults.of(element, MAIN, report);
        let read = targets.find(&attributes).and_then(|(target, name)| {
            let target = (target, name, targets.limits(target));
            actuator(&attributes, document, target, report)
        });
        match read {
            Ok(actuator) => actuators.push(actuator),
            Err(reason) => report.leave_out(element, reason),
        }
    }
    actuators
}

/// What actuators can move.
struct Targets<'a> {
    model: &'a Model,
    joints: Names,
    tendons: Names,
}

impl<'a> Targets<'a> {
    fn of(model: &'a Model) -> Self {
        let joints = model.robot.joints.iter();
        let tendons = model.tendons.iter();
        Self {
            model,
            joints: Names::new(joints.map(|joint| joint.name.as_str())),
            tendons: Names::new(tendons.map(|tendon| tendon.name.as_str())),
        }
    }

    /// What an actuator moves, and its name.
    fn find<'n>(&self, attributes: &Attributes<'n>) -> Result<(Target, &'n str), String> {
        let named = attributes.first_of(&["joint", "jointinparent", "tendon"]);
        let (kind, name) =
            named.ok_or("an actuator that moves no joint and no tendon is not read")?;
        let (kind, target) = match kind {
            "tendon" => (kind, self.tendons.get(name).map(Target::Tendon)),
            _ => ("joint", self.joints.get(name).map(Target::Joint)),
        };
        let target = target.ok_or_else(|| format!("there is no {kind} '{}'", short(name)))?;
        Ok((target, name))
    }

    /// The positions that it can have, and the largest force.
    fn limits(&self, target: Target) -> Limits {
        match target {
            Target::Joint(joint) => self.model.robot.joints[joint].limits,
            Target::Tendon(tendon) => {
                let range = self.model.tendons[tendon].range;
                Limits {
                    lower: range.map(|[low, _]| low),
                    upper: range.map(|[_, high]| high),
                    ..Limits::default()
                }
            }
        }
    }
}

impl Actuator {
    /// A motor that an element outside of a file describes, with what it moves ("joint" or "tendon" and its name), and what was wrong with it. Its `target` means nothing.
    ///
    /// # Errors
    /// When it describes none; in words.
    pub fn of_element(element: &Element) -> Result<(Self, [String; 2], Vec<Warning>), String> {
        let mut report = Report::default();
        let mut document = Document::new(&Element::default(), &mut report);
        document.settings.use_radians();
        let attributes = document.defaults.of(element, MAIN, &mut report);
        let (key, name) = moved(&attributes)?;
        let kind = if key == "tendon" { key } else { "joint" };
        let target = (Target::Joint(0), name, Limits::default());
        let actuator = actuator(&attributes, &document, target, &mut report)?;
        let named = [kind.to_owned(), name.to_owned()];
        Ok((actuator, named, report.finish(()).warnings))
    }
}

/// What an actuator moves: the attribute that says it, and the name.
fn moved<'a>(attributes: &Attributes<'a>) -> Result<(&'static str, &'a str), String> {
    let named = attributes.first_of(&["joint", "jointinparent", "tendon"]);
    named.ok_or_else(|| "an actuator that moves no joint and no tendon is not read".to_owned())
}

fn actuator(
    attributes: &Attributes,
    document: &Document,
    (target, name, limits): (Target, &str, Limits),
    report: &mut Report,
) -> Result<Actuator, String> {
    let kind = attributes.element.name.as_str();
    let law = Law::read(kind, attributes, report)?;
    let gear = attributes.numbers(report, "gear", [1.0])[0];
    let by_range = document.settings.limits_by_range;
    let mut range = |flag: &str, name: &str| {
        let is_limited = attributes
            .is_true(flag)
            .unwrap_or(by_range && attributes.get(name).is_some());
        let numbers = attributes.numbers(report, name, [0.0; 2]);
        is_limited.then_some(numbers)
    };
    let forces = range("forcelimited", "forcerange").map(|force| scaled(force, gear));
    let told =
        range("ctrllimited", "ctrlrange").or_else(|| inherited_range(attributes, &limits, report));
    let drive = law.drive(gear);
    // The control of a motor is a force.
    let control = told.map(|told| scaled(told, law.of_joint(drive, gear)));
    let of_control = control.filter(|_| drive == Drive::Force);
    let effort = [forces.map(largest), of_control.map(largest), limits.effort];
    let of_joint = limits.effort.map(|most| [-most, most]);
    let of_control = of_control.map(|control| control.map(|force| force + law.bias[0] * gear));
    let ranges = [forces, of_control, of_joint].into_iter().flatten();
    Ok(Actuator {
        name: attributes.get("name").unwrap_or(name).to_owned(),
        target,
        drive,
        effort: effort.into_iter().flatten().reduce(f64::min),
        bias: law.bias[0] * gear,
        range: ranges.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])]),
        control: control.filter(|_| drive != Drive::Force),
        line: attributes.element.line,
    })
}

/// The range of control that a position actuator has from the range of its joint: `inheritrange` times as large about the same middle.
fn inherited_range(
    attributes: &Attributes,
    limits: &Limits,
    report: &mut Report,
) -> Option<[f64; 2]> {
    let factor = attributes.number(report, "inheritrange")?;
    let (lower, upper) = limits.lower.zip(limits.upper)?;
    let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0 * factor);
    (factor > 0.0).then_some([middle - half, middle + half])
}

/// The force of an actuator: `gain` times its control, and `bias`: a constant, per length and per speed.
struct Law {
    gain: f64,
    bias: [f64; 3],
}

impl Law {
    fn read(kind: &str, attributes: &Attributes, report: &mut Report) -> Result<Self, String> {
        let mut number =
            |name: &str, otherwise: f64| attributes.number(report, name).unwrap_or(otherwise);
        match kind {
            "motor" => Ok(Self {
                gain: 1.0,
                bias: [0.0; 3],
            }),
            "position" => {
                let (stiffness, damping) = (number("kp", 1.0), number("kv", 0.0));
                if attributes.get("dampratio").is_some() {
                    report.leave_out(
                        attributes.element,
                        "dampratio is not read: kv says how it is damped",
                    );
                }
                Ok(Self {
                    gain: stiffness,
                    bias: [0.0, -stiffness, -damping],
                })
            }
            "velocity" => {
                let damping = number("kv", 1.0);
                Ok(Self {
                    gain: damping,
                    bias: [0.0, 0.0, -damping],
                })
            }
            "general" => Ok(Self::general(attributes, report)),
            other => Err(format!(
                "an actuator of type '{}' is not read",
                short(other)
            )),
        }
    }

    fn general(attributes: &Attributes, report: &mut Report) -> Self {
        if !matches!(attributes.get("dyntype"), None | Some("none")) {
            report.leave_out(
                attributes.element,
                "dyntype is not read: it acts at once on its control",
            );
        }
        let is_affine = attributes.get("biastype") == Some("affine");
        let bias = attributes.numbers(report, "biasprm", [0.0; 3]);
        Self {
            gain: attributes.numbers(report, "gainprm", [1.0])[0],
            bias: if is_affine { bias } else { [0.0; 3] },
        }
    }

    /// What it does to the joint, whose positions the gear makes lengths, and whose forces it is multiplied with.
    fn drive(&self, gear: f64) -> Drive {
        let [_, stiffness, damping] = self.bias.map(|number| -number * gear * gear);
        if stiffness != 0.0 {
            Drive::Position { stiffness, damping }
        } else if damping != 0.0 {
            Drive::Velocity { damping }
        } else {
            Drive::Force
        }
    }

    /// Force, position or speed of the joint per unit of its control.
    fn of_joint(&self, drive: Drive, gear: f64) -> f64 {
        let force = self.gain * gear;
        match drive {
            Drive::Position { stiffness, .. } => force / stiffness,
            Drive::Velocity { damping } => force / damping,
            Drive::Force => force,
        }
    }
}

/// A range in other units; the sign of the factor may turn it round.
fn scaled(range: [f64; 2], factor: f64) -> [f64; 2] {
    let [a, b] = range.map(|end| end * factor);
    [a.min(b), a.max(b)]
}

fn largest([low, high]: [f64; 2]) -> f64 {
    low.abs().max(high.abs())
}
