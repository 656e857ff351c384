//! The light that surfaces reflect: the lighting model of OpenGL's fixed functions.
//!
//! `emission + ambient * a + sum over lights of s / (c0 + c1 d + c2 d^2) * (max(N.L, 0) * diffuse * a + max(N.H, 0)^shininess * specular)`
//! with the material's colour a for ambient and diffuse light, the unit normal N, the unit vector L to the light at the distance d, the unit
//! vector H half-way between L and the direction to a viewer at infinity, and for spots s the power of the cosine of the angle to the
//! axis, 0 beyond the cutoff (M. Segal and K. Akeley, *The OpenGL Graphics System: A Specification*, version 1.3, section 2.13.1; the
//! half-way vector is J. Blinn's, *Models of light reflection for computer synthesized pictures*, 1977).

use geometry::Finite;
use nalgebra::Vector3;

use crate::view::View;
use crate::{Light, LightKind, Material, World};

/// The lights of a world, in the camera's axes: right, up, depth; metres.
#[derive(Debug, Clone)]
pub struct Lighting {
    ambient: [f32; 3],
    lights: Vec<PlacedLight>,
}

#[derive(Debug, Clone)]
struct PlacedLight {
    light: Light,
    position: Vector3<f32>,
    /// Where it shines.
    axis: Vector3<f32>,
    /// Of half the opening.
    cutoff_cosine: f32,
}

impl Lighting {
    /// Lights with poses that are not finite are left out.
    pub fn new(world: &World, view: &View) -> Self {
        let placed =
            world.lights.iter().filter(|light| light.pose.is_finite()).map(|light| PlacedLight::new(light, view));
        Self { ambient: world.ambient, lights: placed.collect() }
    }

    /// The colour of a point of a surface.
    pub fn lit(&self, material: &Material, point: &Vector3<f32>, normal: &Vector3<f32>) -> [f32; 3] {
        let mut colour = [0, 1, 2].map(|i| material.emission[i] + material.ambient_diffuse[i] * self.ambient[i]);
        for placed in &self.lights {
            let (diffuse, specular) = placed.reflected(material.shininess, point, normal);
            for (i, part) in colour.iter_mut().enumerate() {
                *part += diffuse * placed.light.diffuse[i] * material.ambient_diffuse[i];
                *part += specular * placed.light.specular[i] * material.specular[i];
            }
        }
        colour
    }
}

impl PlacedLight {
    fn new(light: &Light, view: &View) -> Self {
        let transform = view.transform(&light.pose);
        let cutoff_cosine = match light.kind {
            LightKind::Spot { cutoff, .. } => libm::cos(cutoff) as f32,
            _ => -1.0,
        };
        Self {
            light: *light,
            position: view.in_metres(transform.translation).cast(),
            axis: view.in_metres(transform.rotation.column(2).into()).cast(),
            cutoff_cosine,
        }
    }

    /// How much diffuse and specular light is reflected.
    fn reflected(&self, shininess: u32, point: &Vector3<f32>, normal: &Vector3<f32>) -> (f32, f32) {
        let (to_light, strength) = self.incoming(point);
        let cosine = normal.dot(&to_light);
        if cosine <= 0.0 || strength == 0.0 {
            return (0.0, 0.0);
        }
        let half = (to_light - Vector3::z()).try_normalize(1e-12).unwrap_or_default();
        (strength * cosine, strength * power(normal.dot(&half).max(0.0), shininess))
    }

    /// The direction to the light, and how much of it arrives at a point.
    fn incoming(&self, point: &Vector3<f32>) -> (Vector3<f32>, f32) {
        let offset = self.position - point;
        let distance = offset.norm();
        let to_light = offset / distance.max(f32::MIN_POSITIVE);
        let [constant, linear, quadratic] = self.light.attenuation;
        let faded = 1.0 / (constant + linear * distance + quadratic * distance * distance);
        match self.light.kind {
            LightKind::Directional => (-self.axis, 1.0),
            LightKind::Omni => (to_light, faded),
            LightKind::Spot { exponent, .. } => {
                let cosine = -to_light.dot(&self.axis);
                (to_light, if cosine < self.cutoff_cosine { 0.0 } else { faded * power(cosine.max(0.0), exponent) })
            }
        }
    }
}

/// A power by repeated squaring: the same bits on every machine.
pub fn power(mut base: f32, mut exponent: u32) -> f32 {
    let mut result = 1.0;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result *= base;
        }
        base *= base;
        exponent >>= 1;
    }
    result
}
