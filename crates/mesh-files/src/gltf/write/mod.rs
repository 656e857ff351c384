//! Writes glTF, binary or as text with everything in it. Vertices are those of corners where corners have normals or texture coordinates,
//! since glTF knows no others.

mod animation;
mod buffer;
mod container;
mod views;

use serde_json::{Map, Value, json};

use super::asset::{Animation, Asset, Node};
use crate::error::WriteError;
use crate::format::check_parts;
use crate::mesh_file::{MeshFile, Part, Texture, UpAxis};
use buffer::Buffer;

/// What is written: the parts of a mesh file, or an asset.
struct Contents<'a> {
    nodes: &'a [Node],
    meshes: Vec<&'a [Part]>,
    textures: &'a [Texture],
    animations: &'a [Animation],
}

/// A mesh file as a binary one: a node, a mesh and a material for each part.
pub(crate) fn write(file: &MeshFile) -> Result<Vec<u8>, WriteError> {
    let parts = file.parts.iter().filter(|part| !part.triangles.is_empty());
    let meshes: Vec<&[Part]> = parts.map(std::slice::from_ref).collect();
    let turned = turned_up(file.up);
    let parent = turned.is_some().then_some(0);
    let own = meshes.iter().enumerate().map(|(number, mesh)| Node {
        name: if mesh[0].name.is_empty() {
            format!("part{number}")
        } else {
            mesh[0].name.clone()
        },
        parent,
        mesh: Some(number),
        ..Node::default()
    });
    let nodes: Vec<Node> = turned.into_iter().chain(own).collect();
    let (document, bytes) = Contents {
        nodes: &nodes,
        meshes,
        textures: &file.textures,
        animations: &[],
    }
    .document();
    container::binary(&document.to_string(), bytes)
}

/// The node that turns what is below it, since glTF's y points up.
fn turned_up(up: Option<UpAxis>) -> Option<Node> {
    let half = 0.5_f64.sqrt();
    let rotation = match up {
        Some(UpAxis::Y) => return None,
        Some(UpAxis::X) => [0.0, 0.0, half, half],
        _ => [-half, 0.0, 0.0, half],
    };
    Some(Node {
        rotation,
        ..Node::default()
    })
}

impl Asset {
    /// A `.glb` file.
    ///
    /// # Errors
    ///
    /// Nodes before their parents, triangles of vertices that are not there, numbers that are not finite, and more than the format can count.
    pub fn to_binary(&self) -> Result<Vec<u8>, WriteError> {
        let (document, bytes) = self.document()?;
        container::binary(&document.to_string(), bytes)
    }

    /// A `.gltf` file: text, with buffers and images inside of it.
    ///
    /// # Errors
    ///
    /// As [`Asset::to_binary`].
    pub fn to_text(&self) -> Result<String, WriteError> {
        let (mut document, bytes) = self.document()?;
        if !bytes.is_empty() {
            document["buffers"][0]["uri"] = json!(container::data_uri(&bytes));
        }
        Ok(document.to_string())
    }

    fn document(&self) -> Result<(Value, Vec<u8>), WriteError> {
        check_parts(self.meshes.iter().flatten())?;
        self.check_nodes()?;
        let meshes = self.meshes.iter().map(Vec::as_slice).collect();
        let contents = Contents {
            nodes: &self.nodes,
            meshes,
            textures: &self.textures,
            animations: &self.animations,
        };
        Ok(contents.document())
    }

    fn check_nodes(&self) -> Result<(), WriteError> {
        let is_sound = |number: usize, node: &Node| {
            let mut numbers = node.translation.iter().chain(&node.rotation);
            let has_mesh = |mesh: usize| {
                self.meshes
                    .get(mesh)
                    .is_some_and(|parts| parts.iter().any(has_triangles))
            };
            numbers.all(|x| x.is_finite())
                && node.parent.is_none_or(|parent| parent < number)
                && node.mesh.is_none_or(has_mesh)
        };
        let wrong = self
            .nodes
            .iter()
            .enumerate()
            .position(|(number, node)| !is_sound(number, node));
        wrong.map_or(Ok(()), |node| Err(WriteError::NoSuchNode { node }))
    }
}

fn has_triangles(part: &Part) -> bool {
    !part.triangles.is_empty()
}

impl Contents<'_> {
    /// The JSON, and the bytes of its one buffer.
    fn document(&self) -> (Value, Vec<u8>) {
        let mut buffer = Buffer::new(self.textures);
        let meshes: Vec<Value> = self.meshes.iter().map(|parts| buffer.mesh(parts)).collect();
        let animations: Vec<Value> = self
            .animations
            .iter()
            .filter_map(|animation| buffer.animation(animation))
            .collect();
        let (cameras, lights) = views::cameras_and_lights(self.nodes);
        let mut document = Map::new();
        document.insert(
            "asset".into(),
            json!({ "version": "2.0", "generator": "Swanilda" }),
        );
        document.insert("scene".into(), json!(0));
        let roots: Vec<usize> = (0..self.nodes.len())
            .filter(|&node| self.nodes[node].parent.is_none())
            .collect();
        document.insert(
            "scenes".into(),
            json!([if roots.is_empty() {
                json!({})
            } else {
                json!({ "nodes": roots })
            }]),
        );
        insert(&mut document, "nodes", views::nodes(self.nodes));
        insert(&mut document, "meshes", meshes);
        insert(&mut document, "animations", animations);
        insert(&mut document, "cameras", cameras);
        if !lights.is_empty() {
            document.insert("extensionsUsed".into(), json!(["KHR_lights_punctual"]));
            document.insert(
                "extensions".into(),
                json!({ "KHR_lights_punctual": { "lights": lights } }),
            );
        }
        let bytes = buffer.finish(&mut document);
        (Value::Object(document), bytes)
    }
}

/// Empty lists are not allowed.
fn insert(document: &mut Map<String, Value>, name: &str, list: Vec<Value>) {
    if !list.is_empty() {
        document.insert(name.into(), Value::Array(list));
    }
}
