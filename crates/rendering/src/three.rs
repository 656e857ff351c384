//! Three of something.

/// `[f(0), f(1), f(2)]`. The compiler does not always inline `array::map`, which makes loops over pixels a third slower.
#[inline(always)]
pub fn three<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}
