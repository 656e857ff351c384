//! Scenes as glTF files, and the nodes of glTF files as objects.
//!
//! `mesh_files` reads and writes the files. Its frames have y up and look along -z, ours have z up and look along z: `export` and `import` turn what
//! lies in the world, and cameras and lights about their y axis.

mod export;
mod file;
mod import;
mod recording;
mod viewers;

use std::collections::BTreeMap;

use geometry::Pose;
use mesh_files::gltf::{Asset, Node};
use mesh_files::{Limits, ReadError};
use nalgebra::{Translation3, UnitQuaternion, Vector3};

pub use recording::Recording;
use scene::{Handle, Kind, Scene, SceneResult};

/// How much a file may contain: no scene could hold more.
const LIMITS: Limits = Limits {
    vertices: 12_000_000,
    triangles: 4_000_000,
    parts: 10_000,
};

/// A glTF file in memory, and which objects became which nodes.
#[derive(Debug)]
pub struct GltfFile {
    asset: Asset,
    /// The node that turns z up; a file that was read has none at first.
    root: Option<usize>,
    exported: Vec<Exported>,
    /// The last node of each object.
    nodes: BTreeMap<Handle, usize>,
}

/// An object that became a node.
#[derive(Debug, Clone, Copy)]
struct Exported {
    node: usize,
    object: Placed,
    /// In whose frame the node is placed.
    parent: Option<Placed>,
}

/// An object, and whether its node looks the other way.
#[derive(Debug, Clone, Copy)]
struct Placed {
    handle: Handle,
    is_turned: bool,
}

impl Default for GltfFile {
    /// Without objects: a node that turns z up.
    fn default() -> Self {
        let mut file = Self {
            asset: Asset::default(),
            root: None,
            exported: Vec::new(),
            nodes: BTreeMap::new(),
        };
        file.root();
        file
    }
}

impl GltfFile {
    /// Reads a file, binary or text. What it names, `resolve` looks up.
    ///
    /// # Errors
    /// Where it is damaged or too large.
    pub(crate) fn read(bytes: &[u8], resolve: mesh_files::Resolve) -> Result<Self, ReadError> {
        let asset = Asset::read(bytes, LIMITS, resolve)?;
        Ok(Self {
            asset,
            root: None,
            exported: Vec::new(),
            nodes: BTreeMap::new(),
        })
    }

    /// The node of the world.
    fn root(&mut self) -> usize {
        *self.root.get_or_insert_with(|| {
            self.asset.nodes.push(Node {
                rotation: upright().rotation.coords.into(),
                ..Node::default()
            });
            self.asset.nodes.len() - 1
        })
    }

    /// Nodes, meshes and materials as the file has them.
    pub fn asset(&self) -> &Asset {
        &self.asset
    }
}

/// From our frame of the world to that of a file.
fn upright() -> Pose {
    Pose::rotation(Vector3::x() * -std::f64::consts::FRAC_PI_2)
}

/// Half a turn about y: from where we look to where glTF looks, and back.
fn turned() -> Pose {
    Pose::rotation(Vector3::y() * std::f64::consts::PI)
}

/// Cameras and lights look the other way.
fn is_turned(kind: &Kind) -> bool {
    matches!(
        kind,
        Kind::Camera(_) | Kind::VisionSensor(_) | Kind::Light(_)
    )
}

impl Placed {
    fn new(scene: &Scene, handle: Handle) -> SceneResult<Self> {
        Ok(Self {
            handle,
            is_turned: is_turned(&scene.object(handle)?.kind),
        })
    }

    /// The frame of the node of an object at a pose.
    fn node_frame(self, pose: Pose) -> Pose {
        if self.is_turned {
            pose * turned()
        } else {
            pose
        }
    }
}

fn pose_of(node: &Node) -> Pose {
    let [x, y, z, w] = node.rotation;
    let rotation = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
    Pose::from_parts(Translation3::from(node.translation), rotation)
}
