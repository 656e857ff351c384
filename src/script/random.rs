//! Random numbers of scripts: one generator per Lua state, seeded alike at each start.

use rand_mt::Mt;

/// The Mersenne twister behind `sim.getRandom`: 32 bits per number, so that the sequences are those scripts know.
pub(crate) struct Random {
    generator: Mt,
}

impl Random {
    /// The seed every script starts with.
    pub const DEFAULT_SEED: u32 = 123_456;

    pub(crate) fn new(seed: u32) -> Self {
        Self { generator: Mt::new(seed) }
    }

    /// The next number in [0, 1).
    pub(crate) fn next(&mut self) -> f64 {
        f64::from(self.generator.next_u32()) / 4_294_967_296.0
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
