//! Pictures of a floor, 49 boxes and one bumpy ball: `cargo bench -p swanilda-rendering`.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use geometry::Pose;
use nalgebra::{Point3, Vector3};
use rendering::{
    Background, Camera, Channels, Instance, Light, LightKind, Material, Mesh, Picture, Projection,
    Renderer, World,
};

/// A closed surface of `4 * rings^2` triangles with a radius of about 0.5, with smooth normals.
fn bumpy_ball(rings: usize) -> Mesh {
    let sectors = 2 * rings;
    let point = |ring: usize, sector: usize| {
        // A pole is one point, so that the surface is closed.
        if ring == 0 || ring == rings {
            return [0.0, 0.0, if ring == 0 { 0.5 } else { -0.5 }];
        }
        let polar = std::f64::consts::PI * ring as f64 / rings as f64;
        let around = std::f64::consts::TAU * (sector % sectors) as f64 / sectors as f64;
        let radius = 0.5 + 0.05 * (5.0 * polar).sin() * (6.0 * around).sin();
        let (sin, cos) = polar.sin_cos();
        [
            radius * sin * around.cos(),
            radius * sin * around.sin(),
            radius * cos,
        ]
    };
    let vertices: Vec<[f64; 3]> = (0..=rings)
        .flat_map(|r| (0..sectors).map(move |s| point(r, s)))
        .collect();
    let at = |ring: usize, sector: usize| (ring * sectors + sector % sectors) as u32;
    let quad = |r: usize, s: usize| {
        [
            [at(r, s), at(r + 1, s), at(r + 1, s + 1)],
            [at(r, s), at(r + 1, s + 1), at(r, s + 1)],
        ]
    };
    let triangles: Vec<[u32; 3]> = (0..rings)
        .flat_map(|r| (0..sectors).flat_map(move |s| quad(r, s)))
        .collect();
    let normals: Vec<[f64; 3]> = triangles
        .iter()
        .flatten()
        .map(|vertex| vertices[*vertex as usize])
        .collect();
    Mesh::new(&vertices, &triangles, &normals, &[]).expect("a ball has area")
}

fn cuboid(size: [f64; 3]) -> Mesh {
    let mesh = geometry::primitive::tessellate(geometry::PrimitiveKind::Cuboid, size, false)
        .expect("a size");
    Mesh::new(&mesh.vertices, &mesh.triangles, &mesh.normals, &[]).expect("a box has area")
}

/// Looks at the origin.
fn camera(width: u32, height: u32) -> Camera {
    let eye = Point3::new(1.6, -1.6, 1.2);
    let up = Vector3::z();
    let pose = Pose::face_towards(&eye, &Point3::new(0.0, 0.0, 0.15), &up);
    Camera {
        pose,
        projection: Projection::Perspective {
            angle: 60f64.to_radians(),
        },
        near: 0.01,
        far: 10.0,
        resolution: [width, height],
    }
}

fn pictures(c: &mut Criterion) {
    let (floor, brick) = (cuboid([6.0, 6.0, 0.1]), cuboid([0.15, 0.15, 0.3]));
    let (grey, red, blue) = (
        Material::new([0.6; 3]),
        Material::new([0.8, 0.2, 0.1]),
        Material::new([0.2, 0.3, 0.8]),
    );
    let light = Light::new(
        LightKind::Directional,
        Pose::face_towards(
            &Point3::new(1.0, -2.0, 3.0),
            &Point3::origin(),
            &Vector3::x(),
        ),
    );
    for (name, rings) in [("1k", 16), ("20k", 71), ("200k", 224)] {
        let ball = bumpy_ball(rings);
        let mut instances = vec![
            Instance {
                mesh: &floor,
                pose: Pose::translation(0.0, 0.0, -0.05),
                material: &grey,
                id: 1,
            },
            Instance {
                mesh: &ball,
                pose: Pose::translation(0.0, 0.0, 0.6),
                material: &red,
                id: 2,
            },
        ];
        instances.extend((0..49).map(|i| {
            let (x, y) = (f64::from(i % 7) * 0.4 - 1.2, f64::from(i / 7) * 0.4 - 1.2);
            Instance {
                mesh: &brick,
                pose: Pose::translation(x, y, 0.15),
                material: &blue,
                id: 3 + i as u32,
            }
        }));
        let world = World {
            instances: &instances,
            lights: &[light],
            ambient: [0.2; 3],
            background: Background::plain([0.7, 0.8, 0.9]),
            ..World::EMPTY
        };
        for (size, width, height) in [("256x256", 256, 256), ("640x480", 640, 480)] {
            let both = Channels {
                colour: false,
                ..Channels::ALL
            };
            let cases = [
                ("depth", Channels::DEPTH, 1),
                ("ids", Channels::IDS, 1),
                ("depth and ids", both, 1),
                ("colour", Channels::COLOUR, 1),
                ("all", Channels::ALL, 1),
                ("all, 2 threads", Channels::ALL, 2),
            ];
            for (what, channels, threads) in cases {
                let (mut renderer, mut picture) = (Renderer::new(threads), Picture::default());
                let camera = camera(width, height);
                c.bench_function(&format!("{name} triangles, {size}, {what}"), |b| {
                    b.iter(|| {
                        renderer.render_into(black_box(&world), &camera, channels, &mut picture);
                    });
                });
            }
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(300)).measurement_time(std::time::Duration::from_secs(1));
    targets = pictures
}
criterion_main!(benches);
