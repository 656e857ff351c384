//! What a glTF file contains: nodes with their meshes, cameras and lights, and how nodes move.

use crate::mesh_file::{Part, Texture};

/// A glTF file as a tree of nodes, its y axis up. Lengths are in metres, angles in radians.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Asset {
    /// Parents lie before their children.
    pub nodes: Vec<Node>,
    /// Of each mesh, a part for each material.
    pub meshes: Vec<Vec<Part>>,
    /// What materials refer to.
    pub textures: Vec<Texture>,
    /// How nodes move. None are read.
    pub animations: Vec<Animation>,
    /// What was left out while it was read, a sentence each.
    pub warnings: Vec<String>,
}

/// A frame, and what lies in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Empty if it has none.
    pub name: String,
    /// An earlier node.
    pub parent: Option<usize>,
    /// In the frame of the parent.
    pub translation: [f64; 3],
    /// In the frame of the parent: a unit quaternion x, y, z, w.
    pub rotation: [f64; 4],
    /// An index of [`Asset::meshes`].
    pub mesh: Option<usize>,
    /// Looks along -z, y up.
    pub camera: Option<Camera>,
    /// Shines along -z.
    pub light: Option<Light>,
}

impl Default for Node {
    /// A frame at that of the parent, with nothing in it.
    fn default() -> Self {
        let rotation = [0.0, 0.0, 0.0, 1.0];
        Self {
            name: String::new(),
            parent: None,
            translation: [0.0; 3],
            rotation,
            mesh: None,
            camera: None,
            light: None,
        }
    }
}

/// The projection of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// What it shows.
    pub extent: Extent,
    /// Width of the picture divided by its height.
    pub aspect_ratio: f64,
    /// Distances of what is seen: from, to (m).
    pub clipping: [f64; 2],
}

/// How much a camera shows, from the bottom to the top of its picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// The angle of a perspective view (rad).
    Angle(f64),
    /// The height of an orthographic view (m).
    Height(f64),
}

/// A light (`KHR_lights_punctual`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it shines.
    pub kind: LightKind,
    /// From 0 to 1.
    pub color: [f64; 3],
    /// Candela, or lux of a directional light.
    pub intensity: f64,
}

/// Where a light shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// In all directions.
    Point,
    /// From far away, along -z.
    Directional,
    /// Along -z, up to an angle from it (rad).
    Spot(f64),
}

/// How nodes move in the course of time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Animation {
    /// Empty if it has none.
    pub name: String,
    /// One for each node that moves.
    pub tracks: Vec<Track>,
}

/// Where a node is at some times, and in between on the straight or shortest way.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// An index of [`Asset::nodes`].
    pub node: usize,
    /// Increasing, from 0 (s).
    pub times: Vec<f64>,
    /// One for each time, or empty where the node stays in its place.
    pub translations: Vec<[f64; 3]>,
    /// One for each time, or empty where the node does not turn.
    pub rotations: Vec<[f64; 4]>,
}
