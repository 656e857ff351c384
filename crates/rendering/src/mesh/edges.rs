//! The edges of a mesh, for drawing the sharp ones.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::Mesh;

/// An edge, with what decides whether it is drawn.
#[derive(Debug, Clone)]
pub struct MeshEdge {
    pub ends: [[f64; 3]; 2],
    /// Of the faces on both sides; one at the border of an open mesh.
    pub normals: [Option<[f32; 3]>; 2],
    /// Of the angle between the normals; -2 at a border, or where more than two faces meet.
    pub cosine: f32,
}

impl MeshEdge {
    /// Whether it belongs to one face only.
    pub fn is_border(&self) -> bool {
        self.normals[1].is_none()
    }
}

impl Mesh {
    /// All edges, each once, in the order in which triangles have them.
    pub(crate) fn find_edges(&self) -> Vec<MeshEdge> {
        let mut edges: Vec<MeshEdge> = Vec::new();
        let mut places = HashMap::new();
        for cluster in &self.clusters {
            let vertices = &self.vertices[cluster.vertices.clone()];
            for corners in &self.corners[cluster.triangles.clone()] {
                let corners = corners.map(|corner| vertices[usize::from(corner)]);
                let normal = face_normal(&corners);
                for ends in [
                    [corners[0], corners[1]],
                    [corners[1], corners[2]],
                    [corners[2], corners[0]],
                ] {
                    match places.get(&key(&ends)) {
                        Some(&at) => edges_meet(&mut edges[numbers::place(at)], normal),
                        None => {
                            places.insert(key(&ends), numbers::count_u32(edges.len()));
                            edges.push(MeshEdge {
                                ends,
                                normals: [Some(normal), None],
                                cosine: -2.0,
                            });
                        }
                    }
                }
            }
        }
        edges
    }
}

fn edges_meet(edge: &mut MeshEdge, normal: [f32; 3]) {
    let is_second = edge.normals[1].is_none();
    let cosine = edge.normals[0].map_or(-2.0, |first| {
        Vector3::from(first).dot(&Vector3::from(normal))
    });
    // Not more than 1 by rounding: all edges are drawn where the limit is an angle of zero.
    edge.cosine = if is_second { cosine.min(1.0) } else { -2.0 };
    edge.normals[1] = edge.normals[1].or(Some(normal));
}

fn face_normal(corners: &[[f64; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(Vector3::from);
    (b - a).cross(&(c - a)).normalize().cast::<f32>().into()
}

/// The same for both directions. Adding zero makes the two zeros one.
fn key(ends: &[[f64; 3]; 2]) -> [[u64; 3]; 2] {
    let [a, b] = ends.map(|end| end.map(|x| (x + 0.0).to_bits()));
    [a.min(b), a.max(b)]
}
