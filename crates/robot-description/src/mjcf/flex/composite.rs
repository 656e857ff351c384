//! `<composite>`: cables, and the kinds that MuJoCo had before flexcomps.

use std::f64::consts::PI;

use nalgebra::{Point3, Vector3};

use super::flexcomp::{PLANE_OF_EDGES, SOLID_OF_EDGES, config};
use super::grid::{Grid, surface};
use super::holding::Holding;
use super::section::{Section, of_kind};
use super::{Flex, FlexForm, FlexPin, MAX_LINE, Reader, Refusal, within};
use crate::mjcf::attributes::Attributes;
use crate::mjcf::element::Element;
use crate::xml::short;

/// Elements inside of it that mean something here, or nothing that could be missed.
const READ: &[&str] = &["geom", "joint", "tendon", "pin", "plugin", "site", "skin"];
/// Young's modulus along a cable that says none: its links do not stretch.
const YOUNG: f64 = 1e8;
/// The part of the stiffness of a solid rod that is left to what does not resist bending.
const LIMP: f64 = 1e-6;
/// Longest time constant of the damping of bending, s.
const MAX_RATIO: f64 = 10.0;

pub(super) fn read<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Flex, Refusal> {
    let attributes = reader.attributes(element);
    reader.leave_out_others(element, READ);
    let mut flex = match attributes.get("type").unwrap_or_default() {
        "cable" => cable(reader, element, &attributes)?,
        "rope" => rope(reader, element, &attributes)?,
        "grid" | "cloth" => net(reader, element, &attributes)?,
        "box" | "cylinder" | "ellipsoid" => solid(reader, element, &attributes)?,
        other => return Err(refusal(other)),
    };
    flex.name = attributes.get("prefix").unwrap_or_default().to_owned();
    flex.line = element.line;
    place(reader, &attributes, &mut flex);
    Ok(flex)
}

/// Why composites of a type are not read.
fn refusal(kind: &str) -> Refusal {
    match kind {
        "particle" => "particles are bodies that nothing holds together, not a soft thing: bodies with a <freejoint> are read".into(),
        "loop" => "a loop is a line of nodes without ends, which ropes have: it is not read".into(),
        other => format!("composites of type '{}' are not read", short(other)),
    }
}

/// Moves the nodes by `offset` and the orientation.
fn place(reader: &mut Reader, attributes: &Attributes, flex: &mut Flex) {
    let offset = attributes.numbers(reader.report, "offset", [0.0; 3]);
    let pose = reader.pose(attributes);
    for point in &mut flex.points {
        let turned = pose * Point3::from(*point) + Vector3::from(offset);
        *point = turned.into();
    }
}

fn of_section(section: &Section, count: [usize; 3], mass: f64) -> Flex {
    Flex {
        count,
        nodes: (0..count.iter().product()).collect(),
        radius: section.radius(),
        mass,
        friction: section.friction,
        touches: section.touches,
        color: section.color,
        ..Flex::default()
    }
}

fn cable<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    attributes: &Attributes,
) -> Result<Flex, Refusal> {
    let section = Section::read(reader, element, "capsule")?;
    let points = line(reader, attributes)?;
    let count = points.len();
    let pairs = points.windows(2);
    let lengths = pairs.map(|pair| (Vector3::from(pair[1]) - Vector3::from(pair[0])).norm());
    let lengths: Vec<f64> = lengths.collect();
    if lengths.iter().any(|length| *length < 1e-9) {
        return Err("nodes of it are at one place".into());
    }
    let mass = lengths.iter().map(|l| section.mass_of_length(*l)).sum();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let (form, damping) = rod(reader, element, &section, mean)?;
    let initial = attributes.get("initial").unwrap_or("none");
    let pin = FlexPin {
        node: 0,
        clamped: initial != "ball",
    };
    Ok(Flex {
        points,
        form,
        damping,
        pins: if initial == "free" {
            Vec::new()
        } else {
            vec![pin]
        },
        ..of_section(&section, [count, 1, 1], mass)
    })
}

/// The nodes of a cable: listed, or along a curve.
fn line(reader: &mut Reader, attributes: &Attributes) -> Result<Vec<[f64; 3]>, Refusal> {
    if let Some(text) = attributes.get("vertex") {
        let numbers: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
        let numbers = numbers.map_err(|_| "vertex has what is no number".to_owned())?;
        let (points, rest) = numbers.as_chunks::<3>();
        let are_fine = rest.is_empty() && numbers.iter().all(|x| x.abs() < 1e4);
        return if are_fine && (2..=MAX_LINE).contains(&points.len()) {
            Ok(points.to_vec())
        } else {
            Err("vertex is no list of at least two points".into())
        };
    }
    let [count, 1, 1] = reader.count(attributes, 1.0)? else {
        return Err("a cable has a count along one axis".into());
    };
    if count < 2 {
        return Err("a cable needs a count of at least 2".into());
    }
    let size = attributes.numbers(reader.report, "size", [1.0, 0.0, 0.0]);
    let curve = attributes.get("curve").unwrap_or("s");
    let words: Vec<&str> = curve.split_whitespace().take(3).collect();
    let at = |number: usize| {
        let s = number as f64 / (count - 1) as f64;
        curve_at(&words, size, s)
    };
    (0..count).map(at).collect()
}

/// A place of a curve, from 0 to 1: by axis `s`, `cos(s)`, `sin(s)` or `0`.
fn curve_at(words: &[&str], [scale, radius, turns]: [f64; 3], s: f64) -> Result<[f64; 3], Refusal> {
    let mut point = [0.0; 3];
    let (sine, cosine) = libm::sincos(2.0 * PI * turns * s);
    for (number, word) in point.iter_mut().zip(words) {
        *number = match *word {
            "s" => scale * s,
            "cos(s)" => radius * cosine,
            "sin(s)" => radius * sine,
            "0" => 0.0,
            other => return Err(format!("there is no curve '{}'", short(other))),
        };
    }
    within(
        "size",
        point.iter().fold(0.0, |a: f64, b| a.max(b.abs())),
        0.0..1e4,
    )?;
    Ok(point)
}

/// What a chain of links resists, and the ratio of its damping. `length` is that of a link.
fn rod<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    section: &Section,
    length: f64,
) -> Result<(FlexForm, f64), Refusal> {
    let joint = of_kind(reader, element, "joint", "main");
    let joint = joint.map(|attributes| reader.spring(&attributes));
    let joint = joint.unwrap_or_default();
    let [mut young, mut shear] = [0.0, 0.0];
    let mut straight = false;
    for plugin in element.named("plugin") {
        let name = plugin.attribute("plugin").unwrap_or_default();
        if name != "mujoco.elasticity.cable" {
            let text = format!("plugin '{}' is not known", short(name));
            reader.report.leave_out(plugin, text);
            continue;
        }
        young = within(
            "bend",
            config(reader, plugin, "bend").unwrap_or(0.0),
            0.0..1e16,
        )?;
        shear = within(
            "twist",
            config(reader, plugin, "twist").unwrap_or(0.0),
            0.0..1e16,
        )?;
        straight = is_flat(plugin);
    }
    if section.is_box() && young > 0.0 {
        reader
            .report
            .warn(element, "it bends equally in all directions");
    }
    let [area, moment] = section.area();
    let stretch = area * if young > 0.0 { young } else { YOUNG };
    let limp = (LIMP * YOUNG * moment).max(joint.damping * length / MAX_RATIO);
    let bend = (young * moment + joint.stiffness * length).max(limp);
    let twist = (shear * 2.0 * moment + joint.stiffness * length).max(limp);
    let form = FlexForm::Line {
        stretch,
        bend,
        twist,
        straight,
    };
    Ok((form, (joint.damping * length / bend).min(MAX_RATIO)))
}

/// Whether a cable is straight at rest, whatever form it begins with.
fn is_flat(plugin: &Element) -> bool {
    plugin.named("config").any(|setting| {
        setting.attribute("key") == Some("flat") && setting.attribute("value") == Some("true")
    })
}

/// A grid of bodies, each at a node.
fn grid(reader: &mut Reader, attributes: &Attributes) -> Result<Grid, Refusal> {
    let spacing = reader.number(attributes, "spacing", 0.0);
    Ok(Grid {
        count: reader.count(attributes, 1.0)?,
        spacing: [within("spacing", spacing, 1e-6..1e3)?; 3],
    })
}

/// The old rope: bodies that are linked one to the next, of which the link itself is one.
fn rope<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    attributes: &Attributes,
) -> Result<Flex, Refusal> {
    let section = Section::read(reader, element, "capsule")?;
    let grid = grid(reader, attributes)?;
    let ([count, 1, 1], true) = (grid.count, grid.dimension() == 1) else {
        return Err("a rope has a count along x".into());
    };
    let (form, damping) = rod(reader, element, &section, grid.spacing[0])?;
    let own = reader.own_node(&grid);
    Ok(Flex {
        points: grid_from(&grid, own),
        form,
        damping,
        pins: vec![FlexPin {
            node: grid.number(own),
            clamped: true,
        }],
        ..of_section(&section, grid.count, section.mass_of_node() * count as f64)
    })
}

/// The points of a grid, with one of them at the origin.
fn grid_from(grid: &Grid, own: [usize; 3]) -> Vec<[f64; 3]> {
    let points = grid.points();
    let origin = Vector3::from(points[grid.number(own)]);
    let moved = points.iter().map(|point| Vector3::from(*point) - origin);
    moved.map(Into::into).collect()
}

impl Reader<'_> {
    /// The node of a rope or cloth that the link itself is, by its name (`B3`, `B2_4`), else that in the middle.
    fn own_node(&self, grid: &Grid) -> [usize; 3] {
        let named = || {
            let digits = self.link_name.strip_prefix('B')?;
            let mut node = [0; 3];
            let mut words = digits.split('_');
            for (axis, number) in node.iter_mut().enumerate().take(grid.dimension()) {
                *number = words.next()?.parse().ok()?;
                if *number >= grid.count[axis] {
                    return None;
                }
            }
            words.next().is_none().then_some(node)
        };
        named().unwrap_or_else(|| grid.count.map(|count| (count - 1) / 2))
    }
}

/// Nodes that are held to their neighbours: the old grid, and the old cloth, of which the link itself is a part.
fn net<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    attributes: &Attributes,
) -> Result<Flex, Refusal> {
    let section = Section::read(reader, element, "sphere")?;
    let grid = grid(reader, attributes)?;
    let is_cloth = attributes.get("type") == Some("cloth");
    let node_mass = section.mass_of_node();
    let edges = links(reader, element, node_mass);
    let joint = of_kind(reader, element, "joint", "main");
    let joint = joint
        .map(|attributes| reader.spring(&attributes))
        .unwrap_or_default();
    let spacing = grid.spacing[0];
    let form = match grid.dimension() {
        1 => FlexForm::Line {
            stretch: edges.stiffness * spacing,
            bend: LIMP * YOUNG * section.area()[1],
            twist: LIMP * YOUNG * section.area()[1],
            straight: true,
        },
        2 => FlexForm::Sheet {
            triangles: grid.triangles(),
            stretch: PLANE_OF_EDGES[0] * edges.stiffness,
            bend: if is_cloth { joint.stiffness } else { 0.0 },
            poisson: PLANE_OF_EDGES[1],
        },
        _ => return Err("its count is not along one or two axes".into()),
    };
    let mut flex = Flex {
        points: grid.points(),
        form,
        damping: edges.ratio(),
        drag: if is_cloth {
            0.0
        } else {
            joint.damping / node_mass.max(1e-9)
        },
        ..of_section(
            &section,
            grid.count,
            node_mass * grid.count.iter().product::<usize>() as f64,
        )
    };
    flex.pins = coordinates(reader, element, &grid)?;
    if is_cloth {
        let own = reader.own_node(&grid);
        flex.points = grid_from(&grid, own);
        flex.pins.push(unclamped(grid.number(own)));
    }
    Ok(flex)
}

/// The tendons between neighbours: constraints, and springs beside them.
fn links<'a>(reader: &mut Reader<'a>, element: &'a Element, node_mass: f64) -> Holding {
    let names = ["solreffix", "solimpfix"];
    match of_kind(reader, element, "tendon", "main") {
        Some(tendon) => {
            let spring = reader.spring(&tendon);
            spring.with(reader.constraint(&tendon, names, node_mass))
        }
        None => {
            let own = reader.attributes(element);
            reader.constraint(&own, names, node_mass)
        }
    }
}

fn unclamped(node: usize) -> FlexPin {
    FlexPin {
        node,
        clamped: false,
    }
}

/// `<pin coord="1 2"/>`: a node by its place in the grid.
fn coordinates<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    grid: &Grid,
) -> Result<Vec<FlexPin>, Refusal> {
    let mut pins = Vec::new();
    for child in element.named("pin") {
        let attributes = reader.attributes(child);
        let place = attributes.numbers(reader.report, "coord", [0.0; 3]);
        let is_inside = (0..3).all(|axis| {
            place[axis].fract() == 0.0 && (0.0..grid.count[axis] as f64).contains(&place[axis])
        });
        if !is_inside {
            return Err(format!("it has no node at {place:?} that could be pinned"));
        }
        pins.push(unclamped(grid.number(place.map(|number| number as usize))));
    }
    Ok(pins)
}

/// A soft body around the link, whose nodes are at its surface.
fn solid<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    attributes: &Attributes,
) -> Result<Flex, Refusal> {
    let section = Section::read(reader, element, "capsule")?;
    let grid = grid(reader, attributes)?;
    if grid.count.iter().any(|count| *count < 3) {
        return Err("its count is not at least 3 along each axis".into());
    }
    let places = grid.places();
    let nodes: Vec<usize> = places
        .filter(|place| grid.is_outside(*place))
        .map(|place| grid.number(place))
        .collect();
    let node_mass = section.mass_of_node();
    let joint = of_kind(reader, element, "joint", "main");
    let spring = match joint {
        Some(joint) => {
            let own = reader.spring(&joint);
            own.with(reader.constraint(&joint, ["solreffix", "solimpfix"], node_mass))
        }
        None => reader.constraint(attributes, ["solreffix", "solimpfix"], node_mass),
    };
    let tetrahedra = grid.tetrahedra();
    let shape = attributes.get("type").unwrap_or_default();
    Ok(Flex {
        points: grid
            .points()
            .into_iter()
            .map(|point| rounded(&grid, shape, point))
            .collect(),
        form: FlexForm::Solid {
            triangles: surface(&tetrahedra),
            tetrahedra,
            young: SOLID_OF_EDGES[0] * spring.stiffness / grid.spacing[0],
            poisson: SOLID_OF_EDGES[1],
        },
        damping: spring.ratio(),
        pins: middle(&grid),
        mass: node_mass * nodes.len() as f64,
        nodes,
        ..of_section(&section, grid.count, node_mass)
    })
}

/// The nodes next to the middle, which the link holds.
fn middle(grid: &Grid) -> Vec<FlexPin> {
    let is_middle = |place: &[usize; 3]| {
        (0..3).all(|axis| (2 * place[axis]).abs_diff(grid.count[axis] - 1) <= 1)
    };
    let places = grid.places().filter(is_middle);
    places.map(|place| unclamped(grid.number(place))).collect()
}

/// A point of a box, moved into the cylinder or ellipsoid that fits in it.
fn rounded(grid: &Grid, shape: &str, point: [f64; 3]) -> [f64; 3] {
    let axes = match shape {
        "cylinder" => 2,
        "ellipsoid" => 3,
        _ => return point,
    };
    let half = |axis: usize| 0.5 * grid.spacing[axis] * (grid.count[axis] - 1) as f64;
    let relative = (0..axes).map(|axis| point[axis] / half(axis));
    let (most, square) = relative.fold((0.0_f64, 0.0), |(most, square), x| {
        (most.max(x.abs()), square + x * x)
    });
    let factor = if square > 0.0 {
        most / square.sqrt()
    } else {
        1.0
    };
    let mut rounded = point;
    rounded[..axes].iter_mut().for_each(|x| *x *= factor);
    rounded
}
