//! Matrices of pixels, of bytes or floats and any number of channels, with the arithmetic of OpenCV (spec: simim 1).
//!
//! Bytes saturate, and conversions round to the nearest, halves to even. Rows are stored in order; the first one is row 0.

mod arithmetic;
mod channels;
mod colour;
mod distance;
mod polar;
mod rearrange;
mod resample;

pub use arithmetic::{Bitwise, Comparison};
pub use distance::{DistanceType, MaskSize};
pub use rearrange::{Flip, Reduction};
pub use resample::Interpolation;

/// Values of a matrix at most: a gigabyte of floats.
const MAX_VALUES: usize = 1 << 28;

/// Why an operation is not possible. The texts begin as those of OpenCV's own exceptions do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MatrixError {
    /// Two images differ in size or format.
    #[error("OpenCV(core): the sizes or formats of the images do not match.")]
    Mismatch,
    /// The operation, which is named, is not defined for the format.
    #[error("OpenCV(core): {0} is not possible with images of this format.")]
    Format(&'static str),
    /// A region reaches beyond the image.
    #[error("OpenCV(core): the region is not inside of the image.")]
    Region,
    /// An image is empty or too large.
    #[error("OpenCV(core): an image has at least one pixel, and {MAX_VALUES} values at most.")]
    Size,
    /// A parameter, which is named, is out of range.
    #[error("OpenCV(core): {0} is out of range.")]
    Range(&'static str),
}

/// The result of an operation on images.
pub type MatrixResult<T> = Result<T, MatrixError>;

/// The type of one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// An unsigned byte.
    Byte,
    /// A float of 32 bits.
    Float,
}

/// Type and number of the values of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelFormat {
    /// The type of a value.
    pub depth: Depth,
    /// Values of a pixel.
    pub channels: usize,
}

impl PixelFormat {
    /// A format of so many channels of a type.
    pub const fn new(depth: Depth, channels: usize) -> Self {
        Self { depth, channels }
    }

    /// The number OpenCV has for the format.
    pub fn opencv_type(self) -> usize {
        let depth = if self.depth == Depth::Byte { 0 } else { 5 };
        depth + (self.channels.saturating_sub(1) << 3)
    }
}

/// The values of all pixels, row by row.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Bytes.
    Bytes(Vec<u8>),
    /// Floats.
    Floats(Vec<f32>),
}

/// An image.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    width: usize,
    height: usize,
    channels: usize,
    values: Values,
}

/// Types of matrix values.
pub(crate) trait Value: Copy + PartialOrd + Default {
    fn to_f64(self) -> f64;
    fn from_f64(number: f64) -> Self;
}

impl Value for u8 {
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn from_f64(number: f64) -> Self {
        numbers::level(round_to_even(number.clamp(0.0, 255.0)))
    }
}

impl Value for f32 {
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn from_f64(number: f64) -> Self {
        numbers::single(number)
    }
}

/// Rounds numbers up to 2^51 to the nearest integer, halves to even: adding this constant leaves no bits for a fraction.
fn round_to_even(number: f64) -> f64 {
    const NO_FRACTION: f64 = 6_755_399_441_055_744.0;
    (number + NO_FRACTION) - NO_FRACTION
}

/// Calls a generic function for the values of matrices, whose depth is the same.
macro_rules! with_values {
    ($matrix:expr, $values:ident => $body:expr) => {
        match &$matrix.values {
            $crate::matrix::Values::Bytes($values) => $crate::matrix::Values::Bytes($body),
            $crate::matrix::Values::Floats($values) => $crate::matrix::Values::Floats($body),
        }
    };
}
use with_values;

impl Matrix {
    /// An image whose first channel has a value; the others are 0.
    ///
    /// # Errors
    /// When it has no pixel or too many.
    pub fn new([width, height]: [usize; 2], format: PixelFormat, first: f64) -> MatrixResult<Self> {
        let count = value_count([width, height], format.channels)?;
        let values = match format.depth {
            Depth::Byte => Values::Bytes(with_first(count, format.channels, first)),
            Depth::Float => Values::Floats(with_first(count, format.channels, first)),
        };
        Ok(Self {
            width,
            height,
            channels: format.channels,
            values,
        })
    }

    /// An image of bytes.
    ///
    /// # Errors
    /// When their number is not that of the values.
    pub fn from_bytes(
        [width, height]: [usize; 2],
        channels: usize,
        bytes: Vec<u8>,
    ) -> MatrixResult<Self> {
        if bytes.len() != value_count([width, height], channels)? {
            return Err(MatrixError::Size);
        }
        Ok(Self {
            width,
            height,
            channels,
            values: Values::Bytes(bytes),
        })
    }

    /// An image of floats.
    ///
    /// # Errors
    /// When their number is not that of the values.
    pub fn from_floats(
        [width, height]: [usize; 2],
        channels: usize,
        floats: Vec<f32>,
    ) -> MatrixResult<Self> {
        if floats.len() != value_count([width, height], channels)? {
            return Err(MatrixError::Size);
        }
        Ok(Self {
            width,
            height,
            channels,
            values: Values::Floats(floats),
        })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Type and number of the values of a pixel.
    pub fn format(&self) -> PixelFormat {
        let depth = match self.values {
            Values::Bytes(_) => Depth::Byte,
            Values::Floats(_) => Depth::Float,
        };
        PixelFormat {
            depth,
            channels: self.channels,
        }
    }

    /// All values, row by row.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// The values when they are bytes.
    pub fn bytes(&self) -> Option<&[u8]> {
        if let Values::Bytes(bytes) = &self.values {
            Some(bytes)
        } else {
            None
        }
    }

    /// The value at an index.
    pub fn value(&self, at: usize) -> Option<f64> {
        match &self.values {
            Values::Bytes(bytes) => bytes.get(at).copied().map(f64::from),
            Values::Floats(floats) => floats.get(at).copied().map(f64::from),
        }
    }

    /// Sets the value at an index; bytes saturate. Nothing happens outside of the image.
    pub fn set_value(&mut self, at: usize, value: f64) {
        match &mut self.values {
            Values::Bytes(bytes) => bytes
                .get_mut(at)
                .into_iter()
                .for_each(|byte| *byte = u8::from_f64(value)),
            Values::Floats(floats) => floats
                .get_mut(at)
                .into_iter()
                .for_each(|float| *float = numbers::single(value)),
        }
    }

    /// The image with values of another type, multiplied by a number.
    pub fn converted(&self, depth: Depth, scale: f64) -> Self {
        fn all<A: Value, B: Value>(values: &[A], scale: f64) -> Vec<B> {
            values
                .iter()
                .map(|value| B::from_f64(value.to_f64() * scale))
                .collect()
        }
        let values = match (&self.values, depth) {
            (Values::Bytes(values), Depth::Byte) => Values::Bytes(all(values, scale)),
            (Values::Bytes(values), Depth::Float) => Values::Floats(all(values, scale)),
            (Values::Floats(values), Depth::Byte) => Values::Bytes(all(values, scale)),
            (Values::Floats(values), Depth::Float) => Values::Floats(all(values, scale)),
        };
        self.with(values)
    }

    /// An image of the same size and number of channels.
    fn with(&self, values: Values) -> Self {
        Self {
            values,
            ..self.shape()
        }
    }

    /// The sizes alone.
    fn shape(&self) -> Self {
        Self {
            width: self.width,
            height: self.height,
            channels: self.channels,
            values: Values::Bytes(Vec::new()),
        }
    }

    pub(crate) fn require(&self, possible: bool, operation: &'static str) -> MatrixResult<()> {
        if possible {
            Ok(())
        } else {
            Err(MatrixError::Format(operation))
        }
    }
}

fn with_first<T: Value>(count: usize, channels: usize, first: f64) -> Vec<T> {
    let mut values = vec![T::default(); count];
    values
        .iter_mut()
        .step_by(channels)
        .for_each(|value| *value = T::from_f64(first));
    values
}

fn value_count([width, height]: [usize; 2], channels: usize) -> MatrixResult<usize> {
    let count = width
        .checked_mul(height)
        .and_then(|pixels| pixels.checked_mul(channels));
    count
        .filter(|count| (1..=MAX_VALUES).contains(count))
        .ok_or(MatrixError::Size)
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn bytes(size: [usize; 2], channels: usize, values: &[u8]) -> Matrix {
        Matrix::from_bytes(size, channels, values.to_vec()).unwrap()
    }

    pub(super) fn floats(size: [usize; 2], channels: usize, values: &[f32]) -> Matrix {
        Matrix::from_floats(size, channels, values.to_vec()).unwrap()
    }

    #[test]
    fn the_first_channel_is_set() {
        let image = Matrix::new([2, 1], PixelFormat::new(Depth::Byte, 3), 7.0).unwrap();
        assert_eq!(image.bytes(), Some(&[7, 0, 0, 7, 0, 0][..]));
        assert_eq!(image.format().opencv_type(), 16);
        assert_eq!(PixelFormat::new(Depth::Float, 2).opencv_type(), 13);
    }

    #[test]
    fn impossible_sizes_are_refused() {
        for size in [[0, 3], [usize::MAX, 2], [1 << 20, 1 << 20]] {
            assert_eq!(
                Matrix::new(size, PixelFormat::new(Depth::Byte, 3), 0.0),
                Err(MatrixError::Size)
            );
        }
        assert!(Matrix::from_bytes([2, 2], 1, vec![0; 5]).is_err());
    }

    #[test]
    fn conversions_saturate_and_round_to_even() {
        let image = floats([6, 1], 1, &[-3.0, 0.5, 1.5, 2.5, 254.7, 1e9]);
        assert_eq!(
            image.converted(Depth::Byte, 1.0).bytes(),
            Some(&[0, 0, 2, 2, 255, 255][..])
        );
        assert_eq!(
            floats([1, 1], 1, &[f32::NAN])
                .converted(Depth::Byte, 1.0)
                .bytes(),
            Some(&[0][..])
        );
        let back = bytes([2, 1], 1, &[0, 255]).converted(Depth::Float, 1.0 / 255.0);
        assert_eq!(back, floats([2, 1], 1, &[0.0, 1.0]));
    }
}
