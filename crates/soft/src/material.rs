//! What a rod is made of.

use std::f64::consts::PI;

/// The stiffness, damping and strength of a rod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Radius of the cross section, metres.
    pub radius: f64,
    /// Mass of a metre, kilograms.
    pub line_density: f64,
    /// Force per strain, newtons: modulus times area.
    pub stretch: f64,
    /// Moment per curvature, N m2: modulus times second moment of area.
    pub bend: f64,
    /// Torque per twist of a metre, N m2.
    pub twist: f64,
    /// Ratio of viscous to elastic stiffness, seconds: what is strained is damped.
    pub damping: f64,
    /// What the surroundings take of the velocity, per second.
    pub drag: f64,
    /// Tension at which an edge breaks, newtons.
    pub strength: f64,
}

impl Material {
    /// A round rod of one material: `young` and `shear` modulus in pascals, `density` in kg/m3.
    pub fn solid(radius: f64, density: f64, young: f64, shear: f64) -> Self {
        let area = PI * radius * radius;
        let second_moment = area * radius * radius / 4.0;
        Self {
            radius,
            line_density: density * area,
            stretch: young * area,
            bend: young * second_moment,
            twist: shear * 2.0 * second_moment,
            damping: 0.0,
            drag: 0.0,
            strength: f64::INFINITY,
        }
    }
}
