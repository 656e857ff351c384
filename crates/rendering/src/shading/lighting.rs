//! The light that surfaces reflect: the lighting model of OpenGL's fixed functions, in each pixel.
//!
//! `emission + a * (ambient + sum of s * diffuse * max(N.L, 0)) + specular * (sum of s * light's specular * max(N.H, 0)^shininess)`
//! with the material's colour a for ambient and diffuse light, the unit normal N, the unit vector L to the light, the unit vector H half-way
//! between L and the direction to a viewer at infinity; H counts where N.L is positive. The strength s is
//! `1 / (c0 + c1 d + c2 d^2)` at the distance d, for spots times the power of the cosine of the angle to the axis, 0 beyond the cutoff; it
//! is 1 for directional lights (M. Segal and K. Akeley, *The OpenGL Graphics System: A Specification*, version 1.3, section 2.13.1; the
//! half-way vector is J. Blinn's, *Models of light reflection for computer synthesized pictures*, 1977).

use geometry::Finite;
use nalgebra::Vector3;
use wide::f32x8;

use crate::projection::view::View;
use crate::shading::shadows::{Shadows, Source};
use crate::three::three;
use crate::{Light, LightKind, Material, World};

/// Three numbers of eight pixels each.
pub type Vectors = [f32x8; 3];

/// The lights of a world, in the camera's axes: right, up, depth; metres.
#[derive(Debug)]
pub struct Lighting<'a> {
    ambient: [f32; 3],
    lights: Vec<PlacedLight>,
    shadows: Option<Shadows<'a>>,
    /// Whether all lights shine everywhere from the same direction, without shadows.
    pub is_uniform: bool,
}

#[derive(Debug, Clone)]
struct PlacedLight {
    light: Light,
    position: [f32; 3],
    /// The direction to a directional light; against the axis of a spot.
    to_light: [f32; 3],
    /// Half-way between a directional light and the viewer.
    half: [f32; 3],
    /// Of half the opening of a spot.
    cutoff_cosine: f32,
}

impl<'a> Lighting<'a> {
    /// Lights with poses that are not finite are left out.
    pub fn new(world: &World<'a>, view: &View) -> Self {
        let lights = world.lights.iter().filter(|light| light.pose.is_finite());
        let lights: Vec<PlacedLight> = lights.map(|light| PlacedLight::new(light, view)).collect();
        let has_shadows = world.shadows && lights.iter().any(|placed| placed.light.casts_shadows);
        let shadows = has_shadows.then(|| Shadows::new(world, view));
        let is_uniform = !has_shadows
            && lights
                .iter()
                .all(|placed| placed.light.kind == LightKind::Directional);
        Self {
            ambient: world.ambient,
            lights,
            shadows,
            is_uniform,
        }
    }

    /// The colours of eight points of a surface; the normals need not have unit length. Only the first `count` points have shadows.
    pub fn lit(
        &self,
        material: &Material,
        normals: Vectors,
        points: Vectors,
        count: usize,
    ) -> Vectors {
        let normals = normalized(normals);
        let has_highlights = material.specular != [0.0; 3];
        let (mut diffuse, mut specular) = (splat(self.ambient), [f32x8::ZERO; 3]);
        for placed in &self.lights {
            let mut incoming = placed.incoming(points);
            if let Some(shadows) = self.shadows.as_ref().filter(|_| placed.light.casts_shadows) {
                incoming.strength *= shadows.reach(placed.source(), points, normals, count);
            }
            let cosine = dot(normals, incoming.to_light);
            add_scaled(
                &mut diffuse,
                positive(cosine) * incoming.strength,
                placed.light.diffuse,
            );
            if has_highlights && placed.light.specular != [0.0; 3] {
                let highlight = power(positive(dot(normals, incoming.half)), material.shininess);
                let highlight = (highlight * incoming.strength) & cosine.simd_gt(f32x8::ZERO);
                add_scaled(&mut specular, highlight, placed.light.specular);
            }
        }
        three(|i| {
            diffuse[i] * material.ambient_diffuse[i]
                + specular[i] * material.specular[i]
                + f32x8::splat(material.emission[i])
        })
    }
}

/// Light that arrives at eight points.
struct Incoming {
    to_light: Vectors,
    half: Vectors,
    strength: f32x8,
}

impl PlacedLight {
    fn new(light: &Light, view: &View) -> Self {
        let transform = view.transform(&light.pose);
        let cutoff_cosine = match light.kind {
            LightKind::Spot { cutoff, .. } => numbers::single(libm::cos(cutoff)),
            _ => -1.0,
        };
        let to_light = -view.in_metres(transform.rotation.column(2).into());
        let half = (to_light - Vector3::z())
            .try_normalize(1e-12)
            .unwrap_or_default();
        Self {
            light: *light,
            position: view.in_metres(transform.translation).cast().into(),
            to_light: to_light.cast().into(),
            half: half.cast().into(),
            cutoff_cosine,
        }
    }

    fn source(&self) -> Source {
        match self.light.kind {
            LightKind::Directional => Source::Direction(self.to_light),
            LightKind::Omni | LightKind::Spot { .. } => Source::Point(self.position),
        }
    }

    fn incoming(&self, points: Vectors) -> Incoming {
        if self.light.kind == LightKind::Directional {
            let (to_light, half) = (splat(self.to_light), splat(self.half));
            return Incoming {
                to_light,
                half,
                strength: f32x8::ONE,
            };
        }
        let offset = three(|i| f32x8::splat(self.position[i]) - points[i]);
        let distance = dot(offset, offset).sqrt();
        let to_light = normalized(offset);
        let half = normalized([to_light[0], to_light[1], to_light[2] - f32x8::ONE]);
        let [constant, linear, quadratic] = splat(self.light.attenuation);
        let faded = f32x8::ONE / (constant + (linear + quadratic * distance) * distance);
        Incoming {
            to_light,
            half,
            strength: faded * self.cone(to_light),
        }
    }

    /// The part of a spot's light in the direction of eight points.
    fn cone(&self, to_light: Vectors) -> f32x8 {
        let LightKind::Spot { exponent, .. } = self.light.kind else {
            return f32x8::ONE;
        };
        let cosine = dot(to_light, splat(self.to_light));
        let inside = cosine.simd_ge(f32x8::splat(self.cutoff_cosine));
        power(positive(cosine), exponent) & inside
    }
}

fn splat(vector: [f32; 3]) -> Vectors {
    three(|i| f32x8::splat(vector[i]))
}

fn dot(a: Vectors, b: Vectors) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What is not positive becomes zero, what is no number too.
fn positive(numbers: f32x8) -> f32x8 {
    numbers & numbers.simd_gt(f32x8::ZERO)
}

/// Vectors of unit length; zero remains zero.
fn normalized(vectors: Vectors) -> Vectors {
    let least = f32x8::splat(f32::MIN_POSITIVE);
    let square = dot(vectors, vectors);
    let scale = f32x8::ONE / square.simd_gt(least).select(square, least).sqrt();
    three(|i| vectors[i] * scale)
}

fn add_scaled(sum: &mut Vectors, amount: f32x8, colour: [f32; 3]) {
    for (part, colour) in sum.iter_mut().zip(colour) {
        *part += amount * colour;
    }
}

/// A power by repeated squaring: the same bits on every machine.
fn power(mut base: f32x8, mut exponent: u32) -> f32x8 {
    let mut result = f32x8::ONE;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result *= base;
        }
        base *= base;
        exponent >>= 1;
    }
    result
}
