//! What acts on bodies by their surface, and what compensates their weight.

use nalgebra::Vector3;

use super::attributes::{Attributes, Defaults, MAIN};
use super::body::Builder;
use super::document::Document;
use super::element::{Element, Report};
use super::{Adhesion, Model};
use crate::model::{Names, Pose};
use crate::xml::short;

impl Builder<'_> {
    /// Notes how much of the weight of a body is compensated.
    pub(super) fn note_compensation(&mut self, attributes: &Attributes, link: usize) {
        let part = attributes.number(&mut self.report, "gravcomp");
        if let Some(part) = part.filter(|part| *part != 0.0) {
            self.model.compensations.push((link, part));
        }
    }

    /// Notes how the surface of a geom moves that is about to be added to its link, where it has that pose. All that is touched of a link moves as one.
    pub(super) fn note_motion(&mut self, attributes: &Attributes, link: usize, pose: &Pose) {
        if attributes.get("adhesion").is_some() {
            let text = "adhesion of geoms is not read: that of actuators is";
            self.report.leave_out(attributes.element, text);
        }
        let numbers = attributes.numbers(&mut self.report, "surfacevel", [0.0; 6]);
        let motion = (numbers != [0.0; 6]).then(|| of_link(numbers, pose));
        let surfaces = &mut self.model.moving_surfaces;
        let known = surfaces.iter().position(|(of, _)| *of == link);
        let others = known.map(|place| surfaces[place].1);
        let is_first = self.model.robot.links[link].collisions.is_empty();
        let reason = if motion == others {
            return;
        } else if is_first {
            surfaces.extend(motion.map(|motion| (link, motion)));
            return;
        } else {
            known.map(|place| surfaces.remove(place));
            "surfacevel is not read where another geom of the body has another one"
        };
        self.report.leave_out(attributes.element, reason);
    }
}

/// The velocity of the link's origin and the angular velocity, both in its frame, of a geom that has that pose in it.
fn of_link([x, y, z, a, b, c]: [f64; 6], pose: &Pose) -> [f64; 6] {
    let (linear, angular) = (Vector3::new(x, y, z), Vector3::new(a, b, c));
    let (linear, angular) = (pose.rotation * linear, pose.rotation * angular);
    let linear = linear - angular.cross(&pose.translation.vector);
    [
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
    ]
}

/// The actuators that let bodies adhere to what they touch.
pub fn adhesions(
    root: &Element,
    document: &Document,
    model: &Model,
    report: &mut Report,
) -> Vec<Adhesion> {
    let links = Names::new(model.robot.links.iter().map(|link| link.name.as_str()));
    let mut adhesions = Vec::new();
    let actuators = root.named("actuator").flat_map(|part| &part.children);
    for element in actuators.filter(|element| element.name == "adhesion") {
        let attributes = document.defaults.of(element, MAIN, report);
        let read = body(&attributes).and_then(|name| {
            let link = links.get(name);
            let link = link.ok_or_else(|| format!("there is no body '{}'", short(name)))?;
            Ok(adhesion(&attributes, name, link, report))
        });
        match read {
            Ok(adhesion) => adhesions.push(adhesion),
            Err(reason) => report.leave_out(element, reason),
        }
    }
    adhesions
}

impl Adhesion {
    /// What an `<adhesion>` outside of a file describes, and the name of the body. Its `link` means nothing.
    ///
    /// # Errors
    /// When it names no body; in words.
    pub fn of_element(element: &Element) -> Result<(Self, String), String> {
        let mut report = Report::default();
        let defaults = Defaults::new(&Element::default(), &mut report);
        let attributes = defaults.of(element, MAIN, &mut report);
        let name = body(&attributes)?;
        Ok((adhesion(&attributes, name, 0, &mut report), name.to_owned()))
    }
}

fn body<'a>(attributes: &Attributes<'a>) -> Result<&'a str, String> {
    let body = attributes.get("body");
    body.ok_or_else(|| "it names no body".to_owned())
}

fn adhesion(attributes: &Attributes, body: &str, link: usize, report: &mut Report) -> Adhesion {
    let mut range = |name: &str| {
        let is_there = attributes.get(name).is_some();
        is_there.then(|| attributes.numbers(report, name, [0.0; 2]))
    };
    let (control, force) = (range("ctrlrange"), range("forcerange"));
    Adhesion {
        name: attributes.get("name").unwrap_or(body).to_owned(),
        link,
        gain: attributes.number(report, "gain").unwrap_or(1.0),
        control,
        force,
        line: attributes.element.line,
    }
}
