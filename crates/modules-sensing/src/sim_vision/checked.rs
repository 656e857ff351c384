//! Arguments whose errors have the words of CoppeliaSim's plugins.

use crate::{ApiError, Args, FromScript, Result};
use scene::Data;
use script::{Absence, Source};

/// An argument that must be there and be right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Checked<T>(pub T);

impl<T> From<T> for Checked<T> {
    fn from(value: T) -> Self {
        Self(value)
    }
}

impl<T: Into<Data>> From<Checked<T>> for Data {
    fn from(Checked(value): Checked<T>) -> Self {
        value.into()
    }
}

impl<T: FromScript> FromScript for Checked<T> {
    const TYPE: &'static str = T::TYPE;
    const ABSENCE: Absence = Absence::Decoded;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        T::from_script(args)
            .map(Self)
            .map_err(|error| worded(&error, i64::from(args.position())))
    }
}

fn worded(error: &ApiError, position: i64) -> ApiError {
    match error {
        ApiError::MoreArguments => ApiError::Other("Not enough arguments.".into()),
        ApiError::TableSize => wrong_size(position),
        _ => wrong(position),
    }
}

/// The error for an argument of the wrong type or value.
pub(super) fn wrong(position: i64) -> ApiError {
    ApiError::Other(format!("Argument {position} is not correct."))
}

/// The error for a table that is too short.
pub(super) fn wrong_size(position: i64) -> ApiError {
    ApiError::Other(format!(
        "Argument {position} is not correct (wrong table size)."
    ))
}
