//! Conversions of numbers that may lose something, by names that say what.

#![warn(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss
)]

/// The whole part, as CoppeliaSim takes it where it wants integers; numbers that are too large become the largest integer, NaN becomes 0.
#[expect(
    clippy::cast_possible_truncation,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn truncated(number: f64) -> i64 {
    number as i64
}

/// The whole part as an integer of 32 bits: the largest or smallest one if the number is too large, 0 for NaN.
#[expect(
    clippy::cast_possible_truncation,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn truncated_i32(number: f64) -> i32 {
    number as i32
}

/// The whole part as an integer of 32 bits without a sign: 0 below zero and for NaN, the largest one if the number is too large.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn truncated_u32(number: f64) -> u32 {
    number as u32
}

/// The whole part as an index or a length: 0 below zero and for NaN, the largest one if the number is too large.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn index(number: f64) -> usize {
    number as usize
}

/// The nearest number of single precision, which is what CoppeliaSim keeps of many numbers.
#[expect(
    clippy::cast_possible_truncation,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn single(number: f64) -> f32 {
    number as f32
}

/// A level of a colour or a pixel: the whole part, 0 to 255 at most.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn level(number: f64) -> u8 {
    number as u8
}

/// A count of what is in memory, or an index of it: an integer of scripts can always hold it.
#[expect(
    clippy::cast_possible_wrap,
    reason = "nothing in memory has more than i64::MAX bytes"
)]
#[inline]
pub const fn count(items: usize) -> i64 {
    items as i64
}

/// The lowest 32 bits, with a sign, as C keeps of integers that are too large.
#[expect(
    clippy::cast_possible_truncation,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn low_i32(integer: i64) -> i32 {
    integer as i32
}

/// The lowest 32 bits, as C keeps of integers that are too large.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn low_u32(integer: i64) -> u32 {
    integer as u32
}

/// The whole part as an integer of 64 bits without a sign: 0 below zero and for NaN, the largest one if the number is too large.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "that is what the function is for; the cast saturates"
)]
#[inline]
pub const fn truncated_u64(number: f64) -> u64 {
    number as u64
}

/// A count of what is in memory, or an index of it, in 32 bits: for what never has more items than an integer of files can hold.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn count_i32(items: usize) -> i32 {
    items as i32
}

/// A count of what is in memory, or an index of it, in 32 bits without a sign: for lists, such as those of meshes, whose indices have 32 bits.
#[expect(
    clippy::cast_possible_truncation,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn count_u32(items: usize) -> u32 {
    items as u32
}

/// A count of what is in memory, or an index of it, in 64 bits.
#[inline]
pub const fn count_u64(items: usize) -> u64 {
    items as u64
}

/// An index of 32 bits, as meshes have, as a place in memory, which has at least as many bits wherever this is built for.
#[inline]
pub const fn place(index: u32) -> usize {
    index as usize
}

/// An integer that is known not to be negative, as a place in memory.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the caller has checked the integer"
)]
#[inline]
pub const fn place_of(integer: i64) -> usize {
    integer as usize
}

/// A count of what is in memory, or an index of it, as a number with a fraction: exact up to 2^53.
#[expect(
    clippy::cast_precision_loss,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn real(items: usize) -> f64 {
    items as f64
}

/// An integer as a number with a fraction: exact up to 2^53, the nearest one beyond.
#[expect(
    clippy::cast_precision_loss,
    reason = "that is what the function is for"
)]
#[inline]
pub const fn real_of(integer: i64) -> f64 {
    integer as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lost() {
        assert_eq!([2.9, -2.9, f64::NAN].map(truncated), [2, -2, 0]);
        assert_eq!(
            [1e300, f64::NEG_INFINITY].map(truncated),
            [i64::MAX, i64::MIN]
        );
        assert_eq!([2.9, -1e300].map(truncated_i32), [2, i32::MIN]);
        assert_eq!([-2.9, 2.9, 1e300].map(truncated_u32), [0, 2, u32::MAX]);
        assert_eq!(
            [-2.9, 2.9, 1e300, f64::NAN].map(index),
            [0, 2, usize::MAX, 0]
        );
        assert_eq!(
            [-1.0, 0.9, 255.9, 256.0, f64::NAN].map(level),
            [0, 0, 255, 255, 0]
        );
        assert_eq!([0.1, 1e300].map(single), [0.1, f32::INFINITY]);
        assert_eq!([-1, 1 << 31, (1 << 32) + 5].map(low_i32), [-1, i32::MIN, 5]);
        assert_eq!(
            [-1, 1 << 31, (1 << 32) + 5].map(low_u32),
            [u32::MAX, 1 << 31, 5]
        );
        assert_eq!(count(3), 3);
        assert_eq!([-2.9, 2.9, 1e300].map(truncated_u64), [0, 2, u64::MAX]);
        assert_eq!(
            (
                count_i32(3),
                count_u32(3),
                count_u64(3),
                place(3),
                place_of(3)
            ),
            (3, 3, 3, 3, 3)
        );
        assert_eq!((real(3), real_of(-3)), (3.0, -3.0));
        assert_eq!([count_i32(1 << 31), low_i32(1 << 31)], [i32::MIN, i32::MIN]);
    }
}
