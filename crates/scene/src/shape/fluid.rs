//! The fluid that a body moves in: what robots in MJCF have.

use crate::{Data, Object};

/// Name of the custom data of a shape that say in what fluid it moves: see [`Fluid`].
pub const FLUID: &str = "mjcfFluid";

/// A fluid at rest that slows a body down. As text: `density=1000 viscosity=0.001`; what is not there is 0.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fluid {
    /// kg/m³
    pub density: f64,
    /// Pa s
    pub viscosity: f64,
}

impl Fluid {
    /// What a text says; None if it says nothing that slows anything down. Words that mean nothing are not looked at.
    pub fn parse(text: &str) -> Option<Self> {
        let mut fluid = Self::default();
        for (name, number) in text
            .split_whitespace()
            .filter_map(|word| word.split_once('='))
        {
            let field = match name {
                "density" => &mut fluid.density,
                "viscosity" => &mut fluid.viscosity,
                _ => continue,
            };
            let number = number.parse::<f64>().ok();
            *field = number
                .filter(|number| number.is_finite() && *number > 0.0)
                .unwrap_or(0.0);
        }
        (fluid != Self::default()).then_some(fluid)
    }
}

impl std::fmt::Display for Fluid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "density={} viscosity={}", self.density, self.viscosity)
    }
}

impl Object {
    /// The fluid that this shape moves in, if it says one.
    pub fn fluid(&self) -> Option<Fluid> {
        let (_, value) = self.custom_data.typed(FLUID)?;
        match value {
            Data::Text(text) | Data::Buffer(text) => Fluid::parse(&String::from_utf8_lossy(text)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fluid_is_what_its_text_says() {
        let fluid = Fluid {
            density: 4000.0,
            viscosity: 0.1,
        };
        assert_eq!(Fluid::parse(&fluid.to_string()), Some(fluid));
        let viscous = Fluid::parse("odd viscosity=2 density=inf");
        assert_eq!(
            viscous.map(|fluid| [fluid.density, fluid.viscosity]),
            Some([0.0, 2.0])
        );
        assert_eq!(Fluid::parse("density=-1"), None);
        assert_eq!(Fluid::parse(""), None);
    }
}
