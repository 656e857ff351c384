//! Gas in a closed surface of triangles.

use crate::V3;

/// Pressure of the air outside, Pa.
const ATMOSPHERE: f64 = 101_325.0;

/// Gas of constant temperature: the product of its absolute pressure and its volume is constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gas {
    /// Absolute pressure times volume, J.
    amount: f64,
}

impl Gas {
    /// Gas with a pressure above that of the air outside (Pa) in a volume (m3).
    pub(crate) fn new(pressure: f64, volume: f64) -> Self {
        Self {
            amount: (pressure + ATMOSPHERE) * volume,
        }
    }

    /// Pressure above that of the air outside, Pa.
    pub(crate) fn pressure(self, volume: f64) -> f64 {
        self.amount / volume - ATMOSPHERE
    }

    /// Potential energy, with the work of the air outside; None in a volume that is none.
    pub(crate) fn potential(self, volume: f64) -> Option<f64> {
        (volume > 0.0).then(|| ATMOSPHERE * volume - self.amount * libm::log(volume))
    }

    /// How the pressure falls with the volume, Pa/m3.
    pub(crate) fn stiffness(self, volume: f64) -> f64 {
        self.amount / (volume * volume)
    }
}

/// Volume within triangles that are closed, m3.
pub(crate) fn volume_of(triangles: &[[usize; 3]], places: &[V3]) -> f64 {
    let parts = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|node| places[node] - places[triangles[0][0]]);
        a.dot(&b.cross(&c))
    });
    parts.sum::<f64>() / 6.0
}

/// How that volume changes with the places.
pub(crate) fn volume_gradient(triangles: &[[usize; 3]], places: &[V3]) -> Vec<V3> {
    let mut gradient = vec![V3::zeros(); places.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|node| places[node]);
        let third = (b - a).cross(&(c - a)) / 6.0;
        triangle.iter().for_each(|node| gradient[*node] += third);
    }
    gradient
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_and_its_gradient() {
        let places = [V3::x(), V3::x() * 2.0, V3::x() + V3::y(), V3::x() + V3::z()];
        let triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        assert!((volume_of(&triangles, &places) - 1.0 / 6.0).abs() < 1e-12);
        let gradient = volume_gradient(&triangles, &places);
        for node in 0..4 {
            for axis in 0..3 {
                let mut moved = places;
                moved[node][axis] += 1e-3;
                let change = (volume_of(&triangles, &moved) - 1.0 / 6.0) / 1e-3;
                assert!((change - gradient[node][axis]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn half_the_volume_has_twice_the_pressure() {
        let gas = Gas::new(1000.0, 0.02);
        assert!((gas.pressure(0.02) - 1000.0).abs() < 1e-6);
        assert!((gas.pressure(0.01) - 103_325.0).abs() < 1e-6);
        let slope = (gas.potential(0.0201).unwrap() - gas.potential(0.0199).unwrap()) / 0.0002;
        assert!((slope + gas.pressure(0.02)).abs() < 10.0);
        assert!(gas.potential(0.0).is_none());
    }
}
