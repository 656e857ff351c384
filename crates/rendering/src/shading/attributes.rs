//! Normals and texture coordinates of a face as linear functions on the picture.
//!
//! Attributes that are linear on a triangle in space are linear on the picture after division by the depth (J. Blinn, *Hyperbolic interpolation*, 1992).
//! With the corners P in view coordinates, the weight of corner i divided by the depth is `ray . (Pj x Pk) / det` (M. Olano and T. Greer,
//! *Triangle scan conversion using 2D homogeneous coordinates*, 1997).

use nalgebra::Vector3;
use wide::f32x8;

use crate::coverage::face::{Face, LANES};
use crate::projection::surface::Surface;
use crate::projection::view::View;
use crate::shading::lighting::Vectors;
use crate::three::three;

/// A linear function of column and row, from a pixel of the face on: exact enough in 32 bits.
#[derive(Debug, Clone, Copy, Default)]
struct Linear {
    start: f32,
    step: [f32; 2],
}

/// Attributes interpolated on a face. Normals and texture coordinates are divided by the depth in perspective.
#[derive(Debug, Clone, Default)]
pub struct Attributes {
    /// Where the functions start.
    pixel: [u16; 2],
    normal: [Linear; 3],
    uv: [Linear; 2],
    /// Whether the normal is the same everywhere.
    pub is_flat: bool,
}

impl Linear {
    fn constant(start: f32) -> Self {
        Self {
            start,
            step: [0.0; 2],
        }
    }

    /// The function `ray . coefficients` from the ray of a pixel on.
    fn new(coefficients: Vector3<f64>, ray: &Vector3<f64>) -> Self {
        Self {
            start: numbers::single(coefficients.dot(ray)),
            step: [
                numbers::single(coefficients.x),
                numbers::single(coefficients.y),
            ],
        }
    }

    /// Eight pixels from a column and row on.
    fn at(&self, [column, row]: [f32; 2]) -> f32x8 {
        let start = self.start + self.step[1] * row + self.step[0] * column;
        f32x8::splat(start) + LANES * self.step[0]
    }
}

impl Attributes {
    pub fn new(view: &View, surface: &Surface, face: &Face, is_textured: bool) -> Self {
        let triangle = &surface.mesh.triangles[numbers::place(face.detail)];
        let pixel = [face.bounds[0][0], face.bounds[1][0]];
        let ray = view.ray(pixel[0].into(), pixel[1].into());
        let ray = Vector3::new(ray[0], ray[1], 1.0);
        let weights = if triangle.is_flat && !is_textured {
            Default::default()
        } else {
            weights(view, surface, face)
        };
        let [a, b, c] = three(|i| Vector3::from(triangle.normals[i]).cast::<f64>());
        let side = if face.back { -1.0 } else { 1.0 };
        let to_camera =
            |normal: Vector3<f64>| view.in_metres(surface.transform.rotation * normal) * side;
        let normal = if triangle.is_flat {
            let normal = to_camera(a);
            three(|axis| Linear::constant(numbers::single(normal[axis])))
        } else {
            // The columns are what the normal changes by from column to column and from row to row, and its value at the centre.
            let part =
                |i: usize| to_camera(a * weights[0][i] + b * weights[1][i] + c * weights[2][i]);
            let parts = match face.is_uniform {
                true => [Vector3::zeros(), Vector3::zeros(), part(2)],
                false => three(part),
            };
            three(|axis| {
                Linear::new(
                    Vector3::new(parts[0][axis], parts[1][axis], parts[2][axis]),
                    &ray,
                )
            })
        };
        let uv = |axis: usize| {
            let [a, b, c] = three(|i| weights[i] * f64::from(triangle.uv[i][axis]));
            Linear::new(a + b + c, &ray)
        };
        let uv = if is_textured {
            [uv(0), uv(1)]
        } else {
            Default::default()
        };
        Self {
            pixel,
            normal,
            uv,
            is_flat: triangle.is_flat,
        }
    }

    /// Vectors along the normals of eight pixels from a column on.
    pub fn normals(&self, column: usize, row: usize) -> Vectors {
        three(|i| self.normal[i].at(self.offset(column, row)))
    }

    /// The texture coordinates of eight pixels from a column on, divided by the depth in perspective.
    pub fn uv(&self, column: usize, row: usize) -> [f32x8; 2] {
        [
            self.uv[0].at(self.offset(column, row)),
            self.uv[1].at(self.offset(column, row)),
        ]
    }

    fn offset(&self, column: usize, row: usize) -> [f32; 2] {
        [
            column as f32 - f32::from(self.pixel[0]),
            row as f32 - f32::from(self.pixel[1]),
        ]
    }
}

/// The weights of the corners, divided by the depth in perspective, as functions of the ray.
fn weights(view: &View, surface: &Surface, face: &Face) -> [Vector3<f64>; 3] {
    if face.is_uniform {
        let closeness = if view.perspective {
            f64::from(face.range[0] + face.range[1]) / 2.0
        } else {
            1.0
        };
        return [Vector3::new(0.0, 0.0, closeness / 3.0); 3];
    }
    let corners = surface.corners(numbers::place(face.detail));
    let [a, b, c] = three(|i| view.homogeneous(corners[i]));
    let (ab, bc, ca) = (a.cross(&b), b.cross(&c), c.cross(&a));
    let over_volume = 1.0 / ab.dot(&c);
    [bc * over_volume, ca * over_volume, ab * over_volume]
}
