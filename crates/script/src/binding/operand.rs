//! Numbers and a frame in either order: releases before 4.3 had the frame first.

use super::args::{Args, FromScript};
use super::source::Source;
use crate::error::{ApiError, ApiResult};
use scene::Data;

/// One of two arguments of a setter, of which one is `N` numbers and the other a frame.
pub enum Operand<const N: usize, F> {
    /// The numbers.
    Numbers([f64; N]),
    /// The frame.
    Frame(F),
}

impl<const N: usize, F: FromScript> FromScript for Operand<N, F>
where
    [f64; N]: FromScript,
{
    const TYPE: &'static str = <[f64; N] as FromScript>::TYPE;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        match <[f64; N]>::from_script(args) {
            Ok(numbers) => Ok(Self::Numbers(numbers)),
            Err(
                ApiError::NotA {
                    expected: "table", ..
                }
                | ApiError::ArgumentType,
            ) => F::from_script(args).map(Self::Frame),
            Err(error) => Err(error),
        }
    }
}

impl<const N: usize, F: From<i64>> From<i64> for Operand<N, F> {
    fn from(raw: i64) -> Self {
        Self::Frame(raw.into())
    }
}

impl<const N: usize, F: Into<Data>> From<Operand<N, F>> for Data {
    fn from(operand: Operand<N, F>) -> Self {
        match operand {
            Operand::Numbers(numbers) => numbers.into(),
            Operand::Frame(frame) => frame.into(),
        }
    }
}

/// The numbers and the frame, whichever came first: the third argument or the one before it.
///
/// # Errors
/// When both are numbers, or both frames.
pub fn arranged<const N: usize, F>(
    first: Operand<N, impl Into<F>>,
    second: Operand<N, impl Into<F>>,
) -> ApiResult<([f64; N], F)> {
    let expected = match (first, second) {
        (Operand::Numbers(numbers), Operand::Frame(frame)) => return Ok((numbers, frame.into())),
        (Operand::Frame(frame), Operand::Numbers(numbers)) => return Ok((numbers, frame.into())),
        (Operand::Numbers(_), Operand::Numbers(_)) => "number",
        (Operand::Frame(_), Operand::Frame(_)) => "table",
    };
    Err(ApiError::NotA {
        position: 3,
        expected,
    })
}
