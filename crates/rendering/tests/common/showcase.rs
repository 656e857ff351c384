//! A scene with a bit of everything.

use std::sync::Arc;

use geometry::{Pose, PrimitiveKind};
use nalgebra::{Point3, Vector3};
use rendering::{
    Background, Camera, Edges, Fog, FogDensity, Image, Instance, Light, LightKind, Lines, Material,
    Mesh, Points, Projection, Texture, TextureMode, World,
};

use super::{ball, cuboid, primitive};

pub struct Showcase {
    meshes: Vec<Mesh>,
    materials: Vec<Material>,
    positions: Vec<[f64; 3]>,
    colours: Vec<[f32; 3]>,
    segments: Vec<[[f64; 3]; 2]>,
}

impl Showcase {
    pub fn new() -> Self {
        let checker: Vec<u8> = (0..64)
            .flat_map(|i| {
                if (i + i / 8) % 2 == 0 {
                    [250, 240, 200]
                } else {
                    [90, 60, 40]
                }
            })
            .collect();
        let image = Arc::new(Image::new([8, 8], false, &checker).expect("64 pixels"));
        let texture = |interpolate, mode| Texture {
            interpolate,
            mode,
            ..Texture::new(image.clone())
        };
        let edges = Edges {
            angle: 0.5,
            borders: true,
            colour: [0.0; 3],
            width: 1.0,
        };
        let glass = Material {
            opacity: 0.4,
            ..Material::new([0.3, 0.8, 0.9])
        };
        let spiral = |i: i32| {
            let angle = f64::from(i) * 0.1;
            [
                0.9 + 0.2 * angle.cos(),
                -0.5 + 0.2 * angle.sin(),
                0.3 + 0.004 * f64::from(i),
            ]
        };
        Self {
            meshes: vec![
                textured_floor(),
                cuboid([0.4; 3]),
                ball(0.3, 24),
                primitive(PrimitiveKind::Cylinder, [0.3, 0.3, 0.6]),
                primitive(PrimitiveKind::Cone, [0.4, 0.4, 0.5]),
            ],
            materials: vec![
                Material {
                    texture: Some(texture(true, TextureMode::Modulate)),
                    ..Material::new([0.9; 3])
                },
                Material {
                    edges: Some(edges),
                    ..Material::new([0.9, 0.5, 0.1])
                },
                Material {
                    specular: [0.9; 3],
                    ..Material::new([0.8, 0.1, 0.1])
                },
                glass,
                Material {
                    wireframe: true,
                    ..Material::new([0.1, 0.9, 0.2])
                },
                Material {
                    emission: [0.3, 0.0, 0.3],
                    ..Material::new([0.5, 0.3, 0.8])
                },
            ],
            positions: (0..120).map(spiral).collect(),
            colours: (0..120)
                .map(|i| [i as f32 / 120.0, 1.0 - i as f32 / 120.0, 0.5])
                .collect(),
            segments: vec![
                [[0.0; 3], [0.5, 0.0, 0.0]],
                [[0.0; 3], [0.0, 0.5, 0.0]],
                [[0.0; 3], [0.0, 0.0, 0.5]],
            ],
        }
    }

    pub fn instances(&self) -> Vec<Instance<'_>> {
        let place = |mesh: usize, material: usize, x: f64, y: f64, z: f64, turn: f64| Instance {
            mesh: &self.meshes[mesh],
            material: &self.materials[material],
            pose: Pose::new(Vector3::new(x, y, z), Vector3::new(0.0, 0.0, turn)),
            id: (10 * mesh + material) as u32,
        };
        vec![
            place(0, 0, 0.0, 0.0, 0.0, 0.0),
            place(1, 1, -0.6, 0.2, 0.2, 0.4),
            place(2, 2, 0.1, 0.5, 0.3, 0.0),
            place(3, 3, 0.2, -0.3, 0.3, 0.0),
            place(1, 3, -0.2, -0.6, 0.2, 0.7),
            place(4, 5, 0.8, 0.4, 0.25, 0.0),
            place(2, 4, -0.8, -0.5, 0.3, 0.0),
        ]
    }

    pub fn points(&self) -> [Points<'_>; 1] {
        [Points {
            positions: &self.positions,
            colours: &self.colours,
            pose: Pose::identity(),
            size: 4.0,
            id: 90,
            overlay: false,
        }]
    }

    pub fn lines(&self) -> [Lines<'_>; 1] {
        let colours = &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let pose = Pose::translation(0.0, 0.0, 0.01);
        [Lines {
            segments: &self.segments,
            colours,
            pose,
            width: 2.0,
            id: 91,
            overlay: true,
        }]
    }

    pub fn world<'a>(
        &'a self,
        instances: &'a [Instance],
        points: &'a [Points],
        lines: &'a [Lines],
        lights: &'a [Light],
    ) -> World<'a> {
        World {
            instances,
            points,
            lines,
            lights,
            ambient: [0.25; 3],
            fog: Some(Fog {
                density: FogDensity::Linear {
                    start: 2.5,
                    end: 8.0,
                },
                colour: [0.7, 0.75, 0.8],
            }),
            background: Background {
                bottom: [0.7, 0.75, 0.8],
                top: [0.2, 0.4, 0.7],
            },
            shadows: false,
        }
    }
}

pub fn lights() -> [Light; 3] {
    let towards =
        |eye: [f64; 3]| Pose::face_towards(&Point3::from(eye), &Point3::origin(), &Vector3::x());
    let sun = Light {
        diffuse: [0.6; 3],
        ..Light::new(LightKind::Directional, towards([1.0, -1.5, 2.0]))
    };
    let kind = LightKind::Spot {
        cutoff: 0.4,
        exponent: 5,
    };
    let spot = Light {
        diffuse: [0.9, 0.8, 0.4],
        ..Light::new(kind, towards([-1.5, -1.0, 2.0]))
    };
    let omni = Light {
        diffuse: [0.2, 0.3, 0.6],
        attenuation: [0.5, 0.0, 0.5],
        ..Light::new(LightKind::Omni, Pose::translation(1.5, 1.0, 0.8))
    };
    [sun, spot, omni]
}

pub fn camera(width: u32, height: u32) -> Camera {
    let pose = Pose::face_towards(
        &Point3::new(-0.9, -2.2, 1.4),
        &Point3::new(0.0, 0.0, 0.2),
        &Vector3::z(),
    );
    let projection = Projection::Perspective {
        angle: 55f64.to_radians(),
    };
    Camera {
        pose,
        projection,
        near: 0.05,
        far: 12.0,
        resolution: [width, height],
    }
}

fn textured_floor() -> Mesh {
    let vertices = [
        [-4.0, -4.0, 0.0],
        [4.0, -4.0, 0.0],
        [4.0, 4.0, 0.0],
        [-4.0, 4.0, 0.0],
    ];
    let uv = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 5.0],
        [0.0, 0.0],
        [5.0, 5.0],
        [0.0, 5.0],
    ];
    Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[], &uv).expect("a floor")
}
