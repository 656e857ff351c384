//! Triangle meshes: validated, transformed, boxed. Lengths are in metres.
//!
//! Triangles wind counter-clockwise seen from outside. A [`Mesh`] made by this module is valid: finite
//! vertices, indices in range, three normals per triangle.

mod bounding_box;
mod decomposition;
mod edges;
mod enclosure;
mod extrusion;
mod fast_hash;
mod half_edges;
mod hull;
mod islands;
mod normals;

use nalgebra::Vector3;
use thiserror::Error;

pub use bounding_box::BoundingBox;
pub use decomposition::DecompositionParameters;
pub use extrusion::Extrusion;

use crate::Pose;
use fast_hash::{FastMap, FastSet};
use half_edges::HalfEdges;

/// A triangle mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Points in the frame of the mesh (m).
    pub vertices: Vec<[f64; 3]>,
    /// Indices of the corners into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, one per corner: 3 per triangle. Zero for triangles without area.
    pub normals: Vec<[f64; 3]>,
}

/// Why lists of numbers are not a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum MeshError {
    /// No vertex or no triangle.
    #[error("invalid data: a mesh needs vertices and triangles.")]
    Empty,
    /// The vertex list does not hold three numbers per vertex.
    #[error("invalid data: {0} vertex coordinates are not a multiple of 3.")]
    VertexCount(usize),
    /// The index list does not hold three numbers per triangle.
    #[error("invalid data: {0} indices are not a multiple of 3.")]
    IndexCount(usize),
    /// A triangle refers to a vertex that is not there.
    #[error("invalid data: index {index} is not below the vertex count {vertices}.")]
    IndexOutOfRange {
        /// The offending index.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// The normal list does not hold nine numbers per triangle.
    #[error("invalid data: {found} normal coordinates instead of {expected}.")]
    NormalCount {
        /// Numbers given.
        found: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("invalid data.")]
    NotFinite,
    /// A coordinate is beyond [`MAX_COORDINATE`].
    #[error(
        "invalid data: a coordinate is beyond {MAX_COORDINATE:e}, which scene files cannot hold."
    )]
    TooLarge,
}

/// The largest coordinate of a mesh, metres. Scene files hold 32-bit numbers, which end at 3e38; products of a few coordinates must
/// fit into 64 bits.
pub const MAX_COORDINATE: f64 = 1e30;

/// How many faces of a mesh are compared with all vertices before the edges are looked at.
const SAMPLED_FACES: usize = 8;

fn check_coordinates(coordinates: &[f64]) -> Result<(), MeshError> {
    if !coordinates.iter().all(|c| c.is_finite()) {
        return Err(MeshError::NotFinite);
    }
    if coordinates.iter().all(|c| c.abs() <= MAX_COORDINATE) {
        Ok(())
    } else {
        Err(MeshError::TooLarge)
    }
}

impl Mesh {
    /// Mesh with flat normals.
    ///
    /// # Errors
    /// [`MeshError::Empty`], [`MeshError::IndexOutOfRange`], [`MeshError::NotFinite`] and [`MeshError::TooLarge`].
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let count = vertices.len();
        if count == 0 || triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        check_coordinates(vertices.as_flattened())?;
        if let Some(index) = triangles
            .as_flattened()
            .iter()
            .find(|i| **i as usize >= count)
        {
            return Err(MeshError::IndexOutOfRange {
                index: i64::from(*index),
                vertices: count,
            });
        }
        let mut mesh = Self {
            vertices,
            triangles,
            normals: Vec::new(),
        };
        mesh.compute_normals(0.0);
        Ok(mesh)
    }

    /// Mesh from flat lists, as scripts pass them: 3n coordinates, 3m indices from 0, 9m normal coordinates.
    /// Without normals they are flat.
    ///
    /// # Errors
    /// Every variant of [`MeshError`].
    pub fn from_flat(
        vertices: &[f64],
        indices: &[i64],
        normals: Option<&[f64]>,
    ) -> Result<Self, MeshError> {
        let points = vertices.as_chunks().0.to_vec();
        if !vertices.len().is_multiple_of(3) {
            return Err(MeshError::VertexCount(vertices.len()));
        }
        if !indices.len().is_multiple_of(3) {
            return Err(MeshError::IndexCount(indices.len()));
        }
        let error = |index| MeshError::IndexOutOfRange {
            index,
            vertices: points.len(),
        };
        let corners = indices
            .iter()
            .map(|i| u32::try_from(*i).map_err(|_| error(*i)));
        let corners = corners.collect::<Result<Vec<u32>, _>>()?;
        let mut mesh = Self::new(points, corners.as_chunks().0.to_vec())?;
        if let Some(normals) = normals {
            mesh.set_normals(normals)?;
        }
        Ok(mesh)
    }

    /// Normals, 9 numbers per triangle.
    ///
    /// # Errors
    /// [`MeshError::NormalCount`] when there are too few, [`MeshError::NotFinite`], [`MeshError::TooLarge`].
    pub fn set_normals(&mut self, normals: &[f64]) -> Result<(), MeshError> {
        let (found, expected) = (normals.len(), 9 * self.triangles.len());
        let used = normals
            .get(..expected)
            .ok_or(MeshError::NormalCount { found, expected })?;
        check_coordinates(used)?;
        self.normals = used.as_chunks().0.to_vec();
        Ok(())
    }

    /// 3n coordinates.
    pub fn flat_vertices(&self) -> Vec<f64> {
        self.vertices.as_flattened().to_vec()
    }

    /// 3m indices.
    pub fn flat_indices(&self) -> Vec<i64> {
        self.triangles
            .as_flattened()
            .iter()
            .map(|i| i64::from(*i))
            .collect()
    }

    /// 9m normal coordinates.
    pub fn flat_normals(&self) -> Vec<f64> {
        self.normals.as_flattened().to_vec()
    }

    /// Makes one vertex of those closer than about `tolerance` (m; 0: equal ones), drops triangles that
    /// collapse and repeated triangles of the same winding. Vertices keep the order of their first use.
    pub fn merge_duplicates(&mut self, tolerance: f64) {
        let cell = |c: f64| {
            Some((c / tolerance).round())
                .filter(|k| tolerance > 0.0 && k.is_finite())
                .unwrap_or(c)
        };
        let mut kept = Vec::new();
        let mut seen = FastMap::default();
        let mut place = |v: &[f64; 3]| {
            *seen
                .entry(v.map(|c| (cell(c) + 0.0).to_bits()))
                .or_insert_with(|| {
                    kept.push(*v);
                    kept.len() as u32 - 1
                })
        };
        let map: Vec<u32> = self.vertices.iter().map(&mut place).collect();
        self.vertices = kept;
        self.keep_distinct_triangles(&map);
    }

    /// Turns the inside out.
    pub fn flip(&mut self) {
        self.triangles
            .iter_mut()
            .for_each(|triangle| triangle.swap(1, 2));
        self.normals
            .iter_mut()
            .for_each(|normal| *normal = normal.map(|c| -c));
        self.normals
            .as_chunks_mut::<3>()
            .0
            .iter_mut()
            .for_each(|corners| corners.swap(1, 2));
    }

    /// Moves the mesh: `pose` is where its frame goes.
    pub fn transform(&mut self, pose: &Pose) {
        self.vertices.iter_mut().for_each(|v| *v = moved(pose, v));
        self.normals
            .iter_mut()
            .for_each(|n| *n = (pose.rotation * Vector3::from(*n)).into());
    }

    /// Scales about the origin; a mirroring keeps the outside outside. The normals become flat when the
    /// factors differ.
    pub fn scale(&mut self, factors: [f64; 3]) {
        self.vertices
            .iter_mut()
            .for_each(|v| *v = [0, 1, 2].map(|i| v[i] * factors[i]));
        if factors.iter().product::<f64>() < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        if factors[0] != factors[1] || factors[0] != factors[2] || factors[0] < 0.0 {
            self.compute_normals(0.0);
        }
    }

    /// Adds `other`, whose frame lies at `pose`.
    pub fn append(&mut self, other: &Mesh, pose: &Pose) {
        let first = self.vertices.len() as u32;
        self.vertices
            .extend(other.vertices.iter().map(|v| moved(pose, v)));
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
        let rotated = |n: &[f64; 3]| <[f64; 3]>::from(pose.rotation * Vector3::from(*n));
        self.normals.extend(other.normals.iter().map(rotated));
    }

    /// Smallest and largest corner along the axes of the mesh frame; `None` without vertices.
    pub fn aabb(&self) -> Option<([f64; 3], [f64; 3])> {
        let first = *self.vertices.first()?;
        let grow = |(low, high): ([f64; 3], [f64; 3]), v: &[f64; 3]| {
            (
                [0, 1, 2].map(|i| low[i].min(v[i])),
                [0, 1, 2].map(|i| high[i].max(v[i])),
            )
        };
        Some(self.vertices.iter().fold((first, first), grow))
    }

    /// Enclosed volume (m3): positive for a closed mesh that winds outward.
    pub fn volume(&self) -> f64 {
        let origin = self
            .vertices
            .first()
            .map_or(Vector3::zeros(), |v| Vector3::from(*v));
        let corners = self
            .triangles
            .iter()
            .map(|t| self.corners(t).map(|c| c - origin));
        corners.map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
    }

    /// Whether the mesh is closed, in one piece without holes, and nowhere dented.
    pub fn is_convex(&self) -> bool {
        let mut is_used = vec![false; self.vertices.len()];
        self.triangles
            .as_flattened()
            .iter()
            .for_each(|vertex| is_used[*vertex as usize] = true);
        let (used, faces) = (
            is_used.iter().filter(|is_used| **is_used).count(),
            self.triangles.len(),
        );
        if used + faces != 3 * faces / 2 + 2
            || self.is_dented_widely(&is_used)
            || self.volume() <= 0.0
        {
            return false;
        }
        let edges = HalfEdges::new(self.vertices.len(), &self.triangles);
        edges.are_distinct() && self.triangles.iter().all(|t| self.is_ridge(t, &edges))
    }

    /// Whether a vertex is clearly outside of one of a few faces: most meshes that are not convex are found out so.
    fn is_dented_widely(&self, is_used: &[bool]) -> bool {
        let stride = self.triangles.len().div_ceil(SAMPLED_FACES).max(1);
        self.triangles.iter().step_by(stride).any(|t| {
            let Some(normal) = self.area_vector(t).try_normalize(0.0) else {
                return true;
            };
            let [a, ..] = self.corners(t);
            let used = self
                .vertices
                .iter()
                .zip(is_used)
                .filter(|(_, is_used)| **is_used);
            used.into_iter().any(|(vertex, _)| {
                let offset = Vector3::from(*vertex) - a;
                normal.dot(&offset) > 1e-2 * offset.norm()
            })
        })
    }

    fn keep_distinct_triangles(&mut self, map: &[u32]) {
        let mut seen = FastSet::default();
        let (mut triangles, mut normals) = (Vec::new(), Vec::new());
        for (t, n) in self.triangles.iter().zip(self.normals.as_chunks::<3>().0) {
            let mut turned = t.map(|i| map[i as usize]);
            let kept = turned;
            let lowest = (0..3).min_by_key(|i| turned[*i]).unwrap_or(0);
            turned.rotate_left(lowest);
            if kept[0] != kept[1] && kept[1] != kept[2] && kept[2] != kept[0] && seen.insert(turned)
            {
                triangles.push(kept);
                normals.extend(n);
            }
        }
        (self.triangles, self.normals) = (triangles, normals);
    }

    pub(crate) fn points(&self) -> Vec<Vector3<f64>> {
        self.vertices.iter().map(|v| Vector3::from(*v)).collect()
    }

    /// The three points of a triangle, which is one of `triangles`.
    pub fn corners(&self, triangle: &[u32; 3]) -> [Vector3<f64>; 3] {
        triangle.map(|i| Vector3::from(self.vertices[i as usize]))
    }

    pub(crate) fn area_vector(&self, triangle: &[u32; 3]) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a))
    }

    /// Whether the neighbours of a triangle bend away from its outside.
    fn is_ridge(&self, t: &[u32; 3], edges: &HalfEdges) -> bool {
        let Some(normal) = self.area_vector(t).try_normalize(0.0) else {
            return false;
        };
        let [a, ..] = self.corners(t);
        (0..3).all(|i| {
            let Some(neighbour) = edges.triangle(t[(i + 1) % 3], t[i]) else {
                return false;
            };
            let far = self.triangles[neighbour as usize]
                .into_iter()
                .find(|c| *c != t[i] && *c != t[(i + 1) % 3]);
            let offset = far.map_or(Vector3::zeros(), |far| {
                Vector3::from(self.vertices[far as usize]) - a
            });
            normal.dot(&offset) <= 1e-6 * offset.norm()
        })
    }
}

fn moved(pose: &Pose, v: &[f64; 3]) -> [f64; 3] {
    (pose.rotation * Vector3::from(*v) + pose.translation.vector).into()
}

/// Meshes for the tests of this and its neighbouring modules.
#[cfg(test)]
pub(crate) mod samples {
    use super::Mesh;

    pub const CORNER: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

    pub fn tetrahedron() -> Mesh {
        Mesh::new(
            CORNER.to_vec(),
            vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        )
        .expect("valid")
    }

    pub fn block(size: [f64; 3]) -> Mesh {
        let corner = |i: u32| [0, 1, 2].map(|a| size[a] * (f64::from(i >> a & 1) - 0.5));
        Mesh::convex_hull(&(0..8).map(corner).collect::<Vec<_>>()).expect("spans space")
    }

    #[track_caller]
    pub fn close(a: &[f64], b: &[f64]) {
        assert!(
            a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9),
            "{a:?} is not {b:?}"
        );
    }
}

#[cfg(test)]
mod tests {
    use super::samples::{block, close, tetrahedron};
    use super::*;

    #[test]
    fn flat_lists_are_checked() {
        let new = |v: &[f64], i: &[i64]| Mesh::from_flat(v, i, None).map(|m| m.triangles.len());
        let v = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
        assert_eq!(new(&v, &[0, 1, 2]), Ok(1));
        assert_eq!(new(&v[..8], &[0, 1, 2]), Err(MeshError::VertexCount(8)));
        assert_eq!(new(&v, &[0, 1]), Err(MeshError::IndexCount(2)));
        assert_eq!(
            new(&v, &[0, 1, 3]),
            Err(MeshError::IndexOutOfRange {
                index: 3,
                vertices: 3
            })
        );
        assert_eq!(
            new(&v, &[0, 1, -1]),
            Err(MeshError::IndexOutOfRange {
                index: -1,
                vertices: 3
            })
        );
        assert_eq!(new(&[], &[]), Err(MeshError::Empty));
        assert_eq!(
            new(&[f64::NAN, 0., 0.], &[0, 0, 0]),
            Err(MeshError::NotFinite)
        );
        let normals = Mesh::from_flat(&v, &[0, 1, 2], Some(&[1.0; 8])).err();
        assert_eq!(
            normals,
            Some(MeshError::NormalCount {
                found: 8,
                expected: 9
            })
        );
    }

    #[test]
    fn duplicates_merge() {
        let mut soup = tetrahedron();
        soup.append(&tetrahedron(), &Pose::translation(1e-9, 0.0, 0.0));
        soup.merge_duplicates(1e-6);
        assert_eq!(
            (
                soup.vertices.len(),
                soup.triangles.len(),
                soup.normals.len()
            ),
            (4, 4, 12)
        );
        soup.vertices[0] = [-0.0, 0.0, 0.0];
        soup.append(&tetrahedron(), &Pose::identity());
        soup.merge_duplicates(0.0);
        assert_eq!(soup.vertices.len(), 4);
        soup.merge_duplicates(1e9);
        assert!(soup.triangles.is_empty());
    }

    #[test]
    fn convexity_and_volume() {
        close(
            &[tetrahedron().volume(), block([1., 2., 4.]).volume()],
            &[1.0 / 6.0, 8.0],
        );
        assert!(tetrahedron().is_convex() && block([1., 2., 4.]).is_convex());
        let mut two = tetrahedron();
        two.append(&tetrahedron(), &Pose::translation(3., 0., 0.));
        assert!(!two.is_convex());
        let mut dented = block([1., 1., 1.]);
        dented.vertices[0] = [0.1, 0.1, 0.1];
        assert!(!dented.is_convex());
        let mut mirrored = tetrahedron();
        mirrored.scale([-1., 2., 3.]);
        close(&[mirrored.volume()], &[1.0]);
    }
}
