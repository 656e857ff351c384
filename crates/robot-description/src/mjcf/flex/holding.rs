//! How firmly edges hold nodes: by constraints that give way, and by springs.

use super::Reader;
use crate::mjcf::attributes::Attributes;

/// MuJoCo's own settings of constraints: time constant (s) and damping ratio; impedances.
const SOLREF: [f64; 2] = [0.02, 1.0];
const SOLIMP: [f64; 2] = [0.9, 0.95];

/// Springs and dampers of a kind.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Holding {
    /// N/m.
    pub stiffness: f64,
    /// N s/m.
    pub damping: f64,
}

impl Holding {
    /// Both side by side.
    pub fn with(self, other: Self) -> Self {
        Self {
            stiffness: self.stiffness + other.stiffness,
            damping: self.damping + other.damping,
        }
    }

    /// Ratio of viscous to elastic stiffness, seconds.
    pub fn ratio(self) -> f64 {
        if self.stiffness > 0.0 {
            self.damping / self.stiffness
        } else {
            0.0
        }
    }
}

impl Reader<'_> {
    /// What a constraint between two nodes of that mass holds them with. MuJoCo gives way to a force f by an acceleration (1 - d) / d times f / m, and goes back by
    /// b v + k d r; its impedance d is taken as that of errors beyond a millimetre.
    pub fn constraint(
        &mut self,
        attributes: &Attributes,
        [solref, solimp]: [&str; 2],
        node_mass: f64,
    ) -> Holding {
        let [first, second] = attributes.numbers(self.report, solref, SOLREF);
        let impedances = attributes.numbers(self.report, solimp, SOLIMP);
        let most = impedances[1].clamp(1e-4, 0.9999);
        let [stiffness, damping] = if first > 0.0 && second > 0.0 {
            let period = most * first;
            [(period * second).powi(2).recip(), 2.0 / period]
        } else if first < 0.0 && second < 0.0 {
            [-first / most, -second / most]
        } else {
            [0.0; 2]
        };
        let inertia = node_mass * most / (1.0 - most);
        Holding {
            stiffness: inertia * most * stiffness,
            damping: inertia * damping,
        }
    }

    /// The spring and damper that attributes say.
    pub fn spring(&mut self, attributes: &Attributes) -> Holding {
        Holding {
            stiffness: self.number(attributes, "stiffness", 0.0).max(0.0),
            damping: self.number(attributes, "damping", 0.0).max(0.0),
        }
    }
}
