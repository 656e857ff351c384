//! The arrays that the meshes of a file share, as they are collected: equal ones stand in the file once.

use std::collections::HashMap;
use std::hash::Hash;

use super::chunks::MeshPool;
use super::{Indices, Normals, Rest};

/// Where the vertices, indices, normals and edges of a mesh are in the pool of a file.
pub type Places = [Option<i32>; 4];

/// The arrays of one mesh; normals and edges may be missing.
pub struct Arrays {
    pub vertices: Vec<f32>,
    pub indices: Vec<i32>,
    pub normals: Option<Vec<f32>>,
    pub edges: Option<Vec<u8>>,
}

/// A pool that grows, and where its arrays are, by their bits.
#[derive(Default)]
pub struct MeshArrays {
    pub pool: MeshPool,
    vertices: HashMap<Vec<u32>, i32>,
    indices: HashMap<Vec<i32>, i32>,
    normals: HashMap<Vec<u32>, i32>,
    edges: HashMap<Vec<u8>, i32>,
}

impl MeshArrays {
    /// Where the arrays are, after those that were not there yet were added.
    pub fn add(&mut self, mesh: Arrays) -> Places {
        let Self {
            pool,
            vertices,
            indices,
            normals,
            edges,
        } = self;
        [
            Some(place(
                vertices,
                bits(&mesh.vertices),
                &mut pool.vertices,
                Rest(mesh.vertices),
            )),
            Some(place(
                indices,
                mesh.indices.clone(),
                &mut pool.indices,
                Indices(mesh.indices),
            )),
            mesh.normals
                .map(|list| place(normals, bits(&list), &mut pool.normals, Normals(list))),
            mesh.edges
                .map(|list| place(edges, list.clone(), &mut pool.edges, Rest(list))),
        ]
    }
}

fn place<K: Hash + Eq, T>(known: &mut HashMap<K, i32>, key: K, list: &mut Vec<T>, array: T) -> i32 {
    *known.entry(key).or_insert_with(|| {
        list.push(array);
        numbers::count_i32(list.len()) - 1
    })
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_arrays_are_kept_once() {
        let mesh = |z, edges| Arrays {
            vertices: vec![0.0, 0.0, z],
            indices: vec![0, 0, 0],
            normals: None,
            edges,
        };
        let mut arrays = MeshArrays::default();
        assert_eq!(arrays.add(mesh(1.0, None)), [Some(0), Some(0), None, None]);
        assert_eq!(
            arrays.add(mesh(2.0, Some(vec![7]))),
            [Some(1), Some(0), None, Some(0)]
        );
        assert_eq!(
            arrays.add(mesh(1.0, Some(vec![7]))),
            [Some(0), Some(0), None, Some(0)]
        );
        assert_eq!(
            (
                arrays.pool.vertices.len(),
                arrays.pool.indices.len(),
                arrays.pool.edges.len()
            ),
            (2, 1, 1)
        );
    }
}
