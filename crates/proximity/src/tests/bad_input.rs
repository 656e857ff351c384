//! What is not finite or degenerate finds nothing.

use geometry::Pose;

use super::brute_force::{Things, near};
use super::random::Random;
use crate::{
    Filter, Geometry, Piece, Placed, PointSet, TriangleMesh, Volume, VoxelGrid, cast_ray,
    closest_in_volume, distance, intersection_segments, intersects,
};

#[test]
fn what_is_not_finite_finds_nothing() {
    let mut random = Random::new(20);
    let (things, others) = (Things::new(&mut random, 1.0), Things::new(&mut random, 1.0));
    let filter = Filter {
        max_angle: Some(f64::NAN),
        ..Filter::default()
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        let wrong = Pose::translation(bad, 0.0, 0.0);
        for (geometry, other) in things
            .geometries()
            .into_iter()
            .zip(others.geometries().into_iter().rev())
        {
            let (a, b) = (
                Placed {
                    geometry,
                    pose: wrong,
                },
                Placed {
                    geometry: other,
                    pose: Pose::identity(),
                },
            );
            assert_eq!(
                (distance(a, b, f64::INFINITY), distance(b, a, f64::INFINITY)),
                (None, None)
            );
            assert_eq!(
                (distance(b, b, f64::NAN), distance(b, b, -1.0)),
                (None, None)
            );
            assert!(!intersects(a, b) && intersection_segments(a, b).is_empty());
            let everything = Volume {
                pieces: vec![Piece::default()],
            };
            assert_eq!(
                cast_ray(a, &Pose::identity(), [0.0, 0.0, 1.0], [0.0, 1e9], &filter),
                None
            );
            assert_eq!(
                cast_ray(b, &wrong, [0.0, 0.0, 1.0], [0.0, 1e9], &filter),
                None
            );
            assert_eq!(
                closest_in_volume(a, &Pose::identity(), &everything, f64::INFINITY, &filter),
                None
            );
            for way in [[0.0; 3], [f64::NAN; 3], [f64::INFINITY, 0.0, 0.0]] {
                assert_eq!(
                    cast_ray(b, &Pose::identity(), way, [0.0, 1e9], &Filter::default()),
                    None
                );
            }
            assert_eq!(
                cast_ray(
                    b,
                    &Pose::identity(),
                    [1.0; 3],
                    [f64::NAN; 2],
                    &Filter::default()
                ),
                None
            );
            let crooked = Volume {
                pieces: vec![[[f64::NAN, 0.0, 0.0, 0.0]].into_iter().collect()],
            };
            assert_eq!(
                closest_in_volume(b, &Pose::identity(), &crooked, f64::INFINITY, &filter),
                None
            );
        }
    }
}

#[test]
fn geometries_leave_out_what_is_degenerate() {
    assert!(TriangleMesh::new(&[], &[]).is_none());
    assert!(TriangleMesh::new(&[[0.0; 3]; 3], &[[0, 1, 2]]).is_none());
    assert!(TriangleMesh::new(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]).is_none());
    assert!(
        TriangleMesh::new(&[[f64::NAN; 3], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]).is_none()
    );
    assert!(TriangleMesh::new(&[[0.0; 3]], &[[0, 1, 2]]).is_none());
    let mixed = [
        [0., 0., 0.],
        [1., 0., 0.],
        [0., 1., 0.],
        [f64::INFINITY, 0., 0.],
    ];
    assert_eq!(
        TriangleMesh::new(&mixed, &[[0, 1, 2], [0, 1, 3], [0, 0, 1]]).map(|mesh| mesh.len()),
        Some(1)
    );
    assert!(VoxelGrid::new(0.0, [[0.0; 3]].into_iter()).is_none());
    assert!(VoxelGrid::new(f64::NAN, [[0.0; 3]].into_iter()).is_none());
    assert!(VoxelGrid::new(0.1, [[f64::NAN; 3]].into_iter()).is_none());
    assert!(PointSet::new(&[[f64::NAN; 3]]).is_none());
    let same = vec![[0.5; 3]; 3000];
    let points = PointSet::new(&same).expect("points");
    let placed = Placed {
        geometry: Geometry::Points(&points),
        pose: Pose::identity(),
    };
    let origin = Placed {
        geometry: Geometry::Point,
        pose: Pose::identity(),
    };
    near(
        distance(placed, origin, 1.0).expect("near").distance,
        0.75_f64.sqrt(),
        1e-12,
    );
}
