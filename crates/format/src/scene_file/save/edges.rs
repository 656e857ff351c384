//! Visible edges of a mesh: boundary edges, and edges between faces at an angle.

use std::collections::HashMap;

use geometry::Mesh;

/// One bit per edge of each triangle, from the lowest bit on.
pub(super) fn drawn(mesh: &Mesh, threshold: f64) -> Vec<u8> {
    let normals: Vec<[f64; 3]> = mesh
        .triangles
        .iter()
        .map(|triangle| normal(mesh, *triangle))
        .collect();
    let mut faces: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        (0..3).for_each(|corner| faces.entry(edge(*triangle, corner)).or_default().push(face));
    }
    let mut bits = vec![0u8; (3 * mesh.triangles.len()).div_ceil(8)];
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        for corner in 0..3 {
            if is_sharp(
                &faces[&edge(*triangle, corner)],
                &normals,
                libm::cos(threshold),
            ) {
                let at = 3 * face + corner;
                bits[at / 8] |= 1 << (at % 8);
            }
        }
    }
    bits
}

fn edge(triangle: [u32; 3], corner: usize) -> (u32, u32) {
    let (a, b) = (triangle[corner], triangle[(corner + 1) % 3]);
    (a.min(b), a.max(b))
}

fn is_sharp(faces: &[usize], normals: &[[f64; 3]], cosine: f64) -> bool {
    match faces {
        [a, b] => (0..3).map(|i| normals[*a][i] * normals[*b][i]).sum::<f64>() <= cosine,
        _ => true,
    }
}

fn normal(mesh: &Mesh, triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|i| nalgebra::Vector3::from(mesh.vertices[i as usize]));
    (b - a)
        .cross(&(c - a))
        .try_normalize(0.0)
        .unwrap_or_default()
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_edges_are_not_drawn() {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh {
            vertices,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            normals: Vec::new(),
        };
        assert_eq!(drawn(&mesh, 0.5), [0b110_011]);
        assert_eq!(drawn(&mesh, 0.0), [0b111_111]);
    }
}
