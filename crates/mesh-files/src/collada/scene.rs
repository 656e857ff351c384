//! The visual scene: nodes with their transforms, and what they contain.

use bounded_xml::Node;

use super::{Elements, Reader};
use crate::error::Result;
use crate::mesh_file::Material;
use crate::transform::Transform;

/// Nodes within nodes; deeper ones are refused, and with them nodes that contain themselves.
const MAX_DEPTH: usize = 100;

/// Nodes in all: instances of instances multiply.
const MAX_NODES: usize = 1_000_000;

/// Where the walk through the scene is.
struct Walk {
    depth: usize,
    nodes: usize,
}

impl<'a> Reader<'a, '_> {
    /// The scene that is instantiated, else the first; without any, all geometries as they are.
    pub(super) fn scene(&mut self, root: Node<'a, 'a>) -> Result<()> {
        let instance = root
            .first("scene")
            .and_then(|scene| scene.first("instance_visual_scene"));
        let named = instance.and_then(|instance| self.target(instance.attribute("url")?));
        let first = root
            .first("library_visual_scenes")
            .and_then(|library| library.first("visual_scene"));
        let Some(scene) = named.or(first) else {
            return self.all_geometries(root);
        };
        let mut walk = Walk { depth: 0, nodes: 0 };
        for node in scene.all("node") {
            self.node(node, &Transform::IDENTITY, &mut walk)?;
        }
        Ok(())
    }

    fn all_geometries(&mut self, root: Node<'a, 'a>) -> Result<()> {
        for geometry in root
            .all("library_geometries")
            .flat_map(|library| library.all("geometry").collect::<Vec<_>>())
        {
            self.place(geometry, None, &Transform::IDENTITY, geometry)?;
        }
        Ok(())
    }

    fn node(&mut self, node: Node<'a, 'a>, parent: &Transform, walk: &mut Walk) -> Result<()> {
        walk.depth += 1;
        walk.nodes += 1;
        if walk.depth > MAX_DEPTH {
            return Err(self.refused(
                node,
                format!(
                    "more than {MAX_DEPTH} nodes inside each other, or a node that contains itself"
                ),
            ));
        }
        if walk.nodes > MAX_NODES {
            return Err(self.refused(node, format!("more than {MAX_NODES} nodes")));
        }
        let transform = parent.after(&self.transform(node)?);
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "node" => self.node(child, &transform, walk)?,
                "instance_node" => {
                    let target = self.referred(child, "url")?;
                    self.node(target, &transform, walk)?;
                }
                "instance_geometry" => {
                    let geometry = self.referred(child, "url")?;
                    self.place(geometry, Some(child), &transform, node)?;
                }
                "instance_controller" => self.controller(child, &transform, node)?,
                _ => {}
            }
        }
        walk.depth -= 1;
        Ok(())
    }

    /// A skin in its bind pose; of a morph, the mesh it begins with.
    fn controller(
        &mut self,
        instance: Node<'a, 'a>,
        transform: &Transform,
        node: Node<'a, 'a>,
    ) -> Result<()> {
        let controller = self.referred(instance, "url")?;
        let Some(skin) = controller.first("skin").or(controller.first("morph")) else {
            return Err(self.refused(controller, "neither skin nor morph"));
        };
        let bind = match skin.first("bind_shape_matrix") {
            Some(matrix) => self.matrix(matrix)?,
            None => Transform::IDENTITY,
        };
        let geometry = self.referred(skin, "source")?;
        self.place(geometry, Some(instance), &transform.after(&bind), node)
    }

    /// Adds the parts of a geometry.
    fn place(
        &mut self,
        geometry: Node<'a, 'a>,
        instance: Option<Node<'a, 'a>>,
        transform: &Transform,
        node: Node<'a, 'a>,
    ) -> Result<()> {
        let name = node
            .attribute("name")
            .or(node.attribute("id"))
            .unwrap_or("");
        for primitive in self.geometry(geometry)?.iter() {
            self.limits.take(
                primitive.part.vertices.len(),
                primitive.part.triangles.len(),
            )?;
            let mut part = primitive.part.clone();
            part.transform(transform);
            part.material = self.bound(instance, &primitive.symbol)?;
            if !name.is_empty() {
                part.name = name.into();
            }
            self.file.parts.push(part);
        }
        Ok(())
    }

    /// The material that an instance binds to a symbol; without a binding, one whose id is the symbol.
    fn bound(&mut self, instance: Option<Node<'a, 'a>>, symbol: &str) -> Result<Material> {
        let bindings = instance
            .and_then(|instance| instance.first("bind_material")?.first("technique_common"));
        let binding = bindings.and_then(|bindings| {
            let mut all = bindings.all("instance_material");
            all.find(|binding| binding.attribute("symbol") == Some(symbol))
        });
        let named = binding.and_then(|binding| self.target(binding.attribute("target")?));
        match named
            .or_else(|| self.ids.get(symbol).copied())
            .filter(|node| node.has_tag_name_of("material"))
        {
            Some(material) => self.material(material),
            None => Ok(Material {
                name: symbol.into(),
                ..Material::default()
            }),
        }
    }

    /// All transforms of a node, the first outermost.
    fn transform(&self, node: Node<'a, 'a>) -> Result<Transform> {
        let mut transform = Transform::IDENTITY;
        for child in node.children().filter(Node::is_element) {
            let step = match child.tag_name().name() {
                "matrix" => self.matrix(child)?,
                "translate" => Transform::translation(self.numbers(child)?),
                "scale" => Transform::scaling(self.numbers(child)?),
                "rotate" => {
                    let [x, y, z, degrees] = self.numbers(child)?;
                    let (cos, sin) = cos_sin(degrees);
                    Transform::about([x, y, z], cos, sin)
                }
                "lookat" => look_at(self.numbers(child)?),
                "skew" => return Err(self.refused(child, "this transform is not supported")),
                _ => continue,
            };
            transform = transform.after(&step);
        }
        Ok(transform)
    }

    fn matrix(&self, node: Node) -> Result<Transform> {
        let m: [f64; 16] = self.numbers(node)?;
        Ok(Transform(
            [0, 4, 8].map(|row| [m[row], m[row + 1], m[row + 2], m[row + 3]]),
        ))
    }
}

/// Exact for right angles, which are by far the most frequent.
fn cos_sin(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (1.0, 0.0),
        90.0 => (0.0, 1.0),
        180.0 => (-1.0, 0.0),
        270.0 => (0.0, -1.0),
        other => {
            let radians = other.to_radians();
            (libm::cos(radians), libm::sin(radians))
        }
    }
}

/// Eye, point looked at, and direction up: z looks backwards.
fn look_at([ex, ey, ez, px, py, pz, ux, uy, uz]: [f64; 9]) -> Transform {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let z = crate::transform::unit([ex - px, ey - py, ez - pz]);
    let x = crate::transform::unit(cross([ux, uy, uz], z));
    let y = cross(z, x);
    Transform([
        [x[0], y[0], z[0], ex],
        [x[1], y[1], z[1], ey],
        [x[2], y[2], z[2], ez],
    ])
}
