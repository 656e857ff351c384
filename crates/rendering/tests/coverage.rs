//! Every pixel belongs to one triangle: no gaps, nothing twice; the same things in front as by rays.

mod common;

use common::*;
use geometry::Pose;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use parry3d_f64::math::Pose as ParryPose;
use parry3d_f64::query::{Ray, RayCast};
use parry3d_f64::shape::TriMesh;
use rendering::{Camera, Channels, Instance, Material, Mesh, Picture, Projection, Renderer, World};
use test_support::random::Random;

/// A rectangle of `n * n` cells with corners that are moved at random, cut into triangles one way or the other.
fn jittered_grid(n: usize, random: &mut Random) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    for (row, column) in (0..=n).flat_map(|row| (0..=n).map(move |column| (row, column))) {
        let inner = (1..n).contains(&row) && (1..n).contains(&column);
        let [dx, dy] = if inner {
            [random.signed() * 0.2, random.signed() * 0.2]
        } else {
            [0.0; 2]
        };
        vertices.push([
            2.0 * (column as f64 + dx) / n as f64 - 1.0,
            2.0 * (row as f64 + dy) / n as f64 - 1.0,
            0.0,
        ]);
    }
    let at = |row: usize, column: usize| (row * (n + 1) + column) as u32;
    let triangles = (0..n)
        .flat_map(|row| (0..n).map(move |column| (row, column)))
        .flat_map(|(r, c)| {
            let [a, b, d, e] = [at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)];
            if random.signed() > 0.0 {
                [[a, d, b], [a, e, d]]
            } else {
                [[a, e, b], [b, e, d]]
            }
        });
    let triangles = triangles.collect();
    (vertices, triangles)
}

fn seen(instances: &[Instance], camera: &Camera) -> Picture {
    Renderer::new(1).render(
        &World {
            instances,
            ..World::EMPTY
        },
        camera,
        Channels::IDS,
    )
}

#[test]
fn neighbours_leave_no_gap_and_share_no_pixel() {
    let grey = Material::new([0.5; 3]);
    let mut random = Random::new(7);
    // From triangles that are larger than the picture to such that are smaller than a pixel.
    for (n, z, turn) in [
        (1, 0.05, 0.3),
        (2, 0.3, 0.0),
        (4, 0.7, 0.2),
        (9, 1.0, 1.1),
        (40, 1.5, 0.7),
        (60, 3.0, 0.1),
    ] {
        let (vertices, triangles) = jittered_grid(n, &mut random);
        let pose = Pose::from_parts(
            Vector3::new(0.013, -0.021, z).into(),
            UnitQuaternion::from_euler_angles(turn * 0.6, turn * 0.5, turn),
        );
        let camera = camera(97, 61);
        let whole = Mesh::new(&vertices, &triangles, &[], &[]).unwrap();
        let whole = seen(
            &[Instance {
                pose,
                ..instance(&whole, &grey, 1)
            }],
            &camera,
        );
        let mut times = vec![0; whole.ids.len()];
        for triangle in &triangles {
            let Some(mesh) = Mesh::new(&vertices, &[*triangle], &[], &[]) else {
                continue;
            };
            let alone = seen(
                &[Instance {
                    pose,
                    ..instance(&mesh, &grey, 1)
                }],
                &camera,
            );
            times
                .iter_mut()
                .zip(&alone.ids)
                .for_each(|(times, id)| *times += i32::from(*id == 1));
        }
        for (times, id) in times.iter().zip(&whole.ids) {
            assert_eq!(*times, i32::from(*id == 1), "n = {n}");
        }
        // The corners as the border of one quadrilateral: the same pixels.
        let outline = rectangle(2.0, 2.0, 0.0);
        let outline = seen(
            &[Instance {
                pose,
                ..instance(&outline, &grey, 1)
            }],
            &camera,
        );
        assert_eq!(outline.ids, whole.ids, "n = {n}");
        assert!(count(&whole, 1) > 100, "n = {n}");
    }
}

#[test]
fn rays_see_the_same() {
    let mut random = Random::new(99);
    let grey = Material::new([0.5; 3]);
    for round in 0..12 {
        let meshes: Vec<Soup> = (0..8).map(|_| soup(&mut random)).collect();
        let prepared: Vec<Mesh> = meshes
            .iter()
            .map(|(v, t, _)| Mesh::new(v, t, &[], &[]).unwrap())
            .collect();
        let instances: Vec<Instance> = (0..8)
            .map(|i| Instance {
                pose: meshes[i].2,
                ..instance(&prepared[i], &grey, i as u32)
            })
            .collect();
        let projection = match round % 3 {
            0 => Projection::Orthographic { size: 3.0 },
            _ => Projection::Perspective {
                angle: 1.0 + 0.1 * f64::from(round),
            },
        };
        let [x, y, z] = random.vector();
        let eye = Point3::new(2.0 * x, 2.0 * y, 1.0 + z);
        let pose = Pose::face_towards(&eye, &Point3::origin(), &Vector3::new(0.1, 1.0, 0.2));
        let camera = Camera {
            pose,
            projection,
            near: 0.05,
            far: 3.0,
            resolution: [41, 29],
        };
        let world = World {
            instances: &instances,
            ..World::EMPTY
        };
        compare_with_rays(
            &Renderer::new(1).render(&world, &camera, Channels::ALL),
            &camera,
            &meshes,
        );
    }
}

/// Vertices, triangles, and where they are.
type Soup = (Vec<[f64; 3]>, Vec<[u32; 3]>, Pose);

/// Some random triangles, somewhere.
fn soup(random: &mut Random) -> Soup {
    let vertices = (0..12).map(|_| random.vector()).collect();
    let [x, y, z] = random.vector();
    let pose = Pose::new(Vector3::new(x, y, z), Vector3::from(random.vector()) * 3.0);
    (
        vertices,
        vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]],
        pose,
    )
}

fn compare_with_rays(picture: &Picture, camera: &Camera, meshes: &[Soup]) {
    let shapes: Vec<TriMesh> = meshes
        .iter()
        .map(|(v, t, pose)| shape(v, t, &(camera.pose.inverse() * pose)))
        .collect();
    let [width, height] = camera.resolution;
    let hit = |x: u32, y: u32| closest(&shapes, camera, f64::from(x) + 0.5, f64::from(y) + 0.5);
    let mut differences = 0;
    for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        let (expected, found) = (hit(x, y), id_at(picture, x, y));
        let expected_id = expected.map_or(Picture::NOTHING, |(id, _)| id);
        if expected_id != found {
            differences += 1;
            continue;
        }
        let relative =
            expected.map_or(1.0, |(_, z)| (z - camera.near) / (camera.far - camera.near));
        let found = f64::from(depth_at(picture, x, y));
        // Corners lie on a grid of 1/256 pixel: triangles that are seen edge-on may differ.
        differences += u32::from((found - relative).abs() > 2e-7);
    }
    assert!(
        differences <= width * height / 200,
        "{differences} of {} pixels",
        width * height
    );
}

fn shape(vertices: &[[f64; 3]], triangles: &[[u32; 3]], pose: &Pose) -> TriMesh {
    let vertices = vertices.iter().map(|v| {
        let point = pose * Point3::from(*v);
        parry3d_f64::math::Vector::new(point.x, point.y, point.z)
    });
    TriMesh::new(vertices.collect(), triangles.to_vec()).expect("triangles")
}

/// Id and depth of what a ray through a point of the picture meets first, in the camera's frame.
fn closest(shapes: &[TriMesh], camera: &Camera, x: f64, y: f64) -> Option<(u32, f64)> {
    let [width, height] = camera.resolution.map(f64::from);
    let (right, up) = (x - width / 2.0, y - height / 2.0);
    let (origin, direction) = match camera.projection {
        Projection::Perspective { angle } => {
            let scale = 2.0 * (angle / 2.0).tan() / width.max(height);
            ([0.0; 3], [-right * scale, up * scale, 1.0])
        }
        Projection::Orthographic { size } => {
            let scale = size / width.max(height);
            ([-right * scale, up * scale, 0.0], [0.0, 0.0, 1.0])
        }
    };
    let start = [0, 1, 2].map(|i| origin[i] + direction[i] * camera.near);
    let vector = |v: [f64; 3]| parry3d_f64::math::Vector::new(v[0], v[1], v[2]);
    let ray = Ray::new(vector(start), vector(direction));
    let hit = |shape: &TriMesh| {
        shape.cast_ray(&ParryPose::IDENTITY, &ray, camera.far - camera.near, false)
    };
    let hits = shapes
        .iter()
        .enumerate()
        .filter_map(|(id, shape)| Some((id as u32, hit(shape)? + camera.near)));
    hits.min_by(|a, b| a.1.total_cmp(&b.1))
}
