//! Shapes of the simple variant: a primitive, a terrain, a mesh, or a compound of such, with mass and inertia as people know them.

use geometry::Mesh;
use geometry::mass::{MassProperties, solid};
use geometry::pose::euler::{rotation_from_euler, rotation_to_euler};
use geometry::primitive::{PrimitiveKind, heightfield, tessellate};
use nalgebra::{Matrix3, Vector3};

use super::arrays::{self, Arrays, joined, list};
use super::document::Element;
use super::read::{Reading, numbers, put, word};
use super::table::{Step, Unit, word_of};
use super::write::{Item, Writing, number};
use crate::ttt::{FileResult, Node, PositionFirst, unit_quaternion};
use scene::Pose;

/// Default density, kg/m3.
const DENSITY: f64 = 1000.0;
/// The elements that are a geometry.
const GEOMETRIES: [&str; 4] = ["primitive", "heightfield", "mesh", "compound"];
/// Deeper compounds are as wrong here as in binary files.
const MAX_GROUPS: usize = 90;

type Words<T> = Result<T, String>;

impl Reading<'_> {
    /// The geometry of a shape, and all its triangles in the frame of the shape, which mass and inertia are found by.
    pub(super) fn geometry(&mut self, shape: Element<'_>) -> FileResult<Node> {
        let mut found = shape
            .children()
            .filter(|child| GEOMETRIES.contains(&child.name()));
        let (Some(one), None) = (found.next(), found.next()) else {
            return Err(shape.error("a shape needs one primitive, heightfield, mesh or compound"));
        };
        let mut all = Mesh::default();
        let mut tree = self.part(one, &Pose::identity(), &mut all, 0)?;
        let name = if one.name() == "compound" {
            "group"
        } else {
            "mesh"
        };
        let root = if name == "group" {
            tree.get_mut("group")
        } else {
            tree.get_mut("node")
        };
        if let Some(root) = root {
            mass(root, shape, &all).map_err(|what| shape.error(what))?;
            if name == "mesh" {
                // The only node of a shape is its frame: where its vertices are is said by the box.
                put(root, &[Step::Name("frame")], pose_node(&Pose::identity()));
            }
        }
        let inner = if name == "group" {
            tree.get("group").cloned().unwrap_or(tree)
        } else {
            tree
        };
        Ok(Node::table([(name, inner)]))
    }

    /// A child of a compound whose frame in the shape is `frame`.
    fn part(
        &mut self,
        element: Element<'_>,
        frame: &Pose,
        all: &mut Mesh,
        depth: usize,
    ) -> FileResult<Node> {
        element.mark();
        let own = pose(element).map_err(|what| element.error(what))?;
        let in_shape = frame * own;
        if element.name() == "compound" {
            return self.compound(element, &own, &in_shape, all, depth);
        }
        let mut data = self.section("MeshData", element)?;
        let mesh = triangles(element, &mut data).map_err(|what| element.error(what))?;
        let mesh = Mesh {
            normals: Vec::new(),
            ..mesh
        };
        all.append(&mesh, &in_shape);
        let arrays = Arrays {
            vertices: mesh
                .vertices
                .as_flattened()
                .iter()
                .map(|c| numbers::single(*c))
                .collect(),
            indices: mesh
                .triangles
                .as_flattened()
                .iter()
                .map(|i| (*i).cast_signed())
                .collect(),
            ..Arrays::default()
        };
        let place = self.add(arrays).map_err(|what| element.error(what))?;
        arrays::refer(&mut data, place);
        // In a compound the node is where the vertices are; alone it is the box.
        let mut node = Node::table([]);
        let alone = depth == 0;
        put(
            &mut node,
            &[Step::Name("frame")],
            pose_node(&if alone { Pose::identity() } else { own }),
        );
        put(
            &mut node,
            &[Step::Name("box_frame")],
            pose_node(&if alone { own } else { Pose::identity() }),
        );
        if let (true, Some((low, high))) = (data.get("primitive").is_some(), mesh.aabb()) {
            let size = (0..3).map(|axis| Node::Real(high[axis] - low[axis]));
            put(
                &mut node,
                &[Step::Name("box_size")],
                Node::List(size.collect()),
            );
        }
        Ok(Node::table([("node", node), ("mesh", data)]))
    }

    fn compound(
        &mut self,
        element: Element<'_>,
        own: &Pose,
        in_shape: &Pose,
        all: &mut Mesh,
        depth: usize,
    ) -> FileResult<Node> {
        if depth >= MAX_GROUPS {
            return Err(element.error("compounds are nested too deeply"));
        }
        let parts = element
            .children()
            .filter(|child| GEOMETRIES.contains(&child.name()));
        let parts = parts
            .map(|child| self.part(child, in_shape, all, depth + 1))
            .collect::<FileResult<Vec<_>>>()?;
        if parts.len() < 2 {
            return Err(element.error("a compound has two parts or more"));
        }
        let group = Node::table([("frame", pose_node(own)), ("children", Node::List(parts))]);
        Ok(Node::table([("group", group)]))
    }
}

/// The triangles of a part in its own frame; its type is stored in `data`.
fn triangles(element: Element<'_>, data: &mut Node) -> Words<Mesh> {
    match element.name() {
        "primitive" => {
            let code = word("primitive", &text(element, "type")?)?;
            let size = numbers(&text(element, "size")?)?;
            let kind =
                PrimitiveKind::from_code(code).filter(|kind| *kind != PrimitiveKind::Heightfield);
            let kind = kind.ok_or("the type of a primitive is unknown")?;
            if !size.iter().all(|side: &f64| (0.0..1e9).contains(side)) {
                return Err("the size of a primitive is out of range".into());
            }
            let size = geometry::primitive::clamp_size(kind, size);
            set_primitive(data, code, size);
            tessellate(kind, size, false).ok_or_else(|| "this primitive has no size".into())
        }
        "heightfield" => terrain(element, data),
        _ => mesh(element),
    }
}

fn set_primitive(data: &mut Node, code: i64, size: [f64; 3]) {
    let primitive = Node::List(vec![
        Node::Int(code),
        Node::List(size.map(Node::Real).to_vec()),
    ]);
    put(data, &[Step::Name("primitive")], primitive);
}

fn terrain(element: Element<'_>, data: &mut Node) -> Words<Mesh> {
    let counts: [f64; 2] = numbers(&text(element, "size")?)?;
    let [columns, rows] = counts.map(numbers::index);
    let heights: Vec<f64> = list(element, "data")?;
    if columns < 2 || rows < 2 || columns.checked_mul(rows) != Some(heights.len()) {
        return Err(
            "a heightfield needs two columns and rows or more, and a height for each point".into(),
        );
    }
    // The step is divided by the number of steps when it is read: it is the whole width.
    let [width] = numbers(&text(element, "gridStep")?)?;
    if !(heights.iter().all(|height| height.is_finite()) && width > 0.0 && width < 1e9) {
        return Err("a heightfield has numbers out of range".into());
    }
    let mesh =
        heightfield(columns, rows, width, &heights).ok_or("a heightfield is too large or empty")?;
    let (low, high) = mesh.aabb().unwrap_or_default();
    set_primitive(
        data,
        PrimitiveKind::Heightfield.code(),
        std::array::from_fn(|axis| high[axis] - low[axis]),
    );
    let field = Node::table([
        ("columns", Node::Int(numbers::count(columns))),
        ("rows", Node::Int(numbers::count(rows))),
        (
            "heights",
            Node::List(heights.into_iter().map(Node::Real).collect()),
        ),
    ]);
    put(data, &[Step::Name("heightfield")], field);
    Ok(mesh)
}

/// Vertices and triangles; negative numbers of corners count from the end.
fn mesh(element: Element<'_>) -> Words<Mesh> {
    if let Some(file) = element.find(&["fileName"]) {
        let name = file.text();
        return Err(format!(
            "meshes in files ('{}') are not implemented in Swanilda",
            name.trim()
        ));
    }
    let vertices: Vec<f64> = list(element, "vertices")?;
    let count = numbers::count(vertices.len() / 3);
    let indices: Vec<i64> = list(element, "indices")?;
    let indices: Vec<i64> = indices
        .into_iter()
        .map(|at| if at < 0 { at + count } else { at })
        .collect();
    Mesh::from_flat(&vertices, &indices, None).map_err(|error| error.to_string())
}

fn text(element: Element<'_>, name: &str) -> Words<String> {
    let found = element
        .find(&[name])
        .ok_or_else(|| format!("`{name}` is missing"))?;
    Ok(found.mark().text())
}

/// The frame of an element: its position, and its rotation in degrees or as a quaternion.
fn pose(element: Element<'_>) -> Words<Pose> {
    frame(element, "localFrame")
}

fn frame(element: Element<'_>, name: &str) -> Words<Pose> {
    let Some(frame) = element.find(&[name]) else {
        return Ok(Pose::identity());
    };
    frame.mark();
    let part = |name: &str| frame.find(&[name]).map(|found| found.mark().text());
    let position: [f64; 3] = part("position").map_or(Ok([0.0; 3]), |text| numbers(&text))?;
    let rotation = match (part("euler"), part("quaternion")) {
        (Some(angles), _) => rotation_from_euler(&numbers::<3>(&angles)?.map(f64::to_radians)),
        (None, Some(rotation)) => unit_quaternion(numbers(&rotation)?),
        (None, None) => Default::default(),
    };
    if !position
        .iter()
        .chain(rotation.coords.iter())
        .all(|number| number.is_finite())
    {
        return Err("a frame has numbers that are not finite".into());
    }
    Ok(Pose::from_parts(position.into(), rotation))
}

/// Mass, centre and inertia per kilogram of the shape, as specified or those of a solid body.
fn mass(root: &mut Node, shape: Element<'_>, all: &Mesh) -> Words<()> {
    let mut properties = solid(all, DENSITY).unwrap_or_default();
    if let Some(dynamics) = shape.find(&["dynamics"]) {
        read_mass(&mut properties, dynamics.mark())?;
    }
    let inertia = (0..9).map(|at| Node::Real(properties.inertia[(at / 3, at % 3)]));
    put(root, &[Step::Name("mass")], Node::Real(properties.mass));
    put(
        root,
        &[Step::Name("centre_of_mass")],
        Node::List(properties.com.map(Node::Real).to_vec()),
    );
    put(
        root,
        &[Step::Name("inertia")],
        Node::List(inertia.collect()),
    );
    Ok(())
}

fn read_mass(properties: &mut MassProperties, dynamics: Element<'_>) -> Words<()> {
    let part = |name: &str| dynamics.find(&[name]).map(|found| found.mark().text());
    if let Some(text) = part("mass") {
        let [mass] = numbers(&text)?;
        if !(mass > 0.0 && mass < 1e12) {
            return Err("a mass is out of range".into());
        }
        properties.set_mass(mass);
    }
    if let Some(text) = part("centerOfMass") {
        properties.com = numbers(&text)?;
    }
    if let Some(text) = part("inertiaMatrix") {
        properties.inertia = Matrix3::from_row_slice(&numbers::<9>(&text)?) / properties.mass;
    } else if let Some(text) = part("principalMomentOfInertia") {
        // Before 4.5: per kilogram, along the axes of a frame at the centre.
        let axes = frame(dynamics, "localInertiaFrame")?;
        let turn = axes.rotation.to_rotation_matrix().into_inner();
        let moments = Matrix3::from_diagonal(&Vector3::from(numbers::<3>(&text)?));
        (properties.com, properties.inertia) = (
            axes.translation.vector.into(),
            turn * moments * turn.transpose(),
        );
    }
    Ok(())
}

fn pose_node(pose: &Pose) -> Node {
    Node::List(PositionFirst::from(*pose).0.map(Node::Real).to_vec())
}

fn pose_of(node: Option<&Node>) -> Pose {
    let Some(items) = node.and_then(|node| node.items::<7>().ok()) else {
        return Pose::identity();
    };
    PositionFirst(items.each_ref().map(|item| item.real().unwrap_or(f64::NAN)))
        .pose()
        .unwrap_or_default()
}

impl Writing<'_> {
    /// Writes the geometry of a shape, then its mass.
    pub(super) fn geometry(&self, geometry: &Node, out: &mut Item) {
        let root = match (geometry.get("mesh"), geometry.get("group")) {
            (Some(mesh), _) => {
                self.mesh(
                    mesh,
                    &pose_of(mesh.get("node").and_then(|node| node.get("box_frame"))),
                    out,
                );
                mesh.get("node")
            }
            (None, Some(group)) => {
                self.group(group, out);
                Some(group)
            }
            (None, None) => None,
        };
        if let Some(root) = root {
            write_mass(root, out.at(&["dynamics"]));
        }
    }

    fn group(&self, group: &Node, out: &mut Item) {
        let item = out.push("compound");
        write_pose(&pose_of(group.get("frame")), item);
        for child in group
            .get("children")
            .and_then(|children| children.list().ok())
            .unwrap_or_default()
        {
            match (child.get("group"), child.get("node")) {
                (Some(group), _) => self.group(group, item),
                (None, Some(node)) => {
                    let frame = pose_of(node.get("frame")) * pose_of(node.get("box_frame"));
                    self.mesh(child, &frame, item);
                }
                (None, None) => {}
            }
        }
    }

    fn mesh(&self, mesh: &Node, frame: &Pose, out: &mut Item) {
        let Some(data) = mesh.get("mesh") else { return };
        let primitive = data
            .get("primitive")
            .and_then(|primitive| primitive.list().ok())
            .unwrap_or_default();
        let code = primitive
            .first()
            .and_then(|code| code.int().ok())
            .unwrap_or(0);
        let terrain = PrimitiveKind::Heightfield.code();
        let item = out.push(match code {
            0 => "mesh",
            code if code == terrain => "heightfield",
            _ => "primitive",
        });
        write_pose(frame, item);
        match data.get("heightfield").filter(|_| code == terrain) {
            Some(field) => self.terrain(field, primitive.get(1), item),
            None if code == 0 => arrays::write_triangles(self.pool, data, item),
            None => {
                item.leaf("type", word_of("primitive", code).unwrap_or_default());
                let size = primitive
                    .get(1)
                    .and_then(|size| self.numbers(Unit::Real, size, data));
                item.leaf("size", size.unwrap_or_default());
            }
        }
        self.section("MeshData", data, item);
    }

    fn terrain(&self, field: &Node, size: Option<&Node>, item: &mut Item) {
        let count = |name: &str| {
            field
                .get(name)
                .and_then(|count| count.int().ok())
                .unwrap_or(0)
        };
        let heights = field
            .get("heights")
            .and_then(|heights| heights.list().ok())
            .unwrap_or_default();
        let width = size
            .and_then(|size| size.list().ok()?.first()?.real().ok())
            .unwrap_or(0.0);
        item.leaf("size", joined(&[count("columns"), count("rows")]));
        item.leaf(
            "data",
            joined(
                &heights
                    .iter()
                    .map(|height| height.real().unwrap_or(0.0))
                    .collect::<Vec<f64>>(),
            ),
        );
        item.leaf("gridStep", number(width));
    }
}

fn write_pose(pose: &Pose, out: &mut Item) {
    let [x, y, z]: [f64; 3] = pose.translation.vector.into();
    let frame = out.push("localFrame");
    frame.leaf("position", [x, y, z].map(number).join(" "));
    frame.leaf(
        "euler",
        rotation_to_euler(&pose.rotation)
            .map(|angle| number(angle.to_degrees()))
            .join(" "),
    );
}

fn write_mass(root: &Node, out: &mut Item) {
    let Some(mass) = root.get("mass").and_then(|mass| mass.real().ok()) else {
        return;
    };
    out.leaf("mass", number(mass));
    let reals = |name: &str, factor: f64| {
        let items = root.get(name)?.list().ok()?.iter();
        Some(
            items
                .map(|item| number(item.real().unwrap_or(0.0) * factor))
                .collect::<Vec<String>>()
                .join(" "),
        )
    };
    if let (Some(inertia), Some(com)) = (reals("inertia", mass), reals("centre_of_mass", 1.0)) {
        out.leaf("inertiaMatrix", inertia);
        out.leaf("centerOfMass", com);
    }
}
