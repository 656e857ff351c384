//! Meshes, volumes and poses, the same on every run.

use std::f64::consts::{PI, TAU};

use geometry::primitive::tessellate;
use geometry::{Pose, PrimitiveKind};
use nalgebra::{UnitQuaternion, Vector3};
use proximity::{TriangleMesh, Volume};

/// Vertices and triangles of a ball of diameter 1 m with bumps of up to `bumps` metres, of about so many triangles.
pub fn ball(triangles: usize, bumps: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let rings = ((triangles as f64) / 4.0).sqrt() as u32;
    let sides = 2 * rings;
    let place = |ring: u32, side: u32| {
        let (theta, phi) = (
            PI * f64::from(ring) / f64::from(rings),
            TAU * f64::from(side) / f64::from(sides),
        );
        let radius = 0.5 - bumps + bumps * (9.0 * theta).sin() * (7.0 * phi).cos();
        [
            radius * theta.sin() * phi.cos(),
            radius * theta.sin() * phi.sin(),
            radius * theta.cos(),
        ]
    };
    let vertices = (0..=rings)
        .flat_map(|ring| (0..sides).map(move |side| place(ring, side)))
        .collect();
    let number = |ring: u32, side: u32| ring * sides + side % sides;
    let quads = (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side)));
    let faces = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            number(i, j),
            number(i + 1, j),
            number(i + 1, j + 1),
            number(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    (vertices, faces.collect())
}

pub fn cuboid(size: [f64; 3]) -> TriangleMesh {
    let mesh = tessellate(PrimitiveKind::Cuboid, size, false).expect("finite extents");
    TriangleMesh::new(&mesh.vertices, &mesh.triangles).expect("triangles with area")
}

/// A cone of 30 degrees and 1 m, as a convex piece with 16 sides.
pub fn cone() -> Volume {
    let (sin, cos) = (PI / 12.0).sin_cos();
    let side = |i: u32| {
        let angle = TAU * f64::from(i) / 16.0;
        [cos * angle.cos(), cos * angle.sin(), -sin, 0.0]
    };
    Volume {
        pieces: vec![(0..16).map(side).chain([[0.0, 0.0, 1.0, -1.0]]).collect()],
    }
}

/// A pyramid with a square opening of 30 degrees, 1 m long.
pub fn pyramid() -> Volume {
    let (sin, cos) = (PI / 12.0).sin_cos();
    let sides = [
        [cos, 0.0, -sin, 0.0],
        [-cos, 0.0, -sin, 0.0],
        [0.0, cos, -sin, 0.0],
        [0.0, -cos, -sin, 0.0],
    ];
    Volume {
        pieces: vec![sides.into_iter().chain([[0.0, 0.0, 1.0, -1.0]]).collect()],
    }
}

/// A thousand poses, one after the other and again.
pub struct Poses {
    poses: Vec<Pose>,
    next: usize,
}

impl Poses {
    fn new(pose: impl FnMut(u32) -> Pose) -> Self {
        Self {
            poses: (0..1000).map(pose).collect(),
            next: 0,
        }
    }

    /// Sensors at a distance from the origin that look at a place near it.
    pub fn around(distance: f64) -> Self {
        Self::new(|i| {
            let position = direction(i) * distance;
            let target = direction(i + 500) * 0.3;
            let up = if direction(i).z.abs() < 0.9 {
                Vector3::z()
            } else {
                Vector3::x()
            };
            Pose::from_parts(
                position.into(),
                UnitQuaternion::face_towards(&(target - position), &up),
            )
        })
    }

    /// Turned bodies at a distance of `least` and up to 0.5 m more from the origin.
    pub fn apart(least: f64) -> Self {
        Self::new(|i| turned(i, least + 0.15 + 0.5 * f64::from(i) / 1000.0))
    }

    /// Turned bodies at one distance.
    pub fn apart_by(distance: f64) -> Self {
        Self::new(|i| turned(i, distance))
    }

    pub fn next(&mut self) -> Pose {
        self.next = (self.next + 1) % self.poses.len();
        self.poses[self.next]
    }
}

fn turned(i: u32, distance: f64) -> Pose {
    let turn = UnitQuaternion::from_scaled_axis(direction(i + 77) * f64::from(i));
    Pose::from_parts((direction(i) * distance).into(), turn)
}

/// Directions that cover the sphere evenly: a spiral.
fn direction(i: u32) -> Vector3<f64> {
    let z = 1.0 - 2.0 * (f64::from(i * 617 % 1000) + 0.5) / 1000.0;
    let angle = 2.399_963_229_728_653 * f64::from(i);
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * angle.cos(), radius * angle.sin(), z)
}

/// Boxes of 0.2 m in a cube of 10 m.
pub struct Boxes {
    pub cuboid: TriangleMesh,
    pub poses: Vec<Pose>,
}

impl Boxes {
    pub fn new(number: u32) -> Self {
        let place = |i: u32| {
            let shift = |step: u32| f64::from(i * step % 1009) / 1009.0 * 10.0 - 5.0;
            let turn = UnitQuaternion::from_scaled_axis(direction(i) * f64::from(i));
            Pose::from_parts(
                Vector3::new(shift(137), shift(331), shift(577)).into(),
                turn,
            )
        };
        Self {
            cuboid: cuboid([0.2; 3]),
            poses: (0..number).map(place).collect(),
        }
    }
}
