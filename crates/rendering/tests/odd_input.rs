//! Cameras inside of things, huge and missing numbers, degenerate triangles: a picture, never a panic.

mod common;

use common::*;
use geometry::Pose;
use nalgebra::{UnitQuaternion, Vector3};
use rendering::{Channels, Lines, Material, Mesh, Picture, Points, Projection, Renderer, World};

#[test]
fn a_camera_in_a_box_sees_its_walls() {
    let (cube, grey) = (cuboid([2.0, 2.0, 2.0]), Material::new([0.5; 3]));
    let picture = render(&[instance(&cube, &grey, 5)], &camera(64, 64));
    assert_eq!(count(&picture, 5), 64 * 64);
    assert!((depth_at(&picture, 32, 32) - 0.99 / 9.99).abs() < 1e-6);
    assert_eq!(colour_at(&picture, 32, 32), [128; 3]);
    let culled = Material {
        culling: true,
        ..grey
    };
    assert_eq!(
        count(&render(&[instance(&cube, &culled, 5)], &camera(64, 64)), 5),
        0
    );
}

#[test]
fn large_faces_next_to_the_camera_fill_the_picture() {
    let (floor, grey) = (cuboid([1e5, 1e5, 1.0]), Material::new([0.5; 3]));
    for (height, tilt) in [(0.02, 0.0), (0.001, 0.3), (1.0, 0.35), (5.0, -0.9)] {
        // Above the floor, looking along it; the horizon is a straight line.
        let mut camera = camera(400, 300);
        camera.far = 1e7;
        camera.pose = Pose::from_parts(
            Vector3::new(3.0, 7.0, 0.5 + height).into(),
            UnitQuaternion::from_axis_angle(
                &Vector3::x_axis(),
                -std::f64::consts::FRAC_PI_2 + tilt,
            ),
        );
        let picture = render(&[instance(&floor, &grey, 5)], &camera);
        for column in 0..400 {
            let floor = (0..300).filter(|row| id_at(&picture, column, *row) == 5);
            let changes = (1..300)
                .filter(|row| id_at(&picture, column, *row) != id_at(&picture, column, row - 1))
                .count();
            assert!(
                changes <= 1 && floor.count() > 0,
                "{height} {tilt} {column}"
            );
        }
    }
}

#[test]
fn what_is_closer_than_the_near_plane_is_cut_off() {
    let (cube, grey) = (cuboid([1.0, 1.0, 1.0]), Material::new([0.5; 3]));
    let mut camera = camera(64, 64);
    camera.near = 2.0;
    // The front face at 1.5 is cut off, the inside of the back face at 2.5 remains.
    let picture = render(&[at(instance(&cube, &grey, 5), 0.0, 0.0, 2.0)], &camera);
    assert!((depth_at(&picture, 32, 32) - 0.5 / 8.0).abs() < 1e-6);
    assert!(
        picture
            .depth
            .iter()
            .all(|depth| (0.0..=1.0).contains(depth))
    );
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    let (ball, grey) = (ball(0.4, 30), Material::new([0.5; 3]));
    let here = render(
        &[at(instance(&ball, &grey, 5), 0.25, 0.5, 2.0)],
        &camera(128, 128),
    );
    let mut camera = camera(128, 128);
    let shift = [1048576.0, -2097152.0, 524288.0];
    camera.pose = Pose::translation(shift[0], shift[1], shift[2]);
    let there = render(
        &[at(
            instance(&ball, &grey, 5),
            shift[0] + 0.25,
            shift[1] + 0.5,
            shift[2] + 2.0,
        )],
        &camera,
    );
    assert_eq!(here, there);
}

#[test]
fn numbers_that_are_not_finite_are_not_drawn() {
    let (cube, grey) = (cuboid([1.0; 3]), Material::new([0.5; 3]));
    let with = |x: f64| at(instance(&cube, &grey, 5), x, 0.0, 3.0);
    for x in [f64::NAN, f64::INFINITY, 1e300, -1e30] {
        assert_eq!(count(&render(&[with(x)], &camera(16, 16)), 5), 0);
    }
    let cameras = [
        rendering::Camera {
            near: f64::NAN,
            ..camera(16, 16)
        },
        rendering::Camera {
            far: 0.001,
            ..camera(16, 16)
        },
        rendering::Camera {
            far: f64::INFINITY,
            ..camera(16, 16)
        },
        rendering::Camera {
            near: 0.0,
            ..camera(16, 16)
        },
        rendering::Camera {
            projection: Projection::Perspective { angle: 4.0 },
            ..camera(16, 16)
        },
        rendering::Camera {
            projection: Projection::Perspective { angle: f64::NAN },
            ..camera(16, 16)
        },
        rendering::Camera {
            projection: Projection::Orthographic { size: 0.0 },
            ..camera(16, 16)
        },
        rendering::Camera {
            pose: Pose::translation(f64::NAN, 0.0, 0.0),
            ..camera(16, 16)
        },
    ];
    for camera in cameras {
        let picture = render(&[with(0.0)], &camera);
        assert_eq!(
            (count(&picture, Picture::NOTHING), picture.colour.len()),
            (256, 768),
            "{camera:?}"
        );
        assert!(picture.depth.iter().all(|depth| *depth == 1.0));
    }
    assert_eq!(render(&[with(0.0)], &camera(0, 16)).ids, []);
    assert_eq!(count(&render(&[with(0.0)], &camera(1, 1)), 5), 1);
    assert_eq!(render(&[with(0.0)], &camera(1, 5000)).resolution, [1, 4096]);
}

#[test]
fn triangles_without_area_are_left_out() {
    let vertices = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [0.0, f64::NAN, 1.0],
        [0.0, 1.0, 1.0],
    ];
    assert!(
        Mesh::new(
            &vertices,
            &[[0, 1, 2], [0, 0, 1], [0, 1, 3], [0, 1, 9]],
            &[],
            &[]
        )
        .is_none()
    );
    assert!(Mesh::new(&[], &[], &[], &[]).is_none());
    let mesh = Mesh::new(
        &vertices,
        &[[0, 1, 2], [0, 4, 1]],
        &[[f64::NAN; 3]; 6],
        &[[f32::NAN; 2]; 6],
    )
    .unwrap();
    let grey = Material::new([0.5; 3]);
    let picture = render(
        &[at(instance(&mesh, &grey, 5), -0.3, -0.3, 0.0)],
        &camera(16, 16),
    );
    assert!(count(&picture, 5) > 10);
    assert!(picture.colour.iter().any(|part| *part > 100));
}

#[test]
fn slivers_do_not_stick_out() {
    // Fans of very thin triangles around a point, seen edge-on: nothing is closer or farther than they are.
    let vertices: Vec<[f64; 3]> = (0..200)
        .map(|i| {
            let angle = f64::from(i) * 1e-4;
            [angle.sin(), 1e-7 * f64::from(i % 3), 2.0 + angle.cos()]
        })
        .chain([[0.0, 0.0, 2.0]])
        .collect();
    let triangles: Vec<[u32; 3]> = (0..199).map(|i| [200, i, i + 1]).collect();
    let (mesh, grey) = (
        Mesh::new(&vertices, &triangles, &[], &[]).unwrap(),
        Material::new([0.5; 3]),
    );
    for degrees in 0..45 {
        let mut camera = camera(200, 200);
        camera.pose.rotation =
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), f64::from(degrees).to_radians());
        let picture = render(&[instance(&mesh, &grey, 5)], &camera);
        let depths = picture
            .depth
            .iter()
            .zip(&picture.ids)
            .filter(|(_, id)| **id == 5)
            .map(|(depth, _)| *depth);
        depths.for_each(|depth| assert!((0.1991..=0.2994).contains(&depth), "{depth}"));
    }
}

#[test]
fn points_and_lines_anywhere() {
    let odd = [f64::NAN, f64::INFINITY, -1e300, 0.0, 1e-300, 3.0];
    let positions: Vec<[f64; 3]> = (0..216)
        .map(|i| [odd[i % 6], odd[i / 6 % 6], odd[i / 36]])
        .collect();
    let segments: Vec<[[f64; 3]; 2]> = positions
        .iter()
        .flat_map(|a| positions.iter().step_by(7).map(move |b| [*a, *b]))
        .collect();
    let points = Points {
        positions: &positions,
        colours: &[],
        pose: Pose::identity(),
        size: f32::NAN,
        id: 1,
        overlay: false,
    };
    let lines = Lines {
        segments: &segments,
        colours: &[],
        pose: Pose::identity(),
        width: -3.0,
        id: 2,
        overlay: true,
    };
    let world = World {
        points: &[points],
        lines: &[lines],
        ..World::EMPTY
    };
    let picture = Renderer::new(1).render(&world, &camera(64, 64), Channels::ALL);
    assert!(
        picture
            .depth
            .iter()
            .all(|depth| (0.0..=1.0).contains(depth))
    );
}
