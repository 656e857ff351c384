//! A scene of nodes with parameters. It is kept, not drawn.

use std::collections::BTreeMap;

use super::super::error::{UiError, UiResult};
use scene::Data;

/// The types of nodes; the first has the number 44100 (simUI.scene3d_node_type).
pub(crate) const NODE_TYPES: [&str; 22] = [
    "entity",
    "transform",
    "camera",
    "camera-controller-first-person",
    "camera-controller-orbit",
    "light-point",
    "light-directional",
    "light-spot",
    "mesh-cuboid",
    "mesh-torus",
    "mesh-cone",
    "mesh-cylinder",
    "mesh-plane",
    "mesh-sphere",
    "mesh",
    "material-phong",
    "material-gooch",
    "material-texture",
    "material-diffuse-map",
    "texture2d",
    "texture-image",
    "object-picker",
];

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    pub(crate) node_type: &'static str,
    /// -1 for the root.
    pub parent: i64,
    /// Whether it takes effect.
    pub enabled: bool,
    /// Parameters by their names.
    pub params: BTreeMap<String, Data>,
}

/// A scene of its own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene3d {
    /// The nodes by their ids.
    pub nodes: BTreeMap<i64, Node>,
    pub(crate) clear_color: String,
}

impl Scene3d {
    /// Adds a node below `parent` (-1: at the top).
    ///
    /// # Errors
    /// When the id is in use, or parent or type are unknown.
    pub fn add(&mut self, id: i64, parent: i64, type_code: i64) -> UiResult<()> {
        if self.nodes.contains_key(&id) {
            return Err(UiError::other("node id already exists"));
        }
        if parent != -1 && !self.nodes.contains_key(&parent) {
            return Err(UiError::other("parent node id does not exist"));
        }
        let place = type_code
            .checked_sub(44100)
            .and_then(|place| usize::try_from(place).ok());
        let node_type = place.and_then(|place| NODE_TYPES.get(place).copied());
        let node_type = node_type.ok_or_else(|| UiError::other("invalid node type"))?;
        self.nodes.insert(
            id,
            Node {
                node_type,
                parent,
                enabled: true,
                params: BTreeMap::new(),
            },
        );
        Ok(())
    }

    /// The node with that id.
    ///
    /// # Errors
    /// When there is no such node.
    pub fn node_mut(&mut self, id: i64) -> UiResult<&mut Node> {
        self.nodes
            .get_mut(&id)
            .ok_or_else(|| UiError::other("invalid node id"))
    }
}
