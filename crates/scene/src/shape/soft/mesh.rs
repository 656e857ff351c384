//! The mesh of a cloth or volume.

use std::collections::BTreeMap;

use geometry::Mesh;
use nalgebra::Vector3;

use super::body::Body;

/// The mesh of a body with its points in their places, without the triangles that are broken. An open cloth has two sides and a rim, as far apart as it is thick.
pub(super) fn of_body(body: &Body, points: &[[f64; 3]], broken: &[bool]) -> Mesh {
    let is_whole = |triangle: &usize| !broken.get(*triangle).copied().unwrap_or(false);
    let whole = (0..body.triangles.len()).filter(is_whole);
    let triangles: Vec<[u32; 3]> = whole.map(|triangle| body.triangles[triangle]).collect();
    let rim = rim(&triangles);
    let normals = normals(&triangles, points);
    let side = |sign: f64| {
        let moved = points.iter().zip(&normals);
        moved.map(move |(point, normal)| -> [f64; 3] {
            (Vector3::from(*point) + normal * (sign * body.radius)).into()
        })
    };
    let mut mesh = Mesh::default();
    mesh.vertices.extend(side(1.0));
    mesh.triangles.clone_from(&triangles);
    if body.is_volume() || rim.is_empty() {
        return mesh;
    }
    let count = points.len() as u32;
    mesh.vertices.extend(side(-1.0));
    let back = triangles
        .iter()
        .map(|[a, b, c]| [a + count, c + count, b + count]);
    mesh.triangles.extend(back);
    let around = rim
        .iter()
        .flat_map(|[a, b]| [[*b, *a, a + count], [*b, a + count, b + count]]);
    mesh.triangles.extend(around);
    mesh
}

/// The edges of one triangle only, in its direction.
fn rim(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut edges: BTreeMap<[u32; 2], ([u32; 2], usize)> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[*a, *b], [*b, *c], [*c, *a]] {
            let name = [from.min(to), from.max(to)];
            edges.entry(name).or_insert(([from, to], 0)).1 += 1;
        }
    }
    let own = edges.into_values().filter(|(_, count)| *count == 1);
    own.map(|(edge, _)| edge).collect()
}

/// The normals of all points, by the areas of their triangles.
fn normals(triangles: &[[u32; 3]], points: &[[f64; 3]]) -> Vec<Vector3<f64>> {
    let mut normals = vec![Vector3::zeros(); points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|index| Vector3::from(points[index as usize]));
        let normal = (b - a).cross(&(c - a));
        triangle
            .iter()
            .for_each(|index| normals[*index as usize] += normal);
    }
    let unit = |normal: Vector3<f64>| normal.try_normalize(0.0).unwrap_or_default();
    normals.into_iter().map(unit).collect()
}
