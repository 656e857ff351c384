//! The numbers of the specification, and what follows from geometry (spec: sensors 1.2, sensors 2).

use std::f64::consts::PI;

use geometry::{Pose, PrimitiveKind};
use nalgebra::{UnitQuaternion, Vector3};

use super::{at, close, cube, point, primitive};
use crate::{
    Closest, Filter, Geometry, Hit, Placed, PointSet, TriangleMesh, Volume, VoxelGrid, cast_ray,
    closest_in_volume, distance, intersection_segments, intersects,
};

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const EVERYWHERE: f64 = f64::INFINITY;

fn turned(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
}

fn up(on: Placed, range: [f64; 2]) -> Option<Hit> {
    cast_ray(on, &Pose::identity(), UP, range, &Filter::default())
}

#[track_caller]
fn expect_distance(a: Placed, b: Placed, expected: f64) -> Closest {
    let forth = distance(a, b, EVERYWHERE).expect("no limit");
    let back = distance(b, a, EVERYWHERE).expect("no limit");
    close(&[forth.distance, back.distance], &[expected; 2], 1e-9);
    let between = Vector3::from(forth.points[1]) - Vector3::from(forth.points[0]);
    close(&[between.norm()], &[expected], 1e-9);
    forth
}

/// Four planes of a square with half width `half` around the z axis, from z = `near` to z = `far`.
fn shaft(half: f64, near: f64, far: f64) -> Volume {
    let sides = [
        [1., 0., 0., -half],
        [-1., 0., 0., -half],
        [0., 1., 0., -half],
        [0., -1., 0., -half],
    ];
    Volume {
        pieces: vec![
            sides
                .into_iter()
                .chain([[0., 0., -1., near], [0., 0., 1., -far]])
                .collect(),
        ],
    }
}

#[test]
fn rays_v1_v2_v3_v6() {
    let mesh = cube(0.2);
    let on = at(&mesh, 0.03, 0.02, 0.5);
    let hit = up(on, [0.0, 1.0]).expect("the cube is in the way");
    close(&[hit.distance], &[0.4], 1e-12);
    close(&hit.point, &[0.0, 0.0, 0.4], 1e-12);
    close(&hit.normal, &[0.0, 0.0, -1.0], 1e-12);
    close(
        &[up(on, [0.3, 0.8]).expect("in range").distance],
        &[0.4],
        1e-12,
    );
    let behind = up(on, [0.45, 0.95]).expect("the back is in range");
    close(&[behind.distance, behind.normal[2]], &[0.6, 1.0], 1e-12);
    assert_eq!(up(at(&mesh, 0.0, 0.0, 5.0), [0.0, 1.0]), None);
    let down =
        Pose::translation(0.0, 0.0, 1.0) * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI);
    let hit = cast_ray(
        at(&mesh, 0.03, 0.02, 0.0),
        &down,
        UP,
        [0.0, 2.0],
        &Filter::default(),
    )
    .expect("below");
    close(&hit.point, &[0.0, 0.0, 0.9], 1e-12);
    close(&hit.normal, &[0.0, 0.0, -1.0], 1e-12);
}

#[test]
fn rays_through_shared_edges_and_corners_hit() {
    let mesh = cube(0.2);
    for (x, y) in [
        (0.0, 0.0),
        (0.05, 0.05),
        (-0.05, 0.05),
        (0.1, 0.0),
        (0.1, 0.1),
        (-0.1, 0.1),
    ] {
        let hit = up(at(&mesh, x, y, 0.5), [0.0, 1.0]);
        assert!(hit.is_some(), "({x}, {y})");
        close(
            &[hit.expect("an edge belongs to the cube").distance],
            &[0.4],
            1e-12,
        );
    }
    let ball = primitive(PrimitiveKind::Spheroid, 0.2);
    close(
        &[up(at(&ball, 0.0, 0.0, 1.0), [0.0, 2.0])
            .expect("the pole")
            .distance],
        &[0.9],
        1e-12,
    );
}

#[test]
fn rays_see_the_sides_and_angles_they_are_asked_for() {
    let mesh = cube(0.2);
    let ask = |front, back, max_angle| {
        let turn = Pose::from_parts(
            Vector3::new(0.0, 0.0, 1.0).into(),
            UnitQuaternion::from_euler_angles(0.0, 0.3, 0.0),
        );
        let on = Placed {
            geometry: Geometry::Mesh(&mesh),
            pose: turn,
        };
        let filter = Filter {
            front,
            back,
            max_angle,
            any: false,
        };
        cast_ray(on, &Pose::identity(), UP, [0.0, 5.0], &filter).map(|hit| hit.distance)
    };
    let reach = 0.1 / 0.3_f64.cos();
    close(
        &[ask(true, false, None).expect("front")],
        &[1.0 - reach],
        1e-12,
    );
    close(
        &[ask(false, true, None).expect("back")],
        &[1.0 + reach],
        1e-12,
    );
    assert_eq!(ask(false, false, None), None);
    close(
        &[ask(true, true, Some(0.31)).expect("steep enough")],
        &[1.0 - reach],
        1e-12,
    );
    assert_eq!(ask(true, true, Some(0.29)), None);
}

#[test]
fn volumes_v5_clip_triangles() {
    let mesh = cube(0.2);
    let filter = Filter::default();
    let ask = |volume: &Volume, on, below| {
        closest_in_volume(on, &Pose::identity(), volume, below, &filter)
    };
    let hit = ask(&shaft(0.25, 0.0, 1.0), at(&mesh, 0.2, 0.0, 0.5), EVERYWHERE).expect("inside");
    close(&[hit.distance], &[0.412310563], 1e-9);
    close(&hit.point, &[0.1, 0.0, 0.4], 1e-12);
    let cut = ask(
        &shaft(0.05, 0.45, 1.0),
        at(&mesh, 0.0, 0.0, 0.5),
        EVERYWHERE,
    )
    .expect("only the back is inside");
    close(&cut.point, &[0.0, 0.0, 0.6], 1e-12);
    assert_eq!(
        ask(
            &shaft(0.05, 0.45, 0.55),
            at(&mesh, 0.0, 0.0, 0.5),
            EVERYWHERE
        ),
        None
    );
    assert_eq!(
        ask(&shaft(0.25, 0.0, 1.0), at(&mesh, 0.2, 0.0, 0.5), 0.4123),
        None
    );
    let moved = Pose::translation(1.0, 2.0, 3.0) * turned(0.7);
    let on = Placed {
        geometry: Geometry::Mesh(&mesh),
        pose: moved * Pose::translation(0.2, 0.0, 0.5),
    };
    let hit =
        closest_in_volume(on, &moved, &shaft(0.25, 0.0, 1.0), EVERYWHERE, &filter).expect("inside");
    close(&hit.point, &[0.1, 0.0, 0.4], 1e-12);
    close(
        &[hit.normal[2].abs().max(hit.normal[0].abs())],
        &[1.0],
        1e-12,
    );
}

#[test]
fn volumes_are_unions_and_see_points() {
    let [near, far] = [shaft(0.1, 0.2, 0.3), shaft(0.1, 0.8, 0.9)].map(|volume| volume.pieces);
    let volume = Volume {
        pieces: [far, near].concat(),
    };
    let ask = |z: f64| {
        let hit = closest_in_volume(
            point(0.0, 0.0, z),
            &Pose::identity(),
            &volume,
            EVERYWHERE,
            &Filter::default(),
        );
        hit.map(|hit| (hit.distance, hit.normal))
    };
    assert_eq!(ask(0.25), Some((0.25, UP)));
    assert_eq!(ask(0.85), Some((0.85, UP)));
    assert_eq!(ask(0.5), None);
    let points =
        PointSet::new(&[[0.0, 0.0, 0.85], [0.05, 0.0, 0.25], [f64::NAN; 3]]).expect("two points");
    let on = Placed {
        geometry: Geometry::Points(&points),
        pose: Pose::identity(),
    };
    let hit = closest_in_volume(
        on,
        &Pose::identity(),
        &volume,
        EVERYWHERE,
        &Filter::default(),
    )
    .expect("inside");
    close(&hit.point, &[0.05, 0.0, 0.25], 1e-15);
    assert_eq!(
        cast_ray(on, &Pose::identity(), UP, [0.0, 1.0], &Filter::default()),
        None
    );
}

#[test]
fn distances_v7_v8_v9() {
    let (mesh, small) = (cube(0.2), cube(0.05));
    expect_distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 1.0, 0.0, 0.0), 0.8);
    let corners = expect_distance(
        at(&mesh, 0.0, 0.0, 0.0),
        at(&mesh, 0.5, 0.5, 0.5),
        0.3 * 3.0_f64.sqrt(),
    );
    close(
        corners.points.as_flattened(),
        &[0.1, 0.1, 0.1, 0.4, 0.4, 0.4],
        1e-12,
    );
    assert_eq!(
        distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 1.0, 0.0, 0.0), 0.5),
        None
    );
    let exact = distance(
        at(&mesh, 0.0, 0.0, 0.0),
        at(&mesh, 1.0, 0.0, 0.0),
        EVERYWHERE,
    )
    .expect("no limit")
    .distance;
    assert_eq!(
        distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 1.0, 0.0, 0.0), exact),
        None
    );
    expect_distance(point(0.0, 0.0, 0.5), at(&mesh, 0.0, 0.0, 0.0), 0.4);
    expect_distance(point(0.0, 0.0, 0.5), point(0.0, 0.3, 0.1), 0.5);
    assert!(intersects(
        at(&mesh, 0.0, 0.0, 0.0),
        at(&mesh, 0.15, 0.0, 0.0)
    ));
    let crossing = expect_distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.15, 0.03, 0.02), 0.0);
    assert_eq!(crossing.distance, 0.0);
    assert!(!intersects(
        at(&mesh, 0.0, 0.0, 0.0),
        at(&small, 0.0, 0.0, 0.0)
    ));
    expect_distance(at(&mesh, 0.0, 0.0, 0.0), at(&small, 0.0, 0.0, 0.0), 0.075);
    expect_distance(point(0.0, 0.0, 0.0), at(&mesh, 0.02, 0.0, 0.0), 0.08);
}

#[test]
fn tessellated_distances_3_to_7() {
    let ball = primitive(PrimitiveKind::Spheroid, 0.2);
    let turn = Placed {
        geometry: Geometry::Mesh(&ball),
        pose: Pose::translation(0.5, 0.0, 0.0) * turned(PI / 32.0),
    };
    expect_distance(at(&ball, 0.0, 0.0, 0.0), at(&ball, 0.5, 0.0, 0.0), 0.3);
    expect_distance(at(&ball, 0.0, 0.0, 0.0), turn, 0.3004815273);
    expect_distance(at(&ball, 0.0, 0.0, 0.0), point(0.0, 0.0, 0.0), 0.0990438351);
    let s = 1.0 / 3.0_f64.sqrt();
    expect_distance(at(&ball, 0.0, 0.0, 0.0), point(s, s, s), 0.9000388081);
    let cylinder = primitive(PrimitiveKind::Cylinder, 0.2);
    let (sin, cos) = (PI / 32.0).sin_cos();
    expect_distance(
        at(&cylinder, 0.0, 0.0, 0.0),
        point(cos, sin, 0.0),
        0.9004815273,
    );
    expect_distance(at(&cylinder, 0.0, 0.0, 0.0), point(1.0, 0.0, 0.0), 0.9);
}

#[test]
fn contours_14_lie_on_both_surfaces() {
    let mesh = cube(0.2);
    let (a, b) = (at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.15, 0.05, 0.05));
    let segments = intersection_segments(a, b);
    let ends: Vec<_> = segments.iter().flatten().collect();
    for [x, y, z] in &ends {
        for other in [a, b] {
            let gap = distance(other, point(*x, *y, *z), EVERYWHERE)
                .expect("no limit")
                .distance;
            assert!(gap < 1e-9, "{x} {y} {z} is {gap} away");
        }
    }
    // Each cube cuts two edges of length 0.05, 0.15 and 0.15 off three faces of the other one.
    let length: f64 = segments
        .iter()
        .map(|[p, q]| (Vector3::from(*p) - Vector3::from(*q)).norm())
        .sum();
    close(&[length], &[2.0 * (0.05 + 0.15 + 0.15)], 1e-9);
}

#[test]
fn flat_meshes_21() {
    let mesh = TriangleMesh::new(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]])
        .expect("one triangle");
    let closest = expect_distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.0, 0.0, 0.3), 0.3);
    close(&closest.points[0][..2], &closest.points[1][..2], 1e-12);
    assert_eq!(
        distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.0, 0.0, 0.3), 0.2),
        None
    );
    assert!(
        intersects(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.2, 0.2, 0.0)),
        "coplanar triangles overlap"
    );
    assert!(!intersects(
        at(&mesh, 0.0, 0.0, 0.0),
        at(&mesh, 0.9, 0.9, 0.0)
    ));
    expect_distance(at(&mesh, 0.0, 0.0, 0.0), at(&mesh, 0.2, 0.2, 0.0), 0.0);
}

#[test]
fn voxels_are_solid() {
    let grid = VoxelGrid::new(0.05, [[0.125, 0.075, -0.025]].into_iter()).expect("one cell");
    let voxels = Placed {
        geometry: Geometry::Voxels(&grid),
        pose: Pose::identity(),
    };
    let (mesh, tiny) = (cube(0.2), cube(0.01));
    expect_distance(point(0.12, 0.07, -0.03), voxels, 0.0);
    assert!(intersects(point(0.12, 0.07, -0.03), voxels));
    assert!(!intersects(
        point(0.12, 0.07, -0.03),
        at(&mesh, 0.12, 0.0, 0.0)
    ));
    assert!(
        intersects(at(&tiny, 0.125, 0.075, -0.025), voxels),
        "the surface is inside of a cell"
    );
    assert!(
        !intersects(at(&cube(1.0), 0.125, 0.075, -0.025), voxels),
        "the cell is inside of the surface"
    );
    expect_distance(at(&cube(1.0), 0.125, 0.075, -0.025), voxels, 0.475);
    expect_distance(at(&mesh, 0.125, 0.075, 0.325), voxels, 0.225);
    let turn = Placed {
        pose: Pose::translation(0.5, 0.0, 0.0) * turned(PI / 4.0),
        ..voxels
    };
    expect_distance(
        voxels,
        Placed {
            pose: Pose::translation(0.0, 0.0, 0.3),
            ..voxels
        },
        0.25,
    );
    assert!(!intersects(voxels, turn) && intersects(turn, turn));
    let hit = up(
        Placed {
            pose: Pose::translation(-0.125, -0.07, 1.0),
            ..voxels
        },
        [0.0, 2.0],
    )
    .expect("a cell");
    close(&[hit.distance, hit.normal[2]], &[0.95, -1.0], 1e-12);
}

#[test]
fn segments_are_meshes_too() {
    let mesh = TriangleMesh::new(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]])
        .expect("one triangle");
    let through =
        TriangleMesh::of_segments(&[[[0.2, 0.2, -1.0], [0.2, 0.2, 1.0]]]).expect("one segment");
    let (a, b) = (at(&mesh, 0.0, 0.0, 0.0), at(&through, 0.0, 0.0, 0.0));
    expect_distance(a, b, 0.0);
    assert!(intersects(a, b) && intersects(b, a));
    close(
        intersection_segments(a, b).as_flattened().as_flattened(),
        &[0.2, 0.2, 0.0, 0.2, 0.2, 0.0],
        1e-12,
    );
    expect_distance(a, at(&through, 0.0, 0.0, 1.5), 0.5);
    assert!(!intersects(a, at(&through, 1.0, 0.0, 0.0)));
}
