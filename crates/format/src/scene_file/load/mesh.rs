//! Triangles from the arrays shared by the meshes of a file.

use std::collections::HashMap;
use std::rc::Rc;

use geometry::Mesh;
use nalgebra::Vector3;

use crate::ttt::chunks::{MeshData, MeshPool};
use crate::ttt::{File, Indices, Normals, Rest};
use scene::Pose;

/// How far a corner may stand out of a face of a convex mesh, by the mean side of its box.
const CONVEX_TOLERANCE: f64 = 0.015;

/// The arrays of a file, and the meshes made of them so far: what is equal is kept once.
pub(super) struct Meshes<'a> {
    pool: Option<&'a MeshPool>,
    made: HashMap<Key, Rc<Mesh>>,
}

/// Which arrays, and the frame they were moved by.
type Key = ([i32; 3], [u64; 7]);

impl<'a> Meshes<'a> {
    pub(super) fn new(file: &'a File) -> Self {
        Self {
            pool: file.contents.mesh_pool.as_ref(),
            made: HashMap::new(),
        }
    }

    /// The mesh, its vertices moved by `frame`.
    ///
    /// # Errors
    /// In words, when arrays are missing or do not fit each other.
    pub(super) fn mesh(&mut self, data: &MeshData, frame: &Pose) -> Result<Rc<Mesh>, String> {
        let arrays =
            [data.vertices_at, data.indices_at, data.normals_at].map(|at| at.unwrap_or(-1));
        let key = (arrays, bits(frame));
        let shared = arrays[0] >= 0;
        if let Some(mesh) = self.made.get(&key).filter(|_| shared) {
            return Ok(mesh.clone());
        }
        let mut mesh = self.build(data)?;
        if *frame != Pose::identity() {
            mesh.transform(frame);
        }
        let mesh = Rc::new(mesh);
        if shared {
            self.made.insert(key, mesh.clone());
        }
        Ok(mesh)
    }

    fn build(&self, data: &MeshData) -> Result<Mesh, String> {
        let vertices = find(
            self.pool.map(|p| p.vertices.as_slice()),
            data.vertices_at,
            data.vertices.as_ref(),
        );
        let indices = find(
            self.pool.map(|p| p.indices.as_slice()),
            data.indices_at,
            data.indices.as_ref(),
        );
        let normals = find(
            self.pool.map(|p| p.normals.as_slice()),
            data.normals_at,
            data.normals.as_ref(),
        );
        let (Some(Rest(vertices)), Some(Indices(indices))) = (vertices, indices) else {
            return Err("a mesh refers to vertices or indices that are not there".into());
        };
        if !vertices.iter().all(|c| c.is_finite()) {
            return Err("a mesh has a vertex that is not finite".into());
        }
        let points: Vec<[f64; 3]> = vertices
            .as_chunks()
            .0
            .iter()
            .map(|v: &[f32; 3]| v.map(f64::from))
            .collect();
        let triangles: Vec<[u32; 3]> = indices
            .as_chunks()
            .0
            .iter()
            .map(|t: &[i32; 3]| t.map(|i| i.cast_unsigned()))
            .collect();
        if points.is_empty() || triangles.is_empty() {
            return Err("a mesh is empty".into());
        }
        if triangles
            .as_flattened()
            .iter()
            .any(|i| *i as usize >= points.len())
        {
            return Err("a mesh has a triangle whose corner is not there".into());
        }
        let mut mesh = Mesh {
            vertices: points,
            triangles,
            normals: Vec::new(),
        };
        match normals.filter(|Normals(normals)| normals.len() == 9 * mesh.triangles.len()) {
            Some(Normals(normals)) => {
                mesh.normals = normals
                    .as_chunks()
                    .0
                    .iter()
                    .map(|n: &[f32; 3]| n.map(f64::from))
                    .collect();
            }
            None => mesh.compute_normals(data.shading.map_or(0.0, |(angle, _)| angle)),
        }
        Ok(mesh)
    }
}

/// The array of a pool at that index, or the one stored in the mesh itself.
fn find<'a, T>(pool: Option<&'a [T]>, at: Option<i32>, own: Option<&'a T>) -> Option<&'a T> {
    let shared = at.and_then(|at| pool?.get(usize::try_from(at).ok()?));
    shared.or(own)
}

fn bits(frame: &Pose) -> [u64; 7] {
    let (p, q) = (frame.translation, frame.rotation);
    [p.x, p.y, p.z, q.i, q.j, q.k, q.w].map(f64::to_bits)
}

/// Whether no corner stands out of a face by more than a little: the test of programs before 4.5.1.
pub(super) fn is_nearly_convex(mesh: &Mesh) -> bool {
    let Some((low, high)) = mesh.aabb() else {
        return false;
    };
    let side = (0..3).map(|i| high[i] - low[i]).sum::<f64>() / 3.0;
    let points: Vec<Vector3<f64>> = mesh.vertices.iter().map(|v| Vector3::from(*v)).collect();
    let inside = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| points[i as usize]);
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else {
            return true;
        };
        points
            .iter()
            .all(|p| normal.dot(&(p - a)) <= CONVEX_TOLERANCE * side)
    };
    mesh.triangles.iter().all(inside)
}
