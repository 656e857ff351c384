//! Taking a mesh apart into pieces that share no vertex.

use std::collections::BTreeMap;

use super::Mesh;
use crate::partition;

impl Mesh {
    /// The connected pieces, in the order of their first triangles: lists of triangles.
    pub fn islands(&self) -> Vec<Vec<usize>> {
        let mut islands: Vec<Vec<usize>> = Vec::new();
        for (triangle, island) in partition(self.triangles.iter().copied())
            .into_iter()
            .enumerate()
        {
            islands.resize(islands.len().max(island + 1), Vec::new());
            islands[island].push(triangle);
        }
        islands
    }

    /// The mesh of some of the triangles, with the vertices they use.
    pub fn of_triangles(&self, triangles: &[usize]) -> Mesh {
        let mut part = Mesh::default();
        let mut new_index: BTreeMap<u32, u32> = BTreeMap::new();
        for &index in triangles {
            let corners = self.triangles[index].map(|old| {
                *new_index.entry(old).or_insert_with(|| {
                    part.vertices.push(self.vertices[old as usize]);
                    part.vertices.len() as u32 - 1
                })
            });
            part.triangles.push(corners);
            part.normals.extend(
                self.normals
                    .get(3 * index..3 * index + 3)
                    .unwrap_or_default(),
            );
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use crate::Pose;
    use crate::primitive::{PrimitiveKind, tessellate};

    #[test]
    fn two_boxes_are_two_islands() {
        let mut mesh = tessellate(PrimitiveKind::Cuboid, [1.0; 3], false).unwrap();
        let other = mesh.clone();
        mesh.append(&other, &Pose::translation(3.0, 0.0, 0.0));
        let islands: Vec<_> = mesh
            .islands()
            .iter()
            .map(|triangles| mesh.of_triangles(triangles))
            .collect();
        assert_eq!(islands.len(), 2);
        assert_eq!(
            (islands[1].vertices.len(), islands[1].normals.len()),
            (8, 36)
        );
    }
}
