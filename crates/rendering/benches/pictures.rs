//! Pictures of a floor, 49 boxes and one bumpy ball: `cargo bench -p swanilda-rendering`. One at a time under one light; of four cameras
//! around them, as a step of robot learning wants; of three cameras with an image on the floor under four lights, as in scenes of
//! CoppeliaSim.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use geometry::Pose;
use nalgebra::{Point3, Vector3};
use rendering::{
    Background, Camera, Channels, Image, Instance, Light, LightKind, Material, Mesh, Picture,
    Projection, Renderer, Texture, World,
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

/// A square with an image that repeats five times along each side.
fn tiled_floor() -> (Mesh, Material) {
    let [a, b, c, d] = [[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0]];
    let uv = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 5.0],
        [0.0, 0.0],
        [5.0, 5.0],
        [0.0, 5.0],
    ];
    let vertices = [a, b, c, d].map(|[x, y]| [x, y, 0.0]);
    let mesh = Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[], &uv).expect("a floor has area");
    let noise = |at: u32| at.wrapping_mul(2_654_435_761).to_be_bytes()[0];
    let pixels: Vec<u8> = (0..3 * 512 * 512).map(noise).collect();
    let image = Image::new([512, 512], false, &pixels).expect("as many pixels as it needs");
    let material = Material {
        texture: Some(Texture::new(Arc::new(image))),
        ..Material::new([0.6; 3])
    };
    (mesh, material)
}

/// Looks at the middle of the scene, from beside it after some turns around it.
fn camera([width, height]: [u32; 2], turns: f64) -> Camera {
    let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
    let eye = Point3::new(1.6 * (cos + sin), 1.6 * (sin - cos), 1.2);
    let pose = Pose::face_towards(&eye, &Point3::new(0.0, 0.0, 0.15), &Vector3::z());
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

fn sun(x: f64, y: f64) -> Light {
    let from = Point3::new(x, y, 3.0);
    let pose = Pose::face_towards(&from, &Point3::origin(), &Vector3::x());
    Light::new(LightKind::Directional, pose)
}

/// What stands on the floor: a ball and 49 boxes.
struct Things {
    ball: Mesh,
    brick: Mesh,
    red: Material,
    blue: Material,
}

impl Things {
    fn new(rings: usize) -> Self {
        Self {
            ball: bumpy_ball(rings),
            brick: cuboid([0.15, 0.15, 0.3]),
            red: Material::new([0.8, 0.2, 0.1]),
            blue: Material::new([0.2, 0.3, 0.8]),
        }
    }

    /// With a floor, whose upper side is at a height.
    fn instances<'a>(
        &'a self,
        (mesh, material): &'a (Mesh, Material),
        z: f64,
    ) -> Vec<Instance<'a>> {
        let ball = Instance {
            mesh: &self.ball,
            pose: Pose::translation(0.0, 0.0, 0.6),
            material: &self.red,
            id: 2,
        };
        let floor = Instance {
            mesh,
            pose: Pose::translation(0.0, 0.0, z),
            material,
            id: 1,
        };
        let bricks = (0..49).map(|at| Instance {
            mesh: &self.brick,
            pose: Pose::translation(
                f64::from(at % 7) * 0.4 - 1.2,
                f64::from(at / 7) * 0.4 - 1.2,
                0.15,
            ),
            material: &self.blue,
            id: 3 + at as u32,
        });
        [floor, ball].into_iter().chain(bricks).collect()
    }
}

fn world<'a>(instances: &'a [Instance], lights: &'a [Light]) -> World<'a> {
    World {
        instances,
        lights,
        ambient: [0.2; 3],
        background: Background::plain([0.7, 0.8, 0.9]),
        ..World::EMPTY
    }
}

/// Measures pictures of some cameras, one after the other.
fn measure(
    c: &mut Criterion,
    name: &str,
    world: &World,
    cameras: &[Camera],
    channels: Channels,
    threads: usize,
) {
    let (mut renderer, mut picture) = (Renderer::new(threads), Picture::default());
    c.bench_function(name, |b| {
        b.iter(|| {
            for camera in cameras {
                renderer.render_into(black_box(world), camera, channels, &mut picture);
            }
        });
    });
}

fn pictures(c: &mut Criterion) {
    let floor = (cuboid([6.0, 6.0, 0.1]), Material::new([0.6; 3]));
    let depth_and_ids = Channels {
        colour: false,
        ..Channels::ALL
    };
    for (name, rings) in [("1k", 16), ("20k", 71), ("200k", 224)] {
        let things = Things::new(rings);
        let (instances, lights) = (things.instances(&floor, -0.05), [sun(1.0, -2.0)]);
        let world = world(&instances, &lights);
        for [width, height] in [[256, 256], [640, 480]] {
            let cases = [
                ("depth", Channels::DEPTH, 1),
                ("ids", Channels::IDS, 1),
                ("depth and ids", depth_and_ids, 1),
                ("colour", Channels::COLOUR, 1),
                ("colour, 2 threads", Channels::COLOUR, 2),
                ("all", Channels::ALL, 1),
                ("all, 2 threads", Channels::ALL, 2),
            ];
            for (what, channels, threads) in cases {
                let name = format!("{name} triangles, {width}x{height}, {what}");
                let cameras = [camera([width, height], 0.0)];
                measure(c, &name, &world, &cameras, channels, threads);
            }
        }
        let cameras = [0.0, 0.25, 0.5, 0.75].map(|turns| camera([128, 128], turns));
        for threads in [1, 2] {
            let name = format!("{name} triangles, four of 128x128, all, {threads} threads");
            measure(c, &name, &world, &cameras, Channels::ALL, threads);
        }
    }
}

fn tiled_pictures(c: &mut Criterion) {
    let (floor, things) = (tiled_floor(), Things::new(71));
    let instances = things.instances(&floor, 0.0);
    let lights = [[1.0, -2.0], [-1.0, -2.0], [-1.0, 2.0], [0.1, 0.0]].map(|[x, y]| sun(x, y));
    let world = world(&instances, &lights);
    let cameras = [0.0, 0.25, 0.5].map(|turns| camera([1024, 1024], turns));
    for threads in [1, 2] {
        let name =
            format!("20k triangles, image on the floor, three of 1024x1024, {threads} threads");
        let channels = Channels {
            ids: false,
            ..Channels::ALL
        };
        measure(c, &name, &world, &cameras, channels, threads);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(300)).measurement_time(std::time::Duration::from_secs(1));
    targets = pictures, tiled_pictures
}
criterion_main!(benches);
