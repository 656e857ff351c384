//! Soft things: `<flexcomp>` and `<composite>`, as nodes with what holds them together.
//!
//! MuJoCo holds nodes together by constraints that give way, by springs and by elastic material. Here each of these is a stiffness: of a line (N, N m²), of a
//! sheet (N/m, N m) or of a material (Pa).

mod composite;
mod flexcomp;
mod grid;
mod holding;
mod nodes;
mod section;

use super::Files;
use super::attributes::{Attributes, MAIN};
use super::document::Document;
use super::element::{Element, Report};
use crate::model::Pose;

/// Largest number of nodes of a line.
const MAX_LINE: usize = 2000;
/// Largest number of nodes of a sheet or a solid.
const MAX_NODES: usize = 50_000;

/// A soft thing on a link.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Flex {
    /// Its name; of a composite: its prefix.
    pub name: String,
    /// The index of its link.
    pub link: usize,
    /// Its nodes, in the frame of the link, in MuJoCo's order.
    pub points: Vec<[f64; 3]>,
    /// How many nodes there are along each axis.
    pub count: [usize; 3],
    /// Which of the nodes the file speaks of; of a solid composite only those at its surface.
    pub nodes: Vec<usize>,
    /// What holds its nodes together.
    pub form: FlexForm,
    /// Distance from the nodes at which it touches, metres.
    pub radius: f64,
    /// Of all, kg.
    pub mass: f64,
    /// Ratio of viscous to elastic stiffness, seconds.
    pub damping: f64,
    /// What the air takes of the velocity, per second.
    pub drag: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Whether it touches other things.
    pub touches: bool,
    /// Whether it touches itself.
    pub touches_itself: bool,
    /// Nodes that the link holds.
    pub pins: Vec<FlexPin>,
    /// Red, green, blue, opacity.
    pub color: Option<[f64; 4]>,
    /// Its line in the file, from 1.
    pub line: u32,
}

/// A node that a link holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FlexPin {
    /// Index of the node.
    pub node: usize,
    /// Of a line: whether the edge that begins there keeps its direction.
    pub clamped: bool,
}

/// What holds nodes together.
#[derive(Debug, Clone, PartialEq)]
pub enum FlexForm {
    /// A line from node to node.
    Line {
        /// Force per strain, N.
        stretch: f64,
        /// Moment per curvature, N m².
        bend: f64,
        /// Torque per twist of a metre, N m².
        twist: f64,
        /// Whether it is straight at rest, otherwise as the nodes are.
        straight: bool,
    },
    /// A surface.
    Sheet {
        /// Nodes of the triangles.
        triangles: Vec<[u32; 3]>,
        /// Force per strain and width, N/m.
        stretch: f64,
        /// Moment per curvature and width, N m.
        bend: f64,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// A volume.
    Solid {
        /// Nodes of the triangles of its surface, facing outwards.
        triangles: Vec<[u32; 3]>,
        /// Nodes of the tetrahedra, in positive order.
        tetrahedra: Vec<[u32; 4]>,
        /// Young's modulus, Pa.
        young: f64,
        /// Poisson's ratio.
        poisson: f64,
    },
}

impl Default for FlexForm {
    fn default() -> Self {
        Self::Line {
            stretch: 0.0,
            bend: 0.0,
            twist: 0.0,
            straight: true,
        }
    }
}

impl Flex {
    /// The same on a link, from a frame of it.
    pub(super) fn on(mut self, link: usize, frame: Pose) -> Self {
        self.link = link;
        for point in &mut self.points {
            *point = (frame * nalgebra::Point3::from(*point)).into();
        }
        self
    }
}

/// What soft things are read with.
pub struct Reader<'a> {
    pub document: &'a Document,
    pub report: &'a mut Report,
    /// Where meshes are read from.
    pub files: &'a mut dyn Files,
    /// The name of the link, by which old composites say which of their nodes it is.
    pub link_name: &'a str,
}

/// Why something is not read.
type Refusal = String;

impl<'a> Reader<'a> {
    /// A `<flexcomp>` or a `<composite>`.
    pub fn read(&mut self, element: &'a Element) -> Result<Flex, Refusal> {
        let flex = match element.name.as_str() {
            "flexcomp" => flexcomp::read(self, element)?,
            _ => composite::read(self, element)?,
        };
        let positive = [("radius", flex.radius), ("mass", flex.mass)];
        match positive.iter().find(|(_, number)| *number <= 0.0) {
            Some((name, _)) => Err(format!("its {name} is not positive")),
            None => Ok(flex),
        }
    }

    fn attributes(&mut self, element: &'a Element) -> Attributes<'a> {
        self.document.defaults.of(element, MAIN, self.report)
    }

    /// The first child of that name.
    fn child(&mut self, element: &'a Element, name: &'a str) -> Option<Attributes<'a>> {
        let child = element.named(name).next()?;
        Some(self.attributes(child))
    }

    fn number(&mut self, attributes: &Attributes, name: &str, otherwise: f64) -> f64 {
        attributes.number(self.report, name).unwrap_or(otherwise)
    }

    fn pose(&mut self, attributes: &Attributes) -> Pose {
        self.document.pose(attributes, self.report)
    }

    /// Numbers of nodes along three axes, from one to three of them.
    fn count(&mut self, attributes: &Attributes, otherwise: f64) -> Result<[usize; 3], Refusal> {
        let mut numbers = attributes.numbers(self.report, "count", [otherwise; 3]);
        if let Some(said) = attributes.list(&mut Report::default(), "count") {
            numbers.iter_mut().skip(said.len()).for_each(|n| *n = 1.0);
        }
        let is_count = |n: &f64| n.fract() == 0.0 && (1.0..=1e4).contains(n);
        if !numbers.iter().all(is_count) {
            return Err("its count is not made of whole numbers from 1 to 10000".into());
        }
        let count = numbers.map(|n| n as usize);
        let nodes = count.iter().product::<usize>();
        let is_line = count.iter().filter(|n| **n > 1).count() < 2;
        let most = if is_line { MAX_LINE } else { MAX_NODES };
        if nodes > most {
            return Err(format!("it has {nodes} nodes, more than {most}"));
        }
        Ok(count)
    }

    /// The colour that is said, as such or by a material.
    fn color(&mut self, attributes: &Attributes) -> Option<[f64; 4]> {
        self.document.material(attributes, self.report)?.color
    }

    /// Says which elements inside of another one mean nothing here.
    fn leave_out_others(&mut self, element: &Element, known: &[&str]) {
        for child in &element.children {
            if !known.contains(&child.name.as_str()) {
                let name = crate::xml::short(&child.name);
                let text = format!("<{name}> is not read inside of <{}>", element.name);
                self.report.leave_out(child, text);
            }
        }
    }

    /// Whether something touches anything, by its bits.
    fn touches(&mut self, attributes: &Attributes) -> bool {
        let mut bits = |name| self.number(attributes, name, 1.0);
        bits("contype") != 0.0 || bits("conaffinity") != 0.0
    }
}

/// A number in a range, or why not.
fn within(name: &str, number: f64, range: std::ops::Range<f64>) -> Result<f64, Refusal> {
    if range.contains(&number) {
        return Ok(number);
    }
    Err(format!(
        "its {name}, {number}, is not from {} to below {}",
        range.start, range.end
    ))
}

/// A number that is positive, or why not.
fn positive(name: &str, number: f64) -> Result<f64, Refusal> {
    if number > 0.0 {
        return Ok(number);
    }
    Err(format!("its {name} is not positive"))
}

#[cfg(test)]
mod tests;
