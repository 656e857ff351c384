//! Meshes and cameras for tests.

#![allow(dead_code, reason = "each test program uses a part")]

pub mod showcase;

use geometry::Pose;
use geometry::primitive::{PrimitiveKind, tessellate};
use rendering::{
    Camera, Channels, Instance, Light, LightKind, Material, Mesh, Picture, Projection, Renderer,
    World,
};

pub fn primitive(kind: PrimitiveKind, size: [f64; 3]) -> Mesh {
    let mesh = tessellate(kind, size, false).expect("a size");
    Mesh::new(&mesh.vertices, &mesh.triangles, &mesh.normals, &[]).expect("a mesh with area")
}

/// A box with faces perpendicular to the axes, around the origin.
pub fn cuboid(size: [f64; 3]) -> Mesh {
    primitive(PrimitiveKind::Cuboid, size)
}

/// A ball of `rings` rings with twice as many vertices each, with smooth normals.
pub fn ball(radius: f64, rings: usize) -> Mesh {
    let sectors = 2 * rings;
    let point = |ring: usize, sector: usize| {
        let (polar, around) = (
            ring as f64 / rings as f64 * 180.0,
            (sector % sectors) as f64 / sectors as f64 * 360.0,
        );
        let ((z, r), (x, y)) = (polar.to_radians().sin_cos(), around.to_radians().sin_cos());
        [radius * z * y, radius * z * x, radius * r]
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
        .map(|v| vertices[*v as usize])
        .collect();
    Mesh::new(&vertices, &triangles, &normals, &[]).expect("a ball")
}

/// A rectangle across the z axis, seen from -Z.
pub fn rectangle(width: f64, height: f64, z: f64) -> Mesh {
    let (x, y) = (width / 2.0, height / 2.0);
    let vertices = [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]];
    Mesh::new(&vertices, &[[0, 2, 1], [0, 3, 2]], &[], &[]).expect("a rectangle")
}

/// At the origin, looking along +Z, with an opening of 60 degrees.
pub fn camera(width: u32, height: u32) -> Camera {
    let projection = Projection::Perspective {
        angle: 60f64.to_radians(),
    };
    Camera {
        pose: Pose::identity(),
        projection,
        near: 0.01,
        far: 10.0,
        resolution: [width, height],
    }
}

pub fn instance<'a>(mesh: &'a Mesh, material: &'a Material, id: u32) -> Instance<'a> {
    Instance {
        mesh,
        pose: Pose::identity(),
        material,
        id,
    }
}

pub fn at(mut instance: Instance<'_>, x: f64, y: f64, z: f64) -> Instance<'_> {
    instance.pose = Pose::translation(x, y, z);
    instance
}

/// Light that shines along the axis of the camera at the origin.
pub fn headlight() -> Light {
    Light {
        specular: [0.0; 3],
        ..Light::new(LightKind::Directional, Pose::identity())
    }
}

pub fn render(instances: &[Instance], camera: &Camera) -> Picture {
    let world = World {
        instances,
        lights: &[headlight()],
        ..World::EMPTY
    };
    Renderer::new(1).render(&world, camera, Channels::ALL)
}

pub fn id_at(picture: &Picture, x: u32, y: u32) -> u32 {
    picture.ids[(y * picture.resolution[0] + x) as usize]
}

pub fn depth_at(picture: &Picture, x: u32, y: u32) -> f32 {
    picture.depth[(y * picture.resolution[0] + x) as usize]
}

pub fn colour_at(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let at = 3 * (y * picture.resolution[0] + x) as usize;
    [
        picture.colour[at],
        picture.colour[at + 1],
        picture.colour[at + 2],
    ]
}

pub fn count(picture: &Picture, id: u32) -> usize {
    picture.ids.iter().filter(|other| **other == id).count()
}
