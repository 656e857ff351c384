//! Whether a convex mesh has points inside.

use nalgebra::Vector3;

use super::Mesh;
use super::half_edges::HalfEdges;

/// Largest number of neighbours that are visited where faces lie in one plane.
const MAX_DETOUR: usize = 64;

/// The faces of a convex mesh, and which of them are beside each other.
pub(super) struct Enclosure {
    centre: Vector3<f64>,
    /// Of each face: its unit normal, and how far it is from the centre.
    faces: Vec<(Vector3<f64>, f64)>,
    neighbours: Vec<[u32; 3]>,
    /// Where the last point left the mesh: the next one is likely near it.
    last: u32,
}

impl Enclosure {
    /// None if the mesh is not closed, or its middle is not inside.
    pub(super) fn new(mesh: &Mesh) -> Option<Self> {
        let edges = HalfEdges::new(mesh.vertices.len(), &mesh.triangles);
        if !edges.are_closed(&mesh.triangles) {
            return None;
        }
        let centre = mesh.points().iter().sum::<Vector3<f64>>() / mesh.vertices.len().max(1) as f64;
        let face = |t: &[u32; 3]| {
            let normal = mesh.area_vector(t).try_normalize(0.0).unwrap_or_default();
            (normal, normal.dot(&(mesh.corners(t)[0] - centre)))
        };
        let faces: Vec<_> = mesh.triangles.iter().map(face).collect();
        if faces
            .iter()
            .any(|(normal, distance)| *distance <= 0.0 && normal.norm_squared() > 0.0)
        {
            return None;
        }
        let neighbour =
            |t: &[u32; 3]| [0, 1, 2].map(|k| edges.triangle(t[(k + 1) % 3], t[k]).unwrap_or(0));
        let neighbours = mesh.triangles.iter().map(neighbour).collect();
        Some(Self {
            centre,
            faces,
            neighbours,
            last: 0,
        })
    }

    /// How far a point is outside of the face through which the way from the centre to it leaves; negative inside.
    ///
    /// The face is that with the largest share of the way, which is a linear function over the corners of the polar body: it is found by going from
    /// neighbour to neighbour.
    pub(super) fn outside(&mut self, point: &[f64; 3]) -> f64 {
        let offset = Vector3::from(*point) - self.centre;
        let mut best = self.share(self.last, &offset);
        while let Some((face, share)) = self.better(self.last, best, &offset) {
            (self.last, best) = (face, share);
        }
        let (normal, distance) = self.faces[self.last as usize];
        normal.dot(&offset) - distance
    }

    fn share(&self, face: u32, offset: &Vector3<f64>) -> f64 {
        let (normal, distance) = self.faces[face as usize];
        if distance > 0.0 {
            normal.dot(offset) / distance
        } else {
            f64::MIN
        }
    }

    /// A face with a larger share: a neighbour, or a neighbour of those in the same plane.
    fn better(&self, face: u32, share: f64, offset: &Vector3<f64>) -> Option<(u32, f64)> {
        let mut seen = [face; MAX_DETOUR];
        let (mut next, mut count) = (0, 1);
        while next < count {
            for neighbour in self.neighbours[seen[next] as usize] {
                let other = self.share(neighbour, offset);
                if other > share + 1e-12 * share.abs() {
                    return Some((neighbour, other));
                }
                let is_level = other >= share - 1e-12 * share.abs() || other == f64::MIN;
                if is_level && count < MAX_DETOUR && !seen[..count].contains(&neighbour) {
                    seen[count] = neighbour;
                    count += 1;
                }
            }
            next += 1;
        }
        None
    }
}
