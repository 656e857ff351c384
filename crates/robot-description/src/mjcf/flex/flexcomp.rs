//! `<flexcomp>`: nodes with what holds them together.

use nalgebra::Point3;

use super::grid::{Grid, surface};
use super::holding::Holding;
use super::nodes::{self, Elements, Nodes};
use super::{Flex, FlexForm, FlexPin, Reader, Refusal, positive, within};
use crate::mjcf::element::Element;
use crate::xml::short;

/// Elements inside of it that mean something here.
const READ: &[&str] = &["edge", "elasticity", "contact", "pin", "plugin"];
/// How much less than a solid rod a line of edges resists bending.
pub(super) const SLACKNESS: f64 = 1e-3;
/// What edges of stiffness 1 along two axes and a diagonal make of a plane of distance 1: force per strain and width, Poisson's ratio.
pub(super) const PLANE_OF_EDGES: [f64; 2] = [1.5, 1.0 / 3.0];
/// What edges along three axes, a diagonal of each face and one through the cell make: Young's modulus, Poisson's ratio.
pub(super) const SOLID_OF_EDGES: [f64; 2] = [1.89, 0.26];

/// What an elastic material is made of.
#[derive(Debug, Clone, Copy, Default)]
struct Material {
    young: f64,
    poisson: f64,
    thickness: f64,
    damping: f64,
    /// Whether a sheet of it resists stretch, and bending.
    resists: [bool; 2],
}

pub(super) fn read<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Flex, Refusal> {
    let attributes = reader.attributes(element);
    reader.leave_out_others(element, READ);
    let nodes = nodes::read(reader, &attributes)?;
    let count = nodes.points.len();
    let mass = positive("mass", reader.number(&attributes, "mass", 1.0))?;
    let radius = positive("radius", reader.number(&attributes, "radius", 0.005))?;
    let edges = edges(reader, element, mass / count as f64);
    let material = material(reader, element)?;
    if edges.stiffness == 0.0 && material.young == 0.0 {
        return Err("it has neither edges nor elasticity that hold its nodes together".into());
    }
    let ratio = if material.young > 0.0 {
        material.damping
    } else {
        edges.ratio()
    };
    let pose = reader.pose(&attributes);
    let points = nodes.points.iter();
    let mut flex = Flex {
        name: attributes.get("name").unwrap_or_default().to_owned(),
        points: points
            .map(|point| (pose * Point3::from(*point)).into())
            .collect(),
        count: nodes.count,
        nodes: (0..count).collect(),
        radius,
        mass,
        damping: ratio,
        friction: 1.0,
        touches: true,
        touches_itself: true,
        color: reader.color(&attributes),
        line: element.line,
        ..Flex::default()
    };
    flex.pins = pins(reader, element, &nodes)?;
    flex.form = form(nodes, radius, edges, material);
    contact(reader, element, &mut flex);
    if attributes.is_true("rigid") == Some(true) {
        flex.pins = flex.nodes.iter().copied().map(pin).collect();
    }
    Ok(flex)
}

fn edges<'a>(reader: &mut Reader<'a>, element: &'a Element, node_mass: f64) -> Holding {
    let Some(attributes) = reader.child(element, "edge") else {
        return Holding::default();
    };
    let spring = reader.spring(&attributes);
    match attributes.get("equality") {
        None | Some("false") => spring,
        Some(_) => {
            let names = ["solref", "solimp"];
            spring.with(reader.constraint(&attributes, names, node_mass))
        }
    }
}

fn material<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, Refusal> {
    let mut found = Material::default();
    if let Some(attributes) = reader.child(element, "elasticity") {
        let kind = attributes.get("elastic2d").unwrap_or("none");
        found = Material {
            young: reader.number(&attributes, "young", 0.0),
            poisson: reader.number(&attributes, "poisson", 0.0),
            thickness: reader.number(&attributes, "thickness", 0.0),
            damping: reader.number(&attributes, "damping", 0.0),
            resists: [["stretch", "both"], ["bend", "both"]].map(|kinds| kinds.contains(&kind)),
        };
    }
    for plugin in element.named("plugin") {
        let resists = match plugin.attribute("plugin").unwrap_or_default() {
            "mujoco.elasticity.solid" | "mujoco.elasticity.membrane" => [true, false],
            "mujoco.elasticity.shell" => [false, true],
            other => {
                let text = format!("plugin '{}' is not known", short(other));
                reader.report.leave_out(plugin, text);
                continue;
            }
        };
        let mut number = |key: &str| config(reader, plugin, key).unwrap_or(0.0);
        found = Material {
            young: number("young"),
            poisson: number("poisson"),
            thickness: number("thickness"),
            damping: number("damping"),
            resists,
        };
    }
    within("young", found.young, 0.0..1e16)?;
    within("poisson", found.poisson, 0.0..0.4999)?;
    within("damping", found.damping, 0.0..1e3)?;
    Ok(found)
}

/// A number in the settings of a plugin.
pub(super) fn config(reader: &mut Reader, plugin: &Element, key: &str) -> Option<f64> {
    let mut settings = plugin.named("config");
    let setting = settings.find(|setting| setting.attribute("key") == Some(key))?;
    let text = setting.attribute("value")?;
    reader.report.numbers(setting, key, text).first().copied()
}

fn form(nodes: Nodes, radius: f64, edges: Holding, material: Material) -> FlexForm {
    match nodes.elements {
        Elements::Line => {
            let area = std::f64::consts::PI * radius * radius;
            let stretch = edges.stiffness * nodes.spacing + material.young * area;
            let bend = stretch * 0.25 * radius * radius * SLACKNESS;
            FlexForm::Line {
                stretch,
                bend,
                twist: bend,
                straight: nodes.grid.is_some(),
            }
        }
        Elements::Triangles(triangles) => sheet(triangles, edges, material),
        Elements::Tetrahedra(tetrahedra) => {
            let is_material = material.young > 0.0;
            FlexForm::Solid {
                triangles: surface(&tetrahedra),
                tetrahedra,
                young: material.young + SOLID_OF_EDGES[0] * edges.stiffness / nodes.spacing,
                poisson: if is_material {
                    material.poisson
                } else {
                    SOLID_OF_EDGES[1]
                },
            }
        }
    }
}

fn sheet(triangles: Vec<[u32; 3]>, edges: Holding, material: Material) -> FlexForm {
    let Material {
        poisson, thickness, ..
    } = material;
    let plane = material.young * thickness / (1.0 - poisson * poisson);
    let [stretch, bend] = [plane, plane * thickness * thickness / 12.0];
    let [is_stretched, is_bent] = material.resists;
    let of_material = if is_stretched { stretch } else { 0.0 };
    // What only bends keeps its lengths.
    let least = if edges.stiffness == 0.0 { stretch } else { 0.0 };
    FlexForm::Sheet {
        triangles,
        stretch: (PLANE_OF_EDGES[0] * edges.stiffness + of_material).max(least),
        bend: if is_bent { bend } else { 0.0 },
        poisson: if is_stretched {
            poisson
        } else {
            PLANE_OF_EDGES[1]
        },
    }
}

/// What it touches, and how.
fn contact<'a>(reader: &mut Reader<'a>, element: &'a Element, flex: &mut Flex) {
    if let Some(attributes) = reader.child(element, "contact") {
        flex.touches = reader.touches(&attributes);
        flex.touches_itself = attributes.get("selfcollide") != Some("none");
        flex.friction = reader
            .number(&attributes, "friction", 1.0)
            .clamp(0.0, 100.0);
    }
}

fn pin(node: usize) -> FlexPin {
    FlexPin {
        node,
        clamped: false,
    }
}

/// The nodes that are pinned: by numbers, by ranges of them, by places in the grid and by blocks of it.
fn pins<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    of: &Nodes,
) -> Result<Vec<FlexPin>, Refusal> {
    let mut nodes = Vec::new();
    let count = of.points.len();
    for child in element.named("pin") {
        for (name, text) in &child.attributes {
            let numbers = indices(name, text)?;
            match name.as_str() {
                "id" => nodes.extend(numbers),
                "range" => {
                    let (pairs, _) = numbers.as_chunks::<2>();
                    let ends = pairs.iter().map(|[from, to]| *from..(*to + 1).min(count));
                    nodes.extend(ends.flatten());
                }
                "grid" | "gridrange" => {
                    let corners = if name == "grid" { 1 } else { 2 };
                    let grid = of.grid.as_ref().ok_or("its nodes are no grid")?;
                    nodes.extend(block(grid, numbers, corners));
                }
                _ => reader
                    .report
                    .leave_out(child, format!("'{}' is not read", short(name))),
            }
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last().filter(|node| **node >= count) {
        Some(node) => Err(format!("it has no node {node} that could be pinned")),
        None => Ok(nodes.into_iter().map(pin).collect()),
    }
}

/// The nodes at places of the grid, or in boxes between two of them; places outside of it have none. As many numbers as the grid has dimensions.
fn block(grid: &Grid, numbers: Vec<usize>, corners: usize) -> Vec<usize> {
    let axes: Vec<usize> = grid.axes().collect();
    let mut nodes = Vec::new();
    for group in numbers.chunks_exact(axes.len() * corners) {
        let low = &group[..axes.len()];
        let high = &group[group.len() - axes.len()..];
        let is_in = |place: &[usize; 3]| {
            let mut along = axes.iter().zip(low.iter().zip(high));
            along.all(|(axis, (low, high))| (*low..=*high).contains(&place[*axis]))
        };
        nodes.extend(grid.places().filter(is_in).map(|place| grid.number(place)));
    }
    nodes
}

fn indices(name: &str, text: &str) -> Result<Vec<usize>, Refusal> {
    let read = |word: &str| {
        let index = word.parse().ok().filter(|index: &usize| *index < 1 << 24);
        index.ok_or_else(|| format!("{name} has '{}', which is no index", short(word)))
    };
    text.split_whitespace().map(read).collect()
}
