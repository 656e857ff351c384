//! The arrays shared by meshes: equal ones are written once.

use std::collections::HashMap;
use std::rc::Rc;

use geometry::Mesh;

use super::edges;
use crate::ttt::chunks::MeshData;
use crate::ttt::mesh_arrays::{Arrays, MeshArrays, Places};
use scene::Pose;

/// The arrays of a file as it grows.
#[derive(Default)]
pub(super) struct Pool {
    pub(super) arrays: MeshArrays,
    /// Meshes that have been written already: which, in what frame, with edges of which angle.
    written: HashMap<(*const Mesh, [u64; 8]), Written>,
    /// Keeps the meshes of `written` alive, so that no address comes twice.
    kept: Vec<Rc<Mesh>>,
}

/// Where a mesh is in the pool, and the extents of its vertices.
#[derive(Clone, Copy)]
pub(super) struct Written {
    at: Places,
    pub(super) size: [f64; 3],
}

impl Written {
    pub(super) fn refer(&self, data: &mut MeshData) {
        [
            data.vertices_at,
            data.indices_at,
            data.normals_at,
            data.edges_at,
        ] = self.at;
    }
}

impl Pool {
    /// Writes a mesh moved by `frame`.
    pub(super) fn write(&mut self, mesh: &Rc<Mesh>, frame: &Pose, edge_angle: f64) -> Written {
        let key = (Rc::as_ptr(mesh), bits(frame, edge_angle));
        if let Some(written) = self.written.get(&key) {
            return *written;
        }
        let mut moved = (**mesh).clone();
        if *frame != Pose::identity() {
            moved.transform(frame);
        }
        let written = self.add(&moved, edge_angle);
        self.written.insert(key, written);
        self.kept.push(Rc::clone(mesh));
        written
    }

    fn add(&mut self, mesh: &Mesh, edge_angle: f64) -> Written {
        let singles = |list: &[[f64; 3]]| {
            list.as_flattened()
                .iter()
                .map(|c| numbers::single(*c))
                .collect::<Vec<f32>>()
        };
        let arrays = Arrays {
            vertices: singles(&mesh.vertices),
            indices: mesh
                .triangles
                .as_flattened()
                .iter()
                .map(|i| (*i).cast_signed())
                .collect(),
            normals: Some(singles(&mesh.normals)),
            edges: Some(edges::drawn(mesh, edge_angle)),
        };
        let (low, high) = mesh.aabb().unwrap_or_default();
        Written {
            at: self.arrays.add(arrays),
            size: std::array::from_fn(|axis| high[axis] - low[axis]),
        }
    }
}

fn bits(frame: &Pose, edge_angle: f64) -> [u64; 8] {
    let (p, q) = (frame.translation, frame.rotation);
    [p.x, p.y, p.z, q.i, q.j, q.k, q.w, edge_angle].map(f64::to_bits)
}
