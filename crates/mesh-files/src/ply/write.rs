//! Writes PLY: one mesh of all parts, coordinates of 64 bits.

use std::fmt::Write;

use crate::mesh_file::MeshFile;

pub(crate) fn write_text(file: &MeshFile) -> Vec<u8> {
    let mut text = header(file, "ascii");
    for [x, y, z] in vertices(file) {
        writeln!(text, "{x} {y} {z}").expect("writing into a string succeeds");
    }
    for [a, b, c] in triangles(file) {
        writeln!(text, "3 {a} {b} {c}").expect("writing into a string succeeds");
    }
    text.into_bytes()
}

pub(crate) fn write_binary(file: &MeshFile) -> Vec<u8> {
    let mut bytes = header(file, "binary_little_endian").into_bytes();
    for x in vertices(file).flatten() {
        bytes.extend(x.to_le_bytes());
    }
    for triangle in triangles(file) {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|index| index.to_le_bytes()));
    }
    bytes
}

fn header(file: &MeshFile, format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices(file).count(),
        triangles(file).count()
    )
}

fn vertices(file: &MeshFile) -> impl Iterator<Item = [f64; 3]> {
    file.parts
        .iter()
        .flat_map(|part| part.vertices.iter().copied())
}

fn triangles(file: &MeshFile) -> impl Iterator<Item = [u32; 3]> {
    let mut first = 0;
    file.parts.iter().flat_map(move |part| {
        let start = first;
        first += numbers::count_u32(part.vertices.len());
        part.triangles
            .iter()
            .map(move |triangle| triangle.map(|index| index + start))
    })
}
