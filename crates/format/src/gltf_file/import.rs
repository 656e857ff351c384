//! Nodes become objects: shapes, cameras, lights, and dummies for those that only have a name.

use geometry::Pose;
use mesh_files::MeshFile;
use mesh_files::gltf::Node;

use super::viewers::{camera_object, light_object};
use super::{GltfFile, Placed, is_turned, pose_of, upright};
use crate::mesh_file::{ImportedAppearance, to_shapes};
use scene::object::dummy::Dummy;
use scene::shape::Shape;
use scene::{Handle, Kind, Scene, SceneResult, clean_alias};

/// Of a frame that holds nothing, metres.
const DUMMY: f64 = 0.01;
/// Pixels on a side of a texture; larger ones are made smaller.
const MAX_TEXTURE_SIDE: u32 = 2048;

impl GltfFile {
    /// Adds the objects of the file to a scene, parents before children; nodes without a name and without anything in them are none. Also what could
    /// not be used, a sentence each.
    ///
    /// # Errors
    /// When a mesh is too large for a scene, or all handles are in use.
    pub fn add_to(&self, scene: &mut Scene) -> SceneResult<(Vec<Handle>, Vec<String>)> {
        let (mut shapes, warnings) = self.shapes(scene)?;
        let mut placed: Vec<(Option<Handle>, Pose)> = Vec::with_capacity(self.asset.nodes.len());
        let mut handles = Vec::new();
        for node in &self.asset.nodes {
            let (parent, above) = node
                .parent
                .map_or((None, upright().inverse()), |parent| placed[parent]);
            let frame = above * pose_of(node);
            let Some((alias, kind)) = content(node, &mut shapes) else {
                placed.push((parent, frame));
                continue;
            };
            let is_turned = is_turned(&kind);
            let handle = scene.add(&clean_alias(alias.as_bytes()), kind)?;
            let pose = Placed { handle, is_turned }.node_frame(frame);
            scene.set_world_pose(handle, pose)?;
            scene.set_parent(handle, parent, true)?;
            handles.push(handle);
            placed.push((Some(handle), frame));
        }
        Ok((handles, warnings))
    }

    /// The shape of each mesh; a node takes its own out.
    fn shapes(&self, scene: &mut Scene) -> SceneResult<(Vec<Option<Shape>>, Vec<String>)> {
        let mut file = MeshFile {
            parts: self.asset.meshes.iter().flatten().cloned().collect(),
            textures: self.asset.textures.clone(),
            ..MeshFile::default()
        };
        file.merge_identical();
        let imported = ImportedAppearance {
            colours: true,
            transparency: true,
            textures: Some(MAX_TEXTURE_SIDE),
        };
        let mut parts = to_shapes(&mut file, imported, scene)?.into_iter();
        let mut shapes = Vec::new();
        for mesh in &self.asset.meshes {
            let shape = Shape::compound(parts.by_ref().take(mesh.len()).collect())?;
            shape.check_extent(1.0)?;
            shapes.push(Some(shape));
        }
        Ok((shapes, file.warnings))
    }
}

/// The name and the object of a node; None for a frame without a name. What a mesh shares its node with is left out.
fn content(node: &Node, shapes: &mut [Option<Shape>]) -> Option<(String, Kind)> {
    let shape = node.mesh.and_then(|mesh| shapes[mesh].take());
    let (default, kind) = match (shape, &node.camera, &node.light) {
        (Some(shape), ..) => ("shape", Kind::Shape(Box::new(shape))),
        (None, Some(camera), _) => ("camera", Kind::Camera(Box::new(camera_object(camera)))),
        (None, None, Some(light)) => ("light", Kind::Light(Box::new(light_object(light)))),
        (None, None, None) if node.name.is_empty() => return None,
        (None, None, None) => ("", Kind::Dummy(Dummy::new(DUMMY))),
    };
    Some((
        if node.name.is_empty() {
            default.to_owned()
        } else {
            node.name.clone()
        },
        kind,
    ))
}
