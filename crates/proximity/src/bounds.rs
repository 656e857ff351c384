//! Axis-aligned boxes.

use geometry::Pose;
use nalgebra::Vector3;

/// An axis-aligned box, corners included. Metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: [f64; 3],
    /// The corner with the largest coordinates.
    pub max: [f64; 3],
}

impl Bounds {
    /// The box without points: merged with another one it is the other one.
    pub const EMPTY: Self = Self {
        min: [f64::INFINITY; 3],
        max: [f64::NEG_INFINITY; 3],
    };

    /// The smallest box around points; [`Bounds::EMPTY`] without points.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a [f64; 3]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, point| {
            bounds.merged(&Self {
                min: *point,
                max: *point,
            })
        })
    }

    /// The smallest box around both.
    #[inline]
    pub fn merged(&self, other: &Self) -> Self {
        let mut merged = *self;
        for i in 0..3 {
            merged.min[i] = smaller(self.min[i], other.min[i]);
            merged.max[i] = larger(self.max[i], other.max[i]);
        }
        merged
    }

    /// The smallest box, with the axes of the frame that `pose` leads to, around this one. [`Bounds::EMPTY`] stays.
    pub fn transformed(&self, pose: &Pose) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let centre = pose * nalgebra::Point3::from(self.centre());
        let half =
            pose.rotation.to_rotation_matrix().into_inner().abs() * Vector3::from(self.half_size());
        Self {
            min: (centre.coords - half).into(),
            max: (centre.coords + half).into(),
        }
    }

    /// The box grown by `margin` (m) on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self {
            min: self.min.map(|x| x - margin),
            max: self.max.map(|x| x + margin),
        }
    }

    /// Whether there is no point in it.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|i| self.min[i] > self.max[i])
    }

    /// The middle of the box.
    #[inline]
    pub fn centre(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| 0.5 * (self.min[i] + self.max[i]))
    }

    /// Half of the extents.
    #[inline]
    pub fn half_size(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| 0.5 * (self.max[i] - self.min[i]))
    }

    /// Half of the surface (m²): what the chance grows with that a random ray meets the box.
    #[inline]
    pub fn half_area(&self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|i| self.max[i] - self.min[i]);
        x * y + y * z + z * x
    }

    /// Whether the boxes have a point in common.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    /// Whether the other box is inside.
    #[inline]
    pub fn contains(&self, other: &Self) -> bool {
        (0..3).all(|i| self.min[i] <= other.min[i] && other.max[i] <= self.max[i])
    }

    /// Distance of a point from the box (m); 0 inside.
    pub fn distance_to_point(&self, point: &[f64; 3]) -> f64 {
        self.distance_squared_to_point(point).sqrt()
    }

    /// Square of [`Bounds::distance_to_point`] (m²).
    #[inline]
    pub fn distance_squared_to_point(&self, point: &[f64; 3]) -> f64 {
        (0..3)
            .map(|i| square(gap(self.min[i], self.max[i], point[i], point[i])))
            .sum()
    }

    /// Distance between the boxes (m); 0 where they overlap.
    pub fn distance(&self, other: &Self) -> f64 {
        self.distance_squared(other).sqrt()
    }

    /// Square of [`Bounds::distance`] (m²).
    #[inline]
    pub fn distance_squared(&self, other: &Self) -> f64 {
        (0..3)
            .map(|i| square(gap(self.min[i], self.max[i], other.min[i], other.max[i])))
            .sum()
    }
}

/// Distance between two intervals; 0 where they overlap.
#[inline]
fn gap(low: f64, high: f64, other_low: f64, other_high: f64) -> f64 {
    larger(larger(low - other_high, other_low - high), 0.0)
}

#[inline]
fn square(x: f64) -> f64 {
    x * x
}

/// Minimum in one instruction; of a NaN and a number it is `b`.
#[inline]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Maximum in one instruction; of a NaN and a number it is `b`.
#[inline]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
