//! Voxels seen by sensors, against meshes of their faces.

use geometry::primitive::tessellate;
use geometry::{Pose, PrimitiveKind};

use super::random::Random;
use crate::{
    Filter, Geometry, Placed, TriangleMesh, Volume, VoxelGrid, cast_ray, closest_in_volume,
};

/// Cells of 0.25 m, and the triangles of all their faces.
fn cells(random: &mut Random) -> (VoxelGrid, TriangleMesh) {
    let cube = tessellate(PrimitiveKind::Cuboid, [0.25; 3], false).expect("finite extents");
    let centres: Vec<[f64; 3]> = (0..30)
        .map(|_| [(); 3].map(|()| 0.25 * f64::from(random.below(8)) - 0.9))
        .collect();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for centre in &centres {
        let first = vertices.len() as u32;
        triangles.extend(
            cube.triangles
                .iter()
                .map(|triangle| triangle.map(|i| i + first)),
        );
        vertices.extend(
            cube.vertices
                .iter()
                .map(|v| [v[0] + centre[0], v[1] + centre[1], v[2] + centre[2]]),
        );
    }
    let mesh = TriangleMesh::new(&vertices, &triangles).expect("faces");
    (
        VoxelGrid::new(0.25, centres.into_iter()).expect("cells"),
        mesh,
    )
}

fn filter(random: &mut Random) -> Filter {
    let max_angle = (random.below(2) == 0).then_some(0.8);
    Filter {
        front: random.below(3) > 0,
        back: random.below(3) > 0,
        max_angle,
        any: false,
    }
}

#[track_caller]
fn same(a: Option<f64>, b: Option<f64>) {
    match (a, b) {
        (Some(a), Some(b)) => assert!((a - b).abs() < 1e-9, "{a} is not {b}"),
        _ => assert_eq!(a, b),
    }
}

#[test]
fn rays_see_the_faces_of_voxels() {
    let mut random = Random::new(31);
    for _ in 0..60 {
        let (grid, mesh) = cells(&mut random);
        let pose = random.pose(0.5);
        for _ in 0..20 {
            let (sensor, direction, filter) =
                (random.pose(2.0), random.point(1.0), filter(&mut random));
            let ask = |geometry| {
                let on = Placed { geometry, pose };
                cast_ray(on, &sensor, direction, [0.1, 3.0], &filter).map(|hit| hit.distance)
            };
            same(ask(Geometry::Voxels(&grid)), ask(Geometry::Mesh(&mesh)));
        }
    }
}

#[test]
fn volumes_see_the_faces_of_voxels() {
    let mut random = Random::new(32);
    for _ in 0..60 {
        let (grid, mesh) = cells(&mut random);
        let pose = random.pose(0.5);
        for _ in 0..10 {
            let (sensor, filter) = (random.pose(2.0), filter(&mut random));
            let plane = |random: &mut Random| {
                [
                    random.number(),
                    random.number(),
                    random.number(),
                    random.number(),
                ]
            };
            let volume = Volume {
                pieces: vec![(0..4).map(|_| plane(&mut random)).collect()],
            };
            // Of a square another point may be seen at the angle than of its triangles.
            let filter = Filter {
                max_angle: None,
                ..filter
            };
            let ask = |geometry| {
                let on = Placed { geometry, pose };
                closest_in_volume(on, &sensor, &volume, f64::INFINITY, &filter)
                    .map(|hit| hit.distance)
            };
            same(ask(Geometry::Voxels(&grid)), ask(Geometry::Mesh(&mesh)));
        }
    }
}

#[test]
fn a_ray_from_inside_of_a_voxel_sees_its_back() {
    let grid = VoxelGrid::new(0.2, [[0.0; 3]].into_iter()).expect("a cell");
    let on = Placed {
        geometry: Geometry::Voxels(&grid),
        pose: Pose::identity(),
    };
    let ask = |filter| cast_ray(on, &Pose::identity(), [1.0, 0.0, 0.0], [0.0, 1.0], &filter);
    let hit = ask(Filter::default()).expect("the far face");
    assert!((hit.distance - 0.1).abs() < 1e-12 && hit.normal == [1.0, 0.0, 0.0]);
    assert_eq!(
        ask(Filter {
            back: false,
            ..Filter::default()
        }),
        None
    );
}
