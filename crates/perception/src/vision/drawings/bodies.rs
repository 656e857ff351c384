//! Meshes of items: triangles, and small bodies at points. The colours of the items are pixels of an image.

use geometry::PrimitiveKind;
use geometry::primitive::tessellate;
use heap::Lazy;
use nalgebra::Vector3;
use rendering::{Material, Mesh};
use std::f64::consts::TAU;
use std::rc::Rc;

use crate::vision::models::ModelPart;
use crate::vision::palette::Palette;
use crate::vision::surfaces::of_colour;
use scene::Pose;
use scene::appearance::colour::Colour;
use scene::drawing::options::{DrawingFlags, DrawingKind};
use scene::drawing::{DrawingItem, DrawingStyle};

/// Corners of a disc.
const DISC_CORNERS: usize = 16;
/// Triangles of a ball one metre wide, and the vertices that are their corners.
static BALL: Lazy<geometry::Mesh> =
    Lazy::new(|| tessellate(PrimitiveKind::Spheroid, [1.0; 3], false).unwrap_or_default());
static CUBE: Lazy<geometry::Mesh> =
    Lazy::new(|| tessellate(PrimitiveKind::Cuboid, [1.0; 3], false).unwrap_or_default());

/// Triangles of many items.
#[derive(Default)]
pub(super) struct Bodies {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its colour.
    colours: Vec<usize>,
    palette: Palette,
}

impl Bodies {
    /// Adds an item of that size (m) which faces a direction.
    pub(super) fn add(
        &mut self,
        kind: DrawingKind,
        item: DrawingItem,
        size: f64,
        facing: Vector3<f64>,
        colour: [f32; 3],
    ) {
        let centre = Vector3::from(item.points()[0]);
        let frame = frame_facing(facing);
        let flat = |corners: &[[f64; 2]]| -> Vec<[f64; 3]> {
            let corner =
                |[x, y]: &[f64; 2]| (centre + size * (frame[0] * *x + frame[1] * *y)).into();
            corners.iter().map(corner).collect()
        };
        let solid = |mesh: &geometry::Mesh| -> Vec<[f64; 3]> {
            let place = |[x, y, z]: [f64; 3]| {
                (centre + size * (frame[0] * x + frame[1] * y + frame[2] * z)).into()
            };
            mesh.vertices.iter().map(|vertex| place(*vertex)).collect()
        };
        let colour = self
            .palette
            .number(colour.map(|part| (part.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
        match kind {
            DrawingKind::Triangles => self.push(item.points(), &[[0, 1, 2]], colour),
            DrawingKind::TrianglePoints => self.push(&flat(&regular(3)), &fan(3), colour),
            DrawingKind::QuadPoints => {
                self.push(
                    &flat(&[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]),
                    &fan(4),
                    colour,
                );
            }
            DrawingKind::DiscPoints => {
                self.push(&flat(&regular(DISC_CORNERS)), &fan(DISC_CORNERS), colour);
            }
            DrawingKind::SpherePoints => self.push(&solid(&BALL), &BALL.triangles, colour),
            _ => self.push(&solid(&CUBE), &CUBE.triangles, colour),
        }
    }

    fn push(&mut self, vertices: &[[f64; 3]], triangles: &[[u32; 3]], colour: usize) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices);
        self.triangles.extend(
            triangles
                .iter()
                .map(|corners| corners.map(|corner| first + corner)),
        );
        self.colours
            .extend(std::iter::repeat_n(colour, triangles.len()));
    }

    /// Prepared part with all items; None without items.
    pub(super) fn part(self, style: &DrawingStyle, opacity: f32) -> Option<ModelPart> {
        let uv: Vec<[f32; 2]> = self
            .colours
            .iter()
            .flat_map(|number| [self.palette.place(*number); 3])
            .collect();
        let mesh = Rc::new(Mesh::new(&self.vertices, &self.triangles, &[], &uv)?);
        // Where the colour is what the items emit, the image of the colours replaces the light on them.
        let emits = style.flags.contains(DrawingFlags::EMISSION_COLOUR)
            || style.colour.emission.iter().any(|part| *part > 0.0);
        let white = Colour {
            ambient_diffuse: [1.0; 3],
            emission: [0.0; 3],
            ..style.colour
        };
        let surface = if emits {
            Material::unlit([1.0; 3])
        } else {
            of_colour(&white)
        };
        let material = Material {
            opacity,
            culling: style.flags.contains(DrawingFlags::BACK_FACE_CULLING),
            wireframe: style.flags.contains(DrawingFlags::WIREFRAME),
            texture: Some(self.palette.texture()?),
            ..surface
        };
        let auxiliary = Material::unlit(style.colour.auxiliary);
        Some(ModelPart {
            mesh,
            material,
            auxiliary,
            pose: Pose::identity(),
        })
    }
}

/// Three axes, of which the last is the direction.
fn frame_facing(direction: Vector3<f64>) -> [Vector3<f64>; 3] {
    let z = direction.try_normalize(1e-12).unwrap_or_else(Vector3::z);
    let across = if z.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let y = z.cross(&across).normalize();
    [y.cross(&z), y, z]
}

/// The corners of a regular polygon, half a metre from its centre.
fn regular(count: usize) -> Vec<[f64; 2]> {
    let corner = |at: usize| {
        let angle = TAU * at as f64 / count as f64;
        [0.5 * libm::cos(angle), 0.5 * libm::sin(angle)]
    };
    (0..count).map(corner).collect()
}

/// The triangles of a convex polygon.
fn fan(corners: usize) -> Vec<[u32; 3]> {
    (1..corners as u32 - 1).map(|at| [0, at, at + 1]).collect()
}
