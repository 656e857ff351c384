//! Operations on each value, of one image, of two, or of an image and a number for each channel.

use super::{Depth, Matrix, MatrixError, MatrixResult, PixelFormat, Value, Values, with_values};

/// The numbers of an operation, one for each channel; those that are not there are 0.
const SCALAR: usize = 4;

/// A comparison of the values of two images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// a = b.
    Equal,
    /// a > b.
    Greater,
    /// a ≥ b.
    GreaterOrEqual,
    /// a < b.
    Less,
    /// a ≤ b.
    LessOrEqual,
    /// a ≠ b.
    NotEqual,
}

impl Comparison {
    fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Self::Equal => a == b,
            Self::Greater => a > b,
            Self::GreaterOrEqual => a >= b,
            Self::Less => a < b,
            Self::LessOrEqual => a <= b,
            Self::NotEqual => a != b,
        }
    }
}

/// An operation on the bits of two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bitwise {
    /// Bits that are set in both.
    And,
    /// Bits that are set in either.
    Or,
    /// Bits that are set in exactly one.
    Xor,
}

impl Bitwise {
    fn of(self, a: u32, b: u32) -> u32 {
        match self {
            Self::And => a & b,
            Self::Or => a | b,
            Self::Xor => a ^ b,
        }
    }
}

impl Matrix {
    /// The sum of two images, value by value.
    pub fn add(&self, other: &Self) -> MatrixResult<Self> {
        self.zip(other, |a, b| a + b)
    }

    /// This image less another, value by value.
    pub fn subtract(&self, other: &Self) -> MatrixResult<Self> {
        self.zip(other, |a, b| a - b)
    }

    /// The product of two images, value by value.
    pub fn multiply(&self, other: &Self) -> MatrixResult<Self> {
        self.zip(other, |a, b| a * b)
    }

    /// Bytes by 0 are 0.
    pub fn divide(&self, other: &Self) -> MatrixResult<Self> {
        let divide = quotient(self.format().depth);
        self.zip(other, divide)
    }

    /// The absolute difference of two images, value by value.
    pub fn difference(&self, other: &Self) -> MatrixResult<Self> {
        self.zip(other, |a, b| (a - b).abs())
    }

    /// `a self + b other + c`.
    pub fn add_weighted(&self, other: &Self, [a, b, c]: [f64; 3]) -> MatrixResult<Self> {
        self.zip(other, |x, y| x * a + y * b + c)
    }

    /// 255 where a comparison holds, else 0.
    pub fn compare(&self, other: &Self, comparison: Comparison) -> MatrixResult<Self> {
        let holds = self.zip_to(other, |a, b| u8::from(comparison.holds(a, b)) * 255)?;
        Ok(self.with(Values::Bytes(holds)))
    }

    /// An operation on the bits of two images; of floats, on the bits that represent them.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "an operation on the bits of bytes gives the bits of a byte"
    )]
    pub fn bitwise(&self, other: &Self, operation: Bitwise) -> MatrixResult<Self> {
        self.require_same(other)?;
        let values = match (&self.values, &other.values) {
            (Values::Bytes(a), Values::Bytes(b)) => Values::Bytes(
                a.iter()
                    .zip(b)
                    .map(|(a, b)| operation.of((*a).into(), (*b).into()) as u8)
                    .collect(),
            ),
            (Values::Floats(a), Values::Floats(b)) => Values::Floats(
                a.iter()
                    .zip(b)
                    .map(|(a, b)| f32::from_bits(operation.of(a.to_bits(), b.to_bits())))
                    .collect(),
            ),
            _ => return Err(MatrixError::Mismatch),
        };
        Ok(self.with(values))
    }

    /// All bits inverted; of floats, those that represent them.
    pub fn bitwise_not(&self) -> Self {
        self.with(match &self.values {
            Values::Bytes(values) => Values::Bytes(values.iter().map(|value| !value).collect()),
            Values::Floats(values) => Values::Floats(
                values
                    .iter()
                    .map(|value| f32::from_bits(!value.to_bits()))
                    .collect(),
            ),
        })
    }

    /// Absolute values.
    pub fn abs(&self) -> Self {
        self.map(f64::abs)
    }

    /// e to the power of each value; floats only.
    pub fn exp(&self) -> MatrixResult<Self> {
        self.map_floats("exp", libm::exp)
    }

    /// Natural logarithms; floats only.
    pub fn log(&self) -> MatrixResult<Self> {
        self.map_floats("log", libm::log)
    }

    /// Square roots; floats only.
    pub fn sqrt(&self) -> MatrixResult<Self> {
        self.map_floats("sqrt", f64::sqrt)
    }

    /// Bytes have whole powers only. Of other powers, the absolute value is taken.
    pub fn pow(&self, power: f64) -> MatrixResult<Self> {
        if power.fract() == 0.0 {
            return Ok(self.map(|value| libm::pow(value, power)));
        }
        self.map_floats("a power that is not whole", |value| {
            libm::pow(value.abs(), power)
        })
    }

    /// An image of the same size and format whose pixels all have the given values, one for each channel.
    ///
    /// # Errors
    /// When the image has more than four channels.
    pub fn constant(&self, numbers: &[f64]) -> MatrixResult<Self> {
        self.require(self.channels <= SCALAR, "an operation with numbers")?;
        let numbers: Vec<f64> = (0..self.channels)
            .map(|i| numbers.get(i).copied().unwrap_or_default())
            .collect();
        fn repeated<T: Value>(numbers: &[f64], count: usize) -> Vec<T> {
            let pixel: Vec<T> = numbers.iter().map(|number| T::from_f64(*number)).collect();
            pixel.repeat(count)
        }
        let count = self.width * self.height;
        Ok(self.with(match &self.values {
            Values::Bytes(_) => Values::Bytes(repeated(&numbers, count)),
            Values::Floats(_) => Values::Floats(repeated(&numbers, count)),
        }))
    }

    /// Each value with the number of its channel; numbers are not limited to what a byte can be.
    fn zip_numbers(
        &self,
        numbers: &[f64],
        operation: impl Fn(f64, f64) -> f64,
    ) -> MatrixResult<Self> {
        self.require(self.channels <= SCALAR, "an operation with numbers")?;
        let number = |at: usize| numbers.get(at).copied().unwrap_or_default();
        fn all<T: Value>(
            values: &[T],
            channels: usize,
            operation: impl Fn(usize, f64) -> f64,
        ) -> Vec<T> {
            let pixels = values.chunks_exact(channels);
            pixels
                .flat_map(|pixel| {
                    pixel
                        .iter()
                        .enumerate()
                        .map(|(i, v)| T::from_f64(operation(i, v.to_f64())))
                })
                .collect()
        }
        let values = with_values!(self, values => all(values, self.channels, |i, value| operation(value, number(i))));
        Ok(self.with(values))
    }

    /// Adds to each channel its number; missing ones are 0.
    pub fn add_numbers(&self, numbers: &[f64]) -> MatrixResult<Self> {
        self.zip_numbers(numbers, |a, b| a + b)
    }

    /// Subtracts from each channel its number; missing ones are 0.
    pub fn subtract_numbers(&self, numbers: &[f64]) -> MatrixResult<Self> {
        self.zip_numbers(numbers, |a, b| a - b)
    }

    /// The absolute difference of each channel and its number; missing ones are 0.
    pub fn difference_to_numbers(&self, numbers: &[f64]) -> MatrixResult<Self> {
        self.zip_numbers(numbers, |a, b| (a - b).abs())
    }

    /// The numbers divided by the values.
    pub fn divide_numbers(&self, numbers: &[f64]) -> MatrixResult<Self> {
        let divide = quotient(self.format().depth);
        self.zip_numbers(numbers, |value, number| divide(number, value))
    }

    /// As [`Matrix::compare`], with numbers.
    pub fn compare_numbers(&self, numbers: &[f64], comparison: Comparison) -> MatrixResult<Self> {
        let holds = self.zip_numbers(
            numbers,
            |a, b| if comparison.holds(a, b) { 255.0 } else { 0.0 },
        )?;
        Ok(holds.converted(Depth::Byte, 1.0))
    }

    fn map(&self, operation: impl Fn(f64) -> f64) -> Self {
        fn all<T: Value>(values: &[T], operation: impl Fn(f64) -> f64) -> Vec<T> {
            values
                .iter()
                .map(|value| T::from_f64(operation(value.to_f64())))
                .collect()
        }
        self.with(with_values!(self, values => all(values, &operation)))
    }

    fn map_floats(&self, name: &'static str, operation: impl Fn(f64) -> f64) -> MatrixResult<Self> {
        self.require(self.format().depth == Depth::Float, name)?;
        Ok(self.map(operation))
    }

    pub(super) fn zip(
        &self,
        other: &Self,
        operation: impl Fn(f64, f64) -> f64,
    ) -> MatrixResult<Self> {
        Ok(self.with(match self.values {
            Values::Bytes(_) => {
                Values::Bytes(self.zip_to(other, |a, b| u8::from_f64(operation(a, b)))?)
            }
            Values::Floats(_) => {
                Values::Floats(self.zip_to(other, |a, b| numbers::single(operation(a, b)))?)
            }
        }))
    }

    fn zip_to<T>(&self, other: &Self, operation: impl Fn(f64, f64) -> T) -> MatrixResult<Vec<T>> {
        fn all<A: Value, T>(a: &[A], b: &[A], operation: impl Fn(f64, f64) -> T) -> Vec<T> {
            a.iter()
                .zip(b)
                .map(|(a, b)| operation(a.to_f64(), b.to_f64()))
                .collect()
        }
        self.require_same(other)?;
        match (&self.values, &other.values) {
            (Values::Bytes(a), Values::Bytes(b)) => Ok(all(a, b, operation)),
            (Values::Floats(a), Values::Floats(b)) => Ok(all(a, b, operation)),
            _ => Err(MatrixError::Mismatch),
        }
    }

    /// # Errors
    /// Unless another image has the same size and format.
    pub(super) fn require_same(&self, other: &Self) -> MatrixResult<PixelFormat> {
        let is_same = self.size() == other.size() && self.format() == other.format();
        if is_same {
            Ok(self.format())
        } else {
            Err(MatrixError::Mismatch)
        }
    }
}

fn quotient(depth: Depth) -> impl Fn(f64, f64) -> f64 {
    move |a, b| {
        if b == 0.0 && depth == Depth::Byte {
            0.0
        } else {
            a / b
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};
    use super::*;

    fn pair(a: u8, b: u8) -> (Matrix, Matrix) {
        (bytes([1, 1], 1, &[a]), bytes([1, 1], 1, &[b]))
    }

    fn of(result: MatrixResult<Matrix>) -> f64 {
        result.unwrap().value(0).unwrap()
    }

    #[test]
    fn bytes_saturate() {
        let (a, b) = pair(200, 100);
        assert_eq!(of(a.add(&b)), 255.0);
        assert_eq!(of(b.subtract(&a)), 0.0);
        assert_eq!(of(b.difference(&a)), 100.0);
        assert_eq!(of(a.multiply(&b)), 255.0);
        assert_eq!(of(a.divide(&b)), 2.0);
        assert_eq!(of(a.divide(&pair(0, 0).0)), 0.0);
        assert_eq!(of(a.add_weighted(&b, [0.5, 0.25, 1.0])), 126.0);
        assert_eq!(of(pair(3, 0).0.pow(2.0).map(|m| m.abs())), 9.0);
        assert_eq!(of(a.bitwise(&b, Bitwise::And)), f64::from(200u8 & 100));
        assert_eq!(a.bitwise_not().value(0), Some(55.0));
    }

    #[test]
    fn numbers_have_one_for_each_channel() {
        let image = bytes([1, 1], 3, &[0, 0, 255]);
        assert_eq!(
            image.add_numbers(&[10.0, 10.0, 10.0]).unwrap(),
            bytes([1, 1], 3, &[10, 10, 255])
        );
        assert_eq!(
            image.add_numbers(&[1e9, -5.0]).unwrap(),
            bytes([1, 1], 3, &[255, 0, 255])
        );
        assert_eq!(
            image.divide_numbers(&[9.0, 9.0, 510.0]).unwrap(),
            bytes([1, 1], 3, &[0, 0, 2])
        );
        assert_eq!(
            image
                .compare_numbers(&[0.0, 1.0, 300.0], Comparison::Less)
                .unwrap(),
            bytes([1, 1], 3, &[0, 255, 255])
        );
        assert_eq!(
            image.constant(&[f64::NAN, 2.0]).unwrap(),
            bytes([1, 1], 3, &[0, 2, 0])
        );
        assert!(bytes([1, 1], 5, &[0; 5]).add_numbers(&[]).is_err());
    }

    #[test]
    fn floats_are_ieee() {
        let (a, b) = (floats([1, 1], 1, &[1.0]), floats([1, 1], 1, &[0.0]));
        assert_eq!(of(a.divide(&b)), f64::INFINITY);
        assert_eq!(of(floats([1, 1], 1, &[-4.0]).pow(0.5)), 2.0);
        assert!(of(floats([1, 1], 1, &[-4.0]).sqrt()).is_nan());
        assert_eq!(of(b.exp()), 1.0);
        assert_eq!(of(a.log()), 0.0);
        assert_eq!(
            a.compare(&b, Comparison::Greater).unwrap(),
            bytes([1, 1], 1, &[255])
        );
    }

    #[test]
    fn mismatches_are_errors() {
        let (a, b) = pair(1, 2);
        assert_eq!(
            a.add(&floats([1, 1], 1, &[0.0])),
            Err(MatrixError::Mismatch)
        );
        assert_eq!(
            a.add(&bytes([2, 1], 1, &[0, 0])),
            Err(MatrixError::Mismatch)
        );
        assert_eq!(b.exp(), Err(MatrixError::Format("exp")));
        assert!(MatrixError::Mismatch.to_string().starts_with("OpenCV("));
    }
}
