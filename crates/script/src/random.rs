//! Random numbers of scripts: one generator per interpreter, with the same seed at each start.

use std::f64::consts::TAU;

use nalgebra::{Quaternion, UnitQuaternion};
use rand_mt::Mt;

/// The Mersenne twister behind `sim.getRandom`: 32 bits per number, so that the sequences are those scripts know.
pub struct Random {
    seed: u32,
    /// How many numbers were drawn since the seed: with it all that is to come is known.
    drawn: u64,
    /// Made with the first number: it has 2.5 kB, and most scripts want none.
    generator: Option<Box<Mt>>,
}

impl Default for Random {
    fn default() -> Self {
        Self::new(Self::DEFAULT_SEED)
    }
}

impl Random {
    /// The seed every script starts with.
    pub const DEFAULT_SEED: u32 = 123_456;

    pub(crate) fn new(seed: u32) -> Self {
        Self {
            seed,
            drawn: 0,
            generator: None,
        }
    }

    /// The place in the sequence: the seed, and how many numbers were drawn since.
    pub(crate) fn place(&self) -> (u32, u64) {
        (self.seed, self.drawn)
    }

    /// Begins another sequence.
    pub fn restart(&mut self, seed: u32) {
        *self = Self::new(seed);
    }

    /// The next number in [0, 1).
    pub fn next(&mut self) -> f64 {
        let generator = self
            .generator
            .get_or_insert_with(|| Box::new(Mt::new(self.seed)));
        self.drawn += 1;
        f64::from(generator.next_u32()) / 4_294_967_296.0
    }

    /// A word of letters and digits.
    pub(crate) fn string(&mut self, length: usize) -> String {
        const LETTERS: &[u8; 62] =
            b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
        (0..length)
            .map(|_| char::from(LETTERS[numbers::index(self.next() * 62.0)]))
            .collect()
    }

    /// A rotation, all being equally likely (K. Shoemake, Uniform random rotations, Graphics Gems III).
    pub fn rotation(&mut self) -> UnitQuaternion<f64> {
        let (share, first, second) = (self.next(), TAU * self.next(), TAU * self.next());
        let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
        UnitQuaternion::new_normalize(Quaternion::new(
            b * libm::cos(second),
            a * libm::sin(first),
            a * libm::cos(first),
            b * libm::sin(second),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::Random;

    #[test]
    fn starts_with_the_recorded_numbers() {
        let mut random = Random::new(Random::DEFAULT_SEED);
        assert!((random.next() - 0.126_970).abs() < 5e-7);
        assert!((random.next() - 0.514_913).abs() < 5e-7);
    }
}
