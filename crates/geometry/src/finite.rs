//! Whether one can compute with numbers.

use nalgebra::Vector3;

use crate::Pose;

/// Numbers, lists of numbers and poses, all of whose coordinates may be finite.
pub trait Finite {
    /// Whether no coordinate is infinite or NaN.
    fn is_finite(&self) -> bool;

    /// The same value; None where a coordinate is infinite or NaN.
    fn finite(self) -> Option<Self>
    where
        Self: Sized,
    {
        self.is_finite().then_some(self)
    }
}

impl Finite for f64 {
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
}

impl Finite for f32 {
    fn is_finite(&self) -> bool {
        f32::is_finite(*self)
    }
}

impl<T: Finite> Finite for [T] {
    fn is_finite(&self) -> bool {
        self.iter().all(Finite::is_finite)
    }
}

impl<T: Finite> Finite for &[T] {
    fn is_finite(&self) -> bool {
        (**self).is_finite()
    }
}

impl<T: Finite, const N: usize> Finite for [T; N] {
    fn is_finite(&self) -> bool {
        self.as_slice().is_finite()
    }
}

impl Finite for Vector3<f64> {
    fn is_finite(&self) -> bool {
        self.as_slice().is_finite()
    }
}

impl Finite for Pose {
    fn is_finite(&self) -> bool {
        self.translation.vector.is_finite() && self.rotation.coords.as_slice().is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bad_coordinate_is_enough() {
        assert_eq!([1.0, 2.0].finite(), Some([1.0, 2.0]));
        assert_eq!([1.0, f64::NAN].finite(), None);
        assert!(
            Pose::identity().is_finite() && !Pose::translation(0.0, f64::INFINITY, 0.0).is_finite()
        );
        assert!(!Finite::is_finite(&f32::NEG_INFINITY) && [[0.0_f64; 3]; 2].is_finite());
    }
}
