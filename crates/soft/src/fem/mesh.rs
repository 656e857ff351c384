//! What a search for contacts sees of cloths, volumes and rods.

use super::Deformable;
use crate::V3;
use crate::rod::Rod;

/// Nodes with what of the surface is between them.
pub(super) trait Mesh {
    fn len(&self) -> usize;
    fn place(&self, node: usize) -> V3;
    fn velocity(&self, node: usize) -> V3;
    /// Distance from the surface at which it touches something, metres.
    fn radius(&self) -> f64;
    /// Triangles that are not torn.
    fn triangles(&self) -> Vec<[usize; 3]>;
    /// Edges between two nodes, the second one twice; some of them may be there more than once.
    fn edges(&self) -> Vec<[usize; 3]>;

    /// Nodes of these edges, each three times.
    fn surface_nodes(&self) -> Vec<[usize; 3]> {
        let nodes = self.edges().into_iter().flat_map(|[a, b, _]| [a, b]);
        nodes.map(|node| [node; 3]).collect()
    }
}

impl Mesh for Deformable {
    fn len(&self) -> usize {
        self.len()
    }

    fn place(&self, node: usize) -> V3 {
        self.places[node]
    }

    fn velocity(&self, node: usize) -> V3 {
        self.velocities[node]
    }

    fn radius(&self) -> f64 {
        self.material.radius
    }

    fn triangles(&self) -> Vec<[usize; 3]> {
        let all = self.surface.iter().enumerate();
        let whole = all.filter(|(number, _)| !self.is_torn(*number));
        whole.map(|(_, triangle)| *triangle).collect()
    }

    fn edges(&self) -> Vec<[usize; 3]> {
        let edge = |a: usize, b: usize| [a.min(b), a.max(b), a.max(b)];
        let triangles = self.triangles().into_iter();
        triangles
            .flat_map(|[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)])
            .collect()
    }
}

impl Mesh for Rod {
    fn len(&self) -> usize {
        self.len()
    }

    fn place(&self, node: usize) -> V3 {
        self.point(node)
    }

    fn velocity(&self, node: usize) -> V3 {
        self.velocity(node)
    }

    fn radius(&self) -> f64 {
        self.material.radius
    }

    fn triangles(&self) -> Vec<[usize; 3]> {
        Vec::new()
    }

    fn edges(&self) -> Vec<[usize; 3]> {
        let whole = (0..self.len() - 1).filter(|edge| !self.is_broken(*edge));
        whole.map(|edge| [edge, edge + 1, edge + 1]).collect()
    }
}
