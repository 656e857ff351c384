//! Formulas for triangles, boxes and segments against searches and against their faces.

use geometry::Pose;
use nalgebra::Vector3;

use super::brute_force::near;
use super::random::Random;
use crate::placed::Transform;
use crate::primitive::{
    SolidBox, Triangle, Vector, closest_on_segments, closest_on_triangle, closest_on_triangles,
    triangles_touch,
};
use crate::{Geometry, Placed, TriangleMesh, distance};

/// The closest points of triangles by a search over points of one of them: convex, so a golden section in two directions finds it.
fn searched(a: &Triangle, b: &Triangle) -> f64 {
    let on_a = |u: f64, v: f64| a[0] + (a[1] - a[0]) * (u * (1.0 - v)) + (a[2] - a[0]) * (u * v);
    let gap = |u: f64, v: f64| (closest_on_triangle(&on_a(u, v), b) - on_a(u, v)).norm();
    let along = |u: f64| minimum(|v| gap(u, v));
    minimum(along)
}

fn minimum(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..70 {
        let (a, b) = (low + (high - low) * 0.382, low + (high - low) * 0.618);
        if f(a) <= f(b) { high = b } else { low = a }
    }
    f(0.5 * (low + high)).min(f(0.0)).min(f(1.0))
}

#[test]
fn triangles_are_as_far_apart_as_a_search_finds() {
    let mut random = Random::new(13);
    for round in 0..400 {
        let mut triangle = || [(); 3].map(|()| Vector3::from(random.point(1.0)));
        let (a, mut b) = (triangle(), triangle());
        if round % 4 == 0 {
            b[2] = b[1];
        }
        if round % 5 == 0 {
            b.iter_mut().for_each(|p| p.z += 1.5);
        }
        let (p, q, squared) = closest_on_triangles(&a, &b);
        let expected = searched(&a, &b);
        assert!(
            squared.sqrt() <= expected + 1e-9,
            "round {round}: {} is not {expected}",
            squared.sqrt()
        );
        near((closest_on_triangle(&p, &a) - p).norm(), 0.0, 1e-9);
        near((closest_on_triangle(&q, &b) - q).norm(), 0.0, 1e-9);
        assert_eq!(triangles_touch(&a, &b), squared == 0.0, "round {round}");
    }
}

#[test]
fn boxes_are_as_far_from_triangles_and_boxes_as_their_faces() {
    let mut random = Random::new(14);
    for _ in 0..300 {
        let solid = SolidBox {
            centre: random.point(1.0).into(),
            half: Vector::from(random.point(0.4)).abs(),
        };
        let triangle = [(); 3].map(|()| Vector3::from(random.point(2.0)));
        let surface = cuboid(&solid);
        let placed = |mesh| Placed {
            geometry: Geometry::Mesh(mesh),
            pose: Pose::identity(),
        };
        let flat = TriangleMesh::new(&triangle.map(|p| p.into()), &[[0, 1, 2]]).expect("an area");
        let expected = distance(placed(&surface), placed(&flat), f64::INFINITY)
            .expect("no limit")
            .distance;
        let is_inside = solid.closest_to_point(&triangle[0]) == triangle[0];
        near(
            solid.closest_to_triangle(&triangle).2.sqrt(),
            if is_inside { 0.0 } else { expected },
            1e-9,
        );
        let other = SolidBox {
            centre: random.point(1.0).into(),
            half: Vector::from(random.point(0.4)).abs(),
        };
        let pose = random.pose(1.0);
        let moved = cuboid(&other);
        let placed_other = Placed {
            geometry: Geometry::Mesh(&moved),
            pose,
        };
        let expected = distance(placed(&surface), placed_other, f64::INFINITY)
            .expect("no limit")
            .distance;
        let place = Transform::of(&pose);
        let contains = solid.closest_to_point(&place.point(&other.centre))
            == place.point(&other.centre)
            || other.closest_to_point(&place.inverse().point(&solid.centre))
                == place.inverse().point(&solid.centre);
        near(
            solid.closest_to_box(&other, &pose).2.sqrt(),
            if contains { 0.0 } else { expected },
            1e-9,
        );
    }
}

fn cuboid(solid: &SolidBox) -> TriangleMesh {
    let size = (solid.half * 2.0).into();
    let mesh = geometry::primitive::tessellate(geometry::PrimitiveKind::Cuboid, size, false)
        .expect("finite extents");
    let vertices: Vec<[f64; 3]> = mesh
        .vertices
        .iter()
        .map(|v| (Vector::from(*v) + solid.centre).into())
        .collect();
    TriangleMesh::new(&vertices, &mesh.triangles).expect("faces")
}

#[test]
fn nearly_parallel_segments_are_compared_well() {
    let mut random = Random::new(19);
    for _ in 0..2000 {
        let (a, b) = (
            Vector::from(random.point(1.0)),
            Vector::from(random.point(1.0)),
        );
        let small = 10.0_f64.powi(-(random.below(14) as i32));
        let (c, d) = (
            a + Vector::from(random.point(small)),
            b + Vector::from(random.point(small)),
        );
        let found = closest_on_segments([&a, &b], [&c, &d]).2.sqrt();
        let expected = minimum(|t| {
            let p = a + (b - a) * t;
            (crate::primitive::closest_on_segment(&p, &c, &d) - p).norm()
        });
        near(found, expected, 1e-9);
    }
}
