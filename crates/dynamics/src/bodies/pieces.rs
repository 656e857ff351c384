//! The convex pieces of a mesh, by parry's V-HACD. For the meshes of a robot they take seconds.

use file_cache::Key;
use geometry::Mesh;
use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::shape::ConvexPolyhedron;
use rapier3d_f64::parry::transformation::vhacd::{VHACD, VHACDParameters};
use rapier3d_f64::prelude::SharedShape;

use super::hull_shape::hull_shape;
use super::kept_hulls::Hull;
use crate::convert::{from_vector, to_vector};

/// How pieces are computed; another text for each change that may give other pieces. The parameters are parry's own.
const ALGORITHM: &str = "convex pieces: parry3d-f64 0.31.1, V-HACD, exact hulls; 1";

/// What the pieces of a mesh depend on.
pub(super) fn key(mesh: &Mesh) -> Key {
    let coordinates = mesh.vertices.as_flattened().iter();
    let coordinates: Vec<[u8; 8]> = coordinates.map(|x| x.to_le_bytes()).collect();
    let corners = mesh.triangles.as_flattened().iter();
    let corners: Vec<[u8; 4]> = corners.map(|corner| corner.to_le_bytes()).collect();
    let [coordinates, corners] = [coordinates.as_flattened(), corners.as_flattened()];
    Key::of(&[ALGORITHM.as_bytes(), coordinates, corners])
}

/// The convex pieces of a mesh; none if it has no inside.
pub(super) fn hulls(mesh: &Mesh) -> Vec<Hull> {
    let points = super::colliders::points(mesh);
    let hulls = VHACD::decompose(&VHACDParameters::default(), &points, &mesh.triangles, true)
        .compute_exact_convex_hulls(&points, &mesh.triangles);
    let hull = |(points, triangles): (Vec<Vector>, _)| Hull {
        points: points.into_iter().map(from_vector).collect(),
        triangles,
    };
    // Parts within the mesh meet no triangle of it.
    let hulls = hulls.into_iter().map(hull);
    hulls.filter(|hull| !hull.triangles.is_empty()).collect()
}

/// Whether hulls lie in the box around a mesh, but for rounding errors.
pub(super) fn are_within(hulls: &[Hull], mesh: &Mesh) -> bool {
    let Some((low, high)) = mesh.aabb() else {
        return hulls.is_empty();
    };
    let is_within = |point: &[f64; 3]| {
        (0..3).all(|axis| {
            let slack = 1e-9 * low[axis].abs().max(high[axis].abs());
            (low[axis] - slack..=high[axis] + slack).contains(&point[axis])
        })
    };
    hulls.iter().flat_map(|hull| &hull.points).all(is_within)
}

/// One form of all pieces that rapier takes; None without any.
pub(super) fn form(hulls: &[Hull]) -> Option<SharedShape> {
    let piece = |hull: &Hull| {
        let points = hull.points.iter().map(|&point| to_vector(point));
        ConvexPolyhedron::from_convex_mesh(points.collect(), &hull.triangles).map(hull_shape)
    };
    let parts: Vec<_> = hulls
        .iter()
        .filter_map(piece)
        .map(|piece| (EnginePose::IDENTITY, piece))
        .collect();
    (!parts.is_empty()).then(|| SharedShape::compound(parts))
}

#[cfg(test)]
mod tests {
    use super::super::kept_hulls::{decode, encode};
    use super::*;

    #[test]
    fn the_algorithm_names_its_library() {
        let manifest = include_str!("../../../../Cargo.toml");
        let version = manifest
            .split_once("parry3d-f64 = { version = \"=")
            .and_then(|(_, rest)| rest.split_once('"'));
        let (version, _) = version.expect("the version of parry is fixed");
        assert!(
            ALGORITHM.contains(&format!("parry3d-f64 {version},")),
            "another version of parry may divide meshes differently: name it in ALGORITHM"
        );
    }

    #[test]
    fn what_is_read_from_damaged_bytes_is_a_form() {
        let tetrahedron = Hull {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        };
        let bytes = encode(&[tetrahedron.clone(), tetrahedron]);
        let read = |bytes: &[u8]| decode(bytes).map(|hulls| form(&hulls).is_some());
        for (at, bits) in (0..bytes.len()).flat_map(|at| [1, 2, 4, 0x80].map(|bits| (at, bits))) {
            let mut damaged = bytes.clone();
            damaged[at] ^= bits;
            assert_ne!(read(&damaged), Some(false), "byte {at}");
            let other = (at * 7 + usize::from(bits)) % bytes.len();
            damaged.swap(at, other);
            assert_ne!(read(&damaged), Some(false), "bytes {at} and {other}");
        }
    }

    #[test]
    fn the_key_is_of_the_content() {
        let mesh = Mesh::new(
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            vec![[0, 1, 2]],
        );
        let mesh = mesh.expect("it is a mesh");
        assert_eq!(key(&mesh), key(&mesh.clone()));
        let mut other = mesh.clone();
        other.vertices[2][1] = 1.0 + f64::EPSILON;
        assert_ne!(key(&mesh), key(&other));
        let mut other = mesh.clone();
        other.triangles[0] = [1, 2, 0];
        assert_ne!(key(&mesh), key(&other));
    }
}
