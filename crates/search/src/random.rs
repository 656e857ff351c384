//! Random values, the same everywhere for a seed.

use rand_mt::Mt64;

use super::choice::{Domain, Value};

/// How often a value is one of the remarkable ones: bounds, the simplest.
const REMARKABLE: f64 = 0.08;

/// A generator of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Random(Mt64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Mt64::new(seed))
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A number in [0, 1).
    pub(crate) fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number below `count`, which is not zero.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.share() * count as f64) as usize).min(count - 1)
    }

    /// A number below `count`, which is not zero; greater ones are more likely.
    pub(crate) fn late_below(&mut self, count: usize) -> usize {
        let from_end = self.below(count) + 1;
        count - 1 - self.below(from_end)
    }

    /// A number of the standard normal distribution, by the method of Box and Muller.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.share()));
        radius * libm::cos(std::f64::consts::TAU * self.share())
    }

    /// A value of that domain.
    pub(crate) fn value(&mut self, domain: Domain) -> Value {
        let is_value = !matches!(domain, Domain::Follows { .. });
        if is_value && self.share() < REMARKABLE {
            return [domain.simplest(), domain.min(), domain.max()][self.below(3)];
        }
        domain.at(self.share())
    }
}
