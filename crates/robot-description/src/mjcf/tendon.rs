//! Tendons: over points (`<spatial>`) and over joints (`<fixed>`).

use super::attributes::{Attributes, Defaults, MAIN};
use super::document::Document;
use super::element::{Element, Report};
use super::{Model, Tendon, TendonPart};
use crate::model::Names;
use crate::report::Warning;
use crate::xml::short;

/// Reads the tendons of a file. Those over what the file does not have are left out.
pub fn read(
    root: &Element,
    document: &Document,
    model: &Model,
    report: &mut Report,
) -> Vec<Tendon> {
    let joints = Names::new(model.robot.joints.iter().map(|joint| joint.name.as_str()));
    let sites = Names::new(model.sites.iter().map(|site| site.name.as_str()));
    let moves = |name: &str| {
        let joint = joints.get(name).map(|joint| &model.robot.joints[joint]);
        joint.map(|joint| joint.kind.numbers() == 1)
    };
    let mut tendons = Vec::new();
    for element in root.named("tendon").flat_map(|part| &part.children) {
        let number = tendons.len();
        let read = tendon(element, &document.defaults, number, report).and_then(|tendon| {
            for part in &tendon.path {
                match part {
                    TendonPart::Site(name) if sites.get(name).is_none() => {
                        return Err(format!("there is no site '{}'", short(name)));
                    }
                    TendonPart::Joint(name, _) if moves(name).is_none() => {
                        return Err(format!("there is no joint '{}'", short(name)));
                    }
                    TendonPart::Joint(name, _) if moves(name) == Some(false) => {
                        let name = short(name);
                        return Err(format!("the joint '{name}' neither turns nor slides"));
                    }
                    _ => {}
                }
            }
            Ok(tendon)
        });
        match read {
            Ok(tendon) => tendons.push(tendon),
            Err(reason) => report.leave_out(element, reason),
        }
    }
    tendons
}

impl Tendon {
    /// A tendon that a `<spatial>` or `<fixed>` outside of a file describes, and what was wrong with it.
    ///
    /// # Errors
    /// When it describes none; in words.
    pub fn of_element(element: &Element) -> Result<(Self, Vec<Warning>), String> {
        let mut report = Report::default();
        let defaults = Defaults::new(&Element::default(), &mut report);
        let mut tendon = tendon(element, &defaults, 0, &mut report)?;
        tendon.name = element.attribute("name").unwrap_or("tendon").to_owned();
        Ok((tendon, report.finish(()).warnings))
    }
}

fn tendon(
    element: &Element,
    defaults: &Defaults,
    number: usize,
    report: &mut Report,
) -> Result<Tendon, String> {
    let path = match element.name.as_str() {
        "spatial" => points(element, report)?,
        "fixed" => joints(element, report)?,
        other => return Err(format!("<{}> is not read", short(other))),
    };
    // Defaults of both kinds are said by `<tendon>`.
    let attributes = defaults.of_kind(element, "tendon", MAIN, report);
    let mut number_of = |name: &str| attributes.number(report, name).unwrap_or(0.0);
    let mut tendon = Tendon {
        name: format!("tendon_{number}"),
        path,
        stiffness: number_of("stiffness").max(0.0),
        damping: number_of("damping").max(0.0),
        friction: number_of("frictionloss").max(0.0),
        armature: number_of("armature").max(0.0),
        rest: None,
        range: None,
        line: element.line,
    };
    if let Some(name) = attributes.get("name") {
        name.clone_into(&mut tendon.name);
    }
    tendon.rest = rest(&attributes, report);
    tendon.range = range(&attributes, report)?;
    Ok(tendon)
}

/// The lengths between which its spring exerts no force, if they are said: two, or one for both. -1 is that at first.
fn rest(attributes: &Attributes, report: &mut Report) -> Option<[f64; 2]> {
    let numbers = attributes.list(report, "springlength")?;
    let low = *numbers.first()?;
    let high = numbers.get(1).copied().unwrap_or(low).max(low);
    (low != -1.0).then_some([low, high])
}

fn range(attributes: &Attributes, report: &mut Report) -> Result<Option<[f64; 2]>, String> {
    let is_said = attributes.get("range").is_some();
    if !attributes.is_true("limited").unwrap_or(is_said) {
        return Ok(None);
    }
    let [low, high] = attributes.numbers(report, "range", [0.0; 2]);
    if low > high {
        return Err(format!("its range, {low} to {high}, has no length in it"));
    }
    Ok(Some([low, high]))
}

fn points(element: &Element, report: &mut Report) -> Result<Vec<TendonPart>, String> {
    let mut path = Vec::new();
    for child in &element.children {
        match child.name.as_str() {
            "site" => path.push(TendonPart::Site(name(child, "site")?)),
            "pulley" => path.push(TendonPart::Pulley(divisor(child, report)?)),
            "geom" => report.leave_out(
                child,
                "a tendon does not wind around geoms: it goes straight from site to site",
            ),
            other => report.leave_out(child, format!("<{}> is not read", short(other))),
        }
    }
    let is_line = |pair: &[TendonPart]| pair.iter().all(|part| matches!(part, TendonPart::Site(_)));
    if path.windows(2).any(is_line) {
        Ok(path)
    } else {
        Err("it does not lead from a site to another one".into())
    }
}

fn joints(element: &Element, report: &mut Report) -> Result<Vec<TendonPart>, String> {
    let mut path = Vec::new();
    for child in &element.children {
        if child.name == "joint" {
            let factor = child.attribute("coef").map(|text| {
                let numbers = report.numbers(child, "coef", text);
                numbers.first().copied().unwrap_or(0.0)
            });
            let factor = factor.ok_or("a joint of it has no coef")?;
            path.push(TendonPart::Joint(name(child, "joint")?, factor));
        } else {
            let text = format!("<{}> is not read", short(&child.name));
            report.leave_out(child, text);
        }
    }
    if path.is_empty() {
        return Err("it has no joints".into());
    }
    Ok(path)
}

fn name(element: &Element, key: &str) -> Result<String, String> {
    let name = element.attribute(key).map(str::to_owned);
    name.ok_or_else(|| format!("a <{}> of it names no {key}", short(&element.name)))
}

fn divisor(element: &Element, report: &mut Report) -> Result<f64, String> {
    let text = element.attribute("divisor").unwrap_or("1");
    let numbers = report.numbers(element, "divisor", text);
    let divisor = numbers.first().copied().filter(|number| *number > 0.0);
    divisor.ok_or_else(|| "a pulley of it has no positive divisor".to_owned())
}
