//! The edges of a mesh that are worth drawing.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::Mesh;

/// An edge between two places, and what decides whether it is sharp.
struct Edge {
    /// Vertices at its ends.
    ends: [u32; 2],
    /// Unit normal of the first face.
    normal: Vector3<f64>,
    faces: u32,
    /// Of the angle between the normals of its faces.
    cosine: f64,
}

impl Mesh {
    /// The vertices at the ends of each edge where two faces meet at more than `angle` (radians), of each border of an open mesh, and of each edge
    /// where more than two faces meet. Vertices at the same place count as one; triangles without area count as none.
    pub fn sharp_edges(&self, angle: f64) -> Vec<[u32; 2]> {
        let places = self.vertices_by_place();
        let mut edges: Vec<Edge> = Vec::new();
        let mut known: HashMap<[u32; 2], usize> = HashMap::new();
        for triangle in &self.triangles {
            let [a, b, c] = self.corners(triangle);
            let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else {
                continue;
            };
            let corners = triangle.map(|vertex| places[vertex as usize]);
            for ends in [
                [corners[0], corners[1]],
                [corners[1], corners[2]],
                [corners[2], corners[0]],
            ] {
                let key = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                match known.get(&key) {
                    Some(&at) => edges[at].meet(&normal),
                    None => {
                        known.insert(key, edges.len());
                        edges.push(Edge {
                            ends,
                            normal,
                            faces: 1,
                            cosine: 1.0,
                        });
                    }
                }
            }
        }
        let limit = libm::cos(angle);
        edges
            .into_iter()
            .filter(|edge| edge.faces != 2 || edge.cosine < limit)
            .map(|edge| edge.ends)
            .collect()
    }

    /// For each vertex the first one at the same place.
    fn vertices_by_place(&self) -> Vec<u32> {
        let mut first: HashMap<[u64; 3], u32> = HashMap::new();
        // Adding zero makes the two zeros one.
        let key = |vertex: &[f64; 3]| vertex.map(|x| (x + 0.0).to_bits());
        (0..)
            .zip(&self.vertices)
            .map(|(at, vertex)| *first.entry(key(vertex)).or_insert(at))
            .collect()
    }
}

impl Edge {
    fn meet(&mut self, normal: &Vector3<f64>) {
        self.faces += 1;
        self.cosine = self.normal.dot(normal);
    }
}

#[cfg(test)]
mod tests {
    use crate::Mesh;
    use crate::mesh::samples::block;

    #[test]
    fn a_block_has_twelve_edges_and_no_diagonals() {
        assert_eq!(block([1.0, 2.0, 3.0]).sharp_edges(0.5).len(), 12);
        assert_eq!(block([1.0, 2.0, 3.0]).sharp_edges(1.6).len(), 0);
    }

    #[test]
    fn vertices_at_one_place_are_one_and_borders_are_edges() {
        let flat =
            |vertices: Vec<[f64; 3]>| Mesh::new(vertices, vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        let square = flat(vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 0.0, -0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ]);
        assert_eq!(square.sharp_edges(0.1).len(), 4);
    }
}
