//! What cloths and soft volumes are made of.

/// The stiffness, damping and strength of finite elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Distance from its surface at which it touches something, metres.
    pub radius: f64,
    /// Of a cloth: modulus times thickness by 1 - the square of Poisson's ratio, N/m.
    pub stretch: f64,
    /// Of a cloth: moment per curvature of a unit of width, N m.
    pub bend: f64,
    /// Poisson's ratio of a cloth.
    pub poisson: f64,
    /// Lame's first parameter of a volume, Pa.
    pub lambda: f64,
    /// Shear modulus of a volume, Pa.
    pub shear: f64,
    /// Ratio of viscous to elastic stiffness, seconds: what is strained is damped.
    pub damping: f64,
    /// What the surroundings take of the velocity, per second.
    pub drag: f64,
    /// Tension at which a triangle tears, N/m.
    pub strength: f64,
}

impl Material {
    /// A sheet of one material of a thickness (metres): `young`'s modulus in pascals, `poisson`'s ratio.
    pub fn sheet(thickness: f64, young: f64, poisson: f64) -> Self {
        let stretch = young * thickness / (1.0 - poisson * poisson);
        Self {
            radius: 0.5 * thickness,
            stretch,
            bend: stretch * thickness * thickness / 12.0,
            poisson,
            ..Self::solid(young, poisson)
        }
    }

    /// A volume of one material: `young`'s modulus in pascals, `poisson`'s ratio, below one half.
    pub fn solid(young: f64, poisson: f64) -> Self {
        Self {
            radius: 0.0,
            stretch: 0.0,
            bend: 0.0,
            poisson,
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            shear: young / (2.0 * (1.0 + poisson)),
            damping: 0.0,
            drag: 0.0,
            strength: f64::INFINITY,
        }
    }
}
