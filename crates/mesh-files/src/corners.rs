//! Parts from triangles whose corners name a position, a normal and texture coordinates each by an index of its own.

use crate::mesh_file::{Material, Part};
use crate::polygon::triangulate;
use crate::transform::Transform;

/// No normal, no texture coordinates.
pub(crate) const NONE: u32 = u32::MAX;

/// A corner of a triangle: indices into the lists of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub(crate) position: u32,
    pub(crate) normal: u32,
    pub(crate) uv: u32,
}

/// The lists that corners point into.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Lists<'a> {
    pub(crate) positions: &'a [[f64; 3]],
    pub(crate) normals: &'a [[f64; 3]],
    pub(crate) uv: &'a [[f64; 2]],
}

/// Adds the triangles of a polygon, whose positions must be in the list.
pub(crate) fn push_polygon(
    polygon: &[Corner],
    positions: &[[f64; 3]],
    triangles: &mut Vec<[Corner; 3]>,
) {
    if let &[a, b, c] = polygon {
        return triangles.push([a, b, c]);
    }
    let points: Vec<[f64; 3]> = polygon
        .iter()
        .map(|corner| positions[numbers::place(corner.position)])
        .collect();
    triangulate(&points, |triangle| {
        triangles.push(triangle.map(|corner| polygon[corner]));
    });
}

/// A part with only those vertices that triangles use, in the order of the list. Indices must be in the lists or [`NONE`].
pub(crate) fn part(
    name: String,
    lists: Lists,
    corners: &[[Corner; 3]],
    material: Material,
) -> Part {
    let (used, new_index) = used_positions(lists.positions.len(), corners);
    let has = |index: fn(&Corner) -> u32| {
        corners
            .as_flattened()
            .iter()
            .any(|corner| index(corner) != NONE)
    };
    Part {
        name,
        vertices: used
            .iter()
            .map(|&index| lists.positions[numbers::place(index)])
            .collect(),
        triangles: corners
            .iter()
            .map(|triangle| triangle.map(|corner| new_index.of(corner.position)))
            .collect(),
        normals: if has(|corner| corner.normal) {
            attribute(lists.normals, corners, |corner| corner.normal)
        } else {
            Vec::new()
        },
        uv: if has(|corner| corner.uv) {
            attribute(lists.uv, corners, |corner| corner.uv)
        } else {
            Vec::new()
        },
        material,
    }
}

fn attribute<const N: usize>(
    list: &[[f64; N]],
    corners: &[[Corner; 3]],
    index: fn(&Corner) -> u32,
) -> Vec<[[f64; N]; 3]> {
    let value = |corner: Corner| match index(&corner) {
        NONE => [0.0; N],
        index => list[numbers::place(index)],
    };
    corners.iter().map(|triangle| triangle.map(value)).collect()
}

/// How an index into the list becomes one into the vertices of the part.
enum NewIndex {
    Table(Vec<u32>),
    /// Few of a long list are used: a table for each of many small parts would take the square of their number.
    Search(Vec<u32>),
}

impl NewIndex {
    fn of(&self, index: u32) -> u32 {
        match self {
            NewIndex::Table(table) => table[numbers::place(index)],
            NewIndex::Search(used) => {
                numbers::count_u32(used.partition_point(|&other| other < index))
            }
        }
    }
}

/// The indices in use, in order.
fn used_positions(positions: usize, corners: &[[Corner; 3]]) -> (Vec<u32>, NewIndex) {
    let indices = corners.as_flattened().iter().map(|corner| corner.position);
    if corners.len() < positions / 16 {
        let mut used: Vec<u32> = indices.collect();
        used.sort_unstable();
        used.dedup();
        return (used.clone(), NewIndex::Search(used));
    }
    let mut table = vec![NONE; positions];
    indices.for_each(|index| table[numbers::place(index)] = 0);
    let used: Vec<u32> = (0..numbers::count_u32(positions))
        .filter(|&index| table[numbers::place(index)] == 0)
        .collect();
    used.iter()
        .zip(0..)
        .for_each(|(&index, new)| table[numbers::place(index)] = new);
    (used, NewIndex::Table(table))
}

impl Part {
    /// Moves the part by the transform of a node; one that mirrors turns the triangles over, so that they still look outwards.
    pub(crate) fn transform(&mut self, transform: &Transform) {
        self.vertices
            .iter_mut()
            .for_each(|vertex| *vertex = transform.apply(*vertex));
        self.normals
            .as_flattened_mut()
            .iter_mut()
            .for_each(|normal| *normal = transform.normal(*normal));
        if transform.mirrors() {
            self.triangles
                .iter_mut()
                .for_each(|corners| corners.swap(1, 2));
            self.normals
                .iter_mut()
                .for_each(|corners| corners.swap(1, 2));
            self.uv.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
    }
}
