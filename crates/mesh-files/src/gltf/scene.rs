//! The scene: nodes with their transforms.

use serde_json::Value;

use super::{Reader, integer, item, list, numbers, refused, string};
use crate::error::Result;
use crate::mesh_file::Part;
use crate::transform::Transform;

/// Nodes within nodes; deeper ones are refused, and with them nodes that contain themselves.
const MAX_DEPTH: usize = 200;

/// A node of the scene and where it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    /// Its number in the file.
    pub(super) node: usize,
    /// The number of its parent among the placed ones, which is smaller than its own.
    pub(super) parent: Option<usize>,
    /// Its frame in that of the scene, with all scales.
    pub(super) transform: Transform,
}

impl Reader<'_, '_> {
    /// The nodes of the scene of the file, else of the first; without any, every node that is nobody's child, and what is below.
    pub(super) fn scene(&self) -> Result<Vec<Placed>> {
        let scene = integer(self.root, "scene", "scene")?.unwrap_or(0);
        let roots: Vec<usize> = match list(self.root, "scenes").get(scene) {
            Some(scene) => children(scene, "nodes", "scene")?,
            None => self.parentless()?,
        };
        // A node has one parent, so a file has no more visits than nodes.
        let mut is_visited = vec![false; list(self.root, "nodes").len()];
        let mut placed = Vec::new();
        for root in roots {
            self.node(root, None, 0, &mut is_visited, &mut placed)?;
        }
        Ok(placed)
    }

    fn parentless(&self) -> Result<Vec<usize>> {
        let nodes = list(self.root, "nodes");
        let mut is_child = vec![false; nodes.len()];
        for node in nodes {
            for child in children(node, "children", "node")? {
                is_child.get_mut(child).map_or_else(
                    || Err(refused("nodes", format!("no node {child}"))),
                    |is_child| {
                        *is_child = true;
                        Ok(())
                    },
                )?;
            }
        }
        Ok((0..nodes.len()).filter(|node| !is_child[*node]).collect())
    }

    fn node(
        &self,
        index: usize,
        parent: Option<usize>,
        depth: usize,
        is_visited: &mut [bool],
        placed: &mut Vec<Placed>,
    ) -> Result<()> {
        let node = item(self.root, "nodes", index)?;
        let element = format!("node {index}");
        if std::mem::replace(&mut is_visited[index], true) {
            return Err(refused(element, "in the scene twice, or inside itself"));
        }
        if depth > MAX_DEPTH {
            return Err(refused(
                element,
                format!("more than {MAX_DEPTH} nodes inside each other"),
            ));
        }
        let above = parent.map_or(Transform::IDENTITY, |parent| placed[parent].transform);
        let own = placed.len();
        placed.push(Placed {
            node: index,
            parent,
            transform: above.after(&transform(node, &element)?),
        });
        for child in children(node, "children", &element)? {
            self.node(child, Some(own), depth + 1, is_visited, placed)?;
        }
        Ok(())
    }

    /// Adds the parts of a mesh to the file, for each node that has one.
    pub(super) fn flatten(&mut self) -> Result<()> {
        for placed in self.scene()? {
            let node = &list(self.root, "nodes")[placed.node];
            for mut part in self.parts_of(node, placed.node, &placed.transform)? {
                if let Some(name) = string(node, "name").filter(|name| !name.is_empty()) {
                    part.name = name.into();
                }
                self.file.parts.push(part);
            }
        }
        Ok(())
    }

    /// The parts of a node's mesh, moved by a transform.
    pub(super) fn parts_of(
        &mut self,
        node: &Value,
        index: usize,
        transform: &Transform,
    ) -> Result<Vec<Part>> {
        let Some(mesh) = integer(node, "mesh", &format!("node {index}"))? else {
            return Ok(Vec::new());
        };
        let mut parts = Vec::new();
        for part in self.mesh(mesh)?.iter() {
            self.limits
                .take(part.vertices.len(), part.triangles.len())?;
            let mut part = part.clone();
            part.transform(transform);
            parts.push(part);
        }
        Ok(parts)
    }
}

fn children(value: &Value, name: &str, element: &str) -> Result<Vec<usize>> {
    let index = |child: &Value| child.as_u64().and_then(|child| usize::try_from(child).ok());
    let indices = list(value, name).iter().map(index).collect::<Option<_>>();
    indices.ok_or_else(|| refused(element, format!("{name} must be indices")))
}

/// A matrix, by columns; or translation, rotation and scale.
fn transform(node: &Value, element: &str) -> Result<Transform> {
    if let Some(m) = numbers::<16>(node, "matrix", element)? {
        return Ok(Transform(
            [0, 1, 2].map(|row| [m[row], m[row + 4], m[row + 8], m[row + 12]]),
        ));
    }
    let translation = numbers(node, "translation", element)?.unwrap_or([0.0; 3]);
    let rotation = numbers(node, "rotation", element)?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = numbers(node, "scale", element)?.unwrap_or([1.0; 3]);
    Ok(Transform::translation(translation)
        .after(&Transform::rotation(rotation))
        .after(&Transform::scaling(scale)))
}
