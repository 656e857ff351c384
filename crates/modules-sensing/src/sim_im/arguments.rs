//! Arguments of `simIM`: lists of integers of a known length, and lists of handles.

use crate::{ApiError, Args, FromScript, Result};
use scene::Data;
use script::{Source, Table};

/// Integers; a longer table is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ints<const N: usize>(pub [i64; N]);

impl<const N: usize> Ints<N> {
    /// The same as floats.
    pub(super) fn floats(self) -> [f64; N] {
        self.0.map(|number| number as f64)
    }
}

impl<const N: usize> From<[i64; N]> for Ints<N> {
    fn from(numbers: [i64; N]) -> Self {
        Self(numbers)
    }
}

impl<const N: usize> From<Ints<N>> for Data {
    fn from(Ints(numbers): Ints<N>) -> Self {
        numbers.into()
    }
}

impl<const N: usize> FromScript for Ints<N> {
    const TYPE: &'static str = match N {
        2 => "int[2]",
        3 => "int[3]",
        _ => "int[]",
    };

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let numbers = Vec::<i64>::from_script(args)?;
        numbers
            .first_chunk()
            .copied()
            .map(Self)
            .ok_or(ApiError::TableSize)
    }
}

/// Handles of images.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct HandleList(pub Vec<String>);

impl FromScript for HandleList {
    const TYPE: &'static str = "string[]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let Table(Data::Array(items)) = Table::from_script(args)? else {
            return Ok(Self(Vec::new()));
        };
        let text = |item: Data| match item {
            Data::Text(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
            _ => Err(ApiError::NotA {
                position: -1,
                expected: "string",
            }),
        };
        items.into_iter().map(text).collect::<Result<_>>().map(Self)
    }
}
