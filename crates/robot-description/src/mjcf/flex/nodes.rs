//! Where the nodes of a `<flexcomp>` are, and what is between them, by its type.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};

use super::grid::{Grid, surface};
use super::{MAX_NODES, Reader, Refusal, within};
use crate::mjcf::Triangles;
use crate::mjcf::attributes::Attributes;
use crate::xml::short;

/// Longest coordinate of a node, metres.
const MAX_COORDINATE: f64 = 1e4;

/// The nodes, in MuJoCo's order.
pub struct Nodes {
    /// In the frame of the flexcomp, metres.
    pub points: Vec<[f64; 3]>,
    /// How many there are along each axis; of others than grids all along the first.
    pub count: [usize; 3],
    pub elements: Elements,
    /// Mean distance of neighbours, metres.
    pub spacing: f64,
    /// Where nodes have places in a grid.
    pub grid: Option<Grid>,
}

/// What is between nodes.
pub enum Elements {
    /// One is linked with the next.
    Line,
    Triangles(Vec<[u32; 3]>),
    Tetrahedra(Vec<[u32; 4]>),
}

pub fn read(reader: &mut Reader, attributes: &Attributes) -> Result<Nodes, Refusal> {
    let nodes = match attributes.get("type").unwrap_or("grid") {
        "grid" => of_grid(grid(reader, attributes)?),
        "square" => flat(grid(reader, attributes)?)?,
        "disc" => disc(flat(grid(reader, attributes)?)?),
        kind @ ("box" | "cylinder" | "ellipsoid") => shell(&grid(reader, attributes)?, kind)?,
        "mesh" => mesh(reader, attributes)?,
        "direct" => direct(reader, attributes)?,
        "circle" => {
            return Err(
                "a circle is a line of nodes without ends, which ropes have: it is not read".into(),
            );
        }
        other => return Err(format!("flexcomps of type '{}' are not read", short(other))),
    };
    if let Some(dof @ ("trilinear" | "quadratic" | "radial")) = attributes.get("dof") {
        let text = format!("dof '{dof}': each node moves by itself");
        reader.report.warn(attributes.element, text);
    }
    Ok(nodes)
}

fn grid(reader: &mut Reader, attributes: &Attributes) -> Result<Grid, Refusal> {
    let grid = Grid {
        count: reader.count(attributes, 10.0)?,
        spacing: attributes.numbers(reader.report, "spacing", [0.02; 3]),
    };
    for axis in grid.axes() {
        within("spacing", grid.spacing[axis], 1e-6..1e3)?;
    }
    let dimension = grid.dimension();
    let said = reader.number(attributes, "dim", dimension as f64);
    if dimension == 0 || said != dimension as f64 {
        let count = grid.count;
        return Err(format!(
            "its count, {count:?}, does not have dimension {said}"
        ));
    }
    Ok(grid)
}

fn of_grid(grid: Grid) -> Nodes {
    let elements = match grid.dimension() {
        1 => Elements::Line,
        2 => Elements::Triangles(grid.triangles()),
        _ => Elements::Tetrahedra(grid.tetrahedra()),
    };
    Nodes {
        points: grid.points(),
        count: grid.count,
        elements,
        spacing: grid.mean_spacing(),
        grid: Some(grid),
    }
}

/// A grid of two dimensions.
fn flat(grid: Grid) -> Result<Nodes, Refusal> {
    match grid.dimension() {
        2 => Ok(of_grid(grid)),
        _ => Err("its count is not along two axes".into()),
    }
}

/// A square whose nodes are moved inwards, until rings of them are circles. As in MuJoCo, coordinates are then multiplied with half of the size (in metres) along each axis.
fn disc(mut nodes: Nodes) -> Nodes {
    let mut half = [0.0_f64; 3];
    for point in &nodes.points {
        half = [0, 1, 2].map(|axis| half[axis].max(point[axis]));
    }
    for point in &mut nodes.points {
        let factor = inwards(*point, 3);
        *point = [0, 1, 2].map(|axis| point[axis] * factor * half[axis]);
    }
    let largest = half.iter().fold(0.0_f64, |a, b| a.max(*b));
    nodes.spacing *= largest;
    nodes
}

/// By what a point of a cube comes onto the sphere within it, or of a square onto the circle: by the first axes.
fn inwards(point: [f64; 3], axes: usize) -> f64 {
    let of_axes = point.iter().take(axes);
    let (most, square) = of_axes.fold((0.0_f64, 0.0), |(most, square), x| {
        (most.max(x.abs()), square + x * x)
    });
    if square > 0.0 {
        most / square.sqrt()
    } else {
        1.0
    }
}

/// Nodes at the surface of a block, each linked with one in the middle, which is the first.
fn shell(grid: &Grid, kind: &str) -> Result<Nodes, Refusal> {
    if grid.dimension() < 3 {
        return Err("its count is not along three axes".into());
    }
    let places = shell_places(grid);
    let half = |axis: usize| 0.5 * grid.spacing[axis] * (grid.count[axis] - 1) as f64;
    let rounded = match kind {
        "cylinder" => 2,
        "ellipsoid" => 3,
        _ => 0,
    };
    let at = |place: &[usize; 3]| {
        let unit =
            [0, 1, 2].map(|axis| 2.0 * place[axis] as f64 / (grid.count[axis] - 1) as f64 - 1.0);
        let factor = inwards(unit, rounded);
        [0, 1, 2].map(|axis| {
            let factor = if axis < rounded { factor } else { 1.0 };
            unit[axis] * factor * half(axis)
        })
    };
    let mut points = vec![[0.0; 3]];
    points.extend(places.iter().map(at));
    let number: BTreeMap<usize, u32> = (1..)
        .zip(&places)
        .map(|(number, place)| (grid.number(*place), number))
        .collect();
    let named = |node: u32| number.get(&(node as usize)).copied().unwrap_or(0);
    let around = surface(&grid.tetrahedra());
    let tetrahedra = around
        .into_iter()
        .map(|[a, b, c]| [0, named(a), named(b), named(c)]);
    Ok(Nodes {
        count: [points.len(), 1, 1],
        points,
        elements: Elements::Tetrahedra(tetrahedra.collect()),
        spacing: grid.mean_spacing(),
        grid: None,
    })
}

/// The places at the surface of a grid: the faces across z, what is left of those across y, and of those across x.
fn shell_places(grid: &Grid) -> Vec<[usize; 3]> {
    let last = grid.count.map(|count| count - 1);
    let inner = |axis: usize| 1..last[axis];
    let mut places = Vec::new();
    for z in [0, last[2]] {
        for x in 0..=last[0] {
            places.extend((0..=last[1]).map(|y| [x, y, z]));
        }
    }
    for y in [0, last[1]] {
        for x in 0..=last[0] {
            places.extend(inner(2).map(|z| [x, y, z]));
        }
    }
    for x in [0, last[0]] {
        for y in inner(1) {
            places.extend(inner(2).map(|z| [x, y, z]));
        }
    }
    places
}

/// The vertices of a mesh: a sheet, or with `dim="3"` a solid whose triangles are linked with a node at `origin`, the first one.
fn mesh(reader: &mut Reader, attributes: &Attributes) -> Result<Nodes, Refusal> {
    let file = attributes.get("file").ok_or("it names no file")?;
    let file = reader.document.settings.mesh_file(file);
    let found = reader.files.triangles(&file)?;
    let scale = attributes.numbers(reader.report, "scale", [1.0; 3]);
    let (mut points, mut triangles) = welded(&found, scale);
    let flips = scale.iter().product::<f64>() < 0.0;
    if flips {
        triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    match reader.number(attributes, "dim", 2.0) {
        2.0 => of_points(points, Elements::Triangles(triangles)),
        3.0 => {
            attributes
                .get("origin")
                .ok_or("a mesh of dimension 3 needs an origin")?;
            points.insert(0, attributes.numbers(reader.report, "origin", [0.0; 3]));
            let linked = triangles.iter().map(|[a, b, c]| [0, a + 1, b + 1, c + 1]);
            of_points(points, Elements::Tetrahedra(linked.collect()))
        }
        other => Err(format!("a mesh does not have dimension {other}")),
    }
}

/// The vertices that triangles have, those at one place as one, and the triangles between them.
fn welded(mesh: &Triangles, scale: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let used: Vec<[u32; 3]> = (mesh.corners.iter().copied())
        .filter(|corners| {
            corners
                .iter()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        })
        .collect();
    let mut is_used = vec![false; mesh.vertices.len()];
    for corner in used.as_flattened() {
        is_used[*corner as usize] = true;
    }
    let (mut points, mut known) = (Vec::new(), BTreeMap::new());
    let mut numbers = vec![0_u32; mesh.vertices.len()];
    for (vertex, point) in mesh
        .vertices
        .iter()
        .enumerate()
        .filter(|(at, _)| is_used[*at])
    {
        let point = [0, 1, 2].map(|axis| point[axis] * scale[axis]);
        // 0 and -0 are one place.
        let place = point.map(|x| (x + 0.0).to_bits());
        numbers[vertex] = *known.entry(place).or_insert_with(|| {
            points.push(point);
            points.len() as u32 - 1
        });
    }
    let triangles = used
        .iter()
        .map(|corners| corners.map(|corner| numbers[corner as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a);
    (points, triangles.collect())
}

/// Nodes and elements that are listed.
fn direct(reader: &mut Reader, attributes: &Attributes) -> Result<Nodes, Refusal> {
    let numbers: Vec<f64> = listed(attributes, "point")?;
    let (points, rest) = numbers.as_chunks::<3>();
    if !rest.is_empty() {
        return Err("point is no list of places".into());
    }
    let indices: Vec<u32> = listed(attributes, "element")?;
    if indices.iter().any(|index| *index as usize >= points.len()) {
        return Err("element has an index of no point".into());
    }
    let elements = match reader.number(attributes, "dim", 2.0) {
        1.0 => line(&indices, points.len())?,
        2.0 => Elements::Triangles(in_groups(&indices)?),
        3.0 => Elements::Tetrahedra(positive(in_groups(&indices)?, points)),
        other => return Err(format!("there is no dimension {other}")),
    };
    of_points(points.to_vec(), elements)
}

fn listed<T: std::str::FromStr>(attributes: &Attributes, name: &str) -> Result<Vec<T>, Refusal> {
    let text = attributes
        .get(name)
        .ok_or_else(|| format!("it has no {name}"))?;
    let read = |word: &str| {
        let number = word.parse().ok();
        number.ok_or_else(|| format!("{name} has '{}', which is no number", short(word)))
    };
    text.split_whitespace().map(read).collect()
}

fn in_groups<const N: usize>(indices: &[u32]) -> Result<Vec<[u32; N]>, Refusal> {
    match indices.as_chunks::<N>() {
        (groups, []) if !groups.is_empty() => Ok(groups.to_vec()),
        _ => Err(format!("element is no list of {N} indices each")),
    }
}

/// Tetrahedra in positive order.
fn positive(mut tetrahedra: Vec<[u32; 4]>, points: &[[f64; 3]]) -> Vec<[u32; 4]> {
    for corners in &mut tetrahedra {
        let [a, b, c, d] = corners.map(|corner| Vector3::from(points[corner as usize]));
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            corners.swap(2, 3);
        }
    }
    tetrahedra
}

/// Elements that link each node with the next.
fn line(indices: &[u32], count: usize) -> Result<Elements, Refusal> {
    let pairs: Vec<[u32; 2]> = in_groups(indices)?;
    let follows = |(number, pair): (usize, &[u32; 2])| *pair == [number as u32, number as u32 + 1];
    let is_line = pairs.len() + 1 == count && pairs.iter().enumerate().all(follows);
    if is_line {
        Ok(Elements::Line)
    } else {
        Err("its elements do not link each node with the next: only a rope is read".into())
    }
}

fn of_points(points: Vec<[f64; 3]>, elements: Elements) -> Result<Nodes, Refusal> {
    if points.len() > MAX_NODES {
        let count = points.len();
        return Err(format!("it has {count} nodes, more than {MAX_NODES}"));
    }
    let is_near = |x: &f64| x.abs() < MAX_COORDINATE;
    if !points.as_flattened().iter().all(is_near) {
        return Err("a node of it is nowhere".into());
    }
    let spacing = mean_edge(&points, &elements);
    if spacing <= 0.0 {
        return Err("there is nothing between its nodes".into());
    }
    Ok(Nodes {
        count: [points.len(), 1, 1],
        points,
        elements,
        spacing,
        grid: None,
    })
}

/// The mean length of what is between nodes; 0 of nothing.
fn mean_edge(points: &[[f64; 3]], elements: &Elements) -> f64 {
    let at = |node: u32| Point3::from(points[node as usize]);
    let length = |a: u32, b: u32| (at(a) - at(b)).norm();
    let lengths: Vec<f64> = match elements {
        Elements::Line => (1..points.len() as u32)
            .map(|node| length(node - 1, node))
            .collect(),
        Elements::Triangles(triangles) => triangles
            .iter()
            .flat_map(|[a, b, c]| [length(*a, *b), length(*b, *c), length(*c, *a)])
            .collect(),
        Elements::Tetrahedra(tetrahedra) => tetrahedra
            .iter()
            .flat_map(|[a, b, c, d]| {
                [
                    length(*a, *b),
                    length(*b, *c),
                    length(*c, *d),
                    length(*d, *a),
                ]
            })
            .collect(),
    };
    lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
}

#[cfg(test)]
mod tests;
