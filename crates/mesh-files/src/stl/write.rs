//! Writes STL: text with the numbers as they are, binary with 32 bits each.

use std::fmt::Write;

use crate::error::WriteError;
use crate::mesh_file::{MeshFile, Part};
use crate::transform::unit;

/// One solid of all parts.
pub(crate) fn write_text(file: &MeshFile) -> Vec<u8> {
    let mut text = String::from("solid\n");
    for corners in triangles(file) {
        let [x, y, z] = normal(corners);
        write!(text, "facet normal {x} {y} {z}\n outer loop\n")
            .expect("writing into a string succeeds");
        for [x, y, z] in corners {
            writeln!(text, "  vertex {x} {y} {z}").expect("writing into a string succeeds");
        }
        text += " endloop\nendfacet\n";
    }
    text += "endsolid\n";
    text.into_bytes()
}

pub(crate) fn write_binary(file: &MeshFile) -> Result<Vec<u8>, WriteError> {
    let count: usize = file.parts.iter().map(|part| part.triangles.len()).sum();
    let count = u32::try_from(count).map_err(|_| WriteError::TooLarge)?;
    let mut bytes = b"binary STL".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for corners in triangles(file) {
        for x in [normal(corners)]
            .as_flattened()
            .iter()
            .chain(corners.as_flattened())
        {
            bytes.extend(numbers::single(*x).to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    Ok(bytes)
}

fn triangles(file: &MeshFile) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let corners = |part: &Part, triangle: &[u32; 3]| {
        triangle.map(|index| part.vertices[numbers::place(index)])
    };
    file.parts.iter().flat_map(move |part| {
        part.triangles
            .iter()
            .map(move |triangle| corners(part, triangle))
    })
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let (u, v) = (minus(b, a), minus(c, a));
    unit([
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ])
}
