//! Objects become nodes.

use std::collections::BTreeSet;

use geometry::Pose;
use mesh_files::gltf::Node;
use mesh_files::{MeshFile, Part};

use super::{Exported, GltfFile, Placed};
use crate::mesh_file::ShapeParts;
use scene::shape::Shape;
use scene::{Handle, Kind, Scene, SceneResult};

impl GltfFile {
    /// Adds objects, parents first; the kind of their textures is an extension. Scripts are left out, and the meshes of shapes nobody sees.
    ///
    /// # Errors
    /// When a handle is unknown; nothing happens then.
    pub fn add_objects(
        &mut self,
        scene: &Scene,
        handles: &[Handle],
        textures: &'static str,
    ) -> SceneResult<()> {
        for handle in handles {
            scene.object(*handle)?;
        }
        let wanted: BTreeSet<Handle> = handles.iter().copied().collect();
        let is_wanted = |handle: &Handle| {
            wanted.contains(handle)
                && !scene
                    .object(*handle)
                    .is_ok_and(|object| matches!(object.kind, Kind::Script(_)))
        };
        for handle in scene.all_breadth_first().into_iter().filter(is_wanted) {
            self.add_object(scene, handle, textures)?;
        }
        Ok(())
    }

    /// Adds an object below the node of its next ancestor that has one; the number of its node.
    ///
    /// # Errors
    /// When the handle is unknown.
    pub fn add_object(
        &mut self,
        scene: &Scene,
        handle: Handle,
        textures: &'static str,
    ) -> SceneResult<usize> {
        let object = scene.object(handle)?;
        let above = scene
            .ancestors(handle)
            .find_map(|above| Some((above, *self.nodes.get(&above)?)));
        let (parent, parent_node) = match above {
            Some((parent, node)) => (Some(parent), node),
            None => (None, self.root()),
        };
        let mut node = node(scene, handle, parent, parent_node)?;
        match &object.kind {
            Kind::Shape(shape) if scene.is_visible(handle)? => {
                node.mesh = self.mesh(scene, shape, textures)?;
            }
            Kind::Camera(camera) => node.camera = Some(super::viewers::camera(&camera.view)),
            Kind::VisionSensor(sensor) => node.camera = Some(super::viewers::camera(&sensor.view)),
            Kind::Light(light) if light.enabled => node.light = Some(super::viewers::light(light)),
            _ => {}
        }
        self.push(scene, handle, parent, node)
    }

    /// Adds a shape, visible or not, in the frame of an object or the world, below a node; the number of its node.
    ///
    /// # Errors
    /// When there is no such shape or parent.
    pub fn add_shape(
        &mut self,
        scene: &Scene,
        shape: Handle,
        (parent, parent_node): (Option<Handle>, usize),
        textures: &'static str,
    ) -> SceneResult<usize> {
        let mut node = node(scene, shape, parent, parent_node)?;
        node.mesh = self.mesh(scene, scene.object(shape)?.shape()?, textures)?;
        self.push(scene, shape, parent, node)
    }

    fn push(
        &mut self,
        scene: &Scene,
        handle: Handle,
        parent: Option<Handle>,
        node: Node,
    ) -> SceneResult<usize> {
        let number = self.asset.nodes.len();
        let parent = parent
            .map(|parent| Placed::new(scene, parent))
            .transpose()?;
        self.exported.push(Exported {
            node: number,
            object: Placed::new(scene, handle)?,
            parent,
        });
        self.nodes.insert(handle, number);
        self.asset.nodes.push(node);
        Ok(number)
    }

    /// The meshes of a shape in its frame; None if they have no triangles.
    fn mesh(
        &mut self,
        scene: &Scene,
        shape: &Shape,
        textures: &'static str,
    ) -> SceneResult<Option<usize>> {
        let mut parts = ShapeParts {
            file: MeshFile::default(),
            textures: Some(textures),
            colours: true,
            normals: true,
        };
        parts.add("", shape, &Pose::identity(), scene)?;
        let numbers: Vec<usize> = parts
            .file
            .textures
            .into_iter()
            .map(|texture| self.texture(texture))
            .collect();
        let mut mesh: Vec<Part> = parts
            .file
            .parts
            .into_iter()
            .filter(|part| !part.triangles.is_empty())
            .collect();
        for part in &mut mesh {
            part.material.texture = part.material.texture.map(|texture| numbers[texture]);
        }
        if mesh.is_empty() {
            return Ok(None);
        }
        self.asset.meshes.push(mesh);
        Ok(Some(self.asset.meshes.len() - 1))
    }

    /// Equal pictures are in the file once.
    fn texture(&mut self, texture: mesh_files::Texture) -> usize {
        let known = self
            .asset
            .textures
            .iter()
            .position(|known| known.bytes == texture.bytes);
        known.unwrap_or_else(|| {
            self.asset.textures.push(texture);
            self.asset.textures.len() - 1
        })
    }
}

/// A node without contents, below the node of `parent`.
fn node(
    scene: &Scene,
    handle: Handle,
    parent: Option<Handle>,
    parent_node: usize,
) -> SceneResult<Node> {
    let frame = |handle| -> SceneResult<Pose> {
        Ok(Placed::new(scene, handle)?.node_frame(scene.world_pose(handle)?))
    };
    let above = parent.map_or(Ok(Pose::identity()), frame)?;
    let pose = above.inverse() * frame(handle)?;
    Ok(Node {
        name: scene.object(handle)?.alias().to_owned(),
        parent: Some(parent_node),
        translation: pose.translation.vector.into(),
        rotation: pose.rotation.coords.into(),
        ..Node::default()
    })
}
