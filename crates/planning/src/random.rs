//! Where random numbers come from: the caller's generator, so that the caller's seed decides.

/// A generator of random numbers.
pub trait Random {
    /// A number from 0 to 1, without 1, all equally likely.
    fn next(&mut self) -> f64;

    /// A number from `low` to `high`, all equally likely.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A place in a list of so many, which is not empty.
    fn index(&mut self, count: usize) -> usize {
        ((self.next() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// A normally distributed number of mean 0 and deviation 1 (Box and Muller).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.next())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.next())
    }
}
