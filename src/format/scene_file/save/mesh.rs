//! The arrays that meshes share: equal ones stand in the file once.

use std::collections::HashMap;
use std::hash::Hash;
use std::rc::Rc;

use super::edges;
use crate::format::ttt::chunks::{MeshData, MeshPool};
use crate::format::ttt::{Indices, Normals, Rest};
use crate::scene::Pose;
use crate::scene::mesh::Mesh;

/// The arrays of a file as it grows.
#[derive(Default)]
pub(super) struct Pool {
    pub(super) chunk: MeshPool,
    /// Where arrays are, by their bits.
    vertices: HashMap<Vec<u32>, i32>,
    indices: HashMap<Vec<i32>, i32>,
    normals: HashMap<Vec<u32>, i32>,
    edges: HashMap<Vec<u8>, i32>,
    /// Meshes that have been written already: which, in what frame, with edges of which angle.
    written: HashMap<(*const Mesh, [u64; 8]), Written>,
    /// Keeps the meshes of `written` alive, so that no address comes twice.
    kept: Vec<Rc<Mesh>>,
}

/// Where a mesh is in the pool, and the extents of its vertices.
#[derive(Clone, Copy)]
pub(super) struct Written {
    at: [i32; 4],
    pub(super) size: [f64; 3],
}

impl Written {
    pub(super) fn refer(&self, data: &mut MeshData) {
        let [vertices, indices, normals, edges] = self.at.map(Some);
        (data.vertices_at, data.indices_at, data.normals_at, data.edges_at) = (vertices, indices, normals, edges);
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
        let singles = |list: &[[f64; 3]]| list.as_flattened().iter().map(|c| *c as f32).collect::<Vec<f32>>();
        let (vertices, normals) = (singles(&mesh.vertices), singles(&mesh.normals));
        let indices: Vec<i32> = mesh.triangles.as_flattened().iter().map(|i| *i as i32).collect();
        let drawn = edges::drawn(mesh, edge_angle);
        let (low, high) = mesh.aabb().unwrap_or_default();
        Written {
            at: [
                place(&mut self.vertices, float_bits(&vertices), &mut self.chunk.vertices, || Rest(vertices)),
                place(&mut self.indices, indices.clone(), &mut self.chunk.indices, || Indices(indices)),
                place(&mut self.normals, float_bits(&normals), &mut self.chunk.normals, || Normals(normals)),
                place(&mut self.edges, drawn.clone(), &mut self.chunk.edges, || Rest(drawn)),
            ],
            size: std::array::from_fn(|axis| high[axis] - low[axis]),
        }
    }
}

/// Where an array is in the list, after it was added if it was not there.
fn place<K: Hash + Eq, T>(known: &mut HashMap<K, i32>, key: K, list: &mut Vec<T>, array: impl FnOnce() -> T) -> i32 {
    *known.entry(key).or_insert_with(|| {
        list.push(array());
        list.len() as i32 - 1
    })
}

fn float_bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn bits(frame: &Pose, edge_angle: f64) -> [u64; 8] {
    let (p, q) = (frame.translation, frame.rotation);
    [p.x, p.y, p.z, q.i, q.j, q.k, q.w, edge_angle].map(f64::to_bits)
}
